"""Writes a graph as a Mermaid flowchart, which GitHub and GitLab draw in Markdown, or in DOT, the language of Graphviz.

In Mermaid, names stand in quoted labels, where every character that could mean something is a numeric entity.
"""

from collections.abc import Iterator, Mapping

from twinform.compiler.graph.graph import Cluster, Graph, GraphJoint, GraphNode, indent, shortened, write_clusters
from twinform.lazy import lazy_pattern

MOST_EDGES = 500
MOST_CHARACTERS = 50_000
"""What Mermaid draws where it has its default settings, as on GitHub."""
_SHAPES: Mapping[str, str] = {
    "link": '["{}"]',
    "frame": '{{{{"{}"}}}}',
    "world": '[["{}"]]',
    "include": '[/"{}"/]',
    "missing": '["{}"]:::missing',
}
# A test has Mermaid draw names such as `end`, `<script>` and `#quot;` in a browser.
_PLAIN = lazy_pattern(r"[^\w .,/()-]")
"""Characters with an entity; letters of all scripts stay."""


def mermaid(graph: Graph) -> str:
    """Return a flowchart from the roots down: links are boxes, joints rounded, frames hexagons."""
    lines = [
        "flowchart TD",
        *write_clusters(graph, _write_node, _write_joint, _begin_cluster, "end"),
        *indent(_write_edges(graph)),
    ]
    lines.append("  classDef missing stroke:#c62828,stroke-dasharray:5 4")
    return "\n".join(lines) + "\n"


def fits(graph: Graph, text: str) -> bool:
    """Return whether Mermaid draws a graph with its default settings."""
    edges = 2 * len(graph.joints) + len(graph.attachments) + len(graph.followers)
    return edges <= MOST_EDGES and len(text) <= MOST_CHARACTERS


def escaped(text: str) -> str:
    """Return a text as it stands in a label."""
    plain = shortened(text).replace("\\n", "\\\N{WORD JOINER}n")  # of which it would make a new line
    return _PLAIN.sub(lambda found: f"#{ord(found[0])};", plain)


def _begin_cluster(cluster: Cluster) -> tuple[str]:
    return (f'subgraph {cluster.id}["{escaped(cluster.name) or " "}"]',)


def _write_node(node: GraphNode) -> str:
    return node.id + _SHAPES[node.kind].format(escaped(node.label) or " ")


def _write_joint(joint: GraphJoint) -> str:
    label = "<br>".join(escaped(each) for each in (joint.label, joint.type, *joint.details))
    return f'{joint.id}(["{label}"])'


def _write_edges(graph: Graph) -> Iterator[str]:
    for joint in graph.joints:
        yield f"{joint.parent} --- {joint.id} --> {joint.child}"
    for each in graph.attachments:
        yield f"{each.to} -.- {each.frame}"
    for each in graph.followers:
        label = ", ".join(filter(None, ("mimics", escaped(each.detail))))
        yield f'{each.joint} -. "{label}" .-> {each.leader}'


_DOT_SHAPES: Mapping[str, str] = {
    "link": "shape=box",
    "frame": "shape=hexagon style=dashed",
    "world": "shape=box peripheries=2",
    "include": "shape=folder",
    "missing": 'shape=box style=dashed color="#c62828" fontcolor="#c62828"',
}


def dot(graph: Graph) -> str:
    """Return a directed graph from the roots down: links are boxes, joints ellipses, frames hexagons."""
    lines = [f"digraph {quoted(graph.title)} {{", '  node [fontname="Helvetica"]', '  edge [fontname="Helvetica"]']
    lines += write_clusters(graph, _write_dot_node, _write_dot_joint, _begin_dot_cluster, "}")
    lines += indent(_write_dot_edges(graph))
    return "\n".join((*lines, "}")) + "\n"


def _write_dot_node(node: GraphNode) -> str:
    return f"{node.id} [{_DOT_SHAPES[node.kind]} label={quoted(node.label)}]"


def _write_dot_joint(joint: GraphJoint) -> str:
    # A mimic leads from joint to joint, and neither DOT nor Mermaid has edges between edges. So
    # joints are nodes, as `urdf_to_graphviz` draws them.
    return f'{joint.id} [shape=ellipse color="#1f5fa8" label={_write_dot_joint_label(joint)}]'


def _begin_dot_cluster(cluster: Cluster) -> tuple[str, str]:
    return f"subgraph cluster_{cluster.id} {{", f"label={quoted(cluster.name)}"


def quoted(text: str) -> str:
    """Return a text as a string of DOT in which no escape and no HTML entity has a meaning."""
    return f'"{_dot_escaped(text)}"'


def _dot_escaped(text: str) -> str:
    return shortened(text).replace("\\", "\\\\").replace('"', '\\"').replace("&", "&amp;")


def _write_dot_joint_label(joint: GraphJoint) -> str:
    return '"' + "\\n".join(_dot_escaped(each) for each in (joint.label, joint.type, *joint.details)) + '"'


def _write_dot_edges(graph: Graph) -> Iterator[str]:
    for joint in graph.joints:
        yield f"{joint.parent} -> {joint.id} [dir=none]"
        yield f"{joint.id} -> {joint.child}"
    for each in graph.attachments:
        yield f"{each.to} -> {each.frame} [style=dashed dir=none]"
    for each in graph.followers:
        label = ", ".join(filter(None, ("mimics", each.detail)))
        yield f"{each.joint} -> {each.leader} [style=dotted constraint=false label={quoted(label)}]"
