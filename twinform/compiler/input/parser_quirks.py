"""Reports texts that are correct XML, and that other programs read in another way or not at all.

urdfdom does not separate numbers at tabs and new lines. libsdformat reads a text only up to the first comment in it.
Macros and `${...}` of xacro stay as they are in files whose names do not end in `.xacro`.
"""

import re
from collections.abc import Iterator
from typing import NamedTuple

from lxml import etree

from twinform.diagnostics import DiagnosticSink, Location, Severity, rules
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement
from twinform.schemas.xml import Places, path_of
from twinform.text.tokens import COMMENT, INSTRUCTION, SECTION

_KINDS = bytes.maketrans(b"\t\r123456789", b"\n\n000000000")
"""Maps all digits to one, and all line breaks and tabs to one."""
_ASIDE = lazy_pattern(f"{COMMENT}|{INSTRUCTION}|{SECTION}".encode())
_ATTRIBUTE = lazy_pattern(rb"""(?<![\w:.-])([\w:.-]++)\s*+=\s*+(?:"([^"<]*+)"|'([^'<]*+)')""")
_TABBED = lazy_pattern(rb"""["'][-+.\deE ]*+(?:[\t\r\n]|&#)[-+.\deE \t\r\n&#xaAdD;]*+["']""")
"""Numbers in quotes with a break or a character reference between them: a quick test that few files pass."""
_REFERENCE = lazy_pattern(rb"&#(?:0*(?:9|10|13)|x0*[9aAdD]);")
_NUMBERS = lazy_pattern(rb"[-+.\deE \t\r\n]+")
_DIGIT = lazy_pattern(rb"\d")
_BREAK = lazy_pattern(rb"[\t\r\n]")
_COMMENT = b"<!--"
_BEFORE_COMMENT = 200
"""So many bytes before a comment are searched for text."""


def report_tabbed_numbers(text: bytes, sink: DiagnosticSink) -> None:
    """Report numbers of a URDF file with tabs or new lines between them, which an XML parser turns into blanks."""
    if not _has_break_after_digit(text):
        return
    bare = _ASIDE.sub(_line_breaks, text)
    if not _TABBED.search(bare):
        return
    line, counted = 1, 0
    for found in _ATTRIBUTE.finditer(bare):
        value = _REFERENCE.sub(b"\t", found[2] or found[3] or b"")
        if _BREAK.search(value) and _DIGIT.search(value) and _NUMBERS.fullmatch(value):
            name = found[1].decode()
            message = f"the numbers of {name!r} have a tab or a new line between them; expected blanks"
            line, counted = line + bare.count(b"\n", counted, found.start()), found.start()
            sink.report(rules.TABBED_NUMBERS, message, Location(sink.file, line), expected="blanks")


def _has_break_after_digit(text: bytes) -> bool:
    """Whether a tab or a new line follows a digit: a quick test that few files pass."""
    return b"&#" in text or b"0\n" in text.translate(_KINDS, b" ")


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


_EXPAND_HELP = "give the file the suffix .xacro, or pass --xacro"
# Neither part of the robot nor of what Gazebo makes of it: expressions there are for whoever reads
# them.
_SETTINGS = frozenset({"ros2_control", "transmission"})
# Nearly no element has an expression, and libxml2 finds that out faster than Python.
_MAY_HAVE_EXPRESSIONS = etree.XPath("descendant-or-self::*[(text() | @*)[contains(., '${')]]")


def report_unexpanded(root: XmlElement, sink: DiagnosticSink) -> None:
    """Report elements of xacro, and, as an error, expressions where the robot itself should be."""
    macros = [element for element in root.iter() if "xacro" in (tag := str(element.tag)) and _is_of_xacro(tag)]
    if macros:
        where = Location(line=macros[0].sourceline or 0, path=f"/{root.tag}")
        message = f"{_count(len(macros), 'element')} of xacro will not be expanded"
        sink.report(rules.UNEXPANDED_XACRO, message, where, found="xacro", help=_EXPAND_HELP)
    found = list(_with_expressions(root))
    # A file that is not called `.xacro` and has `${...}` in its links or joints is a robot that
    # nobody wrote: an error. In <ros2_control> and <transmission> they are strings for another
    # program.
    expressions, severity = [each for each in found if not each.is_aside], Severity.ERROR
    if not expressions:
        expressions, severity = found, Severity.WARNING
    if expressions:
        element, text, _ = expressions[0]
        shown = text if len(text) <= 60 else text[:57] + "..."
        message = f"xacro expressions in {_count(len(expressions), 'element')} are not expanded: {shown!r}"
        where = Location(line=element.sourceline or 0, path=path_of(element))
        sink.report(rules.UNEXPANDED_XACRO, message, where, found=shown, help=_EXPAND_HELP, severity=severity)


class _Expression(NamedTuple):
    """An element with `${...}`, and whether it is in a part that only other programs read."""

    element: XmlElement
    text: str
    is_aside: bool


def _is_of_xacro(tag: str) -> bool:
    return tag.partition("}")[0].endswith("xacro")


def _with_expressions(root: XmlElement) -> Iterator[_Expression]:
    """Yield the elements that have `${...}`, except those that only plugins or xacro read."""
    for element in _MAY_HAVE_EXPRESSIONS(root):
        around = {str(each.tag) for each in (element, *element.iterancestors())}
        if any(tag[0] == "{" or tag == "plugin" for tag in around):
            continue
        texts = (element.text or "", *element.values())
        found = next((each.strip() for each in texts if "${" in each and "}" in each), None)
        if found is not None:
            yield _Expression(element, found, not _SETTINGS.isdisjoint(around))


def _count(number: int, word: str) -> str:
    return f"{number} {word}{'' if number == 1 else 's'}"
