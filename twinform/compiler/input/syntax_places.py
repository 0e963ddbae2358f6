"""Finds the piece of the text that is wrong in an XML syntax error, from the line and column that libxml2 reports.

libxml2 reports how far it had read: behind a name that it does not know, or at the end of the file for a comment that
is never closed. Its name for the error tells which piece before that is meant.
"""

import re
from collections.abc import Mapping, Sequence

from twinform.compiler.input.syntax_words import described
from twinform.compiler.input.xml_recovery import XmlError
from twinform.diagnostics import Location, Span
from twinform.lazy import lazy_pattern
from twinform.text import Lines, SourceText
from twinform.text.tokens import COMMENT, INSTRUCTION

_WORDS: Mapping[str, str] = {
    "ERR_TAG_NAME_MISMATCH": r"and (?P<word>\S+)$",
    "ERR_ATTRIBUTE_REDEFINED": r"Attribute (?P<word>\S+) redefined",
    "ERR_ATTRIBUTE_WITHOUT_VALUE": r"for attribute (?P<word>\S+)$",
    "NS_ERR_UNDEFINED_NAMESPACE": r"prefix (?P<prefix>\S+) (?:for (?P<word>\S+) )?on (?P<tag>\S+) is",
}
"""For errors whose message names the piece: how to find the name in it."""
_BEFORE: Mapping[str, str] = {
    "ERR_TAG_NAME_MISMATCH": r"</\s*(?P<piece>{word})",
    "ERR_ATTRIBUTE_REDEFINED": r"\s(?P<piece>{word})\s*=",
    "ERR_ATTRIBUTE_WITHOUT_VALUE": r"\s(?P<piece>{word})",
    "ERR_RESERVED_XML_NAME": r"(?P<piece><\?xml)",
    "ERR_VERSION_MISSING": r"(?P<piece><\?xml)",
    "ERR_UNKNOWN_VERSION": r"version\s*=\s*[\"'](?P<piece>[^\"']*)",
    "ERR_UNDECLARED_ENTITY": r"(?P<piece>&[^\s;&]*;)",
    "ERR_CDATA_NOT_FINISHED": r"(?P<piece><!\[CDATA\[)",
    "NS_ERR_QNAME": r"<(?P<piece>[\w.-]+::)",
    "ERR_ATTRIBUTE_NOT_FINISHED": r"\s(?P<piece>[^\s=<>\"']+\s*=\s*[\"'])",
}
"""The form of the piece, which is the last one before the place that libxml2 reports."""
# So the line of some findings is an earlier one than that of other tools, which report where the
# parser noticed.
_NEAR = 300
_HERE = lazy_pattern(r"</?[\w:.-]+|--|[\w:.-]+|\S")
"""The piece at the place that libxml2 reports, for all other errors."""
_DOCTYPE = lazy_pattern(rf"(?:\s++|{COMMENT}|{INSTRUCTION})*+(?P<piece><!DOCTYPE)")
_OPEN_TAG = lazy_pattern(r"</?(?P<piece>[\w:.-]+)")
_OPEN_VALUE = lazy_pattern(r"\s(?P<piece>[^\s=<>\"']+\s*=\s*[\"'])")


