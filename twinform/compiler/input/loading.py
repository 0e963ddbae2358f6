"""Loads a file into a verified document: parse, read by the schema, validate with the XSD, build the IR."""

import errno
import gc
import os
import re
from collections import defaultdict
from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import replace
from itertools import count
from pathlib import Path
from typing import Unpack

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.input import read_sdf, read_urdf
from twinform.compiler.input.allowances import Allowances, content_of
from twinform.compiler.input.finding_lines import with_exact_lines
from twinform.compiler.input.gazebo_extensions import check_extensions
from twinform.compiler.input.load_options import (
    FileOptions,
    Input,
    LoadOptions,
    LoadResult,
    expanded_name,
    name_of_input,
    parts_of,
)
from twinform.compiler.input.parser_quirks import has_comment_after_text, report_split_values, report_tabbed_numbers
from twinform.compiler.input.parsing import (
    UnreadableError,
    parse,
    read_bytes,
    refuse_excess,
    strip_default_namespace,
)
from twinform.compiler.input.size_limits import LIFTED_LIMITS, USUAL_LIMITS, Limits, excess_of_json
from twinform.compiler.input.take_comments import may_have_comments, take_comments
from twinform.compiler.input.unexpanded_xacro import report_unexpanded
from twinform.compiler.input.used_up_tree import LARGE, used_up
from twinform.compiler.option import require_options
from twinform.compiler.output.source_comments import Comments
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import Document, Format
from twinform.ir.record import amend
from twinform.ir.verify import verify
from twinform.schemas import (
    Context,
    Version,
    XmlElement,
    declared_namespaces,
    has_prefixed_attributes,
    parse_version,
    refusals,
    undeclared_prefix,
    validate,
    versions_of,
)

_ROOTS: dict[str, tuple[str, Callable[[XmlElement, Context], Document | None]]] = {
    "robot": ("urdf", read_urdf.build),
    "sdf": ("sdf", read_sdf.build),
}
_CONSEQUENCES = frozenset(
    {rules.MISSING_LIMIT, rules.PARTIAL_LIMIT, rules.SEVERAL_ROOTS, rules.EMPTY_MODEL, rules.UNKNOWN_MATERIAL}
)
_JSON = re.compile(rb"(\xef\xbb\xbf)?\s*\{")
"""How a JSON document begins."""
XACRO = ".xacro"
"""The ending of the names of files that are expanded before they are read."""
_OLD_ROOT = "gazebo"
_OLD_ROOT_VERSIONS = frozenset({"1.2"})
"""What the root of SDF was called, and the versions of these that are known; 1.0 is another language."""
_WITHOUT_VERSION = {"urdf": (1, 0)}
"""The version of a file that declares none."""


def read(source: Input | LoadResult, load_options: LoadOptions, *, name: str = "") -> LoadResult:
    """Read a file, the bytes of one or a document, and report what is wrong; `name` stands for it in findings.

    What was read before is not read again.
    """
    if isinstance(source, LoadResult):
        return source
    sink = DiagnosticSink(file=name or name_of_input(source), strict=load_options.strict)
    with garbage_collection_paused():
        if isinstance(source, Document):
            from twinform.compiler.input.documents import check_document  # noqa: PLC0415 - it reads what it has written

            return check_document(source, sink, load_options, lower_tree)
        return _check(source, sink, load_options)


def _check(source: str | Path | bytes, sink: DiagnosticSink, load_options: LoadOptions) -> LoadResult:
    if not isinstance(source, bytes):
        load_options.search.seen.add(Path(source))
    try:
        # The suffix decides and never the content: nothing that arrives as bytes is run. A file
        # that is named could be run through the `xacro` command as well; --no-xacro is for
        # pipelines over files of strangers.
        if not isinstance(source, bytes) and (load_options.xacro or Path(source).suffix.lower() == XACRO):
            return _check_xacro(Path(source), sink, load_options)
        text = source if isinstance(source, bytes) else bytes_of(Path(source), sink, load_options)
    except UnreadableError:
        return LoadResult(sink.file, None, tuple(sink.diagnostics), unreadable=True)
    allowances = load_options.allowances(sink.file)
    if not _JSON.match(text):
        allowances.read(text, sink)
    return _check_text(text, sink, load_options, allowances)


