"""The tokens of an XML text: tags, comments, processing instructions, CDATA sections and what is between them.

They cover the whole text without a gap, so that a text can be put together again from them. They are kept in arrays
rather than as objects: a file of 60 MB has millions.
"""

import re
from array import array
from enum import IntEnum
from xml.parsers import expat

from twinform.lazy import lazy_pattern

# Possessive repetitions (Python 3.11): they never give back what they took, so no text makes them
# quadratic.
IN_COMMENT = r"[^-]*+(?:-(?!->)[^-]*+)*+"
IN_SECTION = r"[^\]]*+(?:\](?!\]>)[^\]]*+)*+"
IN_INSTRUCTION = r"[^?]*+(?:\?(?!>)[^?]*+)*+"

COMMENT = rf"<!--{IN_COMMENT}(?:-->)?"
SECTION = rf"<!\[CDATA\[{IN_SECTION}(?:\]\]>)?"
INSTRUCTION = rf"<\?{IN_INSTRUCTION}(?:\?>)?"


_TOKEN = lazy_pattern(rf"""{COMMENT}|{INSTRUCTION}|{SECTION}|<(?:[^"'<>]++|"[^"]*+"|'[^']*+')*+>|[^<]++""")


class UnplacedError(ValueError):
    """The positions in a text are unknown: it is not well-formed, or has a document type declaration.

    `line` and `column` are where a parser stopped, from 1, and 0 where that is not known.
    """

    def __init__(self, message: str, line: int = 0, column: int = 0) -> None:
        super().__init__(message)
        self.line, self.column = line, column


class TokenKind(IntEnum):
    """The kind of a token; `BLANK` is white space only, and `EMPTY` a tag such as `<a/>`."""

    BLANK = 0
    TEXT = 1
    START = 2
    EMPTY = 3
    END = 4
    COMMENT = 5
    INSTRUCTION = 6


class Tokens:
    """The tokens of a text, by number; the blanks before and after the root element count.

    Raises:
        UnplacedError: the text is not well-formed, or has a document type declaration.
    """

    def __init__(self, text: str) -> None:
        require_well_formed(text)
        self.text = text
        self.kinds = bytearray()
        self.ends = array("q")
        for found in _TOKEN.finditer(text):
            self.kinds.append(_kind(found.group()))
            self.ends.append(found.end())

    def __len__(self) -> int:
        return len(self.kinds)

    def __getitem__(self, number: int) -> str:
        return self.text[self.start(number) : self.ends[number]]

    def start(self, number: int) -> int:
        """Return where a token begins."""
        return self.ends[number - 1] if number else 0


def _kind(token: str) -> TokenKind:
    if token[0] != "<":
        return TokenKind.TEXT if token.strip(" \t\r\n") else TokenKind.BLANK
    match token[1]:
        case "/":
            return TokenKind.END
        case "?":
            return TokenKind.INSTRUCTION
        case "!":
            return TokenKind.COMMENT if token[2] == "-" else TokenKind.TEXT
        case _:
            return TokenKind.EMPTY if token[-2] == "/" else TokenKind.START


def require_well_formed(text: str) -> None:
    """Raise an error if another parser would find other tokens.

    Raises:
        UnplacedError: the text is not well-formed, or has a document type declaration.
    """
    parser = expat.ParserCreate("utf-8")
    parser.StartDoctypeDeclHandler = _refuse_doctype
    try:
        parser.Parse(text.encode("utf-8", "surrogatepass"), True)
    except expat.ExpatError as error:
        raise UnplacedError(expat.errors.messages[error.code], error.lineno, error.offset + 1) from error


def _refuse_doctype(*_: object) -> None:
    raise UnplacedError("the document has a DOCTYPE")


_ASIDE = lazy_pattern(
    rf"{SECTION}|<!--(?P<comment>{IN_COMMENT})-->|{COMMENT}|(?P<declaration><\?xml\s{IN_INSTRUCTION}\?>)"
    rf"|{INSTRUCTION}",
    re.IGNORECASE,
)
_VISIBLE = lazy_pattern(r"[^\r\n]")


def masked(text: str) -> str:
    """Blank out declarations and comments; the text keeps its length and lines."""
    return _ASIDE.sub(_blank, text) if "<!--" in text or "<?" in text else text


def _blank(found: re.Match[str]) -> str:
    if found["declaration"]:
        return _VISIBLE.sub(" ", found[0])
    if found["comment"] is None:
        return found[0]
    return f"<!--{_VISIBLE.sub(' ', found['comment'])}-->"
