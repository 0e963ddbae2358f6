"""The report as GitHub's Markdown, short enough for a comment in a pull request."""

import re
from collections.abc import Iterator, Sequence
from itertools import islice

from twinform.compiler.compare.comparison_reporters import amounts_of, heading_of, places_of, summary, what_differs
from twinform.compiler.graph.languages import fits, mermaid
from twinform.diagnostics import Diagnostic, Fate, Severity
from twinform.diagnostics.reporters import printable
from twinform.lazy import lazy_pattern
from twinform.report.content import ModelReport, ReportSubject
from twinform.report.markup import count, place
from twinform.report.report_page import outcome

LARGEST = 65_536
"""The longest comment that GitHub takes, in characters; we count bytes, which are never fewer."""
# The most rows of a table; the next number is tried if the whole is too long for a comment.
_LISTED = (25, 10, 3, 0)
_LONGEST = 300
_DRAWN = 60
_SIGNS = lazy_pattern(r"[!\"#$%&'()*+\-./:;<=>?@\[\\\]^_`{|}~]")
_JOINED = lazy_pattern(r"[@#]|://|(?<=www)\.|(?<=GH)-", re.IGNORECASE)
"""What GitHub turns into links: mentions, issues and addresses."""
_BREAK = "\N{ZERO WIDTH SPACE}"


def markdown(report: ModelReport) -> str:
    """Write a report as Markdown: verdicts, differences, findings, losses of a conversion, numbers, a drawing."""
    text = ""
    for most in _LISTED:
        text = "\n".join(_blocks(report, most)) + "\n"
        if len(text.encode()) <= LARGEST:
            break
    return text


def escaped(text: str) -> str:
    """Cut a text to 300 characters, and escape everything that GitHub gives a meaning to."""
    text = printable(text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}\N{HORIZONTAL ELLIPSIS}")
    return _SIGNS.sub(lambda sign: f"\\{sign[0]}", _JOINED.sub(lambda found: found[0] + _BREAK, text))


def _blocks(report: ModelReport, most: int) -> Iterator[str]:
    yield f"## {escaped(report.title)}"
    yield ""
    for subject in report.subjects:
        yield f"* {escaped(subject.name)}: {subject.counts}"
    if report.comparison:
        yield f"* {summary(report.comparison)}"
    elif report.second:
        yield f"* the files cannot be compared: {escaped(report.without_comparison)}"
    if report.converted:
        yield f"* {outcome(report.converted, escaped(report.files[0]) if report.second else '')}"
    for block in (_differences, _findings, _losses, _numbers, _drawing):
        yield from block(report, most)


def _differences(report: ModelReport, most: int) -> Iterator[str]:
    found = report.comparison
    if found is None or found.same:
        return
    rows = [
        (heading_of(item), what_differs(item), ", ".join(amounts_of(item)), ", ".join(places_of(item, found)))
        for item in found.counted
    ]
    yield from _table("Differences", ("Part", "What", "By", "Where"), rows, most)


def _findings(report: ModelReport, most: int) -> Iterator[str]:
    for severity, title in ((Severity.ERROR, "Errors"), (Severity.WARNING, "Warnings")):
        rows = [
            _finding(each, subject)
            for subject in report.subjects
            for each in subject.findings.diagnostics
            if each.severity is severity
        ]
        yield from _table(title, ("Where", "What", "Rule"), rows, most)


def _finding(each: Diagnostic, subject: ReportSubject) -> tuple[str, str, str]:
    help_ = f" ({each.help})" if each.help else ""
    return place(each.location, subject.findings.path), f"{each.message}{help_}", each.rule.name


def _losses(report: ModelReport, most: int) -> Iterator[str]:
    converted = report.converted
    if converted is None:
        return
    if converted.ledger is None:
        rows = [(place(each.location, ""), each.message) for each in converted.reasons]
        yield from _table(f"Why it is not converted to {converted.target.upper()}", ("Where", "Why"), rows, most)
        return
    for fate in (Fate.DROPPED, Fate.APPROXIMATED):
        rows = [(place(e.location, ""), e.message) for e in converted.ledger.entries if e.fate is fate]
        title = f"{fate.value.capitalize()} in {converted.target.upper()}"
        yield from _table(title, ("Where", "What"), rows, most)


def _table(title: str, heads: Sequence[str], rows: Sequence[Sequence[str]], most: int) -> Iterator[str]:
    if not rows:
        return
    yield f"\n<details{' open' if len(rows) <= most else ''}><summary>{title}: {len(rows):,}</summary>\n"
    if most:
        yield f"| {' | '.join(heads)} |"
        yield f"| {' | '.join('---' for _ in heads)} |"
        for row in islice(rows, most):
            yield f"| {' | '.join(escaped(' '.join(cell.split())) for cell in row)} |"
    if len(rows) > most:
        yield f"\nand {len(rows) - most:,} more"
    yield "\n</details>"


def _numbers(report: ModelReport, _: int) -> Iterator[str]:
    """Yield a line for each model."""
    for subject, file in zip(report.subjects, report.files, strict=True):
        for number, model in enumerate(islice(subject.models, 10)):
            name = f"{model.name} in {file}" if report.second else model.name
            yield "" if number == 0 else "  "
            freedom = f"{count(model.dof, 'degree')} of freedom"
            words = (count(model.links, "link"), count(sum(model.joints.values()), "joint"), freedom)
            yield f"{escaped(name)}: {', '.join(words)}, {model.mass:.6g} kg"


def _drawing(report: ModelReport, most: int) -> Iterator[str]:
    graph = report.first.graph
    if graph is None or not most or not 1 < len(graph.nodes) <= _DRAWN:
        return
    text = mermaid(graph)
    if fits(graph, text):
        yield f"\n<details><summary>Links and joints</summary>\n\n```mermaid\n{text}```\n\n</details>"
