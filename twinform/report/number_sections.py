"""Sections with numbers: statistics, masses and inertias, reach of the links, meshes, and how two files differ."""

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import NamedTuple

from twinform.compiler.compare import Comparison, Difference, DifferenceSeverity
from twinform.compiler.compare.comparison_reporters import amounts_of, heading_of, places_of, summary, what_differs
from twinform.compiler.scene import Scene, SceneJoint, SceneLink
from twinform.compiler.statistics import MeshCost, ModelStatistics
from twinform.diagnostics import Diagnostic, Fate, Ledger
from twinform.diagnostics.ledger import LedgerEntry
from twinform.ir.motion import spanning_tree
from twinform.report.content import Converted, ModelReport
from twinform.report.markup import (
    Cell,
    Markup,
    Part,
    bar,
    breakable,
    count,
    element,
    folded,
    join,
    number,
    place,
    table,
)


def statistics(report: ModelReport) -> Markup | None:
    """Make a table of what `twinform stats` counts, with a column for each model of both files."""
    columns = [
        (file, each) for file, subject in zip(report.files, report.subjects, strict=True) for each in subject.models
    ]
    if not columns:
        return None
    names_of_models = [f"{model.name} in {file}" if report.second else model.name for file, model in columns]
    facts = [dict(_facts(model)) for _, model in columns]
    names = [
        name for name in dict.fromkeys(name for each in facts for name in each) if any(each.get(name) for each in facts)
    ]
    heads = ("", *names_of_models)
    made = table("Models in numbers", heads, ((name, *(each.get(name) for each in facts)) for name in names))
    measured = [each.statistics for each in report.subjects if each.statistics]
    words = (f"{each.path}: {each.format.upper()} {each.version or ''}".strip() for each in measured)
    return join(
        (element("p", breakable("; ".join(words))), made, *_advice(names_of_models, [each for _, each in columns]))
    )


def _facts(model: ModelStatistics) -> Iterator[tuple[str, Part]]:
    yield "Links", str(model.links)
    yield "Joints", _kinds(model.joints)
    yield "Degrees of freedom", str(model.dof)
    yield "Closed loops", str(model.loops or "")
    yield "Most joints between a root and a link", str(model.depth)
    yield "Mass", f"{model.mass:.6g} kg" if model.mass else ""
    yield "Links of SDF without a mass, 1 kg each", str(model.masses_assumed or "")
    yield "Links of unknown mass", str(model.masses_unknown or "")
    yield "Visuals", _kinds(model.visuals)
    yield "Collisions", _kinds(model.collisions)
    yield "Sensors", _kinds(model.sensors)
    yield "Plugins", _kinds(model.plugins)
    yield "Lights", str(model.lights or "")
    yield "Named frames", str(model.frames or "")
    yield "Nested models", str(model.models or "")
    yield "Triangles drawn", _large(model.cost.drawn_triangles)
    yield "Triangles for contact", _large(model.cost.touched_triangles)
    yield "Pixels a second", _large(model.cost.pixels_per_second)
    yield "Rays a second", _large(model.cost.rays_per_second)


def _large(value: float) -> str:
    return f"{value:,.0f}" if value else ""


def _kinds(counts: Mapping[str, int]) -> str:
    kinds = ", ".join(f"{number} {kind}" for kind, number in counts.items())
    return f"{sum(counts.values())}: {kinds}" if counts else ""


def _advice(names: Sequence[str], models: Sequence[ModelStatistics]) -> Iterator[Markup]:
    for name, model in zip(names, models, strict=True):
        for each in model.cost.advice:
            yield element(
                "p",
                f"{name} has {each.reason}: ",
                element("code", f"--passes '{each.passes}'"),
                " makes it cheaper.",
            )


_MASS_HEADS = (
    "Link", "Mass (kg)", "Share of the heaviest", "x (m)", "y (m)", "z (m)", "ixx", "iyy", "izz", "ixy", "ixz", "iyz",
)  # fmt: skip
_MOMENTS = 6
_SUMMED = 2


