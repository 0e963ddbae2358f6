"""HTML of the panel in which names do nothing: its texts, the tree of links and joints, and the script for hovering.

The script, `data/page.js`, gets the labels of nodes and the selected links as JSON.
"""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.compare.comparison import Comparison, Difference
from twinform.compiler.graph.graph import shortened
from twinform.compiler.scene import Scene, SceneJoint, SceneLink
from twinform.diagnostics import Diagnostic, Severity
from twinform.diagnostics.ledger import LedgerEntry
from twinform.ir.motion import spanning_tree
from twinform.view.figure import Rgb
from twinform.view.subject import ViewSubject

# Levels that are indented and can be folded: browsers flatten elements that are nested too deep.
_DEEPEST = 60
_MOST_OPEN = 300
"""With more links than this, what is below the roots is folded at first."""
_STYLE = """<style>
.tf-tree{font-size:0.8em;margin:0.5em 0.75em;overflow-x:auto;white-space:nowrap;line-height:1.6}
.tf-tree details details,.tf-tree details>div{margin-left:0.9em}
.tf-tree summary{margin-left:0}.tf-tree details>div{padding-left:0.9em}
.tf-tree button{font:inherit;color:inherit;background:none;border:0;padding:0 0.2em;border-radius:3px;cursor:pointer}
.tf-tree button:hover{background:rgba(128,128,128,0.25)}
.tf-tree button[aria-current=true]{background:rgb(255,170,0);color:#000}
.tf-tree .by{opacity:0.65}.tf-tree .mark{margin-left:0.3em;cursor:help}
</style>"""


class Mark(NamedTuple):
    """A mark beside a link: its sign, its color in CSS, and its text."""

    sign: str
    color: str
    text: str


class _TreeRow(NamedTuple):
    link: str
    joint: SceneJoint | None
    depth: int
    folds: bool


def tree(scene: Scene, marks: Mapping[str, Sequence[Mark]]) -> str:
    """Return the tree of links and joints as HTML; a joint that closes a loop is listed where it closes it."""
    parts: list[str] = []
    open_: list[int] = []
    opens = len(scene.links) <= _MOST_OPEN
    for row in _list_rows(scene):
        while open_ and open_[-1] >= row.depth:
            open_.pop()
            parts.append("</details>")
        text = _write_row(row, marks.get(row.link, ()))
        if row.folds and row.depth < _DEEPEST:
            parts.append(f"<details{' open' if opens or not row.depth else ''}><summary>{text}</summary>")
            open_.append(row.depth)
        else:
            parts.append(f"<div>{text}</div>")
    return f'{_STYLE}<div class="tf-tree">{"".join(parts)}{"</details>" * len(open_)}</div>'


def _list_rows(scene: Scene) -> Iterator[_TreeRow]:
    hung = spanning_tree(scene.joints)
    below: dict[str, list[SceneJoint]] = {}
    for joint in scene.joints:
        below.setdefault(joint.parent, []).append(joint)
    names = {link.name for link in scene.links}
    roots = [link.name for link in scene.links if link.name not in hung or hung[link.name].parent not in names]
    stack: list[tuple[str, SceneJoint | None, int]] = [(name, hung.get(name), 0) for name in reversed(roots)]
    while stack:
        link, joint, depth = stack.pop()
        children = below.get(link, []) if joint is None or hung.get(link) is joint else []
        yield _TreeRow(link, joint, min(depth, _DEEPEST), bool(children))
        stack += [(each.child, each, depth + 1) for each in reversed(children)]


def _write_row(row: _TreeRow, marks: Sequence[Mark]) -> str:
    joint = row.joint
    name, full = escape(shortened(row.link)), escape(row.link)
    by = f' <span class="by">{escape(joint.type)} {escape(shortened(joint.name))}</span>' if joint else ""
    signs = "".join(
        f'<span class="mark" style="color:{each.color}" title="{escape(each.text)}">{escape(each.sign)}</span>'
        for each in marks
    )
    # The tree is HTML, since viser's buttons neither fold nor scale to a thousand links. A click
    # writes the name into the field "Find", as a person would type it: one way into the selection,
    # which also works where the script does not run.
    return f'<button type="button" data-twinform-link="{full}">{name}</button>{by}{signs}'