class SyntaxPlaces:
    """Finds the wrong pieces of one text."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._text = _decode(data)
        self._lines = Lines(self._text or "")
        # libxml2 ends lines at line feeds only
        self._starts = [0, *(found.end() for found in re.finditer("\n", self._text or ""))]

    def location(self, error: XmlError, path: str = "/") -> Location:
        """Return the location of an error; without a column where it is not known."""
        if self._text is None:
            return self._first_undecodable(error, path)
        span = self._find_piece(error, self._text)
        return self.at(span, path) if span else Location(line=error.line, path=path)

    def described(self, error: XmlError) -> XmlError:
        """Return the error with words for people who do not know the parser."""
        offset = self._offset(error)
        return error if offset is None or self._text is None else described(error, self._text, offset)

    def at(self, span: Span, path: str = "/") -> Location:
        """Return the location of a piece."""
        (line, column), (end_line, end_column) = self._lines.place(span.start), self._lines.place(span.end)
        return Location("", line, path, column, end_line, end_column)

    def doctype(self) -> Location:
        """Return the location of the document type declaration."""
        found = _DOCTYPE.match(self._text or "")
        return self.at(Span(*found.span("piece"))) if found else Location(line=1, path="/")

    def _find_piece(self, error: XmlError, text: str) -> Span | None:
        offset = self._offset(error)
        if offset is None:
            return None
        if error.kind == "ERR_TAG_NOT_FINISHED":
            return _start_of_element(error, text, self._starts)
        if error.kind == "ERR_LT_IN_ATTRIBUTE":
            return _unclosed_value(text, offset)
        if error.kind == "ERR_NAME_REQUIRED":
            return _piece_without_name(text, offset)
        if error.kind == "ERR_COMMENT_NOT_FINISHED":
            start = text.find("<!--", text.rfind("-->") + 1)
            return Span(start, start + len("<!--")) if start >= 0 else None
        if error.kind == "ERR_GT_REQUIRED" and text[offset : offset + 1] == "<":
            return _last_before(_OPEN_TAG, text, offset - 1)
        pattern = _pattern_of_piece(error)
        if pattern is not None:
            return _last_before(re.compile(pattern), text, offset)
        here = _HERE.match(text, offset)
        return Span(*here.span()) if here else Span(offset, offset)

    def _offset(self, error: XmlError) -> int | None:
        """Return the offset that libxml2 reports; None if there is none."""
        if self._text is None or not 0 < error.line <= len(self._starts):
            return None
        offset = self._starts[error.line - 1] + max(0, error.column - 1)
        return offset if offset <= len(self._text) else None

    def _first_undecodable(self, error: XmlError, path: str) -> Location:
        """Return the location of the first byte that is not UTF-8, where it is on the line of the error."""
        if error.kind != "ERR_INVALID_ENCODING" or b"\0" in self._data:
            return Location(line=error.line, path=path)
        try:
            self._data.decode()
        except UnicodeDecodeError as wrong:
            start = self._data.rfind(b"\n", 0, wrong.start) + 1
            line = self._data.count(b"\n", 0, start) + 1
            column = len(self._data[start : wrong.start].decode()) + 1
            if line == error.line:
                return Location("", line, path, column, line, column + 1)
        return Location(line=error.line, path=path)


def _decode(data: bytes) -> str | None:
    try:
        return SourceText.of(data).text
    except ValueError:
        return None


def _pattern_of_piece(error: XmlError) -> str | None:
    found = re.search(_WORDS[error.kind], error.message) if error.kind in _WORDS else None
    if error.kind == "NS_ERR_UNDEFINED_NAMESPACE":
        if found is None:
            return None
        prefix, word, tag = (re.escape(each or "") for each in found.group("prefix", "word", "tag"))
        return rf"\s(?P<piece>{prefix}:{word})\s*=" if word else rf"<(?P<piece>{prefix}:{tag})(?=[\s/>])"
    pattern = _BEFORE.get(error.kind)
    if pattern is None or (found is None and error.kind in _WORDS):
        return None
    return pattern.replace("{word}", re.escape(found["word"])) if found else pattern


def _start_of_element(error: XmlError, text: str, starts: Sequence[int]) -> Span | None:
    """Return the name of an element that is never closed."""
    found = re.search(r"tag (?P<tag>\S+) line (?P<line>\d+)$", error.message)
    if found is None or not 0 < int(found["line"]) <= len(starts):
        return None
    # The line is that on which the start tag ends.
    start = starts[int(found["line"])] if int(found["line"]) < len(starts) else len(text)
    return _last_before(re.compile(rf"<(?P<piece>{re.escape(found['tag'])})(?=[\s/>])"), text, start)


def _last_before(pattern: re.Pattern[str], text: str, end: int) -> Span | None:
    """Return the last piece of a form before an offset, which is near it unless something was never closed."""
    for start in (max(0, end - _NEAR), max(0, end - 10_000), 0):
        found = list(pattern.finditer(text, start, end + 1))
        if found:
            return Span(*found[-1].span("piece"))
    return None


def _unclosed_value(text: str, offset: int) -> Span | None:
    """Return a `<` in a value, or the beginning of a value that goes on over lines: its quotes are not closed."""
    opened = _last_before(_OPEN_VALUE, text, offset)
    if opened is not None and "\n" in text[opened.end : offset]:
        return opened
    return Span(offset, offset + 1) if text[offset : offset + 1] == "<" else None


def _piece_without_name(text: str, offset: int) -> Span | None:
    """Return a `&` or `<` without a name, or a tag that is not closed before the next one begins."""
    if text[offset - 1 : offset] in {"&", "<"}:
        return Span(offset - 1, offset)
    if text[offset : offset + 1] == "<":
        return _last_before(_OPEN_TAG, text, offset - 1)
    return Span(offset, min(offset + 1, len(text)))
