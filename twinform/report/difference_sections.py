"""How two files differ, with values and amounts."""

from collections.abc import Iterator, Sequence
from itertools import groupby

from twinform.compiler.compare import Comparison, Difference, DifferenceSeverity
from twinform.compiler.compare.comparison_reporters import amounts_of, heading_of, places_of, summary, what_differs
from twinform.diagnostics import Diagnostic, Fate, Ledger
from twinform.diagnostics.ledger import LedgerEntry
from twinform.report.content import Converted, ModelReport
from twinform.report.markup import Cell, Markup, Part, bar, breakable, count, element, folded, join, place, table

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