def masses(report: ModelReport) -> Markup | None:
    """Make a sortable table of masses, centers of mass and inertias, with a bar for each mass."""
    links = report.first.scene.links if report.first.scene else ()
    if not any(link.mass for link in links):
        return None
    heaviest = max(link.mass.mass for link in links if link.mass)
    whole = sum(link.mass.mass for link in links if link.mass)
    cells = element("th", "Together", scope="row"), element("td", f"{whole:.6g}", class_="number")
    total = element("tr", *cells, element("td", colspan=len(_MASS_HEADS) - _SUMMED))
    caption = (
        "Masses, centers of mass, and inertias in kg m\N{SUPERSCRIPT TWO} about these, in the axes of the link. "
        "Links without a mass have no number."
    )
    return table(caption, _MASS_HEADS, (_mass_row(link, heaviest) for link in links), sortable=True, total=total)


def _mass_row(link: SceneLink, heaviest: float) -> tuple[Cell | Part, ...]:
    solid = link.mass
    if solid is None:
        return (link.name, *([Cell(None)] * (len(_MASS_HEADS) - 1)))
    moments = (number(each) for each in solid.inertia[:_MOMENTS])
    share = Cell(bar(solid.mass, heaviest), solid.mass)
    return (link.name, number(solid.mass), share, *map(number, solid.center), *moments)


class Reach(NamedTuple):
    """How far the frame of a link is from the frame of its root in m: with all joints at zero, and at most.

    `most` is a bound, the length of the chain with every joint stretched; it is infinite if a joint slides without an
    end.
    """

    link: str
    zero: float
    most: float


def reaches(scene: Scene) -> tuple[Reach, ...]:
    """Compute the reach of every link but the roots, in the order of the file."""
    tree = spanning_tree(scene.joints)
    frames = {link.name: link.pose for link in scene.links}
    known: dict[str, tuple[str, float]] = {}
    for start in frames:
        path: list[str] = []
        name = start
        while name in tree and name not in known and tree[name].parent in frames:
            path.append(name)
            name = tree[name].parent
        root, far = known.get(name, (name, 0.0))
        known.setdefault(name, (root, far))
        for each in reversed(path):
            joint = tree[each]
            far += math.dist(frames[joint.parent].translation, frames[each].translation) + _travel(joint)
            known[each] = root, far
    return tuple(
        Reach(name, math.dist(frame.translation, frames[known[name][0]].translation), known[name][1])
        for name, frame in frames.items()
        if known[name][0] != name
    )


def _travel(joint: SceneJoint) -> float:
    """Return how far a joint can slide from its zero position."""
    return sum(max(abs(degree.lower), abs(degree.upper)) for degree in joint.degrees if degree.slides or degree.pitch)


_REACH_HEADS = ("Link", "At zero (m)", "At most (m)", "From 0 to the furthest")


def reach(report: ModelReport) -> Markup | None:
    """Make a sortable table of the reach of links, with a bar for each."""
    found = reaches(report.first.scene) if report.first.scene else ()
    most = max((each.most if math.isfinite(each.most) else each.zero for each in found), default=0.0)
    if not most:
        return None
    caption = (
        "Distances of link frames from the root of their tree: with every joint at zero (dark), and along all joints "
        "between, as if they were stretched (pale), which is a bound"
    )
    rows = (
        (each.link, number(each.zero), number(each.most), Cell(bar(each.zero, most, min(each.most, most)), each.most))
        for each in found
    )
    return table(caption, _REACH_HEADS, rows, sortable=True)


_MESH_HEADS = ("File", "Triangles", "Of the largest", "Bytes", "Visuals", "Collisions", "Remark")


def meshes(report: ModelReport) -> Markup | None:
    """Make a sortable table of mesh files, with a bar for the triangles of each."""
    costs = report.first.meshes
    most = max((each.triangles or 0 for each in costs), default=0)
    rows = (_mesh_row(each, most) for each in costs)
    return table("Mesh files, and the triangles in them", _MESH_HEADS, rows, sortable=True) if costs else None


def _mesh_row(each: MeshCost, most: int) -> tuple[Cell | Part, ...]:
    return (
        each.uri,
        _integer(each.triangles),
        Cell(bar(each.triangles or 0, most), each.triangles),
        _integer(each.bytes),
        _integer(each.visuals),
        _integer(each.collisions),
        each.problem,
    )


def _integer(value: int | None) -> Cell:
    return Cell(None if value is None else f"{value:,}", value)


_DIFFERENCE_HEADS = ("Part", "What", "In A", "In B", "By", "Where")


