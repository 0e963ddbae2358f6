"""Writes a document as text that its schema accepts: the back ends of URDF and SDF, and the findings of the XSD.

In models of SDF that come from URDF, each frame is written behind the parts that it is attached to or posed in. SDF
leaves the order open, but Drake 1.51 puts a frame that stands before its base at the wrong place.
"""

from collections.abc import Callable, Iterable
from collections.abc import Set as AbstractSet
from dataclasses import replace
from typing import Any

from lxml import etree

from twinform.compiler.output.place_comments import place_comments
from twinform.compiler.output.source_comments import Comments
from twinform.diagnostics import Diagnostic, DiagnosticSink, Fate, Location, Source, rules
from twinform.diagnostics.rules import LEFT_COMMENT
from twinform.ir import Document, Element, Format, Frame, Joint, Link, Model, Opaque, walk
from twinform.ir.verify import verify_again
from twinform.lazy import lazy_pattern
from twinform.passes import PassInstrumentation, Pipeline
from twinform.schemas import (
    LAST_LINE,
    Context,
    Item,
    Version,
    WrittenParts,
    XmlElement,
    in_attribute,
    is_valid_text,
    is_valid_without_unknown,
    libxml2_errors,
    parse_version,
    parse_written,
    path_of,
    print_version,
    reader,
    root_text,
    validate,
    versions_of,
)

_TAGS = frozenset({"link", "joint", "frame", "model"})
_NODES = (Link, Joint, Frame, Model)
_Names = tuple[str | None, tuple[str, ...]]
"""The name of a part, if others may be based on it, and the names of the parts that it is based on."""
_NONE: _Names = (None, ())
# Stands for an untyped element, which is written behind the typed ones.
_WRITTEN: Item = (None, None)


# Only in documents that came from URDF, where the order is ours. An SDF file that stays SDF
# keeps its order, also where Drake misreads it. A pass cannot do this: parts are written in the
# order of the lines that they came from.
class _BaseOrder:
    """Orders parts so that each comes after its bases."""

    def __init__(self, names: set[str | None]) -> None:
        self.names = names
        self.done: set[str | None] = set()
        self.waiting: dict[str, list[tuple[Item, _Names]]] = {}

    def place(self, named: list[tuple[Item, _Names]]) -> list[Item]:
        """Return these parts, without those that have to wait, and with those that waited for them."""
        made: list[Item] = []
        for pair in named:
            ready = [pair]
            while ready:
                item, (name, bases) = one = ready.pop()
                # Each part waits under one base that is missing, and is looked at again when that
                # one is there: linear, however long the chains are.
                base = next((base for base in bases if self._is_awaited(base)), None) if bases else None
                if base is not None:
                    self.waiting.setdefault(base, []).append(one)
                    continue
                made.append(item)
                if name is not None:
                    self.done.add(name)
                    ready += reversed(self.waiting.pop(name, []))
        return made

    def _is_awaited(self, name: str) -> bool:
        return name in self.names and name not in self.done

    @property
    def circular(self) -> list[Item]:
        """The parts that still wait, because their bases go round in a circle."""
        return [item for many in self.waiting.values() for item, _ in many]


def with_bases_first(holder: Any, items: list[Item]) -> tuple[list[Item], list[Item]]:
    """Return the parts of a model in their order, and those that are written behind all others.

    The latter are based on an element without a typed form, which is written behind the typed ones, or go round in a
    circle. The parts of anything but a model stay as they are.
    """
    if isinstance(holder, Model):
        untyped = [part.element for part in holder.opaque if part.element is not None]
        return _order_by_bases(items, untyped) if holder.frames else (items, [])
    return _order_by_bases(items, ()) if holder.__class__ is Element and holder.name == "model" else (items, [])


def _order_by_bases(items: list[Item], others: Iterable[Element]) -> tuple[list[Item], list[Item]]:
    named = [(item, _names_of(item[0])) for item in items]
    untyped = [_names_of(other) for other in others]
    order = _BaseOrder({name for _, (name, _) in named} | {name for name, _ in untyped})
    first = order.place(named)
    late = order.place([(_WRITTEN, names) for names in untyped])
    return first, [item for item in (*late, *order.circular) if item is not _WRITTEN]


def _names_of(part: Any) -> _Names:
    if isinstance(part, Element):
        return _names_of_untyped(part)
    if not isinstance(part, _NODES):
        return _NONE
    if not isinstance(part, Frame):
        return part.name, ()
    return part.name, _base_names(part.attached_to, part.pose.relative_to if part.pose is not None else None)


def _names_of_untyped(part: Element) -> _Names:
    if part.name not in _TAGS:
        return _NONE
    name = str(part.get("name"))
    if part.name != "frame":
        return name, ()
    pose = part.find("pose")
    return name, _base_names(part.get("attached_to"), pose.get("relative_to") if pose is not None else None)


def _base_names(*names: str | None) -> tuple[str, ...]:
    """Return the parts of the model that a frame is based on."""
    return tuple([name.partition("::")[0] for name in names if name])


