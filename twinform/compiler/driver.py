"""The way of the data: load, the user's passes, legalisation, back end."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from twinform.compiler.emitting import emit
from twinform.compiler.errors import CompileError
from twinform.compiler.loading import Checked, check, garbage_collection_paused
from twinform.diagnostics import Diagnostic, Ledger, Notes
from twinform.ir import Document, Format
from twinform.ir.verify import verify, verify_again
from twinform.passes import Pass, Pipeline, parse_pipeline
from twinform.passes.legalise import Target, legalisation
from twinform.schemas import Engine

Language = Literal["sdf", "urdf", "json"]
UrdfVersion = Literal["1.0", "1.1", "1.2"]
DEFAULT_SDF_VERSION = "1.11"
"""The version of Gazebo Harmonic, the newest long-term release, and the first that can say `mimic`."""


@dataclass(frozen=True, slots=True)
class Conversion:
    """What `convert` made: the text, the document that it says, and what was found and lost on the way."""

    text: str
    document: Document
    diagnostics: tuple[Diagnostic, ...]
    ledger: Ledger


def plan(
    source: Document,
    *,
    to: Language,
    sdf_version: str | None = None,
    urdf_version: UrdfVersion = "1.0",
    passes: str | Sequence[Pass] | None = None,
    carriers: bool = True,
    model: str | None = None,
) -> Pipeline:
    """Every pass that a conversion of this document runs, in order: the user's, then those that the target asks for."""
    users = _pipeline(passes)
    return Pipeline((*users, *_legalisation(source, to, sdf_version, urdf_version, carriers=carriers, model=model)))


def convert(
    source: str | Path | bytes,
    *,
    to: Language,
    name: str = "",
    sdf_version: str | None = None,
    urdf_version: UrdfVersion = "1.0",
    passes: str | Sequence[Pass] | None = None,
    strict: bool = False,
    carriers: bool = True,
    model: str | None = None,
    engine: Engine = "libxml2",
    watch: Callable[[str, Document], None] | None = None,
) -> Conversion:
    """Compile a file, or the bytes of one, into the target's language; `watch` sees the document after each pass.

    Raises:
        CompileError: the source, a pass or the result has an error.
        PipelineError: `passes` is not a pipeline.
    """
    users = _pipeline(passes)
    with garbage_collection_paused():
        checked = check(source, name=name, strict=strict, engine=engine)
        if checked.document is None or not checked.accepted:
            raise CompileError(checked.diagnostics, unreadable=checked.unreadable)
        legal = _legalisation(checked.document, to, sdf_version, urdf_version, carriers=carriers, model=model)
        return _run(checked, checked.document, users, legal, to, strict=strict, watch=watch)


def _pipeline(passes: str | Sequence[Pass] | None) -> Pipeline:
    return parse_pipeline(passes) if isinstance(passes, str) else Pipeline(tuple(passes or ()))


def _legalisation(
    source: Document,
    to: Language,
    sdf_version: str | None,
    urdf_version: UrdfVersion,
    *,
    carriers: bool,
    model: str | None,
) -> Pipeline:
    if to == "json":
        return Pipeline()
    own = source.version if source.format is Format.SDF else None
    target = Target(Format(to), sdf_version or own or DEFAULT_SDF_VERSION, urdf_version, carriers, model)
    return Pipeline(legalisation(source.format, source.version, target))


def _run(
    checked: Checked,
    document: Document,
    users: Pipeline,
    legal: Pipeline,
    to: Language,
    *,
    strict: bool,
    watch: Callable[[str, Document], None] | None,
) -> Conversion:
    notes = Notes(file=checked.path, strict=strict, diagnostics=list(checked.diagnostics))
    document = users.run(document, notes, watch=watch, verify=verify)
    if not notes.has_errors and len(legal):
        document = legal.run(document, notes, watch=watch)
        if not notes.has_errors:
            verify_again(document, notes)
    text = "" if notes.has_errors else _write(document, to, notes, fit=bool(len(legal)))
    if notes.has_errors:
        raise CompileError(tuple(notes.diagnostics))
    lost = sum(entry.weight for entry in notes.entries)
    ledger = Ledger(max(0, checked.size - lost), tuple(notes.entries))
    return Conversion(text, document, tuple(notes.diagnostics), ledger)


def _write(document: Document, to: Language, notes: Notes, *, fit: bool) -> str:
    if to == "json":
        return document.model_dump_json(indent=2, exclude_defaults=True) + "\n"
    return emit(document, notes, fit=fit)
