"""Findings as a report lists them: in groups of one cause, of each severity so many, each with an anchor."""

from collections.abc import Mapping, Sequence

from twinform.diagnostics import Diagnostic, Severity
from twinform.diagnostics.reporters.file_findings import Group, grouped
from twinform.report.content import ReportSubject

MOST = 300
"""So many groups of a severity are listed."""
WORDS: Mapping[Severity, str] = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "note"}
"""The severities, the worst first, and what a report calls them."""


def groups_of(subject: ReportSubject, severity: Severity) -> list[Group]:
    """All groups of a severity, in the order of the file."""
    return grouped(each for each in subject.findings.diagnostics if each.severity is severity)


def anchor(severity: Severity, number: int, subject: int = 0) -> str:
    """The anchor of a group of a file: the first file is 0."""
    return f"{WORDS[severity]}-{'ab'[subject]}{number}"


def anchors(subject: ReportSubject) -> Mapping[int, str]:
    """Where each finding of the first file is listed, by its identity; nothing of those that are left out."""
    return {
        id(finding): anchor(severity, number)
        for severity in WORDS
        for number, group in enumerate(groups_of(subject, severity)[:MOST])
        for finding in (group.first, *group.others)
    }


def worst(findings: Sequence[Diagnostic]) -> Diagnostic:
    """The first one of the worst severity."""
    return max(findings, key=lambda each: each.severity)
