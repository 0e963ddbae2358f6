"""From a document to validated text."""

import re
from collections.abc import Callable
from collections.abc import Set as AbstractSet
from dataclasses import replace

from lxml import etree

from twinform.compiler.output import sdf, urdf
from twinform.compiler.output.comments import Comments, place_comments
from twinform.compiler.output.default_namespaces import has_made_up_prefixes, restore_defaults
from twinform.diagnostics import Diagnostic, DiagnosticSink, Fate, Location, rules
from twinform.diagnostics.rules import LEFT_COMMENT
from twinform.ir import Document, Format, walk
from twinform.ir.verify import verify_again
from twinform.passes import PassInstrumentation, Pipeline
from twinform.schemas import (
    Context,
    Version,
    XmlElement,
    is_valid_text,
    libxml2_errors,
    noted,
    parse_version,
    path_of,
    print_version,
    reader,
    validate,
    versions_of,
)

_NAMED = re.compile(r"\[@name='([^']*)'\]")
_BACK_ENDS: dict[Format, Callable[[Document, Version, dict[str | None, str]], XmlElement]] = {
    Format.URDF: urdf.emit,
    Format.SDF: sdf.emit,
}
_TEXT_BACK_ENDS: dict[Format, Callable[[Document, Version, dict[str | None, str]], str | None]] = {
    Format.URDF: urdf.emit_text,
    Format.SDF: sdf.emit_text,
}


def emit(
    document: Document,
    sink: DiagnosticSink,
    *,
    fit: bool = False,
    kept: AbstractSet[str] = frozenset(),
    comments: Comments | None = None,
) -> str:
    """The text of a document in its own format and version, and errors in the notes where its schema refuses it.

    Where the document was not read in this version, `fit` leaves out what other versions have and this one has not, and
    accounts for it; but not the names that are `kept`, which the files that it was made of had so too. `comments` are
    those of the file that it was made of.
    """
    if comments is not None:
        return _commented(document, sink, comments, fit=fit, kept=kept)
    text = text_without_tree(document)
    # The text is validated as it stands. What is refused is written again as a tree, because
    # findings, and what `fit` leaves out, are about its elements and their lines.
    if text is not None and is_valid_text(text, document.format, written_version(document)):
        return text
    return serialized(valid_tree(document, sink, fit=fit, kept=kept), document)


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
    """The document after the passes that its target asks for, and its text; empty where the notes have errors.

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


def _commented(
    document: Document, sink: DiagnosticSink, comments: Comments, *, fit: bool, kept: AbstractSet[str]
) -> str:
    with noted() as written:
        root = valid_tree(document, sink, fit=fit, kept=kept)
    placed = place_comments(comments, root, written)
    for message, line in placed.left:
        sink.account(Fate.DROPPED, LEFT_COMMENT, message, Location(line=line, path="/"), 0)
    return placed.framed(serialized(root, document, placed.on_lines))


def valid_tree(
    document: Document, sink: DiagnosticSink, *, fit: bool = False, kept: AbstractSet[str] = frozenset()
) -> XmlElement:
    """The XML of a document, made by `emit` and validated."""
    root = document_tree(document)
    found = DiagnosticSink(file=sink.file)
    _validate(root, document.format, written_version(document), found, kept=kept if fit else None)
    sink.entries.extend(found.entries)
    sink.extend([located(diagnostic, document) for diagnostic in found.diagnostics])
    return root


def located(diagnostic: Diagnostic, document: Document) -> Diagnostic:
    """A finding about what is to be written, with the line of the part of the source that it was made of."""
    if diagnostic.location.line:
        return diagnostic
    lines = {name: node.source.line for node in walk(document) if node.source and (name := getattr(node, "name", None))}
    named = (lines[name] for name in reversed(_NAMED.findall(diagnostic.location.path)) if name in lines)
    return replace(diagnostic, location=diagnostic.location._replace(line=next(named, 1)))


def document_tree(document: Document) -> XmlElement:
    """The XML of a document, its names without a default namespace."""
    return _BACK_ENDS[document.format](document, written_version(document), _prefixes(document))


def text_without_tree(document: Document) -> str | None:
    """The text of a document, the same as that of its tree; nothing where only a tree leads to it."""
    if any(not prefix for prefix, _ in document.namespaces):
        return None
    return _TEXT_BACK_ENDS[document.format](document, written_version(document), _prefixes(document))


def _prefixes(document: Document) -> dict[str | None, str]:
    return {prefix or None: uri for prefix, uri in document.namespaces if prefix}


def serialized(root: XmlElement, document: Document, arrange: Callable[[XmlElement], None] | None = None) -> str:
    """The text of a document whose XML this is; `arrange` has the last word on the blanks in it."""
    default = dict(document.namespaces).get("")
    if default is not None:
        root = _in_namespace(root, default)
    etree.indent(root, "  ")
    if arrange is not None:
        arrange(root)
    text = etree.tostring(root, encoding="unicode")
    if has_made_up_prefixes(text):
        restore_defaults(root, dict(document.namespaces))
        text = etree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0"?>\n{text}\n'


def written_version(document: Document) -> Version:
    """The version whose schema a document follows; the newest where it declares none that exists."""
    known = versions_of(document.format)
    if document.version in known:
        return parse_version(document.version)
    return (1, 0) if document.format is Format.URDF and document.version is None else parse_version(known[-1])


def _validate(
    root: XmlElement, format_: Format, version: Version, sink: DiagnosticSink, *, kept: AbstractSet[str] | None
) -> None:
    """XSD validation of the output. The schema reader runs only where the XSD refuses: on what came in as unknown.

    What the version does not have is left out, but for the names that are kept; all of it stays where `kept` is None.
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
    """Take what the version does not have out of the tree that the schema reader has read."""
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


def _in_namespace(root: XmlElement, namespace: str) -> XmlElement:
    """Return a copy of the tree with its plain names in a default namespace."""
    made = etree.Element(f"{{{namespace}}}{root.tag}", dict(root.attrib), {None: namespace, **root.nsmap})
    made.text = root.text
    made.extend(list(root))
    for element in made.iterdescendants("*"):
        if str(element.tag)[0] != "{":
            element.tag = f"{{{namespace}}}{element.tag}"
    return made
