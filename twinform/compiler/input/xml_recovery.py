"""XML recovery: repairs malformed XML where the meaning is certain, and reports the rest."""

import re
from collections.abc import Iterable
from typing import NamedTuple, Protocol

from lxml import etree

from twinform.lazy import lazy_pattern

REPAIRS = {
    "ERR_UNKNOWN_VERSION": "write <?xml version='1.0'?>",
    "ERR_VERSION_MISSING": "write <?xml version='1.0'?>",
    "ERR_HYPHEN_IN_COMMENT": "write no '--' inside a comment",
    "NS_ERR_UNDEFINED_NAMESPACE": "declare the prefix on the root element with xmlns:prefix='...'",
    "ERR_RESERVED_XML_NAME": "move <?xml ...?> to the very beginning of the file",
}
"""Errors after which libxml2 leaves no doubt about the tree, and what the author should write instead."""

LIMITS = "elements are more than 256 deep, a text has more than 10 MB, or entities make more of it than they are"
"""The reasons for which libxml2 refuses any file."""

LOST_BRACKET = "write <?xml, with the '<', at the beginning"

_BOM = b"\xef\xbb\xbf"
_FOLLOWS = frozenset({"ERR_SPACE_REQUIRED", "ERR_STRING_NOT_STARTED", "ERR_XMLDECL_NOT_FINISHED"})
"""Errors that libxml2 also reports for a declaration that it does not understand."""

_HELP = {
    "ERR_ATTRIBUTE_NOT_STARTED": "put the value of the attribute in quotes: name='value'",
    "ERR_ATTRIBUTE_NOT_FINISHED": "close the quotes of the attribute that begins on this line or before it",
    "ERR_LT_IN_ATTRIBUTE": "close the quotes of the attribute that begins on this line or before it; a '<' that is "
    "meant is written &lt;",
    "ERR_ATTRIBUTE_WITHOUT_VALUE": "give the attribute a value in quotes: name='value'",
    "ERR_ATTRIBUTE_REDEFINED": "delete one of the two attributes of this name",
    "ERR_SPACE_REQUIRED": "put a blank between attributes",
    "ERR_GT_REQUIRED": "close the tag with '>'; an end tag has no attributes",
    "ERR_TAG_NAME_MISMATCH": "let every end tag repeat the name of its start tag",
    "ERR_TAG_NOT_FINISHED": "the file ends too early: it was cut off, or the last end tags are missing",
    "ERR_UNDECLARED_ENTITY": "write the character itself; XML knows only &lt; &gt; &amp; &apos; and &quot;",
    "ERR_COMMENT_NOT_FINISHED": "close the comment with -->",
    "ERR_CDATA_NOT_FINISHED": "close the section with ]]>",
    "ERR_INVALID_ENCODING": "save the file as UTF-8, or name its encoding: <?xml version='1.0' encoding='...'?>",
    "ERR_UNSUPPORTED_ENCODING": "name an encoding that exists, such as UTF-8",
    "ERR_INVALID_CHAR": "delete the control character",
    "NS_ERR_QNAME": "write one colon between a prefix and a name",
}
_COLONS = lazy_pattern(
    rb"<!--(?:.*?-->|.*)|<!\[CDATA\[(?:.*?\]\]>|.*)|(?P<start></?[A-Za-z_][\w.-]*)::(?=[A-Za-z_])", re.DOTALL
)
"""Two colons in a tag, or a comment or section, which is skipped; one that does not end goes to the end of the text."""
_COMMENT = lazy_pattern(rb"<!\[CDATA\[(?:.*?\]\]>|.*)|<!--(?:(?P<content>.*?)-->|.*)", re.DOTALL)
"""A section, or a comment with its content; one that does not end goes to the end of the text."""
_MOST_LOGGED = 100
"""The number of errors that libxml2 lists; of later ones it only lists those of a graver level."""


class LogEntry(Protocol):
    """An entry of libxml2's error log."""

    @property
    def line(self) -> int: ...  # noqa: D102 - the names say it
    @property
    def column(self) -> int: ...  # noqa: D102 - as above
    @property
    def message(self) -> str: ...  # noqa: D102 - as above
    @property
    def type_name(self) -> str: ...  # noqa: D102 - as above
    @property
    def level(self) -> int: ...  # noqa: D102 - as above


class XmlError(NamedTuple):
    """An error at a place, and what to do about it; `kind` is libxml2's name for it."""

    line: int
    column: int
    message: str
    help: str | None
    kind: str = ""


_PREFIX = lazy_pattern(r"prefix (\S+) ")


def prefix_without_namespace(error: XmlError) -> str | None:
    """Return the prefix that an error is about; None for other errors."""
    found = _PREFIX.search(error.message) if error.kind == "NS_ERR_UNDEFINED_NAMESPACE" else None
    return found[1] if found else None


