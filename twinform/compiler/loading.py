"""From text to a verified document: parse, read, gate, build the IR."""

import gc
from collections import defaultdict
from collections.abc import Callable, Generator, Iterable, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from twinform.compiler.errors import CompileError
from twinform.compiler.exact_lines import with_exact_lines
from twinform.compiler.limits import excess_of_json, excess_of_names
from twinform.compiler.parsing import (
    UnreadableError,
    parse,
    read_bytes,
    refuse_excess,
    strip_default_namespace,
)
from twinform.compiler.sdf import front_end as sdf
from twinform.compiler.split_values import report_split_values
from twinform.compiler.tabbed_numbers import report_tabbed_numbers
from twinform.compiler.unexpanded import report_unexpanded
from twinform.compiler.urdf import front_end as urdf
from twinform.compiler.urdf.extensions import check_extensions
from twinform.compiler.uris import SearchPath
from twinform.diagnostics import Diagnostic, Entry, Location, Notes, Origins
from twinform.diagnostics.rules import model, reading, structure
from twinform.diagnostics.rules import xacro as xacro_rules
from twinform.ir import Document, Format, count_parts
from twinform.ir.verify import verify
from twinform.schemas import (
    Context,
    Engine,
    Version,
    XmlElement,
    declared_namespaces,
    gate,
    parse_version,
    print_version,
    refusals,
    table,
    undeclared_prefix,
)

_ROOTS: dict[str, tuple[str, Callable[[XmlElement, Context], Mapping[str, Any]]]] = {
    "robot": ("urdf", urdf.lower),
    "sdf": ("sdf", sdf.lower),
}
_CONSEQUENCES = frozenset(
    {model.MISSING_LIMIT, model.PARTIAL_LIMIT, model.SEVERAL_ROOTS, model.EMPTY_MODEL, model.UNKNOWN_MATERIAL}
)
_QUALIFIED = b'"{'
"""How a name that is in a namespace begins in JSON."""
XACRO = ".xacro"
"""The ending of the names of files that are expanded before they are read."""
_OLD_ROOT = "gazebo"
_OLD_ROOT_VERSIONS = frozenset({"1.2"})
"""What the root of SDF was called, and the versions of these that are known; 1.0 is another language."""
_WITHOUT_VERSION = {"urdf": (1, 0)}
"""The version of a file that declares none."""


@dataclass(frozen=True, slots=True)
class Reading:
    """How files are read.

    `search` are the folders for URIs, `arguments` those of xacro. `xacro` says which files are expanded: by default
    those whose name ends so, all where it is true, and none where it is false.
    """

    strict: bool = False
    engine: Engine = "libxml2"
    search: SearchPath = field(default_factory=SearchPath.of)
    arguments: Mapping[str, str] = field(default_factory=dict[str, str])
    xacro: bool | None = None


@dataclass(frozen=True, slots=True)
class Checked:
    """What `check` found. `unreadable` says that there is no model at all: no file, no XML, or another format.

    The document may be there in spite of errors; `accepted` says whether it has any. `tree` is the XML that it came
    from, and `origins` lead from its lines to where they were written if it was expanded. Where includes were expanded,
    `included` is the size of their files, `entries` what became of parts of them, and `mixed` says that the files may
    have been of several versions.
    """

    path: str
    document: Document | None
    diagnostics: tuple[Diagnostic, ...]
    unreadable: bool = False
    tree: XmlElement | None = None
    origins: Mapping[str, Origins] = field(default_factory=dict[str, Origins])
    included: int = 0
    entries: tuple[Entry, ...] = ()
    mixed: bool = False

    @property
    def text_name(self) -> str:
        """What the text that the document was read from is called in locations: a file, or what it expanded to."""
        expanded = _expanded(self.path)
        return expanded if expanded in self.origins else self.path

    @property
    def size(self) -> int:
        """How many elements and attributes the source has."""
        if self.tree is not None:
            return self.included + _parts(self.tree)
        return count_parts(self.document) if self.document else 0

    @property
    def accepted(self) -> bool:
        """Whether there is no error."""
        return not any(diagnostic.is_error for diagnostic in self.diagnostics)


def _expanded(file: str) -> str:
    return f"{file} (expanded)"


def _parts(tree: XmlElement) -> int:
    return sum(1 + len(element.keys()) for element in tree.iter())


def read(source: str | Path | bytes, how: Reading, *, name: str = "") -> Checked:
    """Read a file, or the bytes of one, and say what is wrong with it; `name` stands for it in findings."""
    file = name or ("<bytes>" if isinstance(source, bytes) else str(source))
    notes = Notes(file=file, strict=how.strict)
    with garbage_collection_paused():
        return _check(source, notes, how)