CHANGED: Rgb = (220, 40, 40)
ONLY_A: Rgb = (150, 50, 200)
ONLY_B: Rgb = (20, 150, 60)
MEANINGS: Mapping[str, Rgb] = {"in both, and different": CHANGED, "in A only": ONLY_A, "in B only": ONLY_B}
QUIET: Rgb = (110, 116, 125)
_SEVERITIES: Mapping[Severity, tuple[str, Rgb]] = {
    Severity.ERROR: ("\N{BLACK CIRCLE}", (200, 30, 30)),
    Severity.WARNING: ("\N{BLACK CIRCLE}", (190, 105, 0)),
    Severity.INFO: ("\N{WHITE CIRCLE}", QUIET),
}


def css(color: Rgb) -> str:
    """Return a color in CSS."""
    return f"rgb{color}"


def severity_color(found: Diagnostic) -> Rgb:
    """Return the color of a finding."""
    return _SEVERITIES[found.severity][1]


def title(subjects: Sequence[ViewSubject]) -> str:
    """Return the names of the robots or worlds that are shown, with their files."""
    first, *others = map(_name, subjects)
    return f"A: {first}, B: {others[0]}" if others else first


def _name(subject: ViewSubject) -> str:
    parts = [*subject.document.worlds, *subject.document.models]
    file = shortened(Path(subject.path).name)
    return " \N{EM DASH} ".join(filter(None, (shortened(parts[0].name) if len(parts) == 1 else "", file)))


def severity_rank(found: Diagnostic) -> int:
    """Return a key that sorts the worst findings first."""
    return -found.severity


def mark(found: Diagnostic) -> Mark:
    """Return the mark of a finding in the tree."""
    sign, color = _SEVERITIES[found.severity]
    return Mark(sign, css(color), f"{found.severity}: {found.message}")


def heading(text: str, color: Rgb) -> str:
    """Return the heading of a text that has no part of the robot to show."""
    return f'<p style="margin:0.6em 0.75em 0;font-size:0.85em;font-weight:600;color:{css(color)}">{escape(text)}</p>'


def alert(title: str, lines: Iterable[str]) -> str:
    """Return what has gone wrong, in the color of errors."""
    text = "".join(map(paragraph, lines))
    return f'<div role="alert">{heading(title, _SEVERITIES[Severity.ERROR][1])}{text}</div>'


def welcome(subjects: Sequence[ViewSubject], key: str) -> str:
    """Return what to do first."""
    if not any(subject.scene.links for subject in subjects):
        return paragraph("There is no link in it, so there is nothing to see: Findings may say why.")
    return paragraph(f"Click a part of the robot to see what it is; hold {key} and drag it to move its joint.")


def paragraph(text: str) -> str:
    """Return a paragraph of plain text."""
    return f'<p style="margin:0.2em 0.75em;font-size:0.85em;overflow-wrap:anywhere">{escape(text)}</p>'


def more(count: int, what: str) -> str:
    """Return how many more there are than are listed."""
    return paragraph(f"and {count:,} more {what}, which have no row here")


def verdict(subjects: Sequence[ViewSubject]) -> str:
    """Return how many findings there are, and what was left out."""
    found = [each for subject in subjects for each in subject.findings]
    errors = sum(each.severity is Severity.ERROR for each in found)
    warnings = sum(each.severity is Severity.WARNING for each in found)
    lines = [f"{errors} errors, {warnings} warnings, {len(found) - errors - warnings} notes"]
    lines += [f"left out: {reason}" for subject in subjects for reason in subject.scene.left_out]
    lines += [f"no ledger, as it cannot be converted: {each}" for subject in subjects for each in subject.unconverted]
    return "".join(map(paragraph, lines))


def place(found: Diagnostic) -> str:
    """Return the file and line of a finding, which may be those of a file that is included."""
    return f"{shortened(Path(found.location.file or '').name)}:{found.location.line}".lstrip(":")


def finding(found: Diagnostic) -> str:
    """Return the message and help of a finding."""
    return paragraph(found.message) + (paragraph(f"help: {found.help}") if found.help else "")


def legend(colors: Mapping[str, Rgb]) -> str:
    """Return what colors mean."""
    return "".join(heading(f"\N{BLACK SQUARE} {text}", color) for text, color in colors.items())


def compared(comparison: Comparison) -> str:
    """Return whether two robots are the same, and what the colors mean."""
    if comparison.same:
        return paragraph("Both files describe the same robot.")
    return paragraph(f"{len(comparison.counted)} differences, on links of these colors:") + legend(MEANINGS)


def difference(found: Difference) -> str:
    """Return a difference with both values."""
    sides = "".join(paragraph(f"{name}: {side.text}") for name, side in (("A", found.a), ("B", found.b)) if side.text)
    return paragraph(found.message) + sides


