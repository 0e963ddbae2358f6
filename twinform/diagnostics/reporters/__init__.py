"""Reporters: one file for each output format; they format and never decide."""

from collections.abc import Mapping
from types import MappingProxyType

from twinform.diagnostics.reporters.findings import Findings, Reporter
from twinform.diagnostics.reporters.github import github
from twinform.diagnostics.reporters.json import json
from twinform.diagnostics.reporters.sarif import sarif
from twinform.diagnostics.reporters.text import Paint, printable, text

REPORTERS: Mapping[str, Reporter] = MappingProxyType({"text": text, "json": json, "sarif": sarif, "github": github})
"""Every output format by its name on the command line."""

__all__ = ["REPORTERS", "Findings", "Paint", "Reporter", "printable", "text"]
