"""The section with the kinematic tree: links with their joints, masses and numbers of findings, and a drawing."""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from twinform.compiler.graph import Graph, GraphJoint, GraphNode
from twinform.compiler.graph.layout import depth_first
from twinform.compiler.graph.svg import svg
from twinform.diagnostics import Diagnostic
from twinform.ir.motion import spanning_tree
from twinform.report.content import WORDS, ModelReport, ReportSubject
from twinform.report.findings_section import anchors
from twinform.report.markup import Markup, Part, count, element, folded, image, join

# Browsers flatten elements nested deeper than about 500, and a chain of 1,000 links is nothing
# unusual in tests. Below this level the rest is one list.
_DEEPEST = 40
_OPEN = 300
"""Larger trees begin folded."""
_DRAWN = 400
"""Larger trees have no drawing."""


def tree(report: ModelReport) -> Markup | None:
    """List the tree of the first file, with a folded drawing."""
    graph = report.first.graph
    if graph is None or not graph.nodes:
        return None
    listed = element("ul", *_list_tree(report.first, graph), class_="tree")
    return join((element("p", graph.summary()), listed, _drawing(graph)))


def _drawing(graph: Graph) -> Markup | None:
    if len(graph.nodes) > _DRAWN:
        return None
    picture = image(svg(graph), alt=f"{graph.title}: {graph.summary()}")
    scroller = element("div", picture, class_="scroller", tabindex="0", role="region", aria_label="Drawing of the tree")
    return folded("Drawing", scroller)


def _list_tree(subject: ReportSubject, graph: Graph) -> Iterator[Markup]:
    """Yield an item for each root, made from the leaves up so that nothing recurses."""
    held = spanning_tree(joint for joint in graph.joints if joint.type != "gearbox")
    across: dict[str, list[GraphJoint]] = defaultdict(list)
    children: dict[str, list[str]] = defaultdict(list)
    for joint in graph.joints:
        if held.get(joint.child) is not joint:
            across[joint.parent].append(joint)
    for node in graph.nodes:
        if node.id in held:
            children[held[node.id].parent].append(node.id)
    nodes = {node.id: node for node in graph.nodes}
    about, places = _findings_by_node(subject, graph), anchors(subject)
    masses = {link.name: link.mass.mass for link in (subject.scene.links if subject.scene else ()) if link.mass}
    order = depth_first([node.id for node in graph.nodes if node.id not in held], children)
    is_open = len(graph.nodes) <= _OPEN
    made: dict[str, list[Markup]] = {}
    for name, level in reversed(order):
        node = nodes[name]
        loops = (f"{each.name} ({each.type}) closes a loop to {nodes[each.child].name}" for each in across[name])
        words = _words(node, held.get(node.id), masses.get(node.name), _badge(about[node.id], places), loops)
        below = [item for child in children[node.id] for item in made.pop(child)]
        if not below or level >= _DEEPEST:
            own = element(
                "li", *words, element("span", f" level {level}", class_="quiet") if level > _DEEPEST else None
            )
            made[node.id] = [own, *below]
        else:
            made[node.id] = [element("li", folded(join(words), element("ul", *below), open_=is_open))]
    for name, level in order:
        if level == 0:
            yield from made[name]


def _words(
    node: GraphNode, joint: GraphJoint | None, mass: float | None, badge: Markup | None, loops: Iterator[str]
) -> list[Part]:
    words: list[Part] = [element("b", node.name, class_=node.kind)]
    if node.kind != "link":
        words.append(f" ({node.kind})")
    if joint:
        words.append(element("span", f" {joint.name}: {', '.join((joint.type, *joint.details))}", class_="quiet"))
    if mass is not None:
        words.append(element("span", f" {mass:.4g} kg", class_="quiet"))
    if badge:
        words += [" ", badge]
    words += [element("span", f" {each}", class_="quiet") for each in loops]
    return words


def _badge(about: Sequence[Diagnostic], places: Mapping[int, str]) -> Markup | None:
    """Say how many findings there are about a node, with a link to the first of the worst."""
    if not about:
        return None
    first = max(about, key=lambda each: each.severity)
    href = f"#{places.get(id(first), 'findings')}"
    return element("a", count(len(about), "finding"), href=href, class_=f"badge {WORDS[first.severity]}")


def _findings_by_node(subject: ReportSubject, graph: Graph) -> Mapping[str, list[Diagnostic]]:
    """Collect the findings about each node; those about a joint count for its child."""
    parts = {node.where.path: node.id for node in graph.nodes} | {each.where.path: each.child for each in graph.joints}
    parts.pop("", None)
    found: dict[str, list[Diagnostic]] = defaultdict(list)
    for each in subject.findings.diagnostics:
        path = each.location.path
        while path and path not in parts:
            path = path.rpartition("/")[0]
        if path:
            found[parts[path]].append(each)
    return found