def _check(source: str | Path | bytes, notes: Notes, how: Reading) -> Checked:
    if not isinstance(source, bytes):
        how.search.seen.add(Path(source))
    try:
        if not isinstance(source, bytes) and (how.xacro or Path(source).suffix.lower() == XACRO):
            return _check_xacro(Path(source), notes, how)
        text = source if isinstance(source, bytes) else read_bytes(Path(source), notes)
    except UnreadableError:
        return Checked(notes.file, None, tuple(notes.diagnostics), unreadable=True)
    return _check_text(text, notes, how)


def _check_text(text: bytes, notes: Notes, how: Reading) -> Checked:
    try:
        document, tree = read_document(text, notes, how.engine)
    except UnreadableError:
        return Checked(notes.file, None, tuple(notes.diagnostics), unreadable=True)
    if document is not None and not notes.has_errors:
        verify(document, notes)
        if document.format is Format.URDF:
            check_extensions(document, notes)
    if tree is not None:
        notes.diagnostics[:] = with_exact_lines(notes.diagnostics, tree, notes.file)
    found = tuple(sorted(notes.diagnostics, key=lambda each: each.location.line))
    return Checked(notes.file, document, found, tree=tree)


def _check_xacro(path: Path, notes: Notes, how: Reading) -> Checked:
    """Expand a xacro file and read the text that comes out; findings are reported where their parts were written.

    Raises:
        UnreadableError: it cannot be expanded, or must not.
    """
    from twinform.compiler.xacro.expansion import expand  # noqa: PLC0415 - few files need it

    if how.xacro is False:
        message = "this is a xacro file, and xacro is refused here"
        notes.report(xacro_rules.XACRO_REFUSED, message, Location(line=1))
        raise UnreadableError
    expansion = expand(path, how.arguments, how.search, notes)
    how.search.seen.update(map(Path, {place.file for place in expansion.origins.places}))
    name = _expanded(notes.file)
    notes.origins[name] = expansion.origins
    checked = _check_text(expansion.text, Notes(name, notes.strict), how)
    notes.extend(checked.diagnostics)
    return replace(checked, path=notes.file, diagnostics=tuple(notes.diagnostics), origins=notes.origins)


def load(
    source: str | Path,
    *,
    strict: bool = False,
    engine: Engine = "libxml2",
    paths: Iterable[str | Path] = (),
    arguments: Mapping[str, str] | None = None,
) -> Document:
    """The document of a file; `paths` and `arguments` are those of `check`.

    Raises:
        CompileError: the file has an error; what was found is in its diagnostics.
    """
    return _document(read(source, Reading(strict, engine, SearchPath.of(paths), arguments or {})))


def loads(text: str | bytes, name: str = "<string>", *, strict: bool = False, engine: Engine = "libxml2") -> Document:
    """The document of a text; `name` stands for the file in diagnostics.

    Raises:
        CompileError: the text has an error; what was found is in its diagnostics.
    """
    data = text.encode() if isinstance(text, str) else text
    return _document(read(data, Reading(strict, engine), name=name))


def _document(checked: Checked) -> Document:
    if checked.document is None or not checked.accepted:
        raise CompileError(checked.diagnostics, unreadable=checked.unreadable)
    return checked.document


def read_document(text: bytes, notes: Notes, engine: Engine) -> tuple[Document | None, XmlElement | None]:
    """The document of a text and its XML tree, if it is XML. Where it has errors, the document is there if it can be.

    Raises:
        UnreadableError: it is neither XML nor one of our own JSON documents.
    """
    if text.lstrip()[:1] == b"{":
        return _from_json(text, notes), None
    root, namespace = read_tree(text, notes)
    report_split_values(text, notes)
    if b"<xacro:" in text or b"${" in text:
        report_unexpanded(root, notes)
    format_, lower = _ROOTS[str(root.tag)]
    if format_ == "urdf":
        report_tabbed_numbers(text, notes)
    context = Context(notes, notes.file, format_, declared_version(root, format_, notes))
    errors = refusals(root, context, engine)
    context.clean = not errors
    context.simple = context.clean and _is_plain(text, notes)
    data = lower(root, context)
    if errors:
        gate(root, context, engine, errors)
    data = {**data, "namespaces": _namespaces(root, namespace, inside=_declares_inside(root, text, notes))}
    if notes.has_errors:
        return _verify_what_is_there(data, notes), root
    return Document.model_validate(data), root


