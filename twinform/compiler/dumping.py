"""Writing a document: `dump` into a file, `dumps` as text, in its own format or as JSON."""

from pathlib import Path
from typing import Literal, get_args

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.loading import LoadOptions, read
from twinform.compiler.input.root_names import FORMATS
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.option import require_value
from twinform.storage.writing import write_atomically

Written = Literal["urdf", "sdf", "mjcf", "json"]


def dumps(document: Document, *, to: Written | None = None) -> str:
    """Write a document as text in its own format, or as JSON where `to` says so.

    Raises:
        CompileError: its format cannot express it; what is wrong is in the diagnostics.
        ValueError: `to` is no format, or another one, for which there is `convert`.
    """
    require_value("to", to, get_args(Written))
    if to not in {None, "json", document.format.value}:
        raise ValueError(
            f"the document is {document.format.upper()}; twinform.convert makes {to.upper() if to else to}"
        )
    # A document that a program has put together may hold anything: it is written and read again, as
    # any file would be.
    checked = read(document, LoadOptions())
    sink = DiagnosticSink(checked.path, diagnostics=[each for each in checked.diagnostics if each.is_error])
    text = ""
    if not sink.has_errors and to == "json":
        from twinform.compiler.output.json import json_text  # noqa: PLC0415 - few documents are written so

        text = json_text(document)
    elif not sink.has_errors:
        text = emit(document, sink)
    if sink.has_errors:
        raise CompileError(tuple(sink.diagnostics))
    return text


def dump(document: Document, path: str | Path, *, to: Written | None = None) -> None:
    """Write a document into a file, all of it or nothing; a name that ends in `.json` asks for JSON.

    Raises:
        CompileError: its format cannot express it; what is wrong is in the diagnostics.
        OSError: the file cannot be written.
        ValueError: the name is that of a file of another format, for which there is `convert`.
    """
    path = Path(path)
    write_atomically(path, dumps(document, to=to or FORMATS.get(path.suffix.lower())))
