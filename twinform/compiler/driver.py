"""The way of the data: load, the user's passes, legalisation, back end."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from twinform.compiler.emitting import emit, emit_legal
from twinform.compiler.errors import CompileError
from twinform.compiler.includes import expand
from twinform.compiler.loading import Checked, Input, Reading, garbage_collection_paused, read
from twinform.compiler.orders import Language, Order, UrdfVersion
from twinform.compiler.other_documents import OtherDocuments
from twinform.compiler.uris import LocalAssets, SearchPath
from twinform.diagnostics import Companion, Diagnostic, Ledger, Notes
from twinform.diagnostics.rules.model import MISSING_LIMIT
from twinform.diagnostics.rules.structure import MISSING_ATTRIBUTE, OUTSIDE_VERSION
from twinform.ir import Document, Format, Include
from twinform.ir.verify import verify
from twinform.passes import Pass, Pipeline, Watch, parse_pipeline
from twinform.passes.legalise.candidates import candidates, name_once_expanded, wanted_includes
from twinform.passes.legalise.sdf_versions import has_early_frames
from twinform.schemas import Engine, XmlElement, table


@dataclass(frozen=True, slots=True)
class Conversion:
    """What `convert` made: the text, the document that it says, and what was found and lost on the way.

    `source` is the XML that it was made from, for those who count: `twinform.compiler.audit`. `companions` are files
    that passes made to lie beside the text.
    """

    text: str
    document: Document
    diagnostics: tuple[Diagnostic, ...]
    ledger: Ledger
    source: XmlElement | None = field(default=None, repr=False, compare=False)
    companions: tuple[Companion, ...] = ()


def plan(
    source: Document,
    *,
    to: Language,
    sdf_version: str | None = None,
    urdf_version: UrdfVersion | None = None,
    passes: str | Sequence[Pass] | None = None,
    carriers: bool = True,
    model: str | None = None,
) -> Pipeline:
    """Every pass that `convert` runs on this document.

    Raises:
        ValueError: SDF has no such version.
    """
    order = Order(
        to=to,
        sdf_version=_known(sdf_version),
        urdf_version=urdf_version,
        passes=_pipeline(passes),
        carriers=carriers,
        model=model,
    )
    return order.plan(source)


def convert(
    source: Input,
    *,
    to: Language,
    name: str = "",
    sdf_version: str | None = None,
    urdf_version: UrdfVersion | None = None,
    passes: str | Sequence[Pass] | None = None,
    strict: bool = False,
    carriers: bool = True,
    model: str | None = None,
    engine: Engine = "libxml2",
    paths: Iterable[str | Path] = (),
    arguments: Mapping[str, str] | None = None,
    xacro: bool | None = None,
    expand_includes: bool = False,
    watch: Watch | None = None,
) -> Conversion:
    """Compile a file, the bytes of one or a document into the target's language; `watch` is told of each pass.

    `paths`, `arguments` and `xacro` are those of `check`. URDF has no includes: for it, those in the model are always
    expanded.

    Raises:
        CompileError: the source, a pass or the result has an error.
        PassError: a pass is at fault.
        PipelineError: `passes` is not a pipeline.
        ValueError: SDF has no such version.
    """
    order = Order(
        to=to,
        sdf_version=_known(sdf_version),
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
    source: Input,
    how: Reading,
    *,
    name: str = "",
    watch: Watch | None = None,
) -> Conversion:
    """`convert`, with all that is asked for in one place.

    Raises:
        CompileError: the source, a pass or the result has an error.
    """
    with garbage_collection_paused():
        checked = read(source, how, name=name)
        order = replace(order, assets=LocalAssets(how.search, Path(checked.path)))
        if checked.accepted and (order.expand_includes or order.to == "urdf" or order.model is not None):
            wanted = None if order.expand_includes else _wanted(checked.document, order)
            before, checked = checked, expand(checked, how, wanted=wanted, carriers=order.carriers)
            order = replace(order, model=name_once_expanded(before.document, checked.document, order.model))
        order = replace(order, mixed=has_mixed_words(checked))
        if checked.document is None or not (checked.accepted or (order.passes and _may_be_mended(checked))):
            raise CompileError(checked.diagnostics, unreadable=checked.unreadable)
        return _run(checked, checked.document, order, how, watch=watch)


def _wanted(document: Document | None, order: Order) -> Callable[[Include], bool]:
    """The includes that have to be put in their place; of a model that stays SDF, the one that stands for it."""
    wanted = wanted_includes(document, order.model)
    if order.to == "urdf" or document is None:
        return wanted
    standing = {id(one.model) for one in candidates(document)}
    return lambda include: id(include) in standing and wanted(include)


def has_mixed_words(checked: Checked) -> bool:
    """Whether files have words that their version does not have, or frames where those have no meaning yet."""
    early = checked.document is not None and has_early_frames(checked.document)
    return checked.mixed or bool(mixed_words(checked)) or early


def mixed_words(checked: Checked) -> frozenset[str]:
    """The words in files that the versions of these do not have."""
    return frozenset(each.found for each in checked.diagnostics if _is_outside_version(each) and each.found)


def _is_outside_version(found: Diagnostic) -> bool:
    """Whether it is a word that the version of the file does not have; that of SDF in an extension of URDF is open."""
    path = found.location.path
    return found.rule is OUTSIDE_VERSION and not (
        path.startswith("/robot") and ("/gazebo[" in path or "/gazebo/" in path)
    )


def _known(version: str | None) -> str | None:
    versions = table("sdf").versions
    if version is not None and version not in versions:
        raise ValueError(f"SDF has no version {version!r}; it has {', '.join(versions)}")
    return version


def _pipeline(passes: str | Sequence[Pass] | None) -> Pipeline:
    return parse_pipeline(passes) if isinstance(passes, str) else Pipeline(tuple(passes or ()))


def _run(
    checked: Checked,
    document: Document,
    order: Order,
    how: Reading,
    *,
    watch: Watch | None,
) -> Conversion:
    """The rest of the way of a document that was read."""
    kept = [each for each in checked.diagnostics if not each.is_error]
    notes = Notes(checked.path, how.strict, kept, list(checked.entries), origins=dict(checked.origins))
    passes = order.passes.with_files(order.assets, OtherDocuments(how, checked.path).read)
    changed = passes.run(document, notes, watch=watch, verify=verify if checked.accepted else None)
    if not checked.accepted:
        verify(changed, notes)
    text = ""
    if not notes.has_errors:
        document, text = written(changed, order, notes, watch, kept=mixed_words(checked) if checked.mixed else None)
    if notes.has_errors:
        raise CompileError(tuple(notes.diagnostics))
    lost = sum(entry.weight for entry in notes.entries)
    ledger = Ledger(max(0, checked.size - lost), notes.traced_entries())
    return Conversion(text, document, tuple(notes.diagnostics), ledger, checked.tree, tuple(notes.companions))


def written(
    document: Document, order: Order, notes: Notes, watch: Watch | None, *, kept: frozenset[str] | None
) -> tuple[Document, str]:
    """What a document becomes, and its text.

    One that was put together from several files has words that are `kept` although its version does not have them: the
    files had them too. It is None where there was one file.
    """
    document = order.selection(document).run(document, notes, watch=watch)
    if notes.has_errors:
        return document, ""
    if order.to == "json":
        from twinform.compiler.json_documents import json_text  # noqa: PLC0415 - few conversions need it

        emit(document, notes)
        return document, json_text(document, notes)
    legal = order.legalisation(document)
    fit = (kept is not None or bool(len(legal))) and not order.target(document, Format(order.to)).mixed
    kept = frozenset() if len(legal) or kept is None else kept
    return emit_legal(document, legal, notes, watch, fit=fit, kept=kept)


def _may_be_mended(checked: Checked) -> bool:
    """Whether nothing is wrong but what a pass can put right: limits that are missing."""
    errors = [each for each in checked.diagnostics if each.is_error]
    return all(
        each.rule is MISSING_LIMIT or (each.rule is MISSING_ATTRIBUTE and each.location.path.endswith("/limit"))
        for each in errors
    )
