"""Parses bytes into an XML tree, safely.

The input may be hostile: no entities, no DTD, no network, no decompression, and limits on size. Real files are often
not quite XML; mistakes that the parsers of ROS and Gazebo accept are repaired where they can only mean one thing.
"""

import codecs
from pathlib import Path
from typing import cast

from lxml import etree

from twinform.compiler.input.size_limits import (
    LIFTED_BY_SIZE,
    USUAL_LIMITS,
    Excess,
    Limits,
    excess_of_bytes,
    excess_of_colons,
    excess_of_namespaces,
    excess_of_tree,
    uncountable_encoding,
)
from twinform.compiler.input.xml_recovery import (
    LIMITS,
    LOST_BRACKET,
    XmlError,
    first_fatal,
    is_full,
    repaired,
    with_bracket,
    with_single_colons,
    without_hyphens,
)
from twinform.compiler.observing import note_failure
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.file_access import OutsideError, Readable
from twinform.schemas import XmlElement, undeclared_namespace

_UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


class UnreadableError(Exception):
    """There is no tree; the reasons are in the diagnostics."""


def read_bytes(
    path: Path, sink: DiagnosticSink, limits: Limits = USUAL_LIMITS, readable: Readable | None = None
) -> bytes:
    """Read the bytes of a file, which has to be `readable`, or without this inside its own root.

    Raises:
        UnreadableError: it is missing, no regular file, too large, or must not be read.
    """
    try:
        text = (readable or Readable.of(path)).read(path, limits.size)
    except (OSError, ValueError) as error:
        if path.exists():
            note_failure()
        reason = error.strerror if isinstance(error, OSError) else str(error)
        hint = error.help if isinstance(error, OutsideError) else None
        raise _unreadable(sink, f"cannot read the file: {reason}", hint) from error
    if len(text) > limits.size:
        message = f"the file has more than {limits.size:,} bytes, which is the limit"
        raise _unreadable(sink, message, LIFTED_BY_SIZE)
    return text


def parse(
    text: bytes, sink: DiagnosticSink, limits: Limits = USUAL_LIMITS, *, keep_comments: bool = False
) -> XmlElement:
    """Parse a text, and return the root of its tree, with namespaces for undeclared prefixes.

    Raises:
        UnreadableError: it is not XML, or has a document type declaration.
    """
    if not text.strip():
        raise _unreadable(sink, "the file is empty")
    refuse_excess(excess_of_bytes(text, limits), sink)
    encoding = uncountable_encoding(text)
    if encoding is not None:
        message = f"the encoding {encoding!r} is none that models are written in"
        hint = "save the file as UTF-8, or name an encoding that it may have, such as UTF-8 or ISO-8859-1"
        sink.report(rules.NOT_WELL_FORMED, message, Location(line=1, path="/"), help=hint)
        raise UnreadableError
    repaired = False
    try:
        root = etree.fromstring(text, _parser(recover=False, keep_comments=keep_comments))
        refuse_excess(excess_of_tree(root, text, limits), sink)
    except etree.XMLSyntaxError as error:
        root, repaired = _recover(text, sink, error, limits, keep_comments=keep_comments), True
    refuse_excess(excess_of_namespaces(root, text, repaired=repaired), sink)
    if root.getroottree().docinfo.doctype:
        from twinform.compiler.input.syntax_places import SyntaxPlaces  # noqa: PLC0415 - few files are refused

        sink.report(rules.DOCTYPE, "the document has a DOCTYPE; none is allowed", SyntaxPlaces(text).doctype())
        raise UnreadableError
    if b"\0" in text[:4] or text[:2] in _UTF_16:
        message = "the file is in UTF-16, which neither urdfdom nor Drake nor libsdformat reads"
        sink.report(rules.WIDE_ENCODING, message, Location(line=1, path="/"), help="save the file as UTF-8")
    return root


def refuse_excess(excess: Excess | None, sink: DiagnosticSink) -> None:
    """Report an excess, if there is one.

    Raises:
        UnreadableError: there is an excess.
    """
    if excess is not None:
        sink.report(rules.OVERSIZED_FILE, excess.message, excess.location, help=excess.help)
        raise UnreadableError


def _parser(*, recover: bool, keep_comments: bool) -> etree.XMLParser:
    return etree.XMLParser(
        # A few entities that stand for each other ("billion laughs") fill the memory.
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        attribute_defaults=False,
        huge_tree=False,
        remove_comments=not keep_comments,
        remove_pis=True,
        recover=recover,
    )