def bytes_of(path: Path, sink: DiagnosticSink, load_options: LoadOptions) -> bytes:
    """What is in a file, or what an editor has of it.

    Raises:
        UnreadableError: it is missing, or too large.
    """
    search = load_options.search
    unsaved = search.unsaved_of(path)
    return read_bytes(path, sink, load_options.limits, search.readable(path)) if unsaved is None else unsaved


def _check_text(text: bytes, sink: DiagnosticSink, load_options: LoadOptions, allowances: Allowances) -> LoadResult:
    try:
        if _JSON.match(text):
            return _check_json(text, sink, load_options, allowances)
        document, tree, size, comments = read_document(text, sink, load_options, allowances)
    except UnreadableError:
        return LoadResult(sink.file, None, tuple(sink.diagnostics), unreadable=True, content=text)
    if document is not None and not sink.has_errors:
        read = len(sink.diagnostics)
        verify(document, sink)
        if document.format is Format.URDF:
            check_extensions(document, sink)
        if len(sink.diagnostics) > read:
            whole = read_tree_again(text) if tree is None else tree
            sink.diagnostics[read:] = with_exact_lines(sink.diagnostics[read:], whole, sink.file)
    allowances.settle(sink)
    if document is None:
        allowances.put_back(sink)
    found = tuple(sorted(sink.diagnostics, key=lambda each: each.location.line))
    tree = tree if load_options.keep_tree else None
    return LoadResult(
        sink.file,
        document,
        found,
        tree=tree,
        content=text,
        tree_size=size,
        allowed=tuple(sink.allowed),
        allowances=allowances,
        comments=comments,
    )


def _check_json(text: bytes, sink: DiagnosticSink, load_options: LoadOptions, allowances: Allowances) -> LoadResult:
    """Read a JSON document as the text of its format that it stands for.

    Raises:
        UnreadableError: there is too much of it.
    """
    from twinform.compiler.input.json_input import read_json  # noqa: PLC0415 - few files are JSON

    refuse_excess(excess_of_json(text, load_options.limits), sink)
    source = read_json(text, sink)
    if source is None:
        return LoadResult(sink.file, None, tuple(sink.diagnostics))
    name = f"{sink.file} (as {source.format.upper()})"
    allowances.origins = sink.origins
    loaded = _check_text(source.text, DiagnosticSink(name, sink.strict), load_options, allowances)
    sink.origins[name] = source.origins(loaded.document, sink.file)
    sink.extend(loaded.diagnostics)
    if loaded.document is not None and loaded.accepted:
        source.compare(loaded.document, sink)
    allowances.settle(sink)
    found = tuple(sorted(sink.diagnostics, key=lambda each: each.location.line))
    allowed = (*loaded.allowed, *sink.allowed)
    return replace(loaded, path=sink.file, diagnostics=found, origins=sink.origins, allowed=allowed)


def _check_xacro(path: Path, sink: DiagnosticSink, load_options: LoadOptions) -> LoadResult:
    """Expand a xacro file and read the text that comes out; findings are reported where their parts were written.

    Raises:
        UnreadableError: it cannot be expanded, or must not.
    """
    from twinform.compiler.input.xacro.expansion import expand  # noqa: PLC0415 - few files need it

    if load_options.xacro is False:
        message = "this is a xacro file, and xacro is refused here"
        sink.report(rules.XACRO_REFUSED, message, Location(line=1))
        raise UnreadableError
    expansion = expand(path, load_options, sink)
    load_options.search.seen.update(map(Path, {place.file for place in expansion.origins.places}))
    name = expanded_name(sink.file)
    sink.origins[name] = expansion.origins
    allowances = load_options.allowances(sink.file, sink.origins)
    unsaved = load_options.search.unsaved_of(path)
    allowances.read(content_of(path, load_options.limits) if unsaved is None else unsaved, sink)
    loaded = _check_text(expansion.text, DiagnosticSink(name, sink.strict), load_options, allowances)
    sink.extend(loaded.diagnostics)
    allowances.settle(sink)
    allowed = (*loaded.allowed, *sink.allowed)
    return replace(loaded, path=sink.file, diagnostics=tuple(sink.diagnostics), origins=sink.origins, allowed=allowed)


