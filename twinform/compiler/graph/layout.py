"""Places a graph for drawing: trees from left to right, a column for each level, a row for each leaf.

What closes a loop takes no place: the joint or attachment that came first holds a node, and the others are drawn
across. Everything is linear in the nodes, and nothing recurses.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple
from unicodedata import east_asian_width

from twinform.compiler.graph.graph import Graph, GraphJoint, GraphNode, shortened
from twinform.ir.motion import spanning_tree

BOX = 30
"""The height of a box."""
MARGIN = 24
_ROW = 54
# More room between rows of different clusters, per level of nesting, for their frames and names.
_BETWEEN = 28
BEND = 44
"""How wide a line bends to the height of a child."""
SMALL = 6.4
"""The width of a letter at a joint, and of one in a box."""
_LETTER = 7.6
_PADDING = 24


class LayoutBox(NamedTuple):
    """Where a node or cluster is."""

    x: float
    y: float
    width: float
    height: float

    @property
    def middle(self) -> float:
        """The height that lines meet it at."""
        return self.y + self.height / 2

    @property
    def right(self) -> float:
        """Its right side."""
        return self.x + self.width

    @property
    def bottom(self) -> float:
        """Its lower side."""
        return self.y + self.height

    def grown(self, by: float, above: float = 0) -> "LayoutBox":
        """Return the box with a margin on all sides, and more above."""
        return LayoutBox(self.x - by, self.y - by - above, self.width + 2 * by, self.height + 2 * by + above)


class Hold(NamedTuple):
    """What a node hangs by: an edge from `parent`, and the words that stand at it."""

    parent: str
    child: str
    words: tuple[str, ...] = ()
    joint: GraphJoint | None = None


@dataclass(slots=True)
class GraphLayout:
    """Boxes by the ids of nodes and clusters, edges of the trees, and other joints, which are drawn across."""

    boxes: dict[str, LayoutBox] = field(default_factory=dict[str, LayoutBox])
    clusters: dict[str, LayoutBox] = field(default_factory=dict[str, LayoutBox])
    holds: list[Hold] = field(default_factory=list[Hold])
    across: list[GraphJoint] = field(default_factory=list[GraphJoint])
    width: float = 0
    height: float = 0


def words_of(joint: GraphJoint) -> tuple[str, ...]:
    """What stands at a joint: its name, and its type with limits."""
    return shortened(joint.label), ", ".join((joint.type, *joint.details))


def _following(leader: str, detail: str) -> tuple[str]:
    return (", ".join(filter(None, (f"mimics {shortened(leader)}", detail))),)


# A robot is a tree with few other edges, so a tidy layout is linear and short. pygraphviz 2.0 brings Graphviz as 110 MB
# of libraries that would read the names of strangers in this process, takes 17 times as long for 1,000 joints (1.9 s,
# more than linear), and its SVG is three times as large and without colors for dark screens. grandalf is under the GPL
# and was last released in 2023; fast-sugiyama places points: boxes, words at edges and clusters would still be ours.
def layout(graph: Graph) -> GraphLayout:
    """Where everything of a graph is."""
    holds, across = _holds(graph)
    children: dict[str, list[str]] = defaultdict(list)
    for node in graph.nodes:
        if node.id in holds:
            children[holds[node.id].parent].append(node.id)
    nodes = {node.id: node for node in graph.nodes}
    for below in children.values():
        below.sort(key=lambda each: _place_of(nodes[each].cluster))
    order = depth_first([node.id for node in graph.nodes if node.id not in holds], children)
    made = GraphLayout(holds=[holds[each] for each, _ in order if each in holds], across=across)
    _place(made, order, nodes, holds, children, _depths(graph))
    made.clusters = _frames(graph, made.boxes)
    _fit(made)
    return made


def _holds(graph: Graph) -> tuple[dict[str, Hold], list[GraphJoint]]:
    """What each node hangs by, and the joints that none hangs by."""
    tree = spanning_tree(joint for joint in graph.joints if joint.type != "gearbox")
    names = {each.id: each.label for each in (*graph.nodes, *graph.joints)}
    follows = {each.joint: _following(names[each.leader], each.detail) for each in graph.followers}
    found = {
        child: Hold(joint.parent, child, (*words_of(joint), *follows.get(joint.id, ())), joint)
        for child, joint in tree.items()
    }
    used = {joint.id for joint in tree.values()}
    tops: dict[str, str] = {child: hold.parent for child, hold in found.items()}
    for each in graph.attachments:
        if each.frame not in found and not _hangs_from(each.to, each.frame, tops):
            found[each.frame] = Hold(each.to, each.frame)
            tops[each.frame] = each.to
    return found, [joint for joint in graph.joints if joint.id not in used]


def _hangs_from(node: str, top: str, tops: Mapping[str, str]) -> bool:
    seen = {node}
    while node != top and (node := tops.get(node, node)) not in seen:
        seen.add(node)
    return node == top


def depth_first(roots: Iterable[str], children: Mapping[str, Sequence[str]]) -> list[tuple[str, int]]:
    """All nodes with their levels, each before what hangs from it."""
    order: list[tuple[str, int]] = []
    stack = [(root, 0) for root in reversed([*roots])]
    while stack:
        node, level = stack.pop()
        order.append((node, level))
        stack += [(child, level + 1) for child in reversed(children.get(node, ()))]
    return order


def _place(
    made: GraphLayout,
    order: Sequence[tuple[str, int]],
    nodes: Mapping[str, GraphNode],
    holds: Mapping[str, Hold],
    children: Mapping[str, Sequence[str]],
    depths: Mapping[str | None, int],
) -> None:
    widths: dict[int, float] = defaultdict(float)
    gaps: dict[int, float] = defaultdict(float)
    for node, level in order:
        widths[level] = max(widths[level], box_width(nodes[node].label))
        if node in holds:
            # The words of a joint stand at the line to its child instead of in a node, which halves
            # the depth of the drawing.
            gaps[level] = max(gaps[level], BEND + text_width(holds[node].words, SMALL) + 10)
    columns: list[float] = []
    at = float(MARGIN)
    for level in range(len(widths)):
        at += gaps[level]
        columns.append(at)
        at += widths[level] + 6
    rows: dict[str, float] = {}
    row, last = float(MARGIN), None
    for node, _ in order:
        if not children.get(node):
            cluster = nodes[node].cluster
            row += _BETWEEN * max(depths[last], depths[cluster]) if last not in {None, cluster} else 0
            rows[node], row, last = row, row + _ROW, cluster
    for node, _ in reversed(order):
        if below := children.get(node):
            rows[node] = (rows[below[0]] + rows[below[-1]]) / 2
    for node, level in order:
        made.boxes[node] = LayoutBox(columns[level], rows[node], box_width(nodes[node].label), BOX)


def _depths(graph: Graph) -> dict[str | None, int]:
    """How deep each cluster is nested."""
    found: dict[str | None, int] = {None: 0}
    for cluster in graph.clusters:  # what is around one comes before it
        found[cluster.id] = found[cluster.inside] + 1
    return found


def _frames(graph: Graph, boxes: Mapping[str, LayoutBox]) -> dict[str, LayoutBox]:
    """A frame for each cluster that can have one with nothing of others in it; a single model needs none."""
    tops = [cluster for cluster in graph.clusters if cluster.inside is None]
    bare = tops[0].id if len(tops) == 1 and tops[0].kind == "model" else None
    above = {cluster.id: cluster.inside for cluster in graph.clusters}
    inner: dict[str, list[LayoutBox]] = defaultdict(list)
    own: dict[str, set[str]] = defaultdict(set)
    for node in graph.nodes:
        if node.cluster:
            inner[node.cluster].append(boxes[node.id])
            own[node.cluster].add(node.id)
    found: dict[str, LayoutBox] = {}
    for cluster in reversed(graph.clusters):  # those that are nested come after what they are in
        if inside := inner[cluster.id]:
            around = _around(inside).grown(10, 16)
            if cluster.id != bare and not _holds_others(around, own[cluster.id], boxes):
                found[cluster.id] = around
            if holder := above[cluster.id]:
                inner[holder] += [found.get(cluster.id, _around(inside))]
                own[holder] |= own[cluster.id]
    return {cluster.id: found[cluster.id] for cluster in graph.clusters if cluster.id in found}


def _around(boxes: Sequence[LayoutBox]) -> LayoutBox:
    x, y = min(box.x for box in boxes), min(box.y for box in boxes)
    return LayoutBox(x, y, max(box.right for box in boxes) - x, max(box.bottom for box in boxes) - y)


def _holds_others(around: LayoutBox, own: set[str], boxes: Mapping[str, LayoutBox]) -> bool:
    return any(
        node not in own
        and box.x < around.right
        and around.x < box.right
        and box.y < around.bottom
        and around.y < box.bottom
        for node, box in boxes.items()
    )


def _fit(made: GraphLayout) -> None:
    """Move everything so that it begins at the margin."""
    every = [*made.boxes.values(), *made.clusters.values()]
    if not every:
        return
    whole = _around(every)
    right, down = MARGIN - whole.x, MARGIN - whole.y
    for known in (made.boxes, made.clusters):
        for key, box in known.items():
            known[key] = LayoutBox(box.x + right, box.y + down, box.width, box.height)
    made.width, made.height = whole.width + 2 * MARGIN, whole.height + 2 * MARGIN


def box_width(label: str) -> float:
    """The width of a box with a name in it."""
    return text_width((shortened(label),), _LETTER) + _PADDING


def text_width(lines: Iterable[str], letter: float) -> float:
    """About how wide texts are."""
    return max((sum(2 if east_asian_width(each) in "WF" else 1 for each in line) * letter for line in lines), default=0)


def _place_of(cluster: str | None) -> int:
    return int(cluster[1:]) if cluster else -1
