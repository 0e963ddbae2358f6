"""Writes a document as text that its schema accepts."""

from collections.abc import Callable
from collections.abc import Set as AbstractSet
from dataclasses import replace

from lxml import etree

from twinform.compiler.output import back_ends
from twinform.compiler.output.place_comments import place_comments
from twinform.compiler.output.source_comments import Comments
from twinform.diagnostics import Diagnostic, DiagnosticSink, Fate, Location, rules
from twinform.diagnostics.rules import LEFT_COMMENT
from twinform.ir import Document, Element, Format, walk
from twinform.ir.verify import verify_again
from twinform.lazy import lazy_pattern
from twinform.passes import PassInstrumentation, Pipeline
from twinform.schemas import (
    LAST_LINE,
    Context,
    Version,
    WrittenParts,
    XmlElement,
    in_attribute,
    is_valid_text,
    libxml2_errors,
    parse_version,
    parse_written,
    path_of,
    print_version,
    reader,
    validate,
    versions_of,
)

_NAMED = lazy_pattern(r"\[@name='([^']*)'\]")
_START_TAG = lazy_pattern("<[^/?]")
_ROOT_TAG = lazy_pattern(r'<[^\s/>?]+(?: xmlns:[^=]+="[^"]*")*')
_BACK_ENDS: dict[Format, Callable[[Document, Version, dict[str | None, str], WrittenParts | None], str]] = {
    Format.URDF: back_ends.urdf_text,
    Format.SDF: back_ends.sdf_text,
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
