"""Writes a graph in DOT, the language of Graphviz."""

from collections.abc import Iterator, Mapping

from twinform.compiler.graph.graph import Cluster, Graph, GraphJoint, GraphNode, indent, shortened, write_clusters

_SHAPES: Mapping[str, str] = {
    "link": "shape=box",
    "frame": "shape=hexagon style=dashed",
    "world": "shape=box peripheries=2",
    "include": "shape=folder",
    "missing": 'shape=box style=dashed color="#c62828" fontcolor="#c62828"',
}


def dot(graph: Graph) -> str:
    """Return a directed graph from the roots down: links are boxes, joints ellipses, frames hexagons."""
    lines = [f"digraph {quoted(graph.title)} {{", '  node [fontname="Helvetica"]', '  edge [fontname="Helvetica"]']
    lines += write_clusters(graph, _write_node, _write_joint, _begin_cluster, "}")
    lines += indent(_write_edges(graph))
    return "\n".join((*lines, "}")) + "\n"


def _write_node(node: GraphNode) -> str:
    return f"{node.id} [{_SHAPES[node.kind]} label={quoted(node.label)}]"


def _write_joint(joint: GraphJoint) -> str:
    # A mimic leads from joint to joint, and neither DOT nor Mermaid has edges between edges. So
    # joints are nodes, as `urdf_to_graphviz` draws them.
    return f'{joint.id} [shape=ellipse color="#1f5fa8" label={_write_joint_label(joint)}]'


def _begin_cluster(cluster: Cluster) -> tuple[str, str]:
    return f"subgraph cluster_{cluster.id} {{", f"label={quoted(cluster.name)}"


def quoted(text: str) -> str:
    """Return a text as a string of DOT in which no escape and no HTML entity has a meaning."""
    return f'"{_escaped(text)}"'


def _escaped(text: str) -> str:
    return shortened(text).replace("\\", "\\\\").replace('"', '\\"').replace("&", "&amp;")


def _write_joint_label(joint: GraphJoint) -> str:
    return '"' + "\\n".join(_escaped(each) for each in (joint.label, joint.type, *joint.details)) + '"'


def _write_edges(graph: Graph) -> Iterator[str]:
    for joint in graph.joints:
        yield f"{joint.parent} -> {joint.id} [dir=none]"
        yield f"{joint.id} -> {joint.child}"
    for each in graph.attachments:
        yield f"{each.to} -> {each.frame} [style=dashed dir=none]"
    for each in graph.followers:
        label = ", ".join(filter(None, ("mimics", each.detail)))
        yield f"{each.joint} -> {each.leader} [style=dotted constraint=false label={quoted(label)}]"
