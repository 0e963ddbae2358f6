"""Loads a file into a verified document: parse, read by the schema, validate with the XSD, build the IR."""

import gc
from collections.abc import Generator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Unpack

from twinform.compiler.input.allowances import OF_OTHER_PARTS, Allowances, content_of, without_consequences
from twinform.compiler.input.expansion import Expansion
from twinform.compiler.input.finding_lines import with_exact_lines
from twinform.compiler.input.front_ends import (
    LARGE,
    ROOTS,
    build_checked_mjcf,
    build_document,
    check_extensions,
    declared_version,
    lower_tree,
    namespaces_of,
    used_up,
)
from twinform.compiler.input.load_options import (
    XACRO,
    FileOptions,
    Input,
    LoadOptions,
    LoadResult,
    Recovered,
    expanded_name,
    name_of_input,
    parts_of,
)
from twinform.compiler.input.parsing import (
    UnreadableError,
    has_comment_after_text,
    parse,
    read_bytes,
    refuse_excess,
    report_split_values,
    report_tabbed_numbers,
    strip_default_namespace,
)
from twinform.compiler.input.size_limits import LIFTED_LIMITS, USUAL_LIMITS, Limits, excess_of_json
from twinform.compiler.input.take_comments import may_have_comments, take_comments
from twinform.compiler.input.unexpanded_xacro import may_be_unexpanded, report_unexpanded, without_what_follows
from twinform.compiler.output.source_comments import Comments
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, rules
from twinform.file_access import itself
from twinform.ir import Document, Format
from twinform.ir.record import amend
from twinform.ir.verify import verify
from twinform.lazy import lazy_pattern
from twinform.option import require_options
from twinform.schemas import (
    Context,
    XmlElement,
    has_prefixed_attributes,
    refusals,
    validate,
)

_JSON = lazy_pattern(rb"(\xef\xbb\xbf)?\s*\{")
"""How a JSON document begins."""
_DECLARATION = lazy_pattern(rb"xmlns[^\s=]*\s*=\s*[\"']")  # begins with what is quick to find
"""A declaration of a namespace; in the carriers of MJCF, which are XML in attributes, the quotes are references."""
_USD = (".usd", ".usda", ".usdc", ".usdz")
_USD_MARKS = (b"#usda", b"PXR-USDC", b"PK\3\4")
_OLD_ROOT = "gazebo"
_OLD_ROOT_VERSIONS = frozenset({"1.2"})
"""The old name of SDF's root, and the known versions of files that have it; 1.0 is another language."""


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
        return _read_source(source, sink, load_options)


def _read_source(source: str | Path | bytes, sink: DiagnosticSink, load_options: LoadOptions) -> LoadResult:
    if is_usd(source):
        message = "this is USD, which `twinform diff` compares with other models; nothing else is made of it"
        sink.report(rules.USD_ONLY_COMPARED, message)
        text = source if isinstance(source, bytes) else None
        return LoadResult(sink.file, None, tuple(sink.diagnostics), unreadable=True, content=text)
    if not isinstance(source, bytes):
        load_options.search.seen.add(Path(source))
    try:
        # The suffix decides and never the content: nothing that arrives as bytes is run. A file
        # that is named could be run through the `xacro` command as well; --no-xacro is for
        # pipelines over files of strangers.
        if not isinstance(source, bytes) and (load_options.xacro or str(source).lower().endswith(XACRO)):
            return _read_xacro(Path(source), sink, load_options)
        text = source if isinstance(source, bytes) else bytes_of(Path(source), sink, load_options)
        if not isinstance(source, bytes) and not load_options.as_mjcf and b"<mujoco" in text and b"<include" in text:
            from twinform.compiler.input.mjcf.splice_includes import splice_includes  # noqa: PLC0415 - few files do

            spliced = splice_includes(Path(source), text, sink, load_options)
            if spliced is not None:
                return _read_expansion(spliced, text, sink, load_options)
    except UnreadableError as error:
        # Fixes of what cannot be expanded are made in the texts of the files, which nothing has expanded.
        texts: Mapping[str, bytes] = getattr(error, "texts", {})
        content = texts.get(sink.file)
        return LoadResult(sink.file, None, tuple(sink.diagnostics), unreadable=True, content=content, texts=texts)
    allowances = load_options.allowances(sink.file)
    if not _JSON.match(text):
        allowances.read(text, sink)
    return _read_text(text, sink, load_options, allowances)


