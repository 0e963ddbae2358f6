"""The lines of a graph's nodes and joints, in those of the clusters around them."""

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence

from twinform.compiler.graph.graph import Cluster, Graph, GraphJoint, GraphNode

_INDENT = "  "


def clustered(
    graph: Graph,
    node: Callable[[GraphNode], str],
    joint: Callable[[GraphJoint], str],
    begin: Callable[[Cluster], Sequence[str]],
    end: str,
) -> Iterator[str]:
    """The line of each node and joint, between those that begin and end its cluster; a single model needs none.

    Of the lines that begin a cluster all but the first are indented like what is in it.
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
    yield from indented(parts[None])
    stack: list[tuple[Cluster | None, int]] = [(cluster, 1) for cluster in reversed(top)]
    while stack:
        one, depth = stack.pop()
        if one is None:
            yield from indented((end,), depth)
            continue
        if one is not bare:
            first, *more = begin(one)
            yield from indented((first,), depth)
            stack.append((None, depth))
            depth += 1
            yield from indented(more, depth)
        yield from indented(parts[one.id], depth)
        stack += [(each, depth) for each in reversed(inside[one.id])]


def indented(lines: Sequence[str] | Iterator[str], depth: int = 1) -> Iterator[str]:
    """The lines, indented by so many steps."""
    return (_INDENT * depth + line for line in lines)
