"""Findings as diagnostics of the protocol, with ranges, severities and related places."""

from collections.abc import Callable, Iterable
from pathlib import Path

from lsprotocol import types

from twinform.diagnostics import Diagnostic, Location, Severity, Span
from twinform.diagnostics.catalog import more_about, rule_address
from twinform.server.documents import TextDocument
from twinform.server.tolerant_tree import Tree

SOURCE = "twinform"
_SEVERITIES = {
    Severity.ERROR: types.DiagnosticSeverity.Error,
    Severity.WARNING: types.DiagnosticSeverity.Warning,
    Severity.INFO: types.DiagnosticSeverity.Information,
}

DocumentOf = Callable[[Path], TextDocument | None]
"""Returns the document of a file, with the text of the editor if it is open, else from the disk."""


def by_file(found: Iterable[Diagnostic], top: Path) -> dict[Path, list[Diagnostic]]:
    """Group findings by file, without duplicates; `top` has a list even if it has no findings."""
    files: dict[Path, dict[tuple[str, str, int, str], Diagnostic]] = {top: {}}
    for each in found:
        where = each.location
        file = Path(where.file) if where.file else top
        files.setdefault(file, {}).setdefault((each.rule.name, each.message, where.line, where.path), each)
    return {file: list(own.values()) for file, own in files.items()}


def as_protocol(found: Diagnostic, document: TextDocument, document_of: DocumentOf) -> types.Diagnostic:
    """Convert a finding about a document."""
    name = found.rule.name
    address = rule_address(name)
    message = "\n".join(filter(None, [found.message, found.help, "" if address else f"more: {more_about(name)}"]))
    return types.Diagnostic(
        range=document.positions.range(span_of(found.location, document)),
        message=message,
        severity=_SEVERITIES[found.severity],
        code=name,
        code_description=types.CodeDescription(address) if address else None,
        source=SOURCE,
        related_information=_related_information(found, document_of) or None,
    )


def notice(message: str, severity: types.DiagnosticSeverity = types.DiagnosticSeverity.Warning) -> types.Diagnostic:
    """Make a diagnostic about a whole document."""
    start = types.Position(0, 0)
    return types.Diagnostic(types.Range(start, start), message, severity, source=SOURCE)


def span_of(where: Location, document: TextDocument) -> Span:
    """Find the piece of text of a location, by its columns or else by its line and the last step of its path."""
    positions = document.positions
    if where.column and 0 < where.line <= len(positions.starts):
        start = positions.starts[where.line - 1] + where.column - 1
        end_line = where.end_line if 0 < where.end_line <= len(positions.starts) else where.line
        end = positions.starts[end_line - 1] + where.end_column - 1 if where.end_column else start + 1
        return Span(start, max(start, min(end, len(document.text))))
    line = positions.line_span(where.line)
    return _find_part(where, document.tree, line) or line


def _find_part(where: Location, tree: Tree, line: Span) -> Span | None:
    """Find the element or attribute of a path on a line; None if no element begins on the line."""
    here = [node for node in tree.nodes if line.start <= node.start < line.end]
    path, _, attribute = where.path.partition("/@")
    tag = path.rpartition("/")[2].partition("[")[0]
    node = next((each for each in here if each.tag == tag), here[0] if here else None)
    if node is None:
        return None
    if attribute in node.attributes:
        return node.attributes[attribute].whole
    return node.start_tag if node.whole_tag else node.name


def _related_information(found: Diagnostic, document_of: DocumentOf) -> list[types.DiagnosticRelatedInformation]:
    made: list[types.DiagnosticRelatedInformation] = []
    for where in found.related:
        document = document_of(Path(where.file)) if where.file else None
        if document is not None:
            place = types.Location(document.uri, document.positions.range(span_of(where, document)))
            made.append(types.DiagnosticRelatedInformation(place, where.path or "see"))
    return made
