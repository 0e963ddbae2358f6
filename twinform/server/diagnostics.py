"""Findings as diagnostics of the protocol: ranges, severities, related places."""

from collections.abc import Callable, Iterable
from pathlib import Path

from lsprotocol import types

from twinform.diagnostics import Diagnostic, Location, Severity, Span, catalog
from twinform.diagnostics.catalog import rule_address
from twinform.server.documents import TextDocument
from twinform.server.tolerant_tree import TolerantNode, Tree

SOURCE = "twinform"
_SEVERITIES = {
    Severity.ERROR: types.DiagnosticSeverity.Error,
    Severity.WARNING: types.DiagnosticSeverity.Warning,
    Severity.INFO: types.DiagnosticSeverity.Information,
}
"""How the editor shows findings."""

DocumentOf = Callable[[Path], TextDocument | None]
"""The text of a file: that of the editor, or else that on the disk."""


def by_file(found: Iterable[Diagnostic], top: Path) -> dict[Path, list[Diagnostic]]:
    """Findings by the files that they are in; those of one place that say the same once. `top` has its list always."""
    files: dict[Path, dict[tuple[str, str, int, str], Diagnostic]] = {top: {}}
    for each in found:
        where = each.location
        file = Path(where.file) if where.file else top
        files.setdefault(file, {}).setdefault((each.rule.name, each.message, where.line, where.path), each)
    return {file: list(own.values()) for file, own in files.items()}


def as_protocol(found: Diagnostic, document: TextDocument, document_of: DocumentOf) -> types.Diagnostic:
    """A finding about a document."""
    message = f"{found.message}\n{found.help}" if found.help else found.message
    return types.Diagnostic(
        range=document.positions.range(span_of(found.location, document)),
        message=message,
        severity=_SEVERITIES[found.severity],
        code=found.rule.name,
        code_description=_page(found),
        source=SOURCE,
        related_information=_related(found, document_of) or None,
    )


def notice(message: str, severity: types.DiagnosticSeverity = types.DiagnosticSeverity.Warning) -> types.Diagnostic:
    """What there is to say of a whole document."""
    start = types.Position(0, 0)
    return types.Diagnostic(types.Range(start, start), message, severity, source=SOURCE)


def span_of(where: Location, document: TextDocument) -> Span:
    """The piece of a text that a location means: by its columns, or else by its line and what its path ends with."""
    positions = document.positions
    if where.column and 0 < where.line <= len(positions.starts):
        start = positions.starts[where.line - 1] + where.column - 1
        end_line = where.end_line if 0 < where.end_line <= len(positions.starts) else where.line
        end = positions.starts[end_line - 1] + where.end_column - 1 if where.end_column else start + 1
        return Span(start, max(start, min(end, len(document.text))))
    return _part(where, document.tree, positions.line_span(where.line)) or positions.line_span(where.line)


def _part(where: Location, tree: Tree, line: Span) -> Span | None:
    """The element on a line that a path leads to, or its attribute; None where no element begins there."""
    here = [node for node in tree.nodes if line.start <= node.start_tag.start < line.end]
    path, _, attribute = where.path.partition("/@")
    tag = path.rpartition("/")[2].partition("[")[0]
    node = next((each for each in here if each.tag == tag), here[0] if here else None)
    if node is None:
        return None
    return node.attributes[attribute].whole if attribute in node.attributes else _start_tag(node)


def _start_tag(node: TolerantNode) -> Span:
    return node.start_tag if node.whole_tag else node.name


def _related(found: Diagnostic, document_of: DocumentOf) -> list[types.DiagnosticRelatedInformation]:
    made: list[types.DiagnosticRelatedInformation] = []
    for where in found.related:
        document = document_of(Path(where.file)) if where.file else None
        if document is not None:
            place = types.Location(document.uri, document.positions.range(span_of(where, document)))
            made.append(types.DiagnosticRelatedInformation(place, where.path or "see"))
    return made


def _page(found: Diagnostic) -> types.CodeDescription | None:
    """The page of one of our own rules."""
    return types.CodeDescription(rule_address(found.rule.name)) if found.rule.name in catalog() else None
