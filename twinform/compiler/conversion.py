"""One conversion: a file is loaded, goes through the user's passes and legalisation, and is written."""

from collections.abc import Callable
from dataclasses import field, replace
from functools import cached_property

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input.allowances import staying
from twinform.compiler.input.loading import (
    Input,
    LoadOptions,
    LoadResult,
    garbage_collection_paused,
    lower_tree,
    read,
    read_tree_again,
)
from twinform.compiler.input.take_comments import comments_of
from twinform.compiler.other_xacro import assets_of
from twinform.compiler.output.emitting import document_tree, emit, emit_legal, located, written_version
from twinform.compiler.output.source_comments import Comments
from twinform.compiler.request import ConversionRequest
from twinform.compiler.resolve_uris import LocalAssets
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Ledger, LineOrigins, Severity, SideFile
from twinform.diagnostics.rules import MISSING_ATTRIBUTE, MISSING_LIMIT, OUTSIDE_VERSION
from twinform.ir import Document, Format, Include, untyped_elements
from twinform.ir.verify import verify
from twinform.notebooks import draw
from twinform.passes import PassError, PassInstrumentation, Pipeline
from twinform.passes.carriers.carriers import KEPT, bits_of_ours
from twinform.passes.legalise.folded_parts import each_folded_once
from twinform.passes.sdf_versions import has_early_frames
from twinform.passes.shared.candidates import candidates, name_once_expanded, wanted_includes
from twinform.schemas import Context, XmlElement

_WITHOUT_INCLUDES = frozenset({"urdf", "mjcf"})
"""Formats in which a model is whole."""
_LAST_LINE = 2**16 - 1
"""The last line that libxml2 can be told."""


@dataclass(frozen=True)  # no slots: `source` is kept in the dictionary
class Conversion:
    """What `convert` made: the text, its document, the diagnostics and the ledger.

    `origin` is what it was read from: the bytes of a file, or the XML of a document in memory. `side_files` are files
    that passes made to lie beside the text. `lines` lead from an expansion by xacro to where its parts were written.
    """

    text: str
    document: Document
    diagnostics: tuple[Diagnostic, ...]
    ledger: Ledger
    origin: bytes | XmlElement | None = field(default=None, repr=False, compare=False)
    side_files: tuple[SideFile, ...] = ()
    lines: LineOrigins | None = field(default=None, repr=False, compare=False)

    @cached_property
    def source(self) -> XmlElement | None:
        """The XML that it was made from, for `twinform.compiler.audit`; a file is parsed once more.

        Elements have the lines that the ledger has: of what xacro expanded, those where they were written.
        """
        if not isinstance(self.origin, bytes):
            return self.origin
        tree = read_tree_again(self.origin)
        for element in tree.iter("*") if self.lines else ():
            place = self.lines and self.lines.place(element.sourceline or 0)
            if place:
                element.sourceline = min(place.line, _LAST_LINE)  # pyright: ignore[reportAttributeAccessIssue]
        return tree

    def _repr_html_(self) -> str:
        """Return what a notebook shows."""
        return draw("Conversion", self)


def convert_once(
    request: ConversionRequest,
    source: Input | LoadResult,
    load_options: LoadOptions,
    *,
    name: str = "",
    instrumentation: PassInstrumentation | None = None,
) -> Conversion:
    """Convert a source with the passes of the request, and no others for consumers.

    Raises:
        CompileError: the source, a pass or the result has an error.
    """
    with garbage_collection_paused(), each_folded_once():
        # The tree of libxml2 takes as much memory as the document, or twice that; whoever wants it
        # parses the text again (`Conversion.source`).
        load_options = replace(load_options, keep_tree=False).read_by(request.sdf_version)
        comments = request.comments and request.to != "json"  # which has no place for any
        # text of MJCF stays what it is
        as_mjcf = request.to == "mjcf" and not (request.passes or request.remedies or request.default_classes)
        loaded = read(source, replace(load_options, keep_comments=comments, as_mjcf=as_mjcf), name=name)
        request = replace(request, assets=assets_of(loaded.path, load_options))
        # SDF to SDF keeps its includes: a world with 525 models from Fuel is read and written
        # without opening any of them. URDF has none, so there those of the chosen model are
        # expanded, and no others; for an older SDF those that would be another robot in it.
        newer = _newer_includes(loaded.document, request)
        if loaded.accepted and (
            request.expand_includes or request.to in _WITHOUT_INCLUDES or request.model is not None or newer
        ):
            from twinform.compiler.expand_includes import expand  # noqa: PLC0415 - most conversions need no includes

            wanted = None if request.expand_includes else _includes_to_expand(loaded.document, request, newer)
            before = loaded.document
            why = f"an include of SDF {request.sdf_version} cannot stand for it" if newer else ""
            loaded = expand(loaded, load_options, wanted=wanted, carriers=request.carriers, why=why)
            request = replace(request, model=name_once_expanded(before, loaded.document, request.model))
        request = replace(request, mixed=has_mixed_words(loaded))
        if loaded.document is None or not (loaded.accepted or _may_be_fixed(loaded, request)):
            raise loaded.error()
        try:
            return _convert_document(loaded, loaded.document, request, load_options, instrumentation=instrumentation)
        except (PassError, LookupError, ValueError, RecursionError) as error:
            # An allowed error is left out where the file is read, and conversions go on in spite of
            # it. Where one fails, it is for that error.
            allowed = [each for each in loaded.allowed if each.is_error]
            if not allowed:
                raise
            stays = staying(allowed, f"the model cannot be converted with it ({error})")
            raise CompileError((*loaded.diagnostics, *stays)) from error


