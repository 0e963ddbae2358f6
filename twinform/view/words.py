"""Text of the panel as HTML in which names do nothing: findings, differences, what is known of a part."""

from collections.abc import Iterable, Mapping, Sequence
from html import escape

from twinform.compiler.compare.comparison import Comparison, Difference
from twinform.compiler.scene import SceneLink
from twinform.diagnostics import Diagnostic, Severity
from twinform.diagnostics.ledger import LedgerEntry
from twinform.view.difference_colors import MEANINGS
from twinform.view.figure import Rgb
from twinform.view.shown_names import shortened
from twinform.view.subject import ViewSubject
from twinform.view.tree_rows import Mark

QUIET: Rgb = (110, 116, 125)
_SEVERITIES: Mapping[Severity, tuple[str, Rgb]] = {
    Severity.ERROR: ("\N{BLACK CIRCLE}", (200, 30, 30)),
    Severity.WARNING: ("\N{BLACK CIRCLE}", (190, 105, 0)),
    Severity.INFO: ("\N{WHITE CIRCLE}", QUIET),
}


def css(color: Rgb) -> str:
    """A color as styles have it."""
    return f"rgb{color}"


def severity_color(found: Diagnostic) -> Rgb:
    """The color of a finding."""
    return _SEVERITIES[found.severity][1]


def severity_rank(found: Diagnostic) -> int:
    """The worst come first."""
    return -found.severity


def mark(found: Diagnostic) -> Mark:
    """What stands in the tree for a finding."""
    sign, color = _SEVERITIES[found.severity]
    return Mark(sign, css(color), f"{found.severity}: {found.message}")


def heading(text: str, color: Rgb) -> str:
    """A line above a text, where there is no part of the robot to show."""
    return f'<p style="margin:0.6em 0.75em 0;font-size:0.85em;font-weight:600;color:{css(color)}">{escape(text)}</p>'


def alert(title: str, lines: Iterable[str]) -> str:
    """What has gone wrong, in the color of errors."""
    text = "".join(map(paragraph, lines))
    return f'<div role="alert">{heading(title, _SEVERITIES[Severity.ERROR][1])}{text}</div>'


def welcome(subjects: Sequence[ViewSubject], key: str) -> str:
    """What there is to do at first."""
    if not any(subject.scene.links for subject in subjects):
        return paragraph("There is no link in it, so there is nothing to see: Findings may say why.")
    return paragraph(f"Click a part of the robot to see what it is; hold {key} and drag it to move its joint.")


def paragraph(text: str) -> str:
    """A text as it is."""
    return f'<p style="margin:0.2em 0.75em;font-size:0.85em;overflow-wrap:anywhere">{escape(text)}</p>'


def more(count: int, what: str) -> str:
    """What is not listed."""
    return paragraph(f"and {count:,} more {what}, which have no row here")


def verdict(subjects: Sequence[ViewSubject]) -> str:
    """How many findings there are."""
    found = [each for subject in subjects for each in subject.findings]
    errors = sum(each.severity is Severity.ERROR for each in found)
    warnings = sum(each.severity is Severity.WARNING for each in found)
    lines = [f"{errors} errors, {warnings} warnings, {len(found) - errors - warnings} notes"]
    lines += [f"left out: {reason}" for subject in subjects for reason in subject.scene.left_out]
    lines += [f"no ledger, as it cannot be converted: {each}" for subject in subjects for each in subject.unconverted]
    return "".join(map(paragraph, lines))


def finding(found: Diagnostic) -> str:
    """A finding without its rule."""
    return paragraph(found.message) + (paragraph(f"help: {found.help}") if found.help else "")


def compared(comparison: Comparison) -> str:
    """Whether two robots are the same."""
    if comparison.same:
        return paragraph("Both files describe the same robot.")
    legend = "".join(heading(f"\N{BLACK SQUARE} {text}", color) for text, color in MEANINGS.items())
    return paragraph(f"{len(comparison.counted)} differences, on links of these colors:") + legend


def difference(found: Difference) -> str:
    """A difference with both values."""
    sides = "".join(paragraph(f"{name}: {side.text}") for name, side in (("A", found.a), ("B", found.b)) if side.text)
    return paragraph(found.message) + sides


def part(link: str, subject: ViewSubject) -> str:
    """What a file says of a link, what was found in it, and what a conversion makes of it."""
    found = next((each for each in subject.scene.links if each.name == link), None)
    if found is None:
        return ""
    rows = [*_facts(found, subject).items()]
    about = subject.about.get(link, ())
    rows += [(str(each.fate if isinstance(each, LedgerEntry) else each.severity), each.message) for each in about]
    cells = "".join(f"<tr><th>{escape(shortened(name))}</th><td>{escape(value)}</td></tr>" for name, value in rows)
    return f'<table style="font-size:0.8em;margin:0.5em 0.75em;text-align:left">{cells}</table>'


def _facts(link: SceneLink, subject: ViewSubject) -> Mapping[str, str]:
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
