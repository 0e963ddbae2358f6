"""Reporters: one file for each output format; they format and never decide."""

from collections.abc import Mapping, Sequence
from importlib import import_module
from types import MappingProxyType

from twinform.diagnostics.reporters.file_findings import NO_TEXTS, FileFindings, FileTexts, Reporter, printable
from twinform.diagnostics.reporters.text import Paint, concise, text


def _of_module(name: str) -> Reporter:
    """The reporter in the module of its name, which is imported when something is reported."""

    def report(files: Sequence[FileFindings]) -> str:
        reporter: Reporter = getattr(import_module(f"{__name__}.{name}"), name)
        return reporter(files)

    return report


REPORTERS: Mapping[str, Reporter] = MappingProxyType(
    {"text": text, "concise": concise} | {name: _of_module(name) for name in ("json", "sarif", "github", "junit")}
)
"""Every output format by its name on the command line."""

__all__ = ["NO_TEXTS", "REPORTERS", "FileFindings", "FileTexts", "Paint", "Reporter", "concise", "printable", "text"]
