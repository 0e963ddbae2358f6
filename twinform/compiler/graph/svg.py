"""Draws a graph as SVG: one file without scripts and fonts of others, with colors for light and dark screens."""

from collections.abc import Iterator, Mapping
from xml.sax.saxutils import escape

from twinform.compiler.graph.graph import Graph, GraphNode, shortened
from twinform.compiler.graph.layout import BEND, BOX, MARGIN, GraphLayout, Hold, LayoutBox, layout, text_width, words_of

_TITLE = 34
"""Room above the drawing for its title."""
_LEAST_WIDTH = 360
_OF_TITLE = 9.6
_CURVE = 22
_SPOKEN = 30
_ROWS = (("name", -5), ("small", 13), ("how", 27))
"""Where the words of a joint stand, from the line to its child: name, type, and which joint it follows."""
_SORTS: Mapping[str, str] = {
    "fixed": "fixed",
    "revolute": "turns",
    "continuous": "turns",
    "prismatic": "slides",
}
"""Classes of joints that have a color; the type stands at each."""
_STYLE = """
:root:is(svg){background:#fff}.page{fill:#fff}
.link,.world{fill:#eef3f9;stroke:#52677d}.frame{fill:none;stroke:#52677d;stroke-dasharray:5 3}
.include{fill:#f6f0e0;stroke:#80631d}.missing{fill:none;stroke:#b3261e;stroke-dasharray:5 3}.world{stroke-width:3}
.cluster{fill:#52677d;fill-opacity:.06;stroke:#8496a9}.edge{fill:none;stroke:#6a7a8a;stroke-width:1.5}
.turns{stroke:#1f5fa8}.slides{stroke:#1c7a45}.moves{stroke:#7b3fa0}.attached{stroke-dasharray:3 3}
.across{stroke-dasharray:7 4}.follows{stroke:#a3480f;stroke-dasharray:2 4}
text{font:13px system-ui,sans-serif;fill:#1b2733}.small{font-size:11px;fill:#43566a}
.name{font-size:11px;font-weight:600}.title{font-size:16px;font-weight:600}.gone{fill:#b3261e}.how{font-size:11px;fill:#8a3c0b}
@media (prefers-color-scheme:dark){:root:is(svg){background:#12181f}.page{fill:#12181f}
.link,.world{fill:#1f2a36;stroke:#8fa3b8}.frame{stroke:#8fa3b8}
.include{fill:#2f2915;stroke:#d0ac55}.missing{stroke:#ff8a80}.cluster{fill:#8fa3b8;stroke:#5d7186}.edge{stroke:#8b9cad}
.turns{stroke:#78b4f5}.slides{stroke:#6fd39b}.moves{stroke:#cf9bf0}.follows{stroke:#f0a06c}
text{fill:#e8eef5}.small{fill:#b3c1d0}.gone{fill:#ff8a80}.how{fill:#f0a06c}}
""".strip()


def svg(graph: Graph) -> str:
    """Return a drawing with the children of each link to its right, and the joints at the lines between them."""
    places = layout(graph)
    room = places.width + 2 * _CURVE * bool(graph.followers)
    width = max(room, _LEAST_WIDTH, text_width((shortened(graph.title),), _OF_TITLE) + 2 * MARGIN)
    height = places.height + _TITLE + MARGIN / 2
    title, summary = _write_name(graph.title or "model"), escape(graph.summary())
    size = f'width="{width:.0f}" height="{height:.0f}" viewBox="0 0 {width:.0f} {height:.0f}"'
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img" aria-labelledby="twinform-title twinform-about">',
        f'<title id="twinform-title">{title}</title>',
        f'<desc id="twinform-about">{summary}. {escape(" ".join(_describe_joints(graph)))}</desc>',
        f"<style>{_STYLE}</style>",
        '<rect class="page" width="100%" height="100%"/>',
        f'<text class="title" x="{MARGIN}" y="28">{title}</text>',
        f'<text class="small" x="{MARGIN}" y="46">{summary}</text>',
        f'<g transform="translate(0 {_TITLE})">',
    )
    body = (
        *_draw_clusters(graph, places),
        *_draw_edges(graph, places),
        *(_draw_node(each, places) for each in graph.nodes),
    )
    return "\n".join((*head, *body, "</g>", "</svg>")) + "\n"


def _describe_joints(graph: Graph) -> Iterator[str]:
    """Yield the joints of a small graph as sentences, for screen readers."""
    names = {node.id: shortened(node.label) for node in graph.nodes}
    for joint in graph.joints if len(graph.joints) <= _SPOKEN else ():
        yield f"{shortened(joint.label)}, {joint.type}, from {names[joint.parent]} to {names[joint.child]}."


