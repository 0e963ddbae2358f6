"""What is wrong with the files, with the lines that it is about."""

from collections.abc import Iterator

from twinform.diagnostics import Diagnostic, Severity
from twinform.diagnostics.reporters.excerpt import excerpt
from twinform.diagnostics.reporters.grouping import Group, grouped
from twinform.report.content import Report, Subject
from twinform.report.markup import Markup, element, join
from twinform.report.parts import count, folded, place

_MOST = 300
"""So many findings of a severity are listed."""
_SHOWN = 5
_WORDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}


def findings(report: Report) -> Markup:
    """The findings of each file, the worst first; notes are folded."""
    return join(_of(subject, several=report.second is not None) for subject in report.subjects)


def _of(subject: Subject, *, several: bool) -> Markup:
    found = subject.findings.diagnostics
    heading = element("h3", subject.name) if several else None
    if not found:
        return join((heading, element("p", "Nothing was found.")))
    return join((heading, *(_listed(subject, severity) for severity in _WORDS)))


def _listed(subject: Subject, severity: Severity) -> Markup | None:
    groups = grouped(each for each in subject.findings.diagnostics if each.severity is severity)
    if not groups:
        return None
    left = len(groups) - _MOST
    more = (
        element("p", f"and {count(left, f'more {_WORDS[severity]}')}: twinform check lists all") if left > 0 else None
    )
    items = element("ul", *(_item(each, subject) for each in groups[:_MOST]), class_="findings")
    title = count(subject.count(severity), _WORDS[severity])
    return folded(title, items, more, open_=severity > Severity.INFO, class_=_WORDS[severity])


def _item(group: Group, subject: Subject) -> Markup:
    one, others = group
    where = one.location
    times = element("span", f" {len(others) + 1} times", class_="quiet") if others else None
    word = _WORDS[one.severity]
    return element(
        "li",
        element("p", element("strong", word, class_=f"badge {word}"), " ", one.message.strip(), times),
        element(
            "p", element("code", place(where, subject.findings.path)), " ", element("code", where.path), class_="quiet"
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
    )


def _also(others: tuple[Diagnostic, ...]) -> str:
    lines = ", ".join(f"line {each.location.line}" for each in others[:_SHOWN])
    more = len(others) - _SHOWN
    return f"{lines} and {more} more" if more > 0 else lines


def _excerpt(one: Diagnostic, subject: Subject) -> Markup | None:
    where, texts = one.location, subject.findings.texts
    lines = list(_lines(one, texts.line(where.file or subject.findings.path, where.line)))
    return element("pre", element("code", *lines), tabindex="0") if lines else None


def _lines(one: Diagnostic, line: str | None) -> Iterator[Markup]:
    for text, marks in excerpt(one.location, line):
        yield join((text, element("mark", marks) if marks else None, "\n"))
