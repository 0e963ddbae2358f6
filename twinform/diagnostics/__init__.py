"""Findings as values: rules, diagnostics, the ledger, and reporters that only format them."""

from twinform.diagnostics.catalog import catalog
from twinform.diagnostics.diagnostic import Diagnostic
from twinform.diagnostics.did_you_mean import did_you_mean, meant_name, nearest_name
from twinform.diagnostics.fix import Fix, Safety
from twinform.diagnostics.ledger import Entry, Fate, Ledger, PhysicsChange, ValueChange
from twinform.diagnostics.location import NOWHERE, Location, Origins, Source
from twinform.diagnostics.policy import Policy
from twinform.diagnostics.rule import Rule, Severity
from twinform.diagnostics.sink import DiagnosticSink, SideFile
from twinform.diagnostics.text_edit import Span, TextEdit

__all__ = [
    "NOWHERE",
    "Diagnostic",
    "DiagnosticSink",
    "Entry",
    "Fate",
    "Fix",
    "Ledger",
    "Location",
    "Origins",
    "PhysicsChange",
    "Policy",
    "Rule",
    "Safety",
    "Severity",
    "SideFile",
    "Source",
    "Span",
    "TextEdit",
    "ValueChange",
    "catalog",
    "did_you_mean",
    "meant_name",
    "nearest_name",
]
