"""Findings as values: rules, diagnostics, the ledger, and reporters that only format them."""

from twinform.diagnostics.catalogue import catalogue
from twinform.diagnostics.companion import Companion
from twinform.diagnostics.diagnostic import Diagnostic
from twinform.diagnostics.did_you_mean import did_you_mean, nearest_name
from twinform.diagnostics.ledger import Entry, Fate, Ledger
from twinform.diagnostics.location import NOWHERE, Location, Source
from twinform.diagnostics.notes import Notes
from twinform.diagnostics.origins import Origins
from twinform.diagnostics.policy import Policy
from twinform.diagnostics.rule import Rule, Severity

__all__ = [
    "NOWHERE",
    "Companion",
    "Diagnostic",
    "Entry",
    "Fate",
    "Ledger",
    "Location",
    "Notes",
    "Origins",
    "Policy",
    "Rule",
    "Severity",
    "Source",
    "catalogue",
    "did_you_mean",
    "nearest_name",
]
