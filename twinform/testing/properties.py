"""What has to hold for models and passes, as functions that raise AssertionError with the reason.

A model is a document, a path, or the text or bytes of a file.
"""

from pathlib import Path
from typing import Literal

from twinform.compiler import CompileError, convert, read
from twinform.compiler.compare import diff
from twinform.compiler.input.loading import LoadOptions
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import Diagnostic, DiagnosticSink
from twinform.diagnostics.reporters import REPORTERS, FileFindings
from twinform.ir import Document
from twinform.ir.verify import verify
from twinform.passes import Pass
from twinform.testing.round_trips import RoundTrip

Model = Document | Path | str | bytes
Language = Literal["urdf", "sdf", "json"]


def assert_valid(model: Model, *, strict: bool = False) -> Document:
    """The document of a model that has no error."""
    text, name = _text(model)
    checked = read(text, LoadOptions(strict=strict), name=name)
    errors = [each for each in checked.diagnostics if each.is_error]
    assert not errors, _report(name, errors)
    assert checked.document is not None
    return checked.document


def assert_round_trip(model: Model, *, via: Language | None = None, sdf_version: str | None = None) -> None:
    """Round trips: written and read it is the same document; through the other format the same robot and texts.

    Through the other format, every name, attribute and text that is not the spelling of a default is back, and nothing
    else has come along: `twinform.normal_form`. `sdf_version` is the version of SDF to go through.
    """
    document = assert_valid(model)
    source, _ = _text(model if not isinstance(model, Path) or model.suffix == ".xacro" else document)
    if via in (None, "json", document.format.value):
        again = assert_valid(_converted(source, "json") if via == "json" else _emitted(document))
        assert again == document, f"the document is another one {'once read again' if via != 'json' else 'after json'}"
        return
    there = _converted(source, via, sdf_version if via == "sdf" else None)
    assert_valid(there)
    trip = RoundTrip.of(source, document)
    try:
        mismatches = [one.message for one in trip.mismatches(trip.back(there))]
    except CompileError as error:
        raise AssertionError(f"it does not come back from {via}:\n{_report('', error.diagnostics)}") from error
    assert not mismatches, f"it does not come back from {via} as it was:\n" + "\n".join(mismatches[:20])


def assert_same_robot(one: Model, other: Model) -> None:
    """Two models describe the same robot, of whatever formats."""
    found = diff(_text(one)[0], _text(other)[0], carriers=True).differences
    assert not found, "they are not the same robot:\n" + "\n".join(each.message for each in found[:20])


def assert_pass_contract(step: Pass, model: Model, *, idempotent: bool = False) -> Document:
    """A pass makes valid of valid, the same each time, and leaves its input alone; gives what it makes.

    What it reports as an error is its verdict on the model, and no fault of it: then its document is not looked at.
    With `idempotent`, running it again changes nothing more.
    """
    document = assert_valid(model)
    before = document.model_dump_json()
    sink, again = DiagnosticSink(), DiagnosticSink()
    made = step.run(document, sink)
    assert step.run(document, again) == made, f"{step.name} makes something else of the same document"
    assert again.diagnostics == sink.diagnostics, f"{step.name} reports something else of the same document"
    assert again.entries == sink.entries, f"{step.name} accounts for something else of the same document"
    assert document.model_dump_json() == before, f"{step.name} changes the document that it is given"
    if sink.has_errors:
        return made
    found = DiagnosticSink()
    verify(made, found)
    errors = [each for each in found.diagnostics if each.is_error]
    assert not errors, f"{step.name} makes a document that is not valid:\n{_report('', errors)}"
    assert_valid(_emitted(made))
    if idempotent:
        assert step.run(made, DiagnosticSink()) == made, f"{step.name} changes what it has made"
    return made


def _text(model: Model) -> tuple[bytes | Path, str]:
    if isinstance(model, Document):
        return _emitted(model), "<document>"
    if isinstance(model, Path):
        return model, str(model)
    return (model.encode() if isinstance(model, str) else model), "<text>"


def _emitted(document: Document) -> bytes:
    sink = DiagnosticSink()
    text = emit(document, sink)
    assert not sink.has_errors, "it cannot be written:\n" + _report("", sink.diagnostics)
    return text.encode()


def _converted(text: bytes | Path, to: Language, sdf_version: str | None = None) -> str:
    try:
        return convert(text, to=to, sdf_version=sdf_version).text
    except CompileError as error:
        raise AssertionError(f"it cannot become {to}:\n{_report('', error.diagnostics)}") from error


def _report(name: str, diagnostics: list[Diagnostic] | tuple[Diagnostic, ...]) -> str:
    return REPORTERS["text"]([FileFindings(name, tuple(diagnostics))])
