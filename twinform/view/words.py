"""Text of the panel as HTML in which names do nothing: the tree, findings, differences, what is known of a part."""

from collections.abc import Mapping, Sequence
from html import escape

from twinform.compiler.compare.comparison import Comparison, Difference
from twinform.compiler.scene import Scene, SceneJoint, SceneLink
from twinform.diagnostics import Diagnostic, Severity
from twinform.diagnostics.ledger import Entry
from twinform.ir.motion import spanning_tree
from twinform.view.names import shortened
from twinform.view.subject import Subject

_DEEPEST = 60
"""Levels of a tree that are indented."""


def paragraph(text: str) -> str:
    """A text as it is."""
    return f'<p style="margin:0.2em 0.75em;font-size:0.85em;overflow-wrap:anywhere">{escape(text)}</p>'


def more(count: int, what: str) -> str:
    """What is not listed."""
    return paragraph(f"and {count:,} more {what}, which have no row here")


def tree(scene: Scene) -> str:
    """The links below those that move them, with the joints; a loop's joint is listed where it closes the loop."""
    hung = spanning_tree(scene.joints)
    below: dict[str, list[SceneJoint]] = {}
    for joint in scene.joints:
        below.setdefault(joint.parent, []).append(joint)
    names = {link.name for link in scene.links}
    roots = [link.name for link in scene.links if link.name not in hung or hung[link.name].parent not in names]
    rows: list[str] = []
    stack: list[tuple[str, SceneJoint | None, int]] = [(name, hung.get(name), 0) for name in reversed(roots)]
    while stack:
        link, joint, depth = stack.pop()
        rows.append(_row(link, joint, depth))
        if joint is None or hung.get(link) is joint:
            stack += [(each.child, each, depth + 1) for each in reversed(below.get(link, []))]
    return f'<div style="font-size:0.8em;margin:0.5em 0.75em;overflow-x:auto;white-space:nowrap">{"".join(rows)}</div>'


def _row(link: str, joint: SceneJoint | None, depth: int) -> str:
    by = f' <span style="opacity:0.6">{escape(joint.type)} {escape(shortened(joint.name))}</span>' if joint else ""
    return f'<div style="padding-left:{min(depth, _DEEPEST)}em">{escape(shortened(link))}{by}</div>'


def verdict(subjects: Sequence[Subject]) -> str:
    """How many findings there are."""
    found = [each for subject in subjects for each in subject.findings]
    errors = sum(each.severity is Severity.ERROR for each in found)
    warnings = sum(each.severity is Severity.WARNING for each in found)
    lines = [f"{errors} errors, {warnings} warnings, {len(found) - errors - warnings} notes"]
    lines += [f"left out: {reason}" for subject in subjects for reason in subject.scene.left_out]
    return "".join(map(paragraph, lines))


def finding(found: Diagnostic) -> str:
    """A finding without its rule."""
    return paragraph(found.message) + (paragraph(f"help: {found.help}") if found.help else "")


def compared(comparison: Comparison) -> str:
    """Whether two robots are the same."""
    if comparison.same:
        return paragraph("Both files describe the same robot.")
    return paragraph(f"{len(comparison.differences)} differences; what differs is red.")


def difference(found: Difference) -> str:
    """A difference with both values."""
    sides = "".join(paragraph(f"{name}: {side.text}") for name, side in (("A", found.a), ("B", found.b)) if side.text)
    return paragraph(found.message) + sides


def part(link: str, subject: Subject) -> str:
    """What a file says of a link, what was found in it, and what a conversion makes of it."""
    found = next((each for each in subject.scene.links if each.name == link), None)
    if found is None:
        return ""
    rows = [*_facts(found, subject).items()]
    about = [each for each in (*subject.findings, *subject.entries) if subject.link_at(each.location.path) == link]
    rows += [(str(each.fate if isinstance(each, Entry) else each.severity), each.message) for each in about]
    cells = "".join(f"<tr><th>{escape(shortened(name))}</th><td>{escape(value)}</td></tr>" for name, value in rows)
    return f'<table style="font-size:0.8em;margin:0.5em 0.75em;text-align:left">{cells}</table>'


def _facts(link: SceneLink, subject: Subject) -> Mapping[str, str]:
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
