"""`Graph`: the links and joints of a document as nodes and edges, in clusters for worlds and models."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Literal

from twinform.dataclass import dataclass
from twinform.diagnostics import NOWHERE, Location
from twinform.diagnostics.reporters import printable

NodeKind = Literal["link", "frame", "world", "include", "missing"]
"""`include` is a model of another file that was not read, and `missing` a name that stands for nothing."""
_LONGEST = 60
_BEGINNING = 40
_INDENT = "  "


@dataclass(frozen=True, slots=True)
class Cluster:
    """A world or model; `inside` is the id of the cluster around it."""

    id: str
    kind: Literal["world", "model"]
    name: str
    inside: str | None = None


@dataclass(frozen=True, slots=True)
class GraphNode:
    """What joints connect; `name` begins with the models around it, `label` does not."""

    id: str
    kind: NodeKind
    name: str
    label: str
    cluster: str | None = None
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class GraphJoint:
    """A joint between two nodes, which are given by id; `details` has the limits of each axis as text."""

    id: str
    name: str
    label: str
    type: str
    parent: str
    child: str
    details: tuple[str, ...] = ()
    cluster: str | None = None
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class Attachment:
    """A frame and the node that it is attached to."""

    frame: str
    to: str


@dataclass(frozen=True, slots=True)
class Follower:
    """A joint that mimics another one, both given by id, and how."""

    joint: str
    leader: str
    detail: str = ""


@dataclass(frozen=True, slots=True)
class Graph:
    """The graph of a document. Ids, unlike names, are short words of letters and digits."""

    title: str
    clusters: tuple[Cluster, ...] = ()
    nodes: tuple[GraphNode, ...] = ()
    joints: tuple[GraphJoint, ...] = ()
    attachments: tuple[Attachment, ...] = ()
    followers: tuple[Follower, ...] = ()

    def summary(self) -> str:
        """Return what is in the graph, in words."""
        kinds = [node.kind for node in self.nodes]
        counts = (
            (kinds.count("link"), "link"),
            (len(self.joints), "joint"),
            (kinds.count("frame"), "frame"),
            (kinds.count("include"), "include"),
            (kinds.count("missing"), "missing part"),
            (len(self.followers), "mimic"),
        )
        found = [f"{count} {word}{'' if count == 1 else 's'}" for count, word in counts if count]
        return ", ".join(found) or "no links"


def shortened(name: str) -> str:
    """Return a name without what a terminal or browser would obey, and without the middle if it is long."""
    if len(name) > _LONGEST:
        name = f"{name[:_BEGINNING]}\N{HORIZONTAL ELLIPSIS}{name[_BEGINNING + 1 - _LONGEST :]}"
    return printable(name)


def write_clusters(
    graph: Graph,
    node: Callable[[GraphNode], str],
    joint: Callable[[GraphJoint], str],
    begin: Callable[[Cluster], Sequence[str]],
    end: str,
) -> Iterator[str]:
    """Yield the line of each node and joint, between the lines that begin and end its cluster; a single model has none.

    Of the lines that begin a cluster, all but the first are indented like its content.
    """
    inside: dict[str | None, list[Cluster]] = defaultdict(list)
    for cluster in graph.clusters:
        inside[cluster.inside].append(cluster)
    parts: dict[str | None, list[str]] = defaultdict(list)
    for each in graph.nodes:
        parts[each.cluster].append(node(each))
    for each in graph.joints:
        parts[each.cluster].append(joint(each))
    top = inside[None]
    bare = top[0] if len(top) == 1 and top[0].kind == "model" else None
    yield from indent(parts[None])
    stack: list[tuple[Cluster | None, int]] = [(cluster, 1) for cluster in reversed(top)]
    while stack:
        one, depth = stack.pop()
        if one is None:
            yield from indent((end,), depth)
            continue
        if one is not bare:
            first, *more = begin(one)
            yield from indent((first,), depth)
            stack.append((None, depth))
            depth += 1
            yield from indent(more, depth)
        yield from indent(parts[one.id], depth)
        stack += [(each, depth) for each in reversed(inside[one.id])]


def indent(lines: Iterable[str], depth: int = 1) -> Iterator[str]:
    """Return the lines indented by this many steps."""
    return (_INDENT * depth + line for line in lines)