def differences(report: ModelReport) -> Markup | None:
    """Give the verdict of the comparison, and list differences, carried differences and, folded, notes."""
    if report.second is None:
        return None
    if report.comparison is None:
        return element("p", f"The files cannot be compared: {report.without_comparison}.")
    found = report.comparison
    verdict = element(
        "p", element("strong", f"{summary(found)}."), f" Rounding up to {found.tolerance:g} does not count."
    )
    files = element("p", "A is ", element("code", found.a), ", B is ", element("code", found.b), ".")
    listed = table(
        "What makes the robots different", _DIFFERENCE_HEADS, _difference_rows(found, DifferenceSeverity.DIFFERENCE)
    )
    carried = table(
        "What only some readers see", _DIFFERENCE_HEADS, _difference_rows(found, DifferenceSeverity.CARRIED)
    )
    notes = table(
        "What is only written in another way", _DIFFERENCE_HEADS, _difference_rows(found, DifferenceSeverity.NOTE)
    )
    return join((
        verdict,
        files,
        listed if found.differences else None,
        carried if found.carried else None,
        folded(count(len(found.notes), "note"), notes) if found.notes else None,
    ))  # fmt: skip


def _difference_rows(found: Comparison, severity: DifferenceSeverity) -> Iterator[tuple[Part, ...]]:
    chosen = (item for item in found.items if item.severity is severity)
    for heading, items in groupby(chosen, key=heading_of):
        for item in items:
            yield (
                heading,
                *_values(item),
                ", ".join(amounts_of(item)),
                element("code", breakable(", ".join(places_of(item, found)))),
            )


def _values(item: Difference) -> tuple[str, str, str]:
    """Return the name of the quantity and both values; a sentence instead of the name if a value says too little."""
    if (
        item.group == "kinematics"
        or item.severity is DifferenceSeverity.CARRIED
        or item.a.text is None
        or item.b.text is None
    ):
        return what_differs(item), item.a.text or "", item.b.text or ""
    return item.aspect, item.a.text, item.b.text


_MEANINGS = {
    Fate.DROPPED: "are not in the result",
    Fate.APPROXIMATED: "are in it in another form, which does not mean quite the same",
    Fate.CARRIED: "are in it in elements that only twinform reads, and come back with the conversion back",
}
_OPEN = 20
"""Longer lists begin folded."""
_LEDGER_HEADS = ("Line", "What became of it", "Parts", "Where", "Rule")


def conversion(report: ModelReport) -> Markup | None:
    """Count the parts that met each fate in the other format, and list all but the expressed ones, folded."""
    converted = report.converted
    if converted is None:
        return None
    if converted.ledger is None:
        return _list_reasons(converted)
    ledger, path, target = converted.ledger, report.first.findings.path, converted.target.upper()
    counts = {"expressed": ledger.expressed} | {fate.value: ledger.count(fate) for fate in _MEANINGS}
    whole = sum(counts.values())
    rows = ((fate, Cell(f"{parts:,}", parts), bar(parts, whole)) for fate, parts in counts.items())
    return join((
        element("p", f"What became of the {whole:,} elements and attributes of the source in {target}:"),
        table("Elements and attributes by fate", ("Fate", "How many", "Share"), rows),
        *(_list_fate(each, ledger, path) for each in _MEANINGS),
    ))  # fmt: skip


def _list_reasons(converted: Converted) -> Markup:
    return join((
        element("p", f"The model cannot be converted to {converted.target.upper()} as it is:"),
        element("ul", *map(_reason, converted.reasons[:_OPEN])),
    ))  # fmt: skip


def _reason(each: Diagnostic) -> Markup:
    return element("li", each.message, f" ({each.help})" if each.help else None)


def _list_fate(fate: Fate, ledger: Ledger, path: str) -> Markup | None:
    entries = [entry for entry in ledger.entries if entry.fate is fate]
    if not entries:
        return None
    parts = count(ledger.count(fate), "part")
    made = table(f"{parts} {_MEANINGS[fate]}", _LEDGER_HEADS, _ledger_rows(entries, path))
    title = f"{fate.value.capitalize()}: {parts} in {count(len(entries), 'remark')}"
    return folded(title, made, open_=fate is Fate.DROPPED and len(entries) <= _OPEN)


def _ledger_rows(entries: Sequence[LedgerEntry], path: str) -> list[tuple[Cell | Markup | str, ...]]:
    return [
        (
            place(entry.location, path).rpartition(":")[2] if entry.location.line else "",
            entry.message,
            Cell(str(entry.weight), entry.weight),
            element("code", breakable(entry.location.path)),
            element("code", entry.rule.name),
        )
        for entry in entries
    ]
