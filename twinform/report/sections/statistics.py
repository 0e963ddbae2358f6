"""The file in numbers, as `twinform stats` has them."""

from collections.abc import Iterator, Mapping

from twinform.compiler.statistics import ModelStatistics
from twinform.report.content import ModelReport
from twinform.report.html_parts import table
from twinform.report.markup import Markup, Part, breakable, element, join


def statistics(report: ModelReport) -> Markup | None:
    """A table with a column for each model, of both files."""
    columns = [(each.name, model) for each in report.subjects for model in each.models]
    if not columns:
        return None
    several = report.second is not None
    heads = ("", *(f"{model.name} in {path}" if several else model.name for path, model in columns))
    facts = [dict(_facts(model)) for _, model in columns]
    names = [
        name for name in dict.fromkeys(name for each in facts for name in each) if any(each.get(name) for each in facts)
    ]
    made = table("Models in numbers", heads, ((name, *(each.get(name) for each in facts)) for name in names))
    return join((_files(report), made, *_advice(columns)))


def _files(report: ModelReport) -> Markup:
    measured = [each.statistics for each in report.subjects if each.statistics]
    words = (f"{each.path}: {each.format.upper()} {each.version or ''}".strip() for each in measured)
    return element("p", breakable("; ".join(words)))


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


def _advice(columns: list[tuple[str, ModelStatistics]]) -> Iterator[Markup]:
    for _, model in columns:
        for each in model.cost.advice:
            yield element(
                "p",
                f"{model.name} has {each.reason}: ",
                element("code", f"--passes '{each.passes}'"),
                " makes it cheaper.",
            )
