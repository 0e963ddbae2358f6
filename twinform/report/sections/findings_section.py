"""What is wrong with the files, with the lines that it is about."""

from collections.abc import Iterator

from twinform.diagnostics import Diagnostic, Severity
from twinform.diagnostics.reporters.file_findings import Group
from twinform.diagnostics.reporters.text import excerpt
from twinform.report.content import ModelReport, ReportSubject
from twinform.report.html_parts import count, folded, place
from twinform.report.listed_findings import MOST, WORDS, anchor, groups_of
from twinform.report.markup import Markup, breakable, element, join

_SHOWN = 5


def findings(report: ModelReport) -> Markup:
    """The findings of each file, the worst first; notes are folded."""
    several = report.second is not None
    return join(_findings_of(subject, number, several=several) for number, subject in enumerate(report.subjects))


def _findings_of(subject: ReportSubject, number: int, *, several: bool) -> Markup:
    found = subject.findings.diagnostics
    heading = element("h3", subject.name) if several else None
    if not found:
        return join((heading, element("p", "Nothing was found.")))
    return join((heading, *(_listed(subject, number, severity) for severity in WORDS)))


def _listed(subject: ReportSubject, number: int, severity: Severity) -> Markup | None:
    groups = groups_of(subject, severity)
    if not groups:
        return None
    left = len(groups) - MOST
    more = element("p", f"and {count(left, f'more {WORDS[severity]}')}: twinform check lists all") if left > 0 else None
    items = (_item(each, subject, anchor(severity, index, number)) for index, each in enumerate(groups[:MOST]))
    title = count(subject.count(severity), WORDS[severity])
    return folded(
        title, element("ul", *items, class_="findings"), more, open_=severity > Severity.INFO, class_=WORDS[severity]
    )


def _item(group: Group, subject: ReportSubject, anchor_: str) -> Markup:
    one, others = group
    where = one.location
    times = element("span", f" {len(others) + 1} times", class_="quiet") if others else None
    word = WORDS[one.severity]
    return element(
        "li",
        element("p", element("strong", word, class_=f"badge {word}"), " ", one.message.strip(), times),
        element(
            "p",
            element("code", breakable(place(where, subject.findings.path))),
            " ",
            element("code", breakable(where.path)),
            class_="quiet",
        ),
        _excerpt(one, subject),
        element("p", f"also at {_also(others)}", class_="quiet") if others else None,
        *(element("p", f"see {place(each, subject.findings.path)}", class_="quiet") for each in one.related),
        element("p", "Help: ", one.help) if one.help else None,
        element("p", f"Fix ({one.fix.safety}): {one.fix.title}") if one.fix else None,
        folded(
            join(("Rule ", element("code", one.rule.name))),
            element("p", one.rule.finds),
            element("p", one.rule.matters),
        ),
        id=anchor_,
    )


def _also(others: tuple[Diagnostic, ...]) -> str:
    lines = ", ".join(f"line {each.location.line}" for each in others[:_SHOWN])
    more = len(others) - _SHOWN
    return f"{lines} and {more} more" if more > 0 else lines


def _excerpt(one: Diagnostic, subject: ReportSubject) -> Markup | None:
    where, texts = one.location, subject.findings.texts
    lines = list(_lines(one, texts.line(where.file or subject.findings.path, where.line)))
    return element("pre", element("code", *lines), tabindex="0") if lines else None


def _lines(one: Diagnostic, line: str | None) -> Iterator[Markup]:
    for text, marks in excerpt(one.location, line):
        yield join((text, element("mark", marks) if marks else None, "\n"))
