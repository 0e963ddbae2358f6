"""Reporters: one file for each output format; they format and never decide."""

from collections.abc import Mapping
from types import MappingProxyType

from twinform.diagnostics.reporters.file_findings import NO_TEXTS, FileFindings, FileTexts, Reporter, printable
from twinform.diagnostics.reporters.github import github
from twinform.diagnostics.reporters.json import json
from twinform.diagnostics.reporters.junit import junit
from twinform.diagnostics.reporters.sarif import sarif
from twinform.diagnostics.reporters.text import Paint, concise, text

REPORTERS: Mapping[str, Reporter] = MappingProxyType(
    {"text": text, "concise": concise, "json": json, "sarif": sarif, "github": github, "junit": junit}
)
"""Every output format by its name on the command line."""

__all__ = ["NO_TEXTS", "REPORTERS", "FileFindings", "FileTexts", "Paint", "Reporter", "concise", "printable", "text"]
