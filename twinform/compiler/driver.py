"""The way of the data: load, the user's passes, legalisation, back end."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

from twinform.compiler.emitting import emit
from twinform.compiler.errors import CompileError
from twinform.compiler.includes import expand
from twinform.compiler.loading import Checked, Reading, garbage_collection_paused, read
from twinform.compiler.uris import SearchPath
from twinform.diagnostics import Diagnostic, Ledger, Notes
from twinform.diagnostics.rules.model import MISSING_LIMIT
from twinform.diagnostics.rules.structure import MISSING_ATTRIBUTE
from twinform.ir import Document, Format
from twinform.ir.verify import verify, verify_again
from twinform.passes import Pass, Pipeline, parse_pipeline
from twinform.passes.legalise import Target, legalisation
from twinform.passes.legalise.candidates import name_once_expanded, wanted_includes
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Order:
    """What a conversion is asked for; `passes` are the user's."""

    to: Language
    sdf_version: str | None = None
    urdf_version: UrdfVersion = "1.0"
    passes: Pipeline = field(default_factory=Pipeline)
    carriers: bool = True
    model: str | None = None
    expand_includes: bool = False

    def legalisation(self, source: Document) -> Pipeline:
        """The passes that the target asks for."""
        if self.to == "json":
            return Pipeline()
        own = source.version if source.format is Format.SDF else None
        version = self.sdf_version or own or DEFAULT_SDF_VERSION
        target = Target(Format(self.to), version, self.urdf_version, self.carriers, self.model)
        return Pipeline(legalisation(source.format, source.version, target))

    def plan(self, source: Document) -> Pipeline:
        """Every pass that a conversion of this document runs, in order: the user's, then those of the target."""
        return Pipeline((*self.passes, *self.legalisation(source)))


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
    """Every pass that `convert` runs on this document."""
    order = Order(
        to=to,
        sdf_version=sdf_version,
        urdf_version=urdf_version,
        passes=_pipeline(passes),
        carriers=carriers,
        model=model,
    )
    return order.plan(source)


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
    paths: Iterable[str | Path] = (),
    arguments: Mapping[str, str] | None = None,
    xacro: bool = True,
    expand_includes: bool = False,
    watch: Callable[[str, Document], None] | None = None,
) -> Conversion:
    """Compile a file, or the bytes of one, into the target's language; `watch` sees the document after each pass.

    `paths`, `arguments` and `xacro` are those of `check`. URDF has no includes: for it, those in the model are always
    expanded.

    Raises:
        CompileError: the source, a pass or the result has an error.
        PipelineError: `passes` is not a pipeline.
    """
    order = Order(
        to=to,
        sdf_version=sdf_version,
        urdf_version=urdf_version,
        passes=_pipeline(passes),
        carriers=carriers,
        model=model,
        expand_includes=expand_includes,
    )
    how = Reading(strict, engine, SearchPath.of(paths), arguments or {}, xacro)
    return fulfil(order, source, how, name=name, watch=watch)


def fulfil(
    order: Order,
    source: str | Path | bytes,
    how: Reading,
    *,
    name: str = "",
    watch: Callable[[str, Document], None] | None = None,
) -> Conversion:
    """`convert`, with all that is asked for in one place.

    Raises:
        CompileError: the source, a pass or the result has an error.
    """
    with garbage_collection_paused():
        checked = read(source, how, name=name)
        if checked.accepted and (order.expand_includes or order.to == "urdf"):
            wanted = None if order.expand_includes else wanted_includes(checked.document, order.model)
            before, checked = checked, expand(checked, how, wanted=wanted, carriers=order.carriers)
            order = replace(order, model=name_once_expanded(before.document, checked.document, order.model))
        if checked.document is None or not (checked.accepted or (order.passes and _may_be_mended(checked))):
            raise CompileError(checked.diagnostics, unreadable=checked.unreadable)
        return _run(checked, checked.document, order, strict=how.strict, watch=watch)


def _pipeline(passes: str | Sequence[Pass] | None) -> Pipeline:
    return parse_pipeline(passes) if isinstance(passes, str) else Pipeline(tuple(passes or ()))


def _run(
    checked: Checked,
    document: Document,
    order: Order,
    *,
    strict: bool,
    watch: Callable[[str, Document], None] | None,
) -> Conversion:
    kept = [each for each in checked.diagnostics if not each.is_error]
    notes = Notes(checked.path, strict, kept, list(checked.entries), origins=dict(checked.origins))
    legal = order.legalisation(document)
    document = order.passes.run(document, notes, watch=watch, verify=verify if checked.accepted else None)
    if not checked.accepted:
        verify(document, notes)
    if not notes.has_errors and len(legal):
        document = legal.run(document, notes, watch=watch)
        if not notes.has_errors:
            verify_again(document, notes)
    text = "" if notes.has_errors else _write(document, order.to, notes, fit=checked.mixed or bool(len(legal)))
    if notes.has_errors:
        raise CompileError(tuple(notes.diagnostics))
    lost = sum(entry.weight for entry in notes.entries)
    ledger = Ledger(max(0, checked.size - lost), tuple(notes.entries))
    return Conversion(text, document, tuple(notes.diagnostics), ledger)


def _may_be_mended(checked: Checked) -> bool:
    """Whether nothing is wrong but what a pass can put right: limits that are missing."""
    errors = [each for each in checked.diagnostics if each.is_error]
    return all(
        each.rule is MISSING_LIMIT or (each.rule is MISSING_ATTRIBUTE and each.location.path.endswith("/limit"))
        for each in errors
    )


def _write(document: Document, to: Language, notes: Notes, *, fit: bool) -> str:
    if to == "json":
        return document.model_dump_json(indent=2, exclude_defaults=True) + "\n"
    return emit(document, notes, fit=fit)