def part(link: str, subject: ViewSubject) -> str:
    """Return a table of a link: what the file says, findings, and its fate in a conversion."""
    found = next((each for each in subject.scene.links if each.name == link), None)
    if found is None:
        return ""
    rows = [*_list_facts(found, subject).items()]
    about = subject.about.get(link, ())
    rows += [(str(each.fate if isinstance(each, LedgerEntry) else each.severity), each.message) for each in about]
    cells = "".join(f"<tr><th>{escape(shortened(name))}</th><td>{escape(value)}</td></tr>" for name, value in rows)
    return f'<table style="font-size:0.8em;margin:0.5em 0.75em;text-align:left">{cells}</table>'


def _list_facts(link: SceneLink, subject: ViewSubject) -> Mapping[str, str]:
    joint = next((each for each in subject.scene.joints if each.child == link.name), None)
    visuals = sum(shape.role == "visual" for shape in link.shapes)
    facts = {"link": shortened(link.name), "line": str(link.where.line or "")}
    if joint:
        facts["joint"] = f"{shortened(joint.name)} ({joint.type}) on {shortened(joint.parent)}"
    facts["mass"] = f"{link.mass.mass:g} kg" if link.mass else "none"
    if link.mass:
        facts["center"] = " ".join(f"{each:.4g}" for each in link.mass.center) + " m"
        facts["inertia"] = " ".join(f"{each:.3g}" for each in link.mass.inertia) + " kg m^2 (xx yy zz xy xz yz)"
    facts["shapes"] = f"{visuals} visuals, {len(link.shapes) - visuals} collisions"
    sensors = [each.name for each in subject.scene.sensors if each.link == link.name]
    return facts | ({"sensors": ", ".join(map(shortened, sensors))} if sensors else {})


def difference_colors(comparison: Comparison, subjects: Sequence[ViewSubject]) -> dict[str, Rgb]:
    """Return the colors of links that differ."""
    first, second = (subject.links for subject in subjects)
    found: dict[str, Rgb] = {}
    for link in (link for each in comparison.counted for link in links_of(each, subjects)):
        found[link] = CHANGED if link in first and link in second else ONLY_A if link in first else ONLY_B
    return found


def links_of(difference: Difference, subjects: Sequence[ViewSubject]) -> tuple[str, ...]:
    """Return the links that a difference is seen on."""
    found = (link for subject in subjects for link in _find_links(difference, subject.scene))
    return tuple(dict.fromkeys(found))


def _find_links(difference: Difference, scene: Scene) -> Iterator[str]:
    """Yield the links of a scene that a difference is seen on; with several models, names begin with the model."""
    model = difference.model.rpartition("::")[2]
    names = {difference.name, f"{model}::{difference.name}"}
    joints, frames = difference.group == "joint", difference.group == "frame"
    if not joints:
        yield from (link.name for link in scene.links if link.name in names)
    if joints:
        yield from (joint.child for joint in scene.joints if joint.name in names)
    if frames:
        yield from (frame.link for frame in scene.frames if frame.name in names)


# viser sets the content of its controls as `innerHTML`, where scripts do not run but event handlers
# do. viser reports clicks and drags, but not where the mouse is. Asking the server with each motion
# would need a second picking of all triangles in Python and works in no page without a server; a
# server of our own in front of viser's means a second port. The script asks the scene that is drawn
# already. It uses `window.__viserMutable`, which is not public, so all of it is guarded: where
# something is missing there is no tip and no error.
_RUN = "if(!window.twinform?.show){const s=document.createElement('script');s.textContent=this.dataset.script;\
document.head.append(s)}twinform.show(JSON.parse(this.dataset.news))"


def control(labels: Mapping[str, str], selected: Iterable[str], title: str) -> str:
    """Return HTML for a control of viser that runs the script with labels of nodes, selected links, and a title."""
    news = json.dumps({"labels": dict(labels), "selected": list(selected), "title": title})
    return (
        f'<img hidden alt="" src="data:," onerror="{escape(_RUN)}" '
        f'data-script="{escape(_read_script())}" data-news="{escape(news)}">'
    )


def with_script(page: str, labels: Mapping[str, str]) -> str:
    """Return a page of viser with the script, and labels by names of nodes."""
    # `</script>` in a name would end the script element.
    news = json.dumps({"labels": dict(labels)}).replace("<", "\\u003c")
    before, end, after = page.rpartition("</body>")
    return f"{before}<script>{_read_script()}</script><script>twinform.show({news})</script>{end}{after}"


@cache
def _read_script() -> str:
    return (files("twinform.view") / "data" / "page.js").read_text(encoding="utf-8")
