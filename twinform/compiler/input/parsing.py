"""Parses bytes into an XML tree, safely, and reports correct XML that other programs read in another way.

The input may be hostile: no entities, no DTD, no network, no decompression, and limits on size. Real files are often
not quite XML; mistakes that the parsers of ROS and Gazebo accept are repaired where they can only mean one thing.

urdfdom does not separate numbers at tabs and new lines. libsdformat reads a text only up to the first comment in it.
Macros and `${...}` of xacro stay as they are in files whose names do not end in `.xacro`.
"""

import codecs
import re
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
    exceeds_limits,
    first_fatal,
    is_full,
    prefix_without_namespace,
    repaired,
    with_bracket,
    with_single_colons,
    without_hyphens,
)
from twinform.compiler.observing import note_failure
from twinform.diagnostics import DiagnosticSink, Location, Severity, rules
from twinform.file_access import OutsideError, Readable
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement, undeclared_namespace
from twinform.schemas.xml import Places, path_of
from twinform.text.tokens import COMMENT, INSTRUCTION, SECTION

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
        reason = error.strerror if isinstance(error, OSError) else "no file can have such a name"
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
        if any(map(exceeds_limits, log)):
            refuse_excess(Excess(f"{LIMITS} (column {flaw.column})", Location(line=flaw.line, path="/")), sink)
        places = SyntaxPlaces(text)
        where = places.location(flaw) if text == source else Location(line=flaw.line, path="/")
        flaw = places.described(flaw)
        sink.report(rules.NOT_WELL_FORMED, f"not well-formed XML: {flaw.message}", where, help=flaw.help)
        raise UnreadableError from error
    refuse_excess(excess_of_tree(root, text, limits), sink)
    places, words = SyntaxPlaces(source), SyntaxPlaces(text)
    is_unchanged = text == source
    prefixes: set[str] = set()
    for number, flaw in enumerate((*flaws, *repaired(log))):
        prefix = prefix_without_namespace(flaw)
        if prefix in prefixes:
            continue  # what declares it once declares it for all
        prefixes.update((prefix,) if prefix else ())
        message = f"not well-formed XML, repaired: {words.described(flaw).message}"
        is_placed = is_unchanged or (number < len(flaws) and whole is None)
        where = places.location(flaw) if is_placed else Location(line=flaw.line, path="/")
        # Gazebo's documentation writes `gz:type` so, and nothing that reads SDF minds.
        severity = Severity.INFO if prefix and root.tag == "sdf" and not sink.strict else None
        sink.report(rules.REPAIRED_XML, message, where, help=flaw.help, severity=severity)
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


_KINDS = bytes.maketrans(b"\t\r123456789", b"\n\n000000000")
"""Maps all digits to one, and all line breaks and tabs to one."""
ASIDE = lazy_pattern(f"{COMMENT}|{INSTRUCTION}|{SECTION}".encode())
"""What is no tag and no text that has to be parsed: comments, instructions and sections."""
_ATTRIBUTE = lazy_pattern(rb"""(?<![\w:.-])([\w:.-]++)\s*+=\s*+(?:"([^"<]*+)"|'([^'<]*+)')""")
_TABBED = lazy_pattern(rb"""["'][-+.\deE ]*+(?:[\t\r\n]|&#)[-+.\deE \t\r\n&#xaAdD;]*+["']""")
"""Numbers in quotes with a break or a character reference between them: a quick test that few files pass."""
_BLANK_BEHIND = lazy_pattern(rb"""["'] *+[-+.\deE]++ ++["']""")
"""A single number in quotes with a blank behind it."""
_REFERENCE = lazy_pattern(rb"&#(?:0*(?:9|10|13)|x0*[9aAdD]);")
_NUMBERS = lazy_pattern(r"[-+.\deE \t\r\n]+")
_DIGIT = lazy_pattern(r"\d")
_BREAK = lazy_pattern(r"[\t\r\n]")
_NAMES = frozenset({"name", "link", "joint", "reference", "version"})
"""Attributes that are no numbers, whatever they look like."""
_COMMENT = b"<!--"
_BEFORE_COMMENT = 200
"""So many bytes before a comment are searched for text."""


def report_tabbed_numbers(text: bytes, sink: DiagnosticSink) -> None:
    """Report numbers of a URDF file with white space that urdfdom does not read, though it is a blank to XML."""
    if not (_has_break_after_digit(text) or _has_blank_before_quote(text)):
        return
    bare = ASIDE.sub(_line_breaks, text)
    if not (_TABBED.search(bare) or _BLANK_BEHIND.search(bare)):
        return
    line, counted = 1, 0
    for found in _ATTRIBUTE.finditer(bare):
        value = _REFERENCE.sub(b"\t", found[2] or found[3] or b"").decode(errors="replace")
        name = found[1].decode()
        if has_unread_numbers(name, value):
            line, counted = line + bare.count(b"\n", counted, found.start()), found.start()
            tabbed = f"the numbers of {name!r} have a tab or a new line between them; expected blanks"
            message = tabbed if _BREAK.search(value) else f"the number of {name!r} has a blank behind it"
            sink.report(rules.TABBED_NUMBERS, message, Location(sink.file, line), expected="blanks")


def has_unread_numbers(name: str, value: str) -> bool:
    """Whether an attribute has numbers with a tab or a new line, or one number with a blank behind it."""
    is_cut_off = value.endswith(" ") and " " not in value.strip(" ")
    if name in _NAMES or not (is_cut_off or _BREAK.search(value)):
        return False
    return bool(_DIGIT.search(value) and _NUMBERS.fullmatch(value))


def _has_break_after_digit(text: bytes) -> bool:
    """Whether a tab or a new line follows a digit: a quick test that few files pass."""
    return b"&#" in text or b"0\n" in text.translate(_KINDS, b" ")


def _has_blank_before_quote(text: bytes) -> bool:
    """Whether a blank stands between a digit and a quote: a quick test that few files pass."""
    alike = text.translate(_KINDS)
    return b'0 "' in alike or b"0 '" in alike


def _line_breaks(found: re.Match[bytes]) -> bytes:
    return b"\n" * found[0].count(b"\n")


def report_split_values(root: XmlElement, sink: DiagnosticSink) -> None:
    """Report texts with a comment in the middle, in a tree that has its comments."""
    places: Places = {}
    for element in root.iter(etree.Element):
        if _is_split(element):
            message = f"the text of <{element.tag}> has a comment in the middle"
            where = Location(sink.file, element.sourceline or 0, path_of(element, places))
            sink.report(rules.SPLIT_VALUE, message, where, found=(element.text or "").strip())


def has_comment_after_text(text: bytes) -> bool:
    """Whether a comment follows text: a quick test that few files pass."""
    at = text.find(_COMMENT)
    while at >= 0:
        if text[max(0, at - _BEFORE_COMMENT) : at].rstrip()[-1:] not in b">":
            return True
        at = text.find(_COMMENT, at + 1)
    return False


def _is_split(element: XmlElement) -> bool:
    pieces = [element.text, *(child.tail for child in element)]
    comments_only = len(element) and all(child.tag is etree.Comment for child in element)
    return bool(comments_only and (element.text or "").strip() and any((piece or "").strip() for piece in pieces[1:]))