def is_usd(source: object) -> bool:
    """Whether an input is USD: a file that is called so, or bytes that begin as a layer or package does."""
    if isinstance(source, bytes):
        return source.startswith(_USD_MARKS)
    return isinstance(source, str | Path) and str(source).lower().endswith(_USD)


def bytes_of(path: Path, sink: DiagnosticSink, load_options: LoadOptions) -> bytes:
    """Return the content of a file, or of the editor that has it open.

    Raises:
        UnreadableError: the file is missing, or too large.
    """
    search = load_options.search
    unsaved = search.unsaved_of(path)
    if unsaved is not None:
        return unsaved
    return read_bytes(path, sink, load_options.limits, itself(path) or search.readable(path))


def _read_text(text: bytes, sink: DiagnosticSink, load_options: LoadOptions, allowances: Allowances) -> LoadResult:
    try:
        if _JSON.match(text):
            return _read_json(text, sink, load_options, allowances)
        document, context, tree, size, comments = read_document(text, sink, load_options, allowances)
    except UnreadableError:
        return LoadResult(sink.file, None, tuple(sink.diagnostics), unreadable=True, content=text)
    found = DiagnosticSink(file=sink.file, strict=sink.strict)
    verify(document, found)
    if document.format is Format.URDF:
        check_extensions(document, found)
    found.diagnostics = [*without_what_follows(found.diagnostics, sink, OF_OTHER_PARTS)]
    if found.diagnostics:
        kept = without_consequences(found.diagnostics, sink.diagnostics, context.stand_ins)
        whole = read_tree_again(text) if tree is None else tree
        sink.extend_new(with_exact_lines(kept, whole, sink.file))
    allowances.settle(sink)
    if context.broken:
        allowances.put_back(sink)
    ordered = tuple(sorted(sink.diagnostics, key=lambda each: each.location.line))
    is_mjcf = tree is not None and tree.tag == "mujoco"  # whose ledger is settled by its parts
    tree = tree if load_options.keep_tree or is_mjcf else None
    return LoadResult(
        sink.file,
        None if context.broken else document,
        ordered,
        tree=tree,
        content=text,
        tree_size=size,
        entries=tuple(sink.entries),
        allowed=tuple(sink.allowed),
        allowances=allowances,
        comments=comments,
        recovered=Recovered(document, tuple(context.stand_ins)) if context.broken else None,
    )


def _read_json(text: bytes, sink: DiagnosticSink, load_options: LoadOptions, allowances: Allowances) -> LoadResult:
    """Read a JSON document by way of the text in its format that it stands for.

    Raises:
        UnreadableError: the document is too large.
    """
    from twinform.compiler.input.json_input import read_json  # noqa: PLC0415 - few files are JSON

    refuse_excess(excess_of_json(text, load_options.limits), sink)
    source = read_json(text, sink)
    if source is None:
        return LoadResult(sink.file, None, tuple(sink.diagnostics))
    name = f"{sink.file} (as {source.format.upper()})"
    allowances.origins = sink.origins
    loaded = _read_text(source.text, DiagnosticSink(name, sink.strict), load_options, allowances)
    sink.origins[name] = source.origins(loaded.document, sink.file)
    sink.extend(loaded.diagnostics)
    if loaded.document is not None and loaded.accepted:
        source.compare(loaded.document, sink)
    allowances.settle(sink)
    found = tuple(sorted(sink.diagnostics, key=lambda each: each.location.line))
    allowed = (*loaded.allowed, *sink.allowed)
    return replace(loaded, path=sink.file, diagnostics=found, origins=sink.origins, allowed=allowed)


