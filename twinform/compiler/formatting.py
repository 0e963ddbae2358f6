"""Formats the bytes of a model file, and reports why a file cannot be formatted."""

from dataclasses import replace

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.parsing import UnreadableError, parse, refuse_excess
from twinform.compiler.input.size_limits import USUAL_LIMITS, Limits, excess_of_bytes
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, rules
from twinform.text import SourceText, UndecodableError, UnplacedError
from twinform.text.formatting import FormatOptions, format_text

_REPAIR = "correct it first: a formatter would have to guess what was meant"


def formatted(data: bytes, name: str, options: FormatOptions, limits: Limits = USUAL_LIMITS) -> bytes:
    """Return the bytes of a file, formatted.

    Raises:
        CompileError: the file is not well-formed XML, or exceeds the limits.
    """
    sink = DiagnosticSink(name, strict=True)  # what others repair is an error here
    try:
        refuse_excess(excess_of_bytes(data, limits), sink)
        return format_text(SourceText.of(data), options).data
    except UnreadableError as error:
        raise CompileError(tuple(sink.diagnostics), unreadable=True) from error
    except (UndecodableError, UnplacedError, UnicodeEncodeError) as error:
        _explain(data, error, sink, limits)
        raise CompileError(tuple(map(_not_repaired, sink.diagnostics)), unreadable=True) from error


def _explain(data: bytes, error: ValueError, sink: DiagnosticSink, limits: Limits) -> None:
    """Report why a text cannot be formatted, as the parser does if it finds something."""
    try:
        parse(data, sink, limits)
    except UnreadableError:
        return
    if not sink.has_errors:
        line, column = (error.line, error.column) if isinstance(error, UnplacedError) else (0, 0)
        where = Location(line=line or 1, path="/", column=column)
        sink.report(rules.NOT_WELL_FORMED, f"not well-formed XML: {error}", where, help=_REPAIR)


def _not_repaired(diagnostic: Diagnostic) -> Diagnostic:
    return replace(diagnostic, message=diagnostic.message.replace(", repaired:", ":", 1))