def _newer_includes(document: Document | None, request: ConversionRequest) -> frozenset[int]:
    """Return the identities of the includes that the requested older version of SDF cannot have."""
    if document is None or request.to != "sdf" or request.sdf_version is None or document.format is not Format.SDF:
        return frozenset()
    from twinform.passes.includes import newer_includes  # noqa: PLC0415 - most conversions ask for no version

    return newer_includes(document, request.sdf_version)


def _includes_to_expand(
    document: Document | None, request: ConversionRequest, newer: frozenset[int]
) -> Callable[[Include], bool]:
    """Tell which includes have to be expanded: for a model that stays SDF, only the one that stands for it."""
    if request.model is None and request.to == "sdf":
        return lambda include: id(include) in newer
    wanted = wanted_includes(document, request.model)
    if request.to in _WITHOUT_INCLUDES or document is None:
        return wanted
    placed = {id(one.model) for one in candidates(document)} | newer
    return lambda include: id(include) in placed and wanted(include)


def has_mixed_words(loaded: LoadResult) -> bool:
    """Whether files have elements that their versions do not have, or frames where those have no meaning yet."""
    early = loaded.document is not None and has_early_frames(loaded.document)
    return loaded.mixed or bool(mixed_words(loaded)) or early or _was_mixed(loaded)


def _was_mixed(loaded: LoadResult) -> bool:
    """Whether a file of MJCF was written of one with such elements."""
    if loaded.tree is None or loaded.tree.tag != "mujoco":
        return False
    from twinform.compiler.input.mjcf.carried_texts import was_mixed  # noqa: PLC0415 - few files are MJCF

    return was_mixed(loaded.tree)


def mixed_words(loaded: LoadResult) -> frozenset[str]:
    """Return the names of elements and attributes in files that the versions of these files do not have."""
    found = (*loaded.diagnostics, *loaded.allowed)
    return frozenset(each.found for each in found if _is_outside_version(each) and each.found)


def _is_outside_version(found: Diagnostic) -> bool:
    """Whether a finding is about a part that the version does not have; `<gazebo>` in URDF has no version of SDF."""
    path = found.location.path
    return found.rule is OUTSIDE_VERSION and not (
        path.startswith("/robot") and ("/gazebo[" in path or "/gazebo/" in path)
    )


def _convert_document(
    loaded: LoadResult,
    document: Document,
    request: ConversionRequest,
    load_options: LoadOptions,
    *,
    instrumentation: PassInstrumentation | None,
) -> Conversion:
    """Run the passes on a document that was read, and write it."""
    kept = tuple(each for each in loaded.diagnostics if not each.is_error)
    sink = replace(loaded, diagnostics=kept).sink(strict=load_options.strict)
    if not request.carriers and request.to != "mjcf":
        from twinform.compiler.input.mjcf.remainders import without_remainders  # noqa: PLC0415 - few ask for it

        if request.to == "urdf" and request.model is None:  # afterwards the floor of a file looks like a robot
            only = [each.full_name for each in candidates(document)]
            request = replace(request, model=only[0] if len(only) == 1 and only[0] else None)
        document = without_remainders(document, sink)
    if request.folder is not None and isinstance(request.assets, LocalAssets) and request.assets.folder is not None:
        from twinform.compiler.moved_paths import moved  # noqa: PLC0415 - most results lie beside their source

        document, there = moved(document, request.assets, request.folder, sink)
        request = replace(request, assets=there)
    passes = _user_passes(request, load_options, loaded.path)
    # The document is verified between the user's passes. Legalisation leaves it half in one format
    # and half in the other, so there the check comes at the end.
    changed = passes.run(document, sink, instrumentation=instrumentation, verify=verify if loaded.accepted else None)
    changed = _run_remedies(changed, request, sink, instrumentation, accepted=loaded.accepted)
    # A file with an error that a pass fixes: only afterwards can it be said whether it is fixed.
    if not loaded.accepted:
        verify(changed, sink)
    text = ""
    if not sink.has_errors:
        kept_words = mixed_words(loaded) if loaded.mixed else None
        comments = comments_of(loaded, document, request.to, request.model)
        document, text = written(changed, request, sink, instrumentation, kept=kept_words, comments=comments)
        if text and request.to == "mjcf" and _keeps_mjcf(changed):
            _check_mjcf(document, sink, load_options)
    if sink.has_errors:
        raise CompileError(tuple(sink.diagnostics))
    # The ledger counts what is preserved by what is left over, so that a fate which nobody wrote
    # down shows as a false "preserved" in the audit.
    if loaded.tree is not None and loaded.tree.tag == "mujoco":
        from twinform.compiler.settle_ledger import settle  # noqa: PLC0415 - few files are MJCF

        sink.entries[:] = settle(sink.entries, loaded.tree)
    lost = sum(entry.weight for entry in sink.entries)
    ledger = Ledger(max(0, loaded.size - lost), sink.traced_entries())
    origin = loaded.tree if loaded.content is None else loaded.content
    lines = loaded.origins.get(loaded.text_name)
    return Conversion(text, document, tuple(sink.diagnostics), ledger, origin, tuple(sink.side_files), lines)