def _read_xacro(path: Path, sink: DiagnosticSink, load_options: LoadOptions) -> LoadResult:
    """Expand a xacro file and read the text that comes out; findings are reported where their parts were written.

    Raises:
        UnreadableError: the file cannot be expanded, or must not be.
    """
    from twinform.compiler.input.expand_xacro import expand  # noqa: PLC0415 - few files need it

    if load_options.xacro is False:
        message = "this is a xacro file, and xacro is refused here"
        sink.report(rules.XACRO_REFUSED, message, Location(line=1))
        raise UnreadableError
    expansion = expand(path, load_options, sink)
    load_options.search.seen.update(map(Path, {place.file for place in expansion.origins.places}))
    return _read_expansion(expansion, _unexpanded(path, load_options), sink, load_options)


def _read_expansion(expansion: Expansion, main: bytes, sink: DiagnosticSink, load_options: LoadOptions) -> LoadResult:
    """Read the text that several files make; the main one has the comments that allow findings."""
    name = expanded_name(sink.file)
    sink.origins[name] = expansion.origins
    allowances = load_options.allowances(sink.file, sink.origins)
    allowances.read(main, sink)
    loaded = _read_text(expansion.text, DiagnosticSink(name, sink.strict), load_options, allowances)
    sink.extend(_at_its_text(each, expansion.strays) for each in loaded.diagnostics)
    if any(each.rule is rules.DUPLICATE_NAME for each in sink.diagnostics):
        from twinform.compiler.input.xacro_mistakes import with_calls  # noqa: PLC0415 - few files have any

        sink.diagnostics[:] = with_calls(sink.diagnostics, expansion.texts)
    if any(each.rule is rules.UNPREFIXED_ELEMENT for each in sink.diagnostics):
        from twinform.compiler.input.xacro_mistakes import without_unprefixed  # noqa: PLC0415 - as above

        sink.diagnostics[:] = without_unprefixed(sink.diagnostics)
    allowances.settle(sink)
    allowed = (*loaded.allowed, *sink.allowed)
    found = tuple(sink.diagnostics)
    return replace(
        loaded, path=sink.file, diagnostics=found, origins=sink.origins, allowed=allowed, expansion=expansion
    )


def _unexpanded(path: Path, load_options: LoadOptions) -> bytes:
    """Return the text of a xacro file that was read before, or nothing where it cannot be read any more."""
    unsaved = load_options.search.unsaved_of(path)
    return content_of(path, load_options.limits) if unsaved is None else unsaved


def _at_its_text(finding: Diagnostic, texts: Mapping[str, Location]) -> Diagnostic:
    """Move a finding about a text to the included file that has it; it was reported where the element around it is."""
    place = texts.get(finding.found or "") if finding.rule is rules.STRAY_TEXT else None
    return replace(finding, location=place._replace(path=finding.location.path)) if place else finding


def load(source: str | Path, **options: Unpack[FileOptions]) -> Document:
    """Read the document of a file: URDF, SDF, MJCF, xacro, or JSON of the IR.

    Example:
        >>> robot = twinform.load("examples/rover.urdf").models[0]
        >>> robot.name, len(robot.links)
        ('rover', 9)

    Args:
        source: The path of the file.

    Keyword Args:
        strict: Refuse what readers ignore, such as unknown names.
        engine: The XSD validator; xmlschema is the slow reference.
        paths: A folder of models or packages, looked in before those that the environment names; repeatable.
        env: An environment variable that xacro files may read besides those of ROS and Gazebo; * fits any letters.
        xacro: Expand all files, or none; by default those called .xacro, .xacro.urdf or .xacro.sdf.
        max_size: The largest file that is read, such as 200MB or 1GiB; by default 64MiB.
        max_tags: The most tags of a file, or parts of a JSON document; by default 1,000,000.
        arguments: The arguments of xacro files, by their names.

    Raises:
        CompileError: the file has an error; what was found is in its diagnostics.
        FileNotFoundError: there is no such file; this is a CompileError too.
        TypeError: there is no such option.
        ValueError: an option has no such value.
    """
    require_options(options, FileOptions)
    loaded = read(source, LoadOptions.of(options))
    return _accepted_document(loaded)


