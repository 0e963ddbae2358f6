"""How two files differ, with values and amounts."""

from collections.abc import Iterator
from itertools import groupby

from twinform.compiler.compare import Comparison, Difference, DifferenceSeverity
from twinform.compiler.compare.comparison_reporters import amounts_of, heading_of, places_of, summary, what_differs
from twinform.report.content import ModelReport
from twinform.report.html_parts import count, folded, table
from twinform.report.markup import Markup, Part, breakable, element, join

_HEADS = ("Part", "What", "In A", "In B", "By", "Where")


def differences(report: ModelReport) -> Markup | None:
    """The verdict, what makes the robots different to all readers or to some, and, folded, what is the same."""
    if report.second is None:
        return None
    if report.comparison is None:
        return element("p", f"The files cannot be compared: {report.without_comparison}.")
    found = report.comparison
    verdict = element(
        "p", element("strong", f"{summary(found)}."), f" Rounding up to {found.tolerance:g} does not count."
    )
    files = element("p", "A is ", element("code", found.a), ", B is ", element("code", found.b), ".")
    listed = table("What makes the robots different", _HEADS, _rows(found, DifferenceSeverity.DIFFERENCE))
    carried = table("What only some readers see", _HEADS, _rows(found, DifferenceSeverity.CARRIED))
    notes = table("What is only written in another way", _HEADS, _rows(found, DifferenceSeverity.NOTE))
    return join((
        verdict,
        files,
        listed if found.differences else None,
        carried if found.carried else None,
        folded(count(len(found.notes), "note"), notes) if found.notes else None,
    ))  # fmt: skip


def _rows(found: Comparison, severity: DifferenceSeverity) -> Iterator[tuple[Part, ...]]:
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
    """What differs, and both values; a sentence where one side has none."""
    if (
        item.group == "kinematics"
        or item.severity is DifferenceSeverity.CARRIED
        or item.a.text is None
        or item.b.text is None
    ):
        return what_differs(item), item.a.text or "", item.b.text or ""
    return item.aspect, item.a.text, item.b.text