def load(source: str | Path, **options: Unpack[FileOptions]) -> Document:
    """The document of a file; `options` are those of `check`.

    Raises:
        CompileError: the file has an error; what was found is in its diagnostics.
        FileNotFoundError: there is no such file.
        TypeError: there is no such option.
    """
    require_options(options, FileOptions)
    loaded = read(source, LoadOptions.of(options))
    if loaded.unreadable and not Path(source).exists():
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(source))
    return _document(loaded)


def loads(text: str | bytes, name: str = "<string>", **options: Unpack[FileOptions]) -> Document:
    """The document of a text; `name` stands for the file in diagnostics.

    Raises:
        CompileError: the text has an error; what was found is in its diagnostics.
        TypeError: there is no such option.
    """
    require_options(options, FileOptions)
    data = text.encode() if isinstance(text, str) else text
    return _document(read(data, LoadOptions.of(options), name=name))


def _document(loaded: LoadResult) -> Document:
    if loaded.document is None or not loaded.accepted:
        raise CompileError(loaded.diagnostics, unreadable=loaded.unreadable)
    return loaded.document


def read_document(
    text: bytes, sink: DiagnosticSink, load_options: LoadOptions, allowances: Allowances
) -> tuple[Document | None, XmlElement | None, int | None, Comments | None]:
    """The document of an XML text, its tree, the size of that if it need not be kept, and the comments.

    A large tree is not kept then, and neither are comments unless they are wanted. Where the text has errors, the
    document is there if it can be.

    Raises:
        UnreadableError: it is not XML.
    """
    engine = load_options.engine
    may_split = has_comment_after_text(text)
    with_comments = may_split or (load_options.keep_comments and may_have_comments(text))
    root, namespace = read_tree(text, sink, load_options.limits, keep_comments=with_comments)
    if may_split:
        report_split_values(root, sink)
    comments = take_comments(root) if with_comments else None
    if b"<xacro:" in text or b"${" in text:
        report_unexpanded(root, sink)
    format_, build = _ROOTS[str(root.tag)]
    if format_ == "urdf":
        report_tabbed_numbers(text, sink)
    context = Context(sink, sink.file, format_, declared_version(root, format_, sink))
    # The XSD is asked before the tree is read, so that the reader need not look for stray text and
    # the like in what the XSD accepts.
    errors = refusals(root, context, engine)
    context.simple = not errors and (_is_plain(text, sink) or not has_prefixed_attributes(root))
    namespaces = _namespaces(root, namespace, inside=_declares_inside(root, text, sink))
    size = None if load_options.keep_tree else parts_of(root)
    comments = comments if load_options.keep_comments else None
    is_used_up = not (load_options.keep_tree or comments) and context.simple and len(text) > LARGE
    document = _built(build, used_up(root) if is_used_up else root, context)
    if errors:
        validate(root, context, engine, errors)
    if document is not None:
        amend(document, "namespaces", namespaces)
        allowances.settle(sink)
        if sink.has_errors:
            _verify_what_is_there(document, read_tree_again(text) if is_used_up else root, sink)
    return document, None if is_used_up else root, size, comments


def _built(
    build: Callable[[XmlElement, Context], Document | None], root: XmlElement, context: Context
) -> Document | None:
    """The document of a tree; None where errors leave gaps in it."""
    document = build(root, context)
    if document is None and not context.sink.has_errors:
        raise ValueError(f"{context.file}: some part lacks what it needs, and nothing was reported")
    return document


def read_tree(
    text: bytes, sink: DiagnosticSink, limits: Limits = USUAL_LIMITS, *, keep_comments: bool = False
) -> tuple[XmlElement, str | None]:
    """The XML tree of a text in one of our formats, its names plain, and the default namespace that it had.

    Raises:
        UnreadableError: it is not XML, or of another format.
    """
    root = parse(text, sink, limits, keep_comments=keep_comments)
    namespace = strip_default_namespace(root)
    if root.tag == _OLD_ROOT and root.get("version") in _OLD_ROOT_VERSIONS:
        message = f"the root of SDF {root.get('version')} is <{_OLD_ROOT}>; read, and written, as <sdf>"
        sink.report(rules.OLD_ROOT, message, Location(line=root.sourceline or 0, path=f"/{root.tag}"))
        root.tag = "sdf"
    if root.tag not in _ROOTS:
        where = Location(line=root.sourceline or 0, path=f"/{root.tag}")
        message = f"the root element is <{root.tag}>; expected <robot> or <sdf>"
        sink.report(rules.UNKNOWN_ROOT, message, where, found=str(root.tag), expected="robot or sdf")
        raise UnreadableError
    return root, namespace


