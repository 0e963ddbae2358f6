"""Findings as values: rules, diagnostics, the ledger, and reporters that only format them."""

from twinform.diagnostics.catalog import catalog
from twinform.diagnostics.diagnostic import (
    NOWHERE,
    Diagnostic,
    Fix,
    LineOrigins,
    Location,
    Rule,
    Safety,
    Severity,
    Source,
    Span,
    TextEdit,
)
from twinform.diagnostics.did_you_mean import (
    did_you_mean,
    is_misspelt,
    is_typo,
    meant_name,
    near_names,
    nearest_name,
    suggest,
)
from twinform.diagnostics.ledger import Fate, Ledger, LedgerEntry, PhysicsChange, ValueChange
from twinform.diagnostics.sink import HEAD, DiagnosticSink, Policy, SideFile

__all__ = [
    "HEAD",
    "NOWHERE",
    "Diagnostic",
    "DiagnosticSink",
    "Fate",
    "Fix",
    "Ledger",
    "LedgerEntry",
    "LineOrigins",
    "Location",
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
    "is_misspelt",
    "is_typo",
    "meant_name",
    "near_names",
    "nearest_name",
    "suggest",
]