def sdf_text(
    document: Document, version: Version, namespaces: dict[str | None, str], parts: WrittenParts | None = None
) -> str:
    """Write a document as SDF. Models that were read from SDF keep their order."""
    arrange = with_bases_first if _has_robots(document) else None
    return root_text("sdf", version, document, namespaces, arrange=arrange, parts=parts)


def _has_robots(document: Document) -> bool:
    """Whether a model of a document comes from URDF."""
    return any(model.source and _is_of_urdf(model.source) for model in document.models)


def _is_of_urdf(source: Source) -> bool:
    while source.above is not None:
        source = source.above
    return source.step == "robot"


def urdf_text(
    document: Document, version: Version, namespaces: dict[str | None, str], parts: WrittenParts | None = None
) -> str:
    """Write a document of one model as URDF."""
    model = document.models[0]
    if document.version is not None:  # as an untyped attribute it is behind the others, and instead of another version
        attribute = Opaque.unchecked(attribute=("version", print_version(version)))
        model = model.copy(opaque=(*model.opaque, attribute))
    return root_text("urdf", version, model, namespaces, parts=parts)


def mjcf_text(
    document: Document, version: Version, namespaces: dict[str | None, str], parts: WrittenParts | None = None
) -> str:
    """Write a document of MJCF, whose elements are all untyped."""
    return root_text("mjcf", version, document, namespaces, parts=parts)


_NAMED = lazy_pattern(r"\[@name='([^']*)'\]")
_START_TAG = lazy_pattern("<[^/?]")
_ROOT_TAG = lazy_pattern(r'<[^\s/>?]+(?: xmlns:[^=]+="[^"]*")*')
_BACK_ENDS: dict[Format, Callable[[Document, Version, dict[str | None, str], WrittenParts | None], str]] = {
    Format.URDF: urdf_text,
    Format.SDF: sdf_text,
    Format.MJCF: mjcf_text,
}


def emit(
    document: Document,
    sink: DiagnosticSink,
    *,
    fit: bool = False,
    kept: AbstractSet[str] = frozenset(),
    comments: Comments | None = None,
) -> str:
    """Write a document in its own format and version, and report where its schema refuses it.

    For a document that was not read in this version, `fit` leaves out elements that only other versions have, and
    accounts for them in the ledger. Elements named in `kept` stay, because the source files had them too. `comments`
    are those of the source file.

    Raises:
        ValueError: there is a name or a text that XML cannot hold.
    """
    parts: WrittenParts | None = None if comments is None else []
    text = _plain_text(document, parts)
    # The text is validated as it stands. What is refused is parsed, because findings, and what `fit`
    # leaves out, are about its elements and their lines.
    if not is_valid_text(text, document.format, written_version(document)):
        text = _fit_to_version(document, text, sink, parts, kept=kept if fit else None)
    plain, text = text, _with_default_namespace(text, document)
    if comments is None or parts is None:
        return text
    if added := len(text) - len(plain):
        root = text.index("\n<") + 1
        parts = [(part, start + added if start > root else start) for part, start in parts]
    text, left = place_comments(comments, text, parts, document.namespaces)
    for comment in left:
        message = f"the comment {' '.join(comment.text.split())!r} is about what is not converted"
        sink.account(Fate.DROPPED, LEFT_COMMENT, message, Location(line=comment.line, path="/"), 0)
    return text


def emit_legal(
    document: Document,
    legalisation: Pipeline,
    sink: DiagnosticSink,
    instrumentation: PassInstrumentation | None = None,
    *,
    fit: bool = True,
    kept: AbstractSet[str] = frozenset(),
    comments: Comments | None = None,
) -> tuple[Document, str]:
    """Run the passes that a target needs, and return the document and its text, which is empty after an error.

    `fit`, `kept` and `comments` are those of `emit`.
    """
    if len(legalisation):
        document = legalisation.run(document, sink, instrumentation=instrumentation)
        if not sink.has_errors:
            verify_again(document, sink)
    if sink.has_errors:
        return document, ""
    text = emit(document, sink, fit=fit, kept=kept, comments=comments)
    return document, "" if sink.has_errors else text


def _fit_to_version(
    document: Document, text: str, sink: DiagnosticSink, parts: WrittenParts | None, *, kept: AbstractSet[str] | None
) -> str:
    """Return the text of a document that its schema refuses, without what `_validate` leaves out."""
    # To read the document takes several times as long, and elements that no version has are kept.
    if is_valid_without_unknown(parse_written(text), document.format, written_version(document)):
        return text
    if parts is None:
        parts = []
        text = _plain_text(document, parts)
    root = _parse_text(text, parts)
    elements = list(root.iter())
    found = DiagnosticSink(file=sink.file)
    _validate(root, document.format, written_version(document), found, kept=kept)
    sink.entries.extend(found.entries)
    sink.extend([located(diagnostic, document) for diagnostic in found.diagnostics])
    if not found.entries:
        return text
    etree.indent(root, "  ")
    made = f'<?xml version="1.0"?>\n{etree.tostring(root, encoding="unicode")}\n'
    starts = dict(zip(root.iter(), _start_offsets(made), strict=True))
    of_start = dict(zip(_start_offsets(text), elements, strict=True))
    parts[:] = [(part, starts[of_start[start]]) for part, start in parts if of_start[start] in starts]
    return made