def _recover(
    text: bytes, sink: DiagnosticSink, error: etree.XMLSyntaxError, limits: Limits, *, keep_comments: bool
) -> XmlElement:
    from twinform.compiler.input.syntax_places import SyntaxPlaces  # noqa: PLC0415 - few files are not well-formed

    source, whole = text, with_bracket(text)
    if whole is not None:
        line = text[: text.index(b"?xml")].count(b"\n") + 1
        message = "not well-formed XML, repaired: the '<' of the XML declaration is missing"
        sink.report(rules.REPAIRED_XML, message, Location(line=line, path="/"), help=LOST_BRACKET)
        text = whole
    text, flaws = with_single_colons(text)
    refuse_excess(excess_of_colons(len(flaws)), sink)
    parser = _parser(recover=True, keep_comments=keep_comments)
    try:
        root = cast("XmlElement | None", etree.fromstring(text, parser))  # None for what has no element at all
    except etree.XMLSyntaxError:  # what begins with a zero byte is no text to libxml2, and nothing is recovered
        root = None
    log = list(parser.error_log)
    flaw = first_fatal(log, text) or (_unlisted_flaw(text) if is_full(log) else None)
    if root is None or flaw is not None:
        flaw = flaw or XmlError(error.position[0], error.position[1], error.msg or "not XML", None)
        if any(entry.type_name == "ERR_RESOURCE_LIMIT" for entry in log):
            refuse_excess(Excess(f"{LIMITS} (column {flaw.column})", Location(line=flaw.line, path="/")), sink)
        places = SyntaxPlaces(text)
        where = places.location(flaw) if text == source else Location(line=flaw.line, path="/")
        flaw = places.described(flaw)
        sink.report(rules.NOT_WELL_FORMED, f"not well-formed XML: {flaw.message}", where, help=flaw.help)
        raise UnreadableError from error
    refuse_excess(excess_of_tree(root, text, limits), sink)
    places, words = SyntaxPlaces(source), SyntaxPlaces(text)
    is_unchanged = text == source
    for number, flaw in enumerate((*flaws, *repaired(log))):
        message = f"not well-formed XML, repaired: {words.described(flaw).message}"
        is_placed = is_unchanged or (number < len(flaws) and whole is None)
        where = places.location(flaw) if is_placed else Location(line=flaw.line, path="/")
        sink.report(rules.REPAIRED_XML, message, where, help=flaw.help)
    _declare_prefixes(root)
    return root


def _unlisted_flaw(text: bytes) -> XmlError | None:
    """Return an error that leaves doubt about the tree, behind so many harmless ones that libxml2 stops listing them.

    In real files the harmless ones are hyphens in comments. Of a hundred others, the last counts as such an error.
    """
    parser = _parser(recover=True, keep_comments=False)
    etree.fromstring(without_hyphens(text), parser)
    log = list(parser.error_log)
    flaw = first_fatal(log, text)
    return flaw or (repaired(log)[-1] if is_full(log) else None)


def _declare_prefixes(root: XmlElement) -> None:
    """Give names with undeclared prefixes, which libxml2 leaves as literal `prefix:name`, a namespace."""
    for element in root.iter("*"):
        tag = str(element.tag)
        if ":" in tag and tag[0] != "{":
            element.tag = _qualified(tag)
        for name in [name for name in element.attrib if ":" in str(name) and str(name)[0] != "{"]:
            element.set(_qualified(str(name)), element.attrib.pop(name))


def _qualified(name: str) -> str:
    prefix, _, local = name.partition(":")
    return f"{{{undeclared_namespace(prefix)}}}{local}"


def strip_default_namespace(root: XmlElement) -> str | None:
    """Remove the default namespace from names, as the readers of ROS and Gazebo do, and return it."""
    namespace = root.nsmap.get(None)
    if namespace is None:
        return None
    start = f"{{{namespace}}}"
    for element in root.iter(f"{start}*"):
        element.tag = str(element.tag)[len(start) :]
    return namespace


def _unreadable(sink: DiagnosticSink, message: str, help: str | None = None) -> UnreadableError:
    sink.report(rules.UNREADABLE_FILE, message, help=help)
    return UnreadableError()