def read_tree(text: bytes, notes: Notes) -> tuple[XmlElement, str | None]:
    """The XML tree of a text in one of our formats, its names plain, and the default namespace that it had.

    Raises:
        UnreadableError: it is not XML, or of another format.
    """
    root = parse(text, notes)
    namespace = strip_default_namespace(root)
    if root.tag == _OLD_ROOT and root.get("version") in _OLD_ROOT_VERSIONS:
        message = f"the root of SDF {root.get('version')} is <{_OLD_ROOT}>; read, and written, as <sdf>"
        notes.report(reading.OLD_ROOT, message, Location(line=root.sourceline or 0, path=f"/{root.tag}"))
        root.tag = "sdf"
    if root.tag not in _ROOTS:
        where = Location(line=root.sourceline or 0, path=f"/{root.tag}")
        message = f"the root element is <{root.tag}>; expected <robot> or <sdf>"
        notes.report(reading.UNKNOWN_ROOT, message, where, found=str(root.tag), expected="robot or sdf")
        raise UnreadableError
    return root, namespace


def lower_tree(root: XmlElement, notes: Notes, *, valid: bool = False) -> Document:
    """The document of a tree that we have written ourselves; errors in the notes where it is not valid after all.

    `valid` says that its schema has seen it already.
    """
    format_, lower = _ROOTS[str(root.tag)]
    context = Context(notes, notes.file, format_, declared_version(root, format_, notes))
    errors = [] if valid else refusals(root, context, "libxml2")
    context.clean = not errors
    data = lower(root, context)
    if errors:
        gate(root, context, "libxml2", errors)
    return Document.model_validate({**data, "namespaces": _namespaces(root, None)})


def _verify_what_is_there(data: Mapping[str, Any], notes: Notes) -> Document | None:
    """After an error the names and references are still checked, so that the author sees all at once.

    Left out are findings that may only follow from what could not be read.
    """
    found = Notes(file=notes.file, strict=notes.strict)
    try:
        document = Document.model_validate(data)
    except ValidationError:
        return None  # without its name or type a thing cannot be looked at, and that is reported already
    verify(document, found)
    notes.extend(each for each in found.diagnostics if each.rule not in _CONSEQUENCES)
    return document


def declared_version(root: XmlElement, format_: str, notes: Notes) -> Version:
    """The version that the table pass goes by: the declared one where the format has it, else the newest."""
    facts, declared = table(format_), root.get("version")
    if declared is None and format_ in _WITHOUT_VERSION:
        return _WITHOUT_VERSION[format_]
    if declared in facts.versions:
        return parse_version(declared)
    where = Location(line=root.sourceline or 0, path=f"/{root.tag}/@version")
    newest = print_version(facts.newest)
    if declared is not None:
        message = f"{format_.upper()} has no version {declared!r}; read as {newest}"
        notes.report(structure.UNKNOWN_VERSION, message, where, found=declared, expected=", ".join(facts.versions))
    return facts.newest


def _is_plain(text: bytes, notes: Notes) -> bool:
    """Whether no name has a namespace: none is declared, nor was a prefix repaired; in UTF-16 there is a zero byte."""
    repaired = any(found.rule is reading.REPAIRED_XML for found in notes.diagnostics)
    return not repaired and b"xmlns" not in text and b"\0" not in text


def _declares_inside(root: XmlElement, text: bytes, notes: Notes) -> bool:
    """Whether other elements than the root may declare namespaces, or have had prefixes of theirs repaired."""
    repaired = any(found.rule is reading.REPAIRED_XML for found in notes.diagnostics)
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


def _from_json(text: bytes, notes: Notes) -> Document | None:
    refuse_excess(excess_of_json(text), notes)
    try:
        document = Document.model_validate_json(text)
    except ValidationError as error:
        for problem in error.errors(include_url=False)[:20]:
            path = "/".join(map(str, problem["loc"]))
            notes.report(structure.INVALID_VALUE, f"{path or 'the document'}: {problem['msg']}", Location(path=path))
        return None
    refuse_excess(excess_of_names(len(document.namespaces), text.count(_QUALIFIED)), notes)
    return document


@contextmanager
def garbage_collection_paused() -> Generator[None]:
    """Keep the collector from walking a growing tree again and again; nothing here makes cycles.

    Before it goes on, all that was made joins the old generation, which `freeze` and `unfreeze` do without looking at
    it; otherwise the first thing that the collector did would be to walk all of it once more.
    """
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            if not gc.get_freeze_count():  # what others have frozen stays so
                gc.freeze()
                gc.unfreeze()
            gc.enable()