def loads(text: str | bytes, name: str = "<string>", **options: Unpack[FileOptions]) -> Document:
    """Read the document of a text.

    Example:
        >>> twinform.loads('<robot name="arm"><link name="base"/></robot>').models[0].links[0].name
        'base'

    Args:
        text: The text of a file, or its bytes.
        name: What stands for the file in diagnostics.

    Keyword Args:
        strict: Refuse what readers ignore, such as unknown names.
        engine: The XSD validator; xmlschema is the slow reference.
        paths: A folder of models or packages, looked in before those that the environment names; repeatable.
        env: An environment variable that xacro files may read besides those of ROS and Gazebo; * fits any letters.
        xacro: Expand all files, or none; by default those called .xacro, .xacro.urdf or .xacro.sdf.
        max_size: The largest file that is read, such as 200MB or 1GiB; by default 64MiB.
        max_tags: The most tags of a file, or parts of a JSON document; by default 1,000,000.
        arguments: The arguments of xacro files, by their names.

    Raises:
        CompileError: the text has an error; what was found is in its diagnostics.
        TypeError: there is no such option.
        ValueError: an option has no such value.
    """
    require_options(options, FileOptions)
    data = text.encode() if isinstance(text, str) else text
    return _accepted_document(read(data, LoadOptions.of(options), name=name))


def _accepted_document(loaded: LoadResult) -> Document:
    if loaded.document is None or not loaded.accepted:
        raise loaded.error()
    return loaded.document


def read_document(
    text: bytes, sink: DiagnosticSink, load_options: LoadOptions, allowances: Allowances
) -> tuple[Document, Context, XmlElement | None, int | None, Comments | None]:
    """Read an XML text: return its document, its tree, the size of a tree that need not be kept, and the comments.

    The tree of a large text is used up where it need not be kept. Where the context is `broken`, the document is good
    for checks only.

    Raises:
        UnreadableError: the text is not XML.
    """
    engine = load_options.engine
    may_split = has_comment_after_text(text)
    with_comments = may_split or (load_options.keep_comments and may_have_comments(text))
    root, namespace = read_tree(text, sink, load_options.limits, keep_comments=with_comments)
    if may_split:
        report_split_values(root, sink)
    comments = take_comments(root) if with_comments else None
    if may_be_unexpanded(text):
        report_unexpanded(root, sink)
    format_, build = ROOTS[str(root.tag)]
    if format_ == "urdf":
        report_tabbed_numbers(text, sink)
    context = Context(sink, sink.file, format_, declared_version(root, format_, sink))
    if format_ == "mjcf" and (b'""' in text or b"''" in text or b'" "' in text):
        from twinform.compiler.input.mjcf.blank_numbers import leave_blank_numbers_out  # noqa: PLC0415 - few files

        leave_blank_numbers_out(root, context)
    # The XSD is asked before the tree is read, so that the reader need not look for stray text and
    # the like in what the XSD accepts.
    errors = refusals(root, context, engine)
    context.simple = not errors and (_is_plain(text, sink) or not has_prefixed_attributes(root))
    namespaces = namespaces_of(root, namespace, inside=_declares_inside(root, text, sink))
    size = None if load_options.keep_tree else parts_of(root)
    comments = comments if load_options.keep_comments else None
    is_mjcf = format_ == "mjcf"
    context.keeps = not is_mjcf or load_options.as_mjcf  # what is lowered is made of the tree
    is_used_up = not (load_options.keep_tree or comments or is_mjcf) and context.simple and len(text) > LARGE
    document = build_document(build, used_up(root) if is_used_up else root, context)
    if errors:
        validate(root, context, engine, errors)
    if is_mjcf and load_options.as_mjcf and not sink.has_errors:
        from twinform.compiler.input.mjcf import check_classes  # noqa: PLC0415 - few files are MJCF

        check_classes(root, context, load_options)
    elif is_mjcf and not sink.has_errors:
        from twinform.compiler.input.mjcf import lower_mjcf  # noqa: PLC0415 - as above

        lowered = lower_mjcf(root, context, load_options)
        context.broken = context.broken or lowered is None
        document = lowered or build_checked_mjcf(root, context)
        namespaces = document.namespaces if lowered else namespaces
    elif not context.keeps:
        document = build_checked_mjcf(root, context)
    amend(document, "namespaces", namespaces)
    allowances.settle(sink)
    return document, context, None if is_used_up else root, size, comments


