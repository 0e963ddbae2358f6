"""Formats the bytes of a model file; what is no XML is refused with the place of the fault."""

from dataclasses import replace

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.parsing import UnreadableError, parse, refuse_excess
from twinform.compiler.input.size_limits import USUAL_LIMITS, Limits, excess_of_bytes
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, rules
from twinform.text import SourceText, UndecodableError, UnplacedError
from twinform.text.formatting import FormatOptions, format_text

_REPAIRED = "not well-formed XML, repaired:"
"""How the reader of models begins what is an error here."""
_REPAIR = "correct it first: a formatter would have to guess what was meant"


def formatted(data: bytes, name: str, options: FormatOptions, limits: Limits = USUAL_LIMITS) -> bytes:
    """The bytes of a file, laid out.

    Raises:
        CompileError: it is not well-formed XML, or beyond the limits.
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
    """Report why a text cannot be formatted, in the words of the reader of models where it has any."""
    try:
        parse(data, sink, limits)
    except UnreadableError:
        return
    if not sink.has_errors:
        line, column = (error.line, error.column) if isinstance(error, UnplacedError) else (0, 0)
        where = Location(line=line or 1, path="/", column=column)
        sink.report(rules.NOT_WELL_FORMED, f"not well-formed XML: {error}", where, help=_REPAIR)


def _not_repaired(diagnostic: Diagnostic) -> Diagnostic:
    return replace(
        diagnostic, message=diagnostic.message.replace("not well-formed XML, repaired:", "not well-formed XML:")
    )
