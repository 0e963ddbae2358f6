"""The section with findings, in groups of one cause, with the lines that they are about."""

from collections.abc import Mapping

from twinform.diagnostics import Diagnostic, Severity
from twinform.diagnostics.reporters.file_findings import Group, grouped
from twinform.diagnostics.reporters.text import excerpt
from twinform.report.content import WORDS, ModelReport, ReportSubject
from twinform.report.markup import Markup, breakable, count, element, folded, join, place

MOST = 300
"""The most groups of a severity that are listed."""


_SHOWN = 5


def findings(report: ModelReport) -> Markup:
    """List the findings of each file, the worst first; notes are folded."""
    several = report.second is not None
    return join(_list_findings(subject, number, several=several) for number, subject in enumerate(report.subjects))


def _list_findings(subject: ReportSubject, number: int, *, several: bool) -> Markup:
    heading = element("h3", subject.name) if several else None
    if not subject.findings.diagnostics:
        return join((heading, element("p", "Nothing was found.")))
    return join((heading, *(_list_severity(subject, number, severity) for severity in WORDS)))


def _list_severity(subject: ReportSubject, number: int, severity: Severity) -> Markup | None:
    groups = _groups_of(subject, severity)
    if not groups:
        return None
    left = len(groups) - MOST
    more = element("p", f"and {count(left, f'more {WORDS[severity]}')}: twinform check lists all") if left > 0 else None
    items = (_item(each, subject, _anchor(severity, index, number)) for index, each in enumerate(groups[:MOST]))
    title = count(subject.count(severity), WORDS[severity])
    return folded(
        title, element("ul", *items, class_="findings"), more, open_=severity > Severity.INFO, class_=WORDS[severity]
    )


def _item(group: Group, subject: ReportSubject, anchor_: str) -> Markup:
    one, others = group
    where, path, word = one.location, subject.findings.path, WORDS[one.severity]
    times = element("span", f" {len(others) + 1} times", class_="quiet") if others else None
    return element(
        "li",
        element("p", element("strong", word, class_=f"badge {word}"), " ", one.message.strip(), times),
        element(
            "p",
            element("code", breakable(place(where, path))),
            " ",
            element("code", breakable(where.path)),
            class_="quiet",
        ),
        _excerpt(one, subject),
        element("p", f"also at {_other_lines(others)}", class_="quiet") if others else None,
        *(element("p", f"see {place(each, path)}", class_="quiet") for each in one.related),
        element("p", "Help: ", one.help) if one.help else None,
        element("p", f"Fix ({one.fix.safety}): {one.fix.title}") if one.fix else None,
        folded(
            join(("Rule ", element("code", one.rule.name))),
            element("p", one.rule.finds),
            element("p", one.rule.matters),
        ),
        id=anchor_,
    )


def _other_lines(others: tuple[Diagnostic, ...]) -> str:
    lines = ", ".join(f"line {each.location.line}" for each in others[:_SHOWN])
    more = len(others) - _SHOWN
    return f"{lines} and {more} more" if more > 0 else lines


def _excerpt(one: Diagnostic, subject: ReportSubject) -> Markup | None:
    where, texts = one.location, subject.findings.texts
    line = texts.line(where.file or subject.findings.path, where.line)
    lines = [join((text, element("mark", marks) if marks else None, "\n")) for text, marks in excerpt(where, line)]
    return element("pre", element("code", *lines), tabindex="0") if lines else None


def _groups_of(subject: ReportSubject, severity: Severity) -> list[Group]:
    """Group the findings of a severity by cause, in the order of the file."""
    return grouped(each for each in subject.findings.diagnostics if each.severity is severity)


def _anchor(severity: Severity, number: int, subject: int = 0) -> str:
    """Name the anchor of a group of findings in the file number `subject`."""
    return f"{WORDS[severity]}-{'ab'[subject]}{number}"


def anchors(subject: ReportSubject) -> Mapping[int, str]:
    """Map the identity of each finding that is listed for the first file to the anchor of its group."""
    return {
        id(finding): _anchor(severity, number)
        for severity in WORDS
        for number, group in enumerate(_groups_of(subject, severity)[:MOST])
        for finding in (group.first, *group.others)
    }
