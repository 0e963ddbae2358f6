"""Expands a xacro file to text, with the origin of each line."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lxml import etree

from twinform.compiler.input.load_options import LoadOptions
from twinform.compiler.input.parsing import UnreadableError, read_bytes
from twinform.compiler.input.size_limits import LARGEST
from twinform.compiler.input.xacro.conversation import ask_worker
from twinform.diagnostics import DiagnosticSink, LineOrigins, Location, rules

_EXPAT = re.compile(r"not well-formed XML: .*: line \d+, column (\d+)$")
"""Where expat noticed what is wrong; it counts columns from 0."""
_REMARKS = {"warning: ": rules.XACRO_WARNING, "error: ": rules.XACRO_WARNING}


@dataclass(frozen=True, slots=True)
class Expansion:
    """The expanded text, and where the elements on its lines were written."""

    text: bytes
    origins: LineOrigins


def expand(path: Path, load_options: LoadOptions, sink: DiagnosticSink) -> Expansion:
    """The text of a xacro file.

    Raises:
        UnreadableError: it cannot be expanded; the diagnostics tell why.
    """
    search = load_options.search
    if search.unsaved_of(path) is None:
        read_bytes(path, sink, load_options.limits, search.readable(path))  # says what is wrong, if it cannot be read
    outcome = ask_worker(path, load_options)
    _report_remarks(outcome, sink)
    if "text" not in outcome:
        _report_failure(outcome, sink)
        raise UnreadableError
    for name in outcome["unused"]:
        message = f"the argument {name!r} is not one of the file's"
        sink.report(rules.UNUSED_ARGUMENT, message, Location(line=1), found=name)
    text = outcome["text"].encode()
    if len(text) > LARGEST:
        message = f"the expanded file has {len(text):,} bytes; the limit is {LARGEST:,}"
        sink.report(rules.UNREADABLE_FILE, message)
        raise UnreadableError
    # Nodes of the IR keep the lines of the expanded text, which are the ones that the `xacro`
    # command prints and by which the writer orders children. Findings name the file that the author
    # can edit first.
    return Expansion(text, _origins(text, outcome["places"]))


def _report_failure(outcome: Mapping[str, Any], sink: DiagnosticSink) -> None:
    if "missing" in outcome:
        advice = "run: pip install 'twinform[xacro]'"
        message = f"this is a xacro file, and xacro is not installed ({outcome['missing']})"
        sink.report(rules.XACRO_MISSING, message, Location(line=1), help=advice)
        return
    file, line = outcome["place"]
    found = _EXPAT.search(outcome["error"])
    column = int(found[1]) + 1 if found else 0
    sink.report(rules.XACRO_ERROR, outcome["error"], Location(file, line, "", column), help=outcome.get("help") or None)


def _report_remarks(outcome: Mapping[str, Any], sink: DiagnosticSink) -> None:
    for text, file, line in outcome.get("remarks", ()):
        start = next((start for start in _REMARKS if text.startswith(start)), "")
        rule = _REMARKS.get(start, rules.XACRO_MESSAGE)
        sink.report(rule, text.removeprefix(start), Location(file, line))


def _origins(text: bytes, places: list[tuple[str, int] | None]) -> LineOrigins:
    """Elements are in the same order in the expanded text and in the list of places."""
    parser = etree.XMLParser(remove_comments=True, remove_pis=True, resolve_entities=False, no_network=True)
    try:
        root = etree.fromstring(text, parser)
    except etree.XMLSyntaxError:
        return LineOrigins()  # reading the text will say what is wrong with it
    pairs = zip(root.iter(), places, strict=False)
    return LineOrigins.of((element.sourceline or 0, Location(*place)) for element, place in pairs if place)
