"""From text to a verified document: parse, read, gate, build the IR."""

import gc
from collections.abc import Callable, Generator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from twinform.compiler.errors import CompileError
from twinform.compiler.parsing import (
    UnreadableError,
    parse,
    read_bytes,
    strip_default_namespace,
    undeclared_prefix,
)
from twinform.compiler.sdf import front_end as sdf
from twinform.compiler.urdf import front_end as urdf
from twinform.compiler.urdf.extensions import check_extensions
from twinform.diagnostics import Diagnostic, Location, Notes
from twinform.diagnostics.rules import reading, structure
from twinform.ir import Document, Format, count_parts
from twinform.ir.verify import verify
from twinform.schemas import Context, Engine, Version, XmlElement, gate, parse_version, print_version, refusals, table

_ROOTS: dict[str, tuple[str, Callable[[XmlElement, Context], Mapping[str, Any]]]] = {
    "robot": ("urdf", urdf.lower),
    "sdf": ("sdf", sdf.lower),
}
_WITHOUT_VERSION = {"urdf": (1, 0)}
"""The version of a file that declares none."""


@dataclass(frozen=True, slots=True)
class Checked:
    """What `check` found. `unreadable` says that there is no model at all: no file, no XML, or another format.

    `tree` is the XML that the document came from.
    """

    path: str
    document: Document | None
    diagnostics: tuple[Diagnostic, ...]
    unreadable: bool = False
    tree: XmlElement | None = None

    @property
    def size(self) -> int:
        """How many elements and attributes the source has."""
        if self.tree is not None:
            return sum(1 + len(element.keys()) for element in self.tree.iter())
        return count_parts(self.document) if self.document else 0

    @property
    def accepted(self) -> bool:
        """Whether there is no error."""
        return not any(diagnostic.is_error for diagnostic in self.diagnostics)


def check(source: str | Path | bytes, *, name: str = "", strict: bool = False, engine: Engine = "libxml2") -> Checked:
    """Read a file, or the bytes of one, and say everything that is wrong with it."""
    notes = Notes(file=name or ("<bytes>" if isinstance(source, bytes) else str(source)), strict=strict)
    with garbage_collection_paused():
        return _check(source, notes, engine)


def _check(source: str | Path | bytes, notes: Notes, engine: Engine) -> Checked:
    try:
        text = source if isinstance(source, bytes) else read_bytes(Path(source), notes)
        document, tree = read_document(text, notes, engine)
    except UnreadableError:
        return Checked(notes.file, None, tuple(notes.diagnostics), unreadable=True)
    if document is not None:
        verify(document, notes)
        if document.format is Format.URDF:
            check_extensions(document, notes)
    return Checked(notes.file, document, tuple(notes.diagnostics), tree=tree)


def load(source: str | Path, *, strict: bool = False, engine: Engine = "libxml2") -> Document:
    """The document of a file.

    Raises:
        CompileError: the file has an error; what was found is in its diagnostics.
    """
    return _document(check(source, strict=strict, engine=engine))


def loads(text: str | bytes, name: str = "<string>", *, strict: bool = False, engine: Engine = "libxml2") -> Document:
    """The document of a text; `name` stands for the file in diagnostics.

    Raises:
        CompileError: the text has an error; what was found is in its diagnostics.
    """
    data = text.encode() if isinstance(text, str) else text
    return _document(check(data, name=name, strict=strict, engine=engine))


def _document(checked: Checked) -> Document:
    if checked.document is None or not checked.accepted:
        raise CompileError(checked.diagnostics, unreadable=checked.unreadable)
    return checked.document


def read_document(text: bytes, notes: Notes, engine: Engine) -> tuple[Document | None, XmlElement | None]:
    """The document of a text and its XML tree, if it is XML. No document where it has errors, which are in the notes.

    Raises:
        UnreadableError: it is neither XML nor one of our own JSON documents.
    """
    if text.lstrip()[:1] == b"{":
        return _from_json(text, notes), None
    root = parse(text, notes)
    namespace = strip_default_namespace(root)
    if root.tag not in _ROOTS:
        where = Location(line=root.sourceline or 0, path=f"/{root.tag}")
        message = f"the root element is <{root.tag}>; expected <robot> or <sdf>"
        notes.report(reading.UNKNOWN_ROOT, message, where, found=str(root.tag), expected="robot or sdf")
        raise UnreadableError
    format_, lower = _ROOTS[str(root.tag)]
    context = Context(notes, notes.file, format_, _declared_version(root, format_, notes))
    errors = refusals(root, context, engine)
    context.clean = not errors
    context.simple = context.clean and b"xmlns" not in text
    data = lower(root, context)
    if errors:
        gate(root, context, engine, errors)
    if notes.has_errors:
        return None, root
    document = Document.model_validate({**data, "namespaces": _namespaces(root, context, namespace)})
    return document, root


def _declared_version(root: XmlElement, format_: str, notes: Notes) -> Version:
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


def _namespaces(root: XmlElement, context: Context, default: str | None) -> tuple[tuple[str, str], ...]:
    found = {prefix: uri for prefix, uri in root.nsmap.items() if prefix} | context.namespaces
    found = {undeclared_prefix(uri) or prefix: uri for prefix, uri in found.items()}
    return (*((("", default),) if default else ()), *sorted(found.items()))


def _from_json(text: bytes, notes: Notes) -> Document | None:
    try:
        return Document.model_validate_json(text)
    except ValidationError as error:
        for problem in error.errors(include_url=False)[:20]:
            path = "/".join(map(str, problem["loc"]))
            notes.report(structure.INVALID_VALUE, f"{path or 'the document'}: {problem['msg']}", Location(path=path))
        return None


@contextmanager
def garbage_collection_paused() -> Generator[None]:
    """Keep the collector from walking a growing tree again and again; nothing here makes cycles."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