def with_bracket(text: bytes) -> bytes | None:
    """Return the text with a `<` before `?xml`; None where the text does not begin with `?xml`."""
    start = text.removeprefix(_BOM)
    return text.replace(b"?xml", b"<?xml", 1) if start.lstrip().startswith(b"?xml") else None


def with_single_colons(text: bytes) -> tuple[bytes, list[XmlError]]:
    """Return the text with one colon for two between a prefix and a name in tags, and where they were."""
    flaws: list[XmlError] = []
    pieces: list[bytes] = []
    line, column, copied = 1, 0, 0
    for found in (each for each in _COLONS.finditer(text) if each["start"]):
        before = text[copied : found.end()]
        line += before.count(b"\n")
        on_line = len(before.rpartition(b"\n")[2].decode(errors="replace"))
        column = on_line if b"\n" in before else column + on_line
        pieces += (text[copied : found.start()], found["start"], b":")
        copied = found.end()
        if not found["start"].startswith(b"</"):
            name = found["start"][1:].decode(errors="replace")
            words = f"two colons behind the prefix {name}"
            flaws.append(XmlError(line, column, words, _HELP["NS_ERR_QNAME"], "NS_ERR_QNAME"))
    return b"".join((*pieces, text[copied:])), flaws


def exceeds_limits(entry: LogEntry) -> bool:
    """Whether libxml2 refuses a file for its size or depth; before 2.14 the error has no name."""
    return entry.type_name == "ERR_RESOURCE_LIMIT" or "XML_PARSE_HUGE" in entry.message


def is_full(log: Iterable[LogEntry]) -> bool:
    """Whether there may be more errors than libxml2 lists."""
    # A hundred harmless errors may hide the one that leaves doubt about the tree.
    return sum(entry.level == etree.ErrorLevels.FATAL for entry in log) >= _MOST_LOGGED


def without_hyphens(text: bytes) -> bytes:
    """Return the text with blanks for the hyphens in comments, so that all else stays where it is."""
    return _COMMENT.sub(_without_hyphens_inside, text)


def _without_hyphens_inside(found: re.Match[bytes]) -> bytes:
    return found[0] if found["content"] is None else b"<!--%b-->" % found["content"].replace(b"-", b" ")


def first_fatal(log: Iterable[LogEntry], text: bytes) -> XmlError | None:
    """Return the first error that leaves doubt about the tree."""
    entries = list(log)
    fixed = {(entry.line, entry.column) for entry in entries if entry.type_name == "ERR_VERSION_MISSING"}
    for entry in entries:
        # libxml2 reports one mistake several times; only the first of them says what it is.
        if entry.type_name in REPAIRS or (entry.type_name in _FOLLOWS and (entry.line, entry.column) in fixed):
            continue
        line = entry.line
        # libxml2 reports it where the file ends, and the mistake is where the comment begins.
        if entry.type_name == "ERR_COMMENT_NOT_FINISHED":
            line = text.count(b"\n", 0, text.find(b"<!--", text.rfind(b"-->") + 1)) + 1
        return XmlError(line, entry.column, entry.message.strip(), _help_for(entry, text), entry.type_name)
    return None


def repaired(log: Iterable[LogEntry]) -> list[XmlError]:
    """Return the errors that leave no doubt about the tree."""
    return [
        XmlError(entry.line, entry.column, entry.message.strip(), REPAIRS[entry.type_name], entry.type_name)
        for entry in log
        if entry.type_name in REPAIRS
    ]


def _help_for(entry: LogEntry, text: bytes) -> str | None:
    if _is_at_the_end(entry, text) and entry.type_name in {"ERR_ATTRIBUTE_WITHOUT_VALUE", "ERR_GT_REQUIRED"}:
        return "the file ends in the middle of a tag: it was cut off"
    match entry.type_name:
        case "ERR_NAME_REQUIRED":
            if entry.message.startswith("xmlParseEntityRef"):
                return "write & as &amp;"
            if entry.message.startswith("error parsing attribute name"):
                return "close the tag with '>' before the next one; a name begins with a letter"
            return "write the name right behind the '<'; a '<' that is meant as text is written &lt;"
        case "ERR_DOCUMENT_EMPTY":
            return "a model begins with '<': delete what stands before it, or name another file if this is no model"
        case "ERR_DOCUMENT_END":
            return _help_for_rest(entry.line, text)
        case _:
            return _HELP.get(entry.type_name)


def _is_at_the_end(entry: LogEntry, text: bytes) -> bool:
    return entry.line >= text.rstrip().count(b"\n") + 1 and not text.rstrip().endswith(b">")


def _help_for_rest(line: int, text: bytes) -> str:
    rest = b"\n".join(text.splitlines()[line - 1 :]).lstrip()
    if rest.startswith(b"<") and not rest.startswith(b"</"):
        return "a file holds one root element: move the second one into a file of its own"
    return "delete what follows the end tag of the root element"