def located(diagnostic: Diagnostic, document: Document) -> Diagnostic:
    """Add the line of the source part to a finding about a document that is being written."""
    if diagnostic.location.line:
        return diagnostic
    lines = {name: node.source.line for node in walk(document) if node.source and (name := getattr(node, "name", None))}
    named = (lines[name] for name in reversed(_NAMED.findall(diagnostic.location.path)) if name in lines)
    return replace(diagnostic, location=diagnostic.location._replace(line=next(named, 1)))


def document_tree(document: Document) -> XmlElement:
    """Return the XML tree of a document, without a default namespace and without layout.

    Raises:
        ValueError: there is a name or a text that XML cannot hold.
    """
    parts: WrittenParts = []
    return _parse_text(_plain_text(document, parts), parts)


def _parse_text(text: str, parts: WrittenParts) -> XmlElement:
    """Parse a written text; untyped elements get the lines that they were read at, and others none."""
    root = parse_written(text)
    for element in root.iter():
        element.sourceline = 0  # pyright: ignore[reportAttributeAccessIssue] - it can be set
        if len(element) and (element.text or "").isspace():
            element.text = None
        if (element.tail or "").isspace():
            element.tail = None
    elements = dict(zip(_start_offsets(text), root.iter(), strict=True))
    for part, start in parts:
        if isinstance(part, Element) and part.source is not None:
            elements[start].sourceline = min(part.source.line, LAST_LINE)  # pyright: ignore[reportAttributeAccessIssue] - see above
    return root


def _start_offsets(text: str) -> list[int]:
    """Return the offsets of the start tags in a text without comments."""
    return [found.start() for found in _START_TAG.finditer(text)]


def document_text(document: Document) -> str:
    """Return the text of a document, whether its schema accepts it or not.

    Raises:
        ValueError: there is a name or a text that XML cannot hold.
    """
    return _with_default_namespace(_plain_text(document), document)


def _plain_text(document: Document, parts: WrittenParts | None = None) -> str:
    """Return the text of a document without its default namespace."""
    prefixes: dict[str | None, str] = {prefix: uri for prefix, uri in document.namespaces if prefix}
    return _BACK_ENDS[document.format](document, written_version(document), prefixes, parts)


def _with_default_namespace(text: str, document: Document) -> str:
    """Return the text with the default namespace of its document on the root."""
    default = dict(document.namespaces).get("")
    if default is None:
        return text
    return _ROOT_TAG.sub(lambda tag: f'{tag[0]} xmlns="{in_attribute(default)}"', text, count=1)


def written_version(document: Document) -> Version:
    """Return the version whose schema a document follows: the newest where it declares none that exists."""
    known = versions_of(document.format)
    if document.version in known:
        return parse_version(document.version)
    return (1, 0) if document.format is Format.URDF and document.version is None else parse_version(known[-1])


def _validate(
    root: XmlElement, format_: Format, version: Version, sink: DiagnosticSink, *, kept: AbstractSet[str] | None
) -> None:
    """Validate the output with the XSD, and run the reader where the XSD refuses something.

    Elements that the version does not have are left out, except those named in `kept`; all stay where it is None.
    """
    errors = libxml2_errors(root, format_, version)
    if not errors:
        return
    found = DiagnosticSink(file=sink.file)
    context = Context(found, sink.file, format_, version)
    reader(format_, version).read(root, context)
    validate(root, context, errors=errors)
    if kept is not None:
        _leave_out(context, kept, sink)
    sink.extend(diagnostic for diagnostic in found.diagnostics if diagnostic.is_error)


def _leave_out(context: Context, kept: AbstractSet[str], sink: DiagnosticSink) -> None:
    """Remove from the tree that the reader has read what the version does not have."""
    version = f"{context.format.upper()} {print_version(context.version)}"
    for element, fact in context.outside:
        if fact.name in kept:
            continue
        what = f"the attribute {fact.name[1:]!r} of <{element.tag}>" if fact.is_attribute else f"<{element.tag}>"
        message = f"{version} does not have {what}"
        where = Location(sink.file, element.sourceline or 0, path_of(element))
        weight = 1 if fact.is_attribute else sum(1 + len(each.keys()) for each in element.iter())
        sink.report(rules.OLDER_VERSION, message, where, found=fact.name)
        sink.account(Fate.DROPPED, rules.OLDER_VERSION, message, where, weight)
        parent = element.getparent()
        if fact.is_attribute:
            element.attrib.pop(fact.name[1:], None)
        elif parent is not None:
            parent.remove(element)
