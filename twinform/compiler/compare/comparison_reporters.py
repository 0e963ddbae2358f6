"""A comparison as text for people and as JSON for programs; reporters only format."""

import math
from collections.abc import Callable, Iterator, Mapping
from itertools import groupby
from types import MappingProxyType

from twinform.compiler.compare.comparison import Comparison, Difference, DifferenceSeverity, Side
from twinform.compiler.input.loading import is_usd
from twinform.diagnostics import Location
from twinform.diagnostics.reporters import printable
from twinform.diagnostics.wording import plural

Paint = Callable[[str, DifferenceSeverity], str]
"""Gives a word the color of a severity."""
Reporter = Callable[[Comparison], str]


def text(comparison: Comparison, paint: Paint = lambda word, _: word) -> str:
    """Format a comparison with a heading for each part, and a line for each difference: `places: severity: what`."""
    lines: list[str] = []
    for heading, items in groupby(comparison.items, key=heading_of):
        lines.append(printable(heading))
        lines += [f"  {_format_item(item, comparison, paint)}" for item in items]
    return "".join(f"{line}\n" for line in lines)


def json(comparison: Comparison) -> str:
    """Format a comparison as `{"a", "b", "same", "tolerance", "items": [...]}`; every key is always there.

    An item is `{"severity", "reader", "model", "group", "name", "aspect", "message", "a", "b", "absolute", "relative",
    "unit"}`; its sides are `{"value", "file", "line", "path"}`. Line 0 means unknown; a difference without end is null.
    """
    whole = {
        "a": comparison.a,
        "b": comparison.b,
        "same": comparison.same,
        "tolerance": comparison.tolerance,
        "items": [item_fields(item) for item in comparison.items],
    }
    from json import dumps  # noqa: PLC0415 - a text needs none of it

    return dumps(whole, indent=2, allow_nan=False) + "\n"


REPORTERS: Mapping[str, Reporter] = MappingProxyType({"text": text, "json": json})
"""Every output format by its name on the command line."""


def summary(comparison: Comparison) -> str:
    """Return the verdict in one line."""
    verdict = "the same robot" if comparison.same else "different robots"
    carried = [f"{len(comparison.carried)} carried"] if comparison.carried else []
    counts = (plural(len(comparison.differences), "difference"), *carried, plural(len(comparison.notes), "note"))
    return f"{verdict}: {', '.join(counts)}"


def heading_of(item: Difference) -> str:
    """Name the part that a difference is about."""
    words = f"{item.group} {item.name!r}" if item.name else item.group
    return f"{words} of model {item.model!r}" if item.model and item.group != "model" else words


def _format_item(item: Difference, comparison: Comparison, paint: Paint) -> str:
    places = ", ".join(places_of(item, comparison))
    amounts = list(amounts_of(item))
    amount = f" ({', '.join(amounts)})" if amounts else ""
    severity = paint(str(item.severity), item.severity)
    return f"{places}{': ' if places else ''}{severity}: {printable(what_differs(item))}{amount}"


def what_differs(item: Difference) -> str:
    """Describe a difference without repeating the heading."""
    short = item.severity is DifferenceSeverity.DIFFERENCE and item.group != "kinematics"
    if short and item.a.text is not None and item.b.text is not None:
        return f"{item.aspect} is {item.a.text}, and {item.b.text}"
    return item.message


def places_of(item: Difference, comparison: Comparison) -> Iterator[str]:
    """Yield the places of a difference in the files."""
    seen: set[Location] = set()
    for file, side in ((comparison.a, item.a), (comparison.b, item.b)):
        where = side.location
        if where in seen or not (where.line or is_usd(where.file)):
            continue
        seen.add(where)
        # prims of a stage come from several layers, and have paths of their own
        yield f"{printable(where.file or file)}{f':{where.line}' if where.line else f'<{printable(where.path)}>'}"


def amounts_of(item: Difference) -> Iterator[str]:
    """Yield how far the values are apart, and its share of the larger one; messages on kinematics have that already."""
    if item.group == "kinematics":
        return
    if item.absolute is not None and math.isfinite(item.absolute):
        yield f"by {item.absolute:.6g}{f' {item.unit}' if item.unit else ''}"
    if item.relative is not None:
        yield f"{100 * item.relative:.3g} %"


def item_fields(item: Difference) -> dict[str, object]:
    """Return a difference as fields of JSON."""
    return {
        "severity": str(item.severity),
        "reader": item.reader,
        "model": item.model,
        "group": item.group,
        "name": item.name,
        "aspect": item.aspect,
        "message": item.message,
        "a": _side_fields(item.a),
        "b": _side_fields(item.b),
        "absolute": _finite_or_none(item.absolute),
        "relative": _finite_or_none(item.relative),
        "unit": item.unit,
    }


def _side_fields(side: Side) -> dict[str, object]:
    where = side.location
    return {"value": side.text, "file": where.file, "line": where.line, "path": where.path}


def _finite_or_none(value: float | None) -> float | None:
    return value if value is not None and math.isfinite(value) else None