def _keeps_mjcf(document: Document) -> bool:
    """Whether a document of URDF or SDF keeps anything of MJCF: what is written for all else MuJoCo reads."""
    untyped = untyped_elements(document, having=bits_of_ours("mjcf"))
    return document.format is not Format.MJCF and any(each.name == KEPT for each in untyped)


def _check_mjcf(document: Document, sink: DiagnosticSink, load_options: LoadOptions) -> None:
    """Report what MuJoCo refuses in a document of MJCF that was written, such as sections that an edit has broken."""
    from twinform.compiler.input.mjcf.normalize import check_written  # noqa: PLC0415 - few conversions need it

    found = DiagnosticSink(file=sink.file)
    context = Context(found, sink.file, Format.MJCF, written_version(document))
    check_written(document_tree(document), context, load_options)
    refused = (each for each in found.diagnostics if each.is_error or each.refused)
    sink.extend([replace(located(each, document), severity=Severity.ERROR) for each in refused])


def _run_remedies(
    document: Document,
    request: ConversionRequest,
    sink: DiagnosticSink,
    instrumentation: PassInstrumentation | None,
    *,
    accepted: bool,
) -> Document:
    """Run the passes that consumers need, and put their changes of the physics into the ledger."""
    if not request.remedies:
        return document
    from twinform.profiles.remedies import physics_changes  # noqa: PLC0415 - see `run_conversion`

    for step in request.remedies.with_files(request.assets):
        before = document
        document = Pipeline((step,)).run(
            before, sink, instrumentation=instrumentation, verify=verify if accepted else None
        )
        # A pass that may change the physics often does not (a capsule that is only seen becomes
        # three shapes), so the two documents are compared.
        sink.entries.extend(physics_changes(before, document, step.name))
    return document


def _user_passes(request: ConversionRequest, load_options: LoadOptions, file: str) -> Pipeline:
    """Return the user's passes with access to files for those that need it."""
    if not request.passes:
        return request.passes
    from twinform.compiler.expand_includes import OtherDocuments  # noqa: PLC0415 - see `_pipeline`

    return request.passes.with_files(request.assets, OtherDocuments(load_options, file).read)


def written(
    document: Document,
    request: ConversionRequest,
    sink: DiagnosticSink,
    instrumentation: PassInstrumentation | None,
    *,
    kept: frozenset[str] | None,
    comments: Comments | None = None,
) -> tuple[Document, str]:
    """Convert a document as requested, and return it with its text, which has the comments of its file.

    `kept` are the elements that stay although the version does not have them, because the document was put together
    from several files that have them; it is None where there was one file.
    """
    document = request.selection(document).run(document, sink, instrumentation=instrumentation)
    if sink.has_errors:
        return document, ""
    if request.to == "json":
        from twinform.compiler.input.documents import compare_documents  # noqa: PLC0415 - few conversions need it
        from twinform.compiler.output.json import json_text  # noqa: PLC0415 - see above

        # JSON has no format of its own to violate: the XML is written for its findings, read for
        # what it cannot express, and thrown away.
        emit(document, sink)
        compare_documents(document, lower_tree(document_tree(document), DiagnosticSink()), sink)
        return document, json_text(document)
    legal = request.legalisation(document)
    fit = (kept is not None or bool(len(legal))) and not request.target(document, Format(request.to)).mixed
    kept = frozenset() if len(legal) or kept is None else kept
    return emit_legal(document, legal, sink, instrumentation, fit=fit, kept=kept, comments=comments)


def _may_be_fixed(loaded: LoadResult, request: ConversionRequest) -> bool:
    """Whether passes may fix all errors of a file: missing limits, and errors that remedies are for."""
    if not (request.passes or request.remedies):
        return False
    errors = [each for each in loaded.diagnostics if each.is_error]
    return all(
        each.rule is MISSING_LIMIT
        or (each.rule is MISSING_ATTRIBUTE and each.location.path.endswith("/limit"))
        or each.rule.name in request.remedied
        for each in errors
    )
