"""Findings as rows of JSON, which processes send and caches keep."""

from typing import Any

from twinform.diagnostics import Diagnostic, Fix, Location, Safety, Severity
from twinform.diagnostics.diagnostic import Span, TextEdit
from twinform.diagnostics.rule_registry import find_rule


def row_of_diagnostic(one: Diagnostic) -> list[Any]:
    """Return a finding as a row of JSON."""
    fix = one.fix and [one.fix.title, [[*edit.span, edit.new, edit.file] for edit in one.fix.edits], one.fix.safety]
    related = [list(each) for each in one.related]
    return [
        one.rule.name,
        one.message,
        list(one.location),
        one.severity,
        one.found,
        one.expected,
        one.help,
        related,
        fix,
    ]


def diagnostic_of_row(row: list[Any]) -> Diagnostic:
    """Make a finding of a row of JSON.

    Raises:
        ValueError, TypeError, LookupError: it is none.
    """
    name, message, location, severity, found, expected, advice, related, fix = row
    registered = find_rule(name)
    if registered is None:
        raise KeyError(name)
    made = fix and Fix(fix[0], tuple(TextEdit(Span(a, b), new, file) for a, b, new, file in fix[1]), Safety(fix[2]))
    places = tuple(Location(*each) for each in related)
    rule, where, level = registered.rule, Location(*location), Severity(severity)
    return Diagnostic(rule, message, where, level, found, expected, advice, places, made)
