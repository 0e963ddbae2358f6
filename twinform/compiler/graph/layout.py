"""Places a graph for drawing: trees from left to right, a column for each level, a row for each leaf.

What closes a loop takes no place: the joint or attachment that came first holds a node, and the others are drawn
across. Everything is linear in the nodes, and nothing recurses.
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import field
from typing import NamedTuple
from unicodedata import east_asian_width

from twinform.compiler.graph.graph import Graph, GraphJoint, GraphNode, shortened
from twinform.dataclass import dataclass
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
    """The rectangle of a node or cluster."""

    x: float
    y: float
    width: float
    height: float

    @property
    def middle(self) -> float:
        """The y coordinate at which lines meet the box."""
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
    """The edge of the tree that leads to a node, and the words that stand at it."""

    parent: str
    child: str
    words: tuple[str, ...] = ()
    joint: GraphJoint | None = None


@dataclass(slots=True)
class GraphLayout:
    """Boxes by the ids of nodes and clusters, the edges of the trees, and other joints, which are drawn across."""

    boxes: dict[str, LayoutBox] = field(default_factory=dict[str, LayoutBox])
    clusters: dict[str, LayoutBox] = field(default_factory=dict[str, LayoutBox])
    holds: list[Hold] = field(default_factory=list[Hold])
    across: list[GraphJoint] = field(default_factory=list[GraphJoint])
    width: float = 0
    height: float = 0


def words_of(joint: GraphJoint) -> tuple[str, ...]:
    """Return what is written at a joint: its name, and its type with limits."""
    return shortened(joint.label), ", ".join((joint.type, *joint.details))


def _describe_follower(leader: str, detail: str) -> tuple[str]:
    return (", ".join(filter(None, (f"mimics {shortened(leader)}", detail))),)


# A robot is a tree with few other edges, so a tidy layout is linear and short. pygraphviz 2.0 brings Graphviz as 110 MB
# of libraries that would read the names of strangers in this process, takes 17 times as long for 1,000 joints (1.9 s,
# more than linear), and its SVG is three times as large and without colors for dark screens. grandalf is under the GPL
# and was last released in 2023; fast-sugiyama places points: boxes, words at edges and clusters would still be ours.
def layout(graph: Graph) -> GraphLayout:
    """Return the places of all nodes and clusters of a graph."""
    holds, across = _find_holds(graph)
    children: dict[str, list[str]] = defaultdict(list)
    for node in graph.nodes:
        if node.id in holds:
            children[holds[node.id].parent].append(node.id)
    nodes = {node.id: node for node in graph.nodes}
    for below in children.values():
        below.sort(key=lambda each: _cluster_number(nodes[each].cluster))
    order = depth_first([node.id for node in graph.nodes if node.id not in holds], children)
    made = GraphLayout(holds=[holds[each] for each, _ in order if each in holds], across=across)
    _place_boxes(made, order, nodes, holds, children, _measure_depths(graph))
    made.clusters = _frame_clusters(graph, made.boxes)
    _move_to_margin(made)
    return made


def _find_holds(graph: Graph) -> tuple[dict[str, Hold], list[GraphJoint]]:
    """Return the edge that leads to each node, and the joints that are in no tree."""
    tree = spanning_tree(joint for joint in graph.joints if joint.type != "gearbox")
    names = {each.id: each.label for each in (*graph.nodes, *graph.joints)}
    follows = {each.joint: _describe_follower(names[each.leader], each.detail) for each in graph.followers}
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
    """Return all nodes with their levels, each before its children."""
    order: list[tuple[str, int]] = []
    stack = [(root, 0) for root in reversed([*roots])]
    while stack:
        node, level = stack.pop()
        order.append((node, level))
        stack += [(child, level + 1) for child in reversed(children.get(node, ()))]
    return order


def _place_boxes(
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


def _measure_depths(graph: Graph) -> dict[str | None, int]:
    """Return how deep each cluster is nested."""
    found: dict[str | None, int] = {None: 0}
    for cluster in graph.clusters:  # what is around one comes before it
        found[cluster.id] = found[cluster.inside] + 1
    return found


def _frame_clusters(graph: Graph, boxes: Mapping[str, LayoutBox]) -> dict[str, LayoutBox]:
    """Return a frame for each cluster, unless nodes of others would be inside; a single model needs none."""
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
            around = _enclose(inside).grown(10, 16)
            if cluster.id != bare and not _overlaps_others(around, own[cluster.id], boxes):
                found[cluster.id] = around
            if holder := above[cluster.id]:
                inner[holder] += [found.get(cluster.id, _enclose(inside))]
                own[holder] |= own[cluster.id]
    return {cluster.id: found[cluster.id] for cluster in graph.clusters if cluster.id in found}


def _enclose(boxes: Sequence[LayoutBox]) -> LayoutBox:
    x, y = min(box.x for box in boxes), min(box.y for box in boxes)
    return LayoutBox(x, y, max(box.right for box in boxes) - x, max(box.bottom for box in boxes) - y)


def _overlaps_others(around: LayoutBox, own: set[str], boxes: Mapping[str, LayoutBox]) -> bool:
    return any(
        node not in own
        and box.x < around.right
        and around.x < box.right
        and box.y < around.bottom
        and around.y < box.bottom
        for node, box in boxes.items()
    )


def _move_to_margin(made: GraphLayout) -> None:
    """Move everything so that the drawing begins at the margin."""
    every = [*made.boxes.values(), *made.clusters.values()]
    if not every:
        return
    whole = _enclose(every)
    right, down = MARGIN - whole.x, MARGIN - whole.y
    for known in (made.boxes, made.clusters):
        for key, box in known.items():
            known[key] = LayoutBox(box.x + right, box.y + down, box.width, box.height)
    made.width, made.height = whole.width + 2 * MARGIN, whole.height + 2 * MARGIN


def box_width(label: str) -> float:
    """Return the width of a box with a name in it."""
    return text_width((shortened(label),), _LETTER) + _PADDING


def text_width(lines: Iterable[str], letter: float) -> float:
    """Estimate the width of the widest of some lines."""
    return max((sum(2 if east_asian_width(each) in "WF" else 1 for each in line) * letter for line in lines), default=0)


def _cluster_number(cluster: str | None) -> int:
    return int(cluster[1:]) if cluster else -1
