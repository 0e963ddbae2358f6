"""Writes a graph in DOT, the language of Graphviz."""

from collections import defaultdict
from collections.abc import Iterator, Mapping

from twinform.compiler.graph.graph import Cluster, Graph, GraphJoint
from twinform.compiler.graph.labels import shortened

_SHAPES: Mapping[str, str] = {
    "link": "shape=box",
    "frame": "shape=hexagon style=dashed",
    "world": "shape=box peripheries=2",
    "include": "shape=folder",
    "missing": 'shape=box style=dashed color="#c62828" fontcolor="#c62828"',
}


def dot(graph: Graph) -> str:
    """A directed graph from the roots down: links are boxes, joints ellipses, frames hexagons."""
    inside: dict[str | None, list[Cluster]] = defaultdict(list)
    for cluster in graph.clusters:
        inside[cluster.inside].append(cluster)
    parts: dict[str | None, list[str]] = defaultdict(list)
    for node in graph.nodes:
        parts[node.cluster].append(f"{node.id} [{_SHAPES[node.kind]} label={quoted(node.label)}]")
    for joint in graph.joints:
        # A mimic leads from joint to joint, and neither DOT nor Mermaid has edges between edges. So
        # joints are nodes, as `urdf_to_graphviz` draws them.
        parts[joint.cluster].append(f'{joint.id} [shape=ellipse color="#1f5fa8" label={_joint_label(joint)}]')
    lines = [f"digraph {quoted(graph.title)} {{", '  node [fontname="Helvetica"]', '  edge [fontname="Helvetica"]']
    lines += _clusters(inside, parts)
    lines += (f"  {line}" for line in _edges(graph))
    return "\n".join((*lines, "}")) + "\n"


def quoted(text: str) -> str:
    """A text as a string of DOT, in which neither escapes nor entities of HTML mean anything."""
    return f'"{_escaped(text)}"'


def _escaped(text: str) -> str:
    return shortened(text).replace("\\", "\\\\").replace('"', '\\"').replace("&", "&amp;")


def _joint_label(joint: GraphJoint) -> str:
    return '"' + "\\n".join(_escaped(each) for each in (joint.label, joint.type, *joint.details)) + '"'


def _clusters(inside: Mapping[str | None, list[Cluster]], parts: Mapping[str | None, list[str]]) -> Iterator[str]:
    """The parts of each cluster in a subgraph; a single model needs none."""
    top = inside.get(None, [])
    bare = top[0].id if len(top) == 1 and top[0].kind == "model" else None
    yield from (f"  {part}" for part in parts.get(None, []))
    stack: list[tuple[Cluster | None, int]] = [(cluster, 1) for cluster in reversed(top)]
    while stack:
        one, depth = stack.pop()
        indent = "  " * depth
        if one is None:
            yield f"{indent}}}"
            continue
        if one.id != bare:
            yield f"{indent}subgraph cluster_{one.id} {{"
            yield f"{indent}  label={quoted(one.name)}"
            stack.append((None, depth))
            depth += 1
        yield from (f"{'  ' * depth}{part}" for part in parts.get(one.id, []))
        stack += [(each, depth) for each in reversed(inside.get(one.id, []))]


def _edges(graph: Graph) -> Iterator[str]:
    for joint in graph.joints:
        yield f"{joint.parent} -> {joint.id} [dir=none]"
        yield f"{joint.id} -> {joint.child}"
    for each in graph.attachments:
        yield f"{each.to} -> {each.frame} [style=dashed dir=none]"
    for each in graph.followers:
        label = ", ".join(filter(None, ("mimics", each.detail)))
        yield f"{each.joint} -> {each.leader} [style=dotted constraint=false label={quoted(label)}]"
