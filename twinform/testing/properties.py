"""Properties of models and passes, as functions that raise `AssertionError` with the reason; round trips of models.

A model is a document, a path, or the text or bytes of a file.
"""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple, Self

from twinform.compiler import URDF_VERSIONS, CompileError, Language, UrdfVersion, convert
from twinform.compiler.compare import diff
from twinform.compiler.expand_includes import expand
from twinform.compiler.input.loading import LoadOptions, read
from twinform.compiler.normal_form import normal_form
from twinform.compiler.output.emitting import emit
from twinform.compiler.resolve_uris import SearchPath
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink
from twinform.diagnostics.reporters import REPORTERS, FileFindings
from twinform.ir import Document, Format
from twinform.ir.verify import verify
from twinform.passes import Pass
from twinform.passes.includes import has_includes
from twinform.passes.legalise.to_urdf.select_model import SelectModel
from twinform.passes.shared.candidates import name_once_expanded, wanted_includes
from twinform.schemas import versions_of

Model = Document | Path | str | bytes


def assert_valid(model: Model, *, strict: bool = False) -> Document:
    """Assert that a model has no error, and return its document."""
    text, name = _text(model)
    checked = read(text, LoadOptions(strict=strict), name=name)
    errors = [each for each in checked.diagnostics if each.is_error]
    assert not errors, _report(name, errors)
    assert checked.document is not None
    return checked.document


def assert_round_trip(model: Model, *, via: Language | None = None, sdf_version: str | None = None) -> None:
    """Assert that a model survives a round trip: written and read, or through the language `via` and back.

    Written and read in its own language or JSON, it is the same document. Through another one it is the same robot, and
    through MJCF a world the same world, with every name, attribute and text that is not the spelling of a default, and
    with nothing more (`twinform.normal_form`). `sdf_version` is the version of SDF to go through.
    """
    document = assert_valid(model)
    source, _ = _text(model if not isinstance(model, Path) or model.suffix == ".xacro" else document)
    if via in (None, "json", document.format.value):
        again = assert_valid(_converted(source, "json") if via == "json" else _emitted(document))
        assert again == document, f"the document is another one {'once read again' if via != 'json' else 'after json'}"
        return
    there = _converted(source, via, sdf_version if via == "sdf" else None)
    assert_valid(there)
    is_whole = via == "mjcf" and not has_includes(document)
    trip = RoundTrip.of_whole(source, document) if is_whole else RoundTrip.of(source, document)
    try:
        mismatches = [one.message for one in trip.mismatches(trip.back(there))]
    except CompileError as error:
        raise AssertionError(f"it does not come back from {via}:\n{_report('', error.diagnostics)}") from error
    assert not mismatches, f"it does not come back from {via} as it was:\n" + "\n".join(mismatches[:20])


def assert_same_robot(one: Model, other: Model) -> None:
    """Assert that two models describe the same robot, in whatever formats."""
    found = diff(_text(one)[0], _text(other)[0], carriers=True).differences
    assert not found, "they are not the same robot:\n" + "\n".join(each.message for each in found[:20])


def assert_pass_contract(step: Pass, model: Model, *, idempotent: bool = False) -> Document:
    """Assert that a pass makes a valid document of a valid one, the same each time, and leaves its input alone.

    Returns the document that it makes, which is not checked if the pass reports an error: that is a verdict on the
    model. With `idempotent`, running the pass again must change nothing more.
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


ANOTHER_ROBOT = "another robot"


class Mismatch(NamedTuple):
    """Something that did not survive a round trip; `kind` is that of a `Discrepancy`, or `ANOTHER_ROBOT`.

    `path` is the XPath in the source, or in the restored text if the source has no such part.
    """

    kind: str
    path: str
    message: str


@dataclass(frozen=True, slots=True)
class RoundTrip:
    """A robot for a round trip through the other format, which has to restore `text`."""

    text: bytes
    format: Format
    version: str | None

    @classmethod
    def of(
        cls, source: Path | bytes, document: Document, *, model: str | None = None, paths: Iterable[str | Path] = ()
    ) -> Self:
        """Make a round trip of a file or text that contains `document`.

        The whole text has to come back if it is one model. Of a world or several models only the model named `model`
        takes part, with its includes expanded, since URDF has neither worlds nor includes.
        """
        if _is_robot(document):
            return cls.of_whole(source, document)
        alone = _select_model(source, document, model, paths)
        return cls(emit(alone, DiagnosticSink()).encode(), alone.format, alone.version)

    @classmethod
    def of_whole(cls, source: Path | bytes, document: Document) -> Self:
        """Make a round trip of all that a file or text holds, as a world in MJCF."""
        text = source.read_bytes() if isinstance(source, Path) else source
        return cls(text, document.format, document.version)

    def back(self, there: str) -> str:
        """Convert a text in the other format back, into the version that the robot had.

        Raises:
            CompileError: the text is refused.
        """
        if self.format is Format.URDF:
            return convert(there.encode(), to="urdf", urdf_version=_urdf_version(self.version)).text
        known = self.version if self.version in versions_of("sdf") else None
        return convert(there.encode(), to="sdf", sdf_version=known).text

    def mismatches(self, back: str) -> Iterator[Mismatch]:
        """Yield what was not restored: the first difference of the robots, and the texts that differ."""
        found = diff(self.text, back.encode(), carriers=True).differences
        if found:
            yield Mismatch(ANOTHER_ROBOT, found[0].a.location.path or found[0].b.location.path, found[0].message)
        source, again = normal_form(self.text, name="source"), normal_form(back.encode(), name="back")
        for one in source.compare(again):
            yield Mismatch(one.kind, one.location.path, one.message)


def _is_robot(document: Document) -> bool:
    """Whether a document has nothing but one model in it."""
    if document.format is Format.URDF:
        return True
    around = (*document.worlds, *document.lights, *document.includes, *document.opaque)
    return len(document.models) == 1 and not around and not has_includes(document)


def _select_model(source: Path | bytes, document: Document, model: str | None, paths: Iterable[str | Path]) -> Document:
    sink = DiagnosticSink()
    alone = SelectModel(model=model).run(document, sink)
    if not sink.has_errors and not has_includes(alone):
        return alone
    load_options = LoadOptions(search=SearchPath.of(paths))
    checked = read(source, load_options)
    whole = expand(checked, load_options, wanted=wanted_includes(checked.document, model)).document or document
    return SelectModel(model=name_once_expanded(checked.document, whole, model)).run(whole, DiagnosticSink())


def _urdf_version(version: str | None) -> UrdfVersion | None:
    return next((known for known in URDF_VERSIONS if known == version), None)