def read_tree_again(text: bytes, *, keep_comments: bool = False) -> XmlElement:
    """The tree of a text that `read_tree` took before, whatever its size; with its comments where they are kept."""
    return read_tree(text, DiagnosticSink(), LIFTED_LIMITS, keep_comments=keep_comments)[0]


def lower_tree(root: XmlElement, sink: DiagnosticSink) -> Document | None:
    """The document of a tree that we have written ourselves; errors in the notes where it is not valid after all."""
    format_, build = _ROOTS[str(root.tag)]
    context = Context(sink, sink.file, format_, declared_version(root, format_, sink))
    errors = refusals(root, context, "libxml2")
    context.simple = not errors and not has_prefixed_attributes(root)
    document = _built(build, root, context)
    if errors:
        validate(root, context, "libxml2", errors)
    if document is not None:
        amend(document, "namespaces", _namespaces(root, None))
    return document


def _verify_what_is_there(document: Document, root: XmlElement, sink: DiagnosticSink) -> None:
    """After an error the names and references are still checked, so that the author sees all at once.

    Left out are findings that may only follow from what could not be read.
    """
    found = DiagnosticSink(file=sink.file, strict=sink.strict)
    verify(document, found)
    kept = (each for each in found.diagnostics if each.rule not in _CONSEQUENCES)
    sink.extend(with_exact_lines(kept, root, sink.file))


def declared_version(root: XmlElement, format_: str, sink: DiagnosticSink) -> Version:
    """The version that the reader goes by: the declared one where the format has it, else the newest."""
    known, declared = versions_of(format_), root.get("version")
    if declared is None and format_ in _WITHOUT_VERSION:
        return _WITHOUT_VERSION[format_]
    if declared in known:
        return parse_version(declared)
    where = Location(line=root.sourceline or 0, path=f"/{root.tag}/@version")
    newest = known[-1]
    if declared is not None:
        message = f"{format_.upper()} has no version {declared!r}; read as {newest}"
        sink.report(rules.UNKNOWN_VERSION, message, where, found=declared, expected=", ".join(known))
    return parse_version(newest)


def _is_plain(text: bytes, sink: DiagnosticSink) -> bool:
    """Whether no name has a namespace: none is declared, nor was a prefix repaired; in UTF-16 there is a zero byte."""
    repaired = any(found.rule is rules.REPAIRED_XML for found in sink.diagnostics)
    return not repaired and b"xmlns" not in text and b"\0" not in text


def _declares_inside(root: XmlElement, text: bytes, sink: DiagnosticSink) -> bool:
    """Whether other elements than the root may declare namespaces, or have had prefixes of theirs repaired."""
    repaired = any(found.rule is rules.REPAIRED_XML for found in sink.diagnostics)
    return repaired or text.count(b"xmlns") > len(root.nsmap) or b"\0" in text


def _namespaces(root: XmlElement, default: str | None, *, inside: bool = True) -> tuple[tuple[str, str], ...]:
    """The prefixes of a document, those of its root first; one that is another namespace inside gets another name."""
    own = [(prefix, uri) for prefix, uri in root.nsmap.items() if prefix]
    others = sorted(declared_namespaces(root).difference(own)) if inside else []
    found: dict[str, str] = {}
    known: set[str] = set()
    numbers: defaultdict[str, count[int]] = defaultdict(lambda: count(2))
    for prefix, uri in (*own, *others):
        wanted = undeclared_prefix(uri) or prefix
        if found.setdefault(wanted, uri) != uri and uri not in known:
            found[next(name for n in numbers[wanted] if (name := f"{wanted}{n}") not in found)] = uri
        known.add(uri)
    return (*((("", default),) if default else ()), *sorted(found.items()))


@contextmanager
def garbage_collection_paused() -> Generator[None]:
    """Keep the collector from walking a growing tree again and again; nothing here makes cycles.

    Before it goes on, all that was made joins the old generation, which `freeze` and `unfreeze` do without looking at
    it; otherwise the first thing that the collector did would be to walk all of it once more.
    """
    enabled = gc.isenabled()
    # Walking a growing tree again and again costs 8 to 15 % of the time.
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            if not gc.get_freeze_count():  # what others have frozen stays so
                gc.freeze()
                gc.unfreeze()
            gc.enable()
