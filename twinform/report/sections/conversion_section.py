"""What a conversion to the other format does to each part, by fate."""

from collections.abc import Sequence

from twinform.diagnostics import Diagnostic, Fate, Ledger
from twinform.diagnostics.ledger import LedgerEntry
from twinform.report.content import Converted, ModelReport
from twinform.report.html_parts import Cell, bar, count, folded, place, table
from twinform.report.markup import Markup, breakable, element, join

_MEANINGS = {
    Fate.DROPPED: "are not in the result",
    Fate.APPROXIMATED: "are in it in another form, which does not mean quite the same",
    Fate.CARRIED: "are in it in elements that only twinform reads, and come back with the conversion back",
}
_OPEN = 20
"""Longer lists begin folded."""
_HEADS = ("Line", "What became of it", "Parts", "Where", "Rule")


def conversion(report: ModelReport) -> Markup | None:
    """How many parts met each fate, and each of them, folded."""
    converted = report.converted
    if converted is None:
        return None
    if converted.ledger is None:
        return _refused(converted)
    ledger, path, target = converted.ledger, report.first.findings.path, converted.target.upper()
    counts = {"expressed": ledger.expressed} | {fate.value: ledger.count(fate) for fate in _MEANINGS}
    whole = sum(counts.values())
    rows = ((fate, Cell(f"{parts:,}", parts), bar(parts, whole)) for fate, parts in counts.items())
    return join((
        element("p", f"What became of the {whole:,} elements and attributes of the source in {target}:"),
        table("Elements and attributes by fate", ("Fate", "How many", "Share"), rows),
        *(_listed(each, ledger, path) for each in _MEANINGS),
    ))  # fmt: skip


def _refused(converted: Converted) -> Markup:
    return join((
        element("p", f"The model cannot be converted to {converted.target.upper()} as it is:"),
        element("ul", *map(_reason, converted.reasons[:_OPEN])),
    ))  # fmt: skip


def _reason(each: Diagnostic) -> Markup:
    return element("li", each.message, f" ({each.help})" if each.help else None)


def _listed(fate: Fate, ledger: Ledger, path: str) -> Markup | None:
    entries = [entry for entry in ledger.entries if entry.fate is fate]
    if not entries:
        return None
    parts = count(ledger.count(fate), "part")
    made = table(f"{parts} {_MEANINGS[fate]}", _HEADS, _rows(entries, path))
    title = f"{fate.value.capitalize()}: {parts} in {count(len(entries), 'remark')}"
    return folded(title, made, open_=fate is Fate.DROPPED and len(entries) <= _OPEN)


def _rows(entries: Sequence[LedgerEntry], path: str) -> list[tuple[Cell | Markup | str, ...]]:
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