def _draw_clusters(graph: Graph, places: GraphLayout) -> Iterator[str]:
    for cluster in graph.clusters:
        if box := places.clusters.get(cluster.id):
            yield f'<rect class="cluster" {_write_box(box)} rx="8"/>'
            yield f'<text class="small" x="{box.x + 8:.1f}" y="{box.y + 13:.1f}">{_write_name(cluster.name)}</text>'


def _draw_node(node: GraphNode, places: GraphLayout) -> str:
    box = places.boxes[node.id]
    corner = BOX / 2 if node.kind == "frame" else 4
    framed = node.cluster in places.clusters or "::" not in node.name
    scope = "" if framed else _write_name(node.name.removesuffix(node.label).removesuffix("::"))
    above = f'<text class="small" x="{box.x:.1f}" y="{box.y - 4:.1f}">{scope}</text>' if scope else ""
    tone = ' class="gone"' if node.kind == "missing" else ""
    what = "" if node.kind == "link" else f" ({node.kind})"
    x, y = box.x + box.width / 2, box.middle + 4.5
    return (
        f'<g><title>{_write_name(node.name)}{what}</title><rect class="{node.kind}" {_write_box(box)} rx="{corner:g}"/>'
        f'<text{tone} x="{x:.1f}" y="{y:.1f}" text-anchor="middle">{_write_name(node.label)}</text>{above}</g>'
    )


def _draw_edges(graph: Graph, places: GraphLayout) -> Iterator[str]:
    anchors: dict[str, tuple[float, float]] = {}
    for hold in places.holds:
        yield _draw_hold(hold, places)
        if hold.joint:
            child = places.boxes[hold.child]
            anchors[hold.joint.id] = child.right, child.middle
    for joint in places.across:
        parent, child = places.boxes[joint.parent], places.boxes[joint.child]
        start, end = (parent.x + parent.width / 2, parent.bottom), (child.x + child.width / 2, child.bottom)
        yield f'<path class="edge across {_choose_class(joint.type)}" d="{_draw_curve(start, end)}"/>'
        x, y = anchors[joint.id] = (start[0] + end[0]) / 2, max(start[1], end[1]) + _CURVE * 0.75
        words = " \N{EM DASH} ".join(words_of(joint))
        yield f'<text class="small" x="{x:.1f}" y="{y + 12:.1f}" text-anchor="middle">{escape(words)}</text>'
    nodes = {node.id: (places.boxes[node.id].right, places.boxes[node.id].middle) for node in graph.nodes}
    for each in graph.followers:
        start, end = anchors[each.joint], anchors.get(each.leader) or nodes[each.leader]
        yield f'<path class="edge follows" d="{_draw_arc(start, end)}"/>'


def _draw_hold(hold: Hold, places: GraphLayout) -> str:
    """Draw the line that leads to a node, with the words above and below its last part."""
    parent, child = places.boxes[hold.parent], places.boxes[hold.child]
    x, y = parent.right, child.middle
    bend, turn = x + BEND / 2, x + BEND
    start = f"M{x:.1f} {parent.middle:.1f}C{bend:.1f} {parent.middle:.1f}"
    path = f"{start} {bend:.1f} {y:.1f} {turn:.1f} {y:.1f}H{child.x:.1f}"
    sort = _choose_class(hold.joint.type) if hold.joint else "attached"
    line = f'<path class="edge {sort}" d="{path}"/>'
    if not hold.words:
        return line
    rows = zip(_ROWS, hold.words, strict=False)
    end = f'x="{child.x - 6:.1f}" text-anchor="end"'
    words = (f'<text class="{row}" {end} y="{y + below:.1f}">{escape(word)}</text>' for (row, below), word in rows)
    return "".join((line, *words))


def _choose_class(type_: str) -> str:
    return _SORTS.get(type_, "moves")


def _draw_curve(start: tuple[float, float], end: tuple[float, float]) -> str:
    low = max(start[1], end[1]) + _CURVE
    return f"M{start[0]:.1f} {start[1]:.1f}C{start[0]:.1f} {low:.1f} {end[0]:.1f} {low:.1f} {end[0]:.1f} {end[1]:.1f}"


def _draw_arc(start: tuple[float, float], end: tuple[float, float]) -> str:
    """Return the path of an arc between the right sides of two boxes."""
    far = max(start[0], end[0]) + _CURVE + abs(start[1] - end[1]) / 8
    return f"M{start[0]:.1f} {start[1]:.1f}C{far:.1f} {start[1]:.1f} {far:.1f} {end[1]:.1f} {end[0]:.1f} {end[1]:.1f}"


def _write_box(box: LayoutBox) -> str:
    return f'x="{box.x:.1f}" y="{box.y:.1f}" width="{box.width:.1f}" height="{box.height:.1f}"'


def _write_name(name: str) -> str:
    return escape(shortened(name))
