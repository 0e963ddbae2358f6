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
from twinform.ir.verify import verify
from twinform.passes import Pass, Pipeline, parse_pipeline
from twinform.passes.legalise import legalisation
from twinform.schemas import Engine

Target = Literal["sdf", "urdf", "json"]
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
    to: Target,
    sdf_version: str | None = None,
    passes: str | Sequence[Pass] | None = None,
    carriers: bool = True,
    model: str | None = None,
) -> Pipeline:
    """Every pass that a conversion of this document runs, in order: the user's, then those that the target asks for."""
    users, legal = _stages(source, to, sdf_version, passes, carriers=carriers, model=model)
    return Pipeline((*users.passes, *legal.passes))


def _stages(
    source: Document,
    to: Target,
    sdf_version: str | None,
    passes: str | Sequence[Pass] | None,
    *,
    carriers: bool,
    model: str | None,
) -> tuple[Pipeline, Pipeline]:
    """The user's passes, between which the document is verified, and legalisation, which is whole only at its end."""
    users = parse_pipeline(passes) if isinstance(passes, str) else Pipeline(tuple(passes or ()))
    if to == "json":
        return users, Pipeline()
    version = sdf_version or (source.version if source.format is Format.SDF else None) or DEFAULT_SDF_VERSION
    legal = legalisation(source.format, Format(to), sdf_version=version, carriers=carriers, model=model)
    return users, Pipeline(legal)


def convert(
    source: str | Path | bytes,
    *,
    to: Target,
    name: str = "",
    sdf_version: str | None = None,
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
    with garbage_collection_paused():
        checked = check(source, name=name, strict=strict, engine=engine)
        if checked.document is None or not checked.accepted:
            raise CompileError(checked.diagnostics, unreadable=checked.unreadable)
        stages = _stages(checked.document, to, sdf_version, passes, carriers=carriers, model=model)
        return _run(checked, stages, to, strict=strict, watch=watch)


def _run(
    checked: Checked,
    stages: tuple[Pipeline, Pipeline],
    to: Target,
    *,
    strict: bool,
    watch: Callable[[str, Document], None] | None,
) -> Conversion:
    assert checked.document is not None  # noqa: S101 - the caller looked
    notes = Notes(file=checked.path, strict=strict, diagnostics=list(checked.diagnostics))
    users, legal = stages
    document = users.run(checked.document, notes, watch=watch, verify=verify)
    if not notes.has_errors and len(legal):
        document = legal.run(document, notes, watch=watch)
        if not notes.has_errors:
            verify(document, notes)
    text = "" if notes.has_errors else _write(document, to, notes)
    if notes.has_errors:
        raise CompileError(tuple(notes.diagnostics))
    lost = sum(entry.weight for entry in notes.entries)
    ledger = Ledger(max(0, checked.size - lost), tuple(notes.entries))
    return Conversion(text, document, tuple(notes.diagnostics), ledger)


def _write(document: Document, to: Target, notes: Notes) -> str:
    if to == "json":
        return document.model_dump_json(indent=2, exclude_defaults=True) + "\n"
    return emit(document, notes)
