"""Writes a graph as a Mermaid flowchart, which GitHub and GitLab draw in Markdown.

Names stand in quoted labels, where every character that could mean something is a numeric entity; ids are ours.
"""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

from twinform.compiler.graph.graph import Cluster, Graph, GraphJoint, GraphNode
from twinform.compiler.graph.labels import shortened

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
_PLAIN = re.compile(r"[^\w .,/()-]")
"""Characters with an entity; letters of all scripts stay."""


def mermaid(graph: Graph) -> str:
    """A flowchart from the roots down: links are boxes, joints rounded, frames hexagons."""
    inside: dict[str | None, list[Cluster]] = defaultdict(list)
    for cluster in graph.clusters:
        inside[cluster.inside].append(cluster)
    parts: dict[str | None, list[str]] = defaultdict(list)
    for node in graph.nodes:
        parts[node.cluster].append(_node(node))
    for joint in graph.joints:
        parts[joint.cluster].append(f'{joint.id}(["{_joint_label(joint)}"])')
    lines = ["flowchart TD", *_indented(_clusters(inside, parts)), *_indented(_edges(graph))]
    lines.append("  classDef missing stroke:#c62828,stroke-dasharray:5 4")
    return "\n".join(lines) + "\n"


def fits(graph: Graph, text: str) -> bool:
    """Whether Mermaid draws it with its default settings."""
    edges = 2 * len(graph.joints) + len(graph.attachments) + len(graph.followers)
    return edges <= MOST_EDGES and len(text) <= MOST_CHARACTERS


def escaped(text: str) -> str:
    """A text in a label."""
    plain = shortened(text).replace("\\n", "\\\N{WORD JOINER}n")  # of which it would make a new line
    return _PLAIN.sub(lambda found: f"#{ord(found[0])};", plain)


def _clusters(inside: Mapping[str | None, list[Cluster]], parts: Mapping[str | None, list[str]]) -> Iterator[str]:
    """The parts of each cluster in a subgraph; a single model needs none."""
    top = inside.get(None, [])
    bare = top[0].id if len(top) == 1 and top[0].kind == "model" else None
    yield from parts.get(None, [])
    stack: list[Cluster | str] = list(reversed(top))
    while stack:
        one = stack.pop()
        if isinstance(one, str):
            yield one
            continue
        if one.id != bare:
            yield f'subgraph {one.id}["{escaped(one.name) or " "}"]'
            stack.append("end")
        yield from parts.get(one.id, [])
        stack += reversed(inside.get(one.id, []))


def _node(node: GraphNode) -> str:
    return node.id + _SHAPES[node.kind].format(escaped(node.label) or " ")


def _joint_label(joint: GraphJoint) -> str:
    return "<br>".join(escaped(each) for each in (joint.label, joint.type, *joint.details))


def _edges(graph: Graph) -> Iterator[str]:
    for joint in graph.joints:
        yield f"{joint.parent} --- {joint.id} --> {joint.child}"
    for each in graph.attachments:
        yield f"{each.to} -.- {each.frame}"
    for each in graph.followers:
        label = ", ".join(filter(None, ("mimics", escaped(each.detail))))
        yield f'{each.joint} -. "{label}" .-> {each.leader}'


def _indented(lines: Iterable[str]) -> Iterator[str]:
    depth = 1
    for line in lines:
        depth -= line == "end"
        yield f"{'  ' * depth}{line}"
        depth += line.startswith("subgraph ")