def read_tree(
    text: bytes, sink: DiagnosticSink, limits: Limits = USUAL_LIMITS, *, keep_comments: bool = False
) -> tuple[XmlElement, str | None]:
    """Parse a text of one of our formats: return its tree, with plain names, and the default namespace that it had.

    Raises:
        UnreadableError: it is not XML, or of another format.
    """
    root = parse(text, sink, limits, keep_comments=keep_comments)
    namespace = strip_default_namespace(root)
    if root.tag == _OLD_ROOT and root.get("version") in _OLD_ROOT_VERSIONS:
        message = f"the root of SDF {root.get('version')} is <{_OLD_ROOT}>; read, and written, as <sdf>"
        sink.report(rules.OLD_ROOT, message, Location(line=root.sourceline or 0, path=f"/{root.tag}"))
        root.tag = "sdf"
    if root.tag not in ROOTS:
        where = Location(line=root.sourceline or 0, path=f"/{root.tag}")
        message = f"the root element is <{root.tag}>; expected <robot>, <sdf> or <mujoco>"
        sink.report(rules.UNKNOWN_ROOT, message, where, found=str(root.tag), expected="robot, sdf or mujoco")
        raise UnreadableError
    return root, namespace


def read_tree_again(text: bytes, *, keep_comments: bool = False) -> XmlElement:
    """Parse a text that `read_tree` has accepted before, without limits on its size."""
    return read_tree(text, DiagnosticSink(), LIFTED_LIMITS, keep_comments=keep_comments)[0]


def _is_plain(text: bytes, sink: DiagnosticSink) -> bool:
    """Whether no name has a namespace: none is declared, and no prefix was repaired; UTF-16 has zero bytes."""
    repaired = any(found.rule is rules.REPAIRED_XML for found in sink.diagnostics)
    return not repaired and not _DECLARATION.search(text) and b"\0" not in text


def _declares_inside(root: XmlElement, text: bytes, sink: DiagnosticSink) -> bool:
    """Whether elements below the root may declare namespaces, or may have had prefixes repaired."""
    repaired = any(found.rule is rules.REPAIRED_XML for found in sink.diagnostics)
    return repaired or text.count(b"xmlns") > len(root.nsmap) or b"\0" in text


@contextmanager
def garbage_collection_paused() -> Generator[None]:
    """Pause the garbage collector, which would walk the growing tree again and again; nothing here makes cycles.

    Afterwards `freeze` and `unfreeze` move all new objects into the oldest generation without looking at them;
    otherwise the collector would begin with walking all of them once more.
    """
    enabled = gc.isenabled()
    # It costs 8 to 15 % of the time.
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            if not gc.get_freeze_count():  # what others have frozen stays so
                gc.freeze()
                gc.unfreeze()
            gc.enable()
