"""Comments of an XML text, and the lines of what each of them is about: the element after it, or the line it ends.

The text need not be well-formed: only tags, comments and sections are looked for, as in files that are repaired.
"""

import re
from bisect import bisect_left
from collections.abc import Iterator
from typing import NamedTuple

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern
from twinform.text.positions import indentation
from twinform.text.tokens import COMMENT, IN_COMMENT, INSTRUCTION, SECTION

_TOKEN = lazy_pattern(
    rf"<!--(?P<comment>{IN_COMMENT})-->"
    rf"|{COMMENT}|{SECTION}|{INSTRUCTION}"
    r"|<(?P<close>/?)[^\s<>/\"'!?](?:[^<>\"'/]++|\"[^\"]*+\"|'[^']*+'|/(?!>))*+(?P<empty>/?)>"
)

_LINE_END = lazy_pattern(r"\r?\n")


class Comment(NamedTuple):
    """A comment: the text in it, the line that it begins on, and the lines that it is about.

    One that stands behind something on its line is about that line, with all of a tag that ends there. Another one is
    about the next element, with all in it; `first` and `last` are 0 where none follows in the element around it.
    """

    text: str
    line: int
    first: int = 0
    last: int = 0


@dataclass(slots=True)
class _UnfinishedElement:
    """An open element: the comments before it, and the ones in it that still wait for an element."""

    before: list[int]
    line: int
    waiting: list[int]


def comments(text: str) -> list[Comment]:
    """List every comment of a text, in order."""
    return list(_CommentScan(text).run())


class _CommentScan:
    """One pass over a text, with lines counted by their line feeds, as findings count them."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.line, self.counted = 1, 0
        self.found: list[Comment] = []
        self.open = [_UnfinishedElement([], 0, [])]
        self.last_begin, self.last_end = 0, 0
        """The lines on which the last tag began and ended."""

    def run(self) -> Iterator[Comment]:
        for token in _TOKEN.finditer(self.text):
            begin = self._line_at(token.start())
            end = self._line_at(token.end())
            comment = token["comment"]
            if comment is not None:
                self._comment(comment, token.start(), begin)
            elif token["close"] is not None:
                self._tag(token, begin, end)
                self.last_begin, self.last_end = begin, end
        yield from self.found

    def _line_at(self, offset: int) -> int:
        self.line, self.counted = self.line + self.text.count("\n", self.counted, offset), offset
        return self.line

    def _comment(self, text: str, start: int, line: int) -> None:
        if indentation(self.text, start) is None:
            first = self.last_begin if self.last_end == line else line
            self.found.append(Comment(text, line, first, line))
            return
        self.open[-1].waiting.append(len(self.found))
        self.found.append(Comment(text, line))

    def _tag(self, token: re.Match[str], begin: int, end: int) -> None:
        if token["close"]:
            if len(self.open) > 1:
                closed = self.open.pop()
                self._settle(closed.before, closed.line, end)
            return
        around = self.open[-1]
        before, around.waiting = around.waiting, []
        if token["empty"]:
            self._settle(before, begin, end)
        else:
            self.open.append(_UnfinishedElement(before, begin, []))

    def _settle(self, before: list[int], first: int, last: int) -> None:
        for index in before:
            self.found[index] = self.found[index]._replace(first=first, last=last)


class CommentPlace(NamedTuple):
    """An offset at which a comment about a line can stand, and what stands between them and the text around it."""

    offset: int
    before: str
    after: str


class CommentPlaces:
    """Finds where comments can stand so that no text and no tag is another one for them."""

    def __init__(self, text: str, line_end: str = "\n") -> None:
        self._text, self._line_end = text, line_end
        self._tokens = list(_TOKEN.finditer(text))
        self._starts = [token.start() for token in self._tokens]
        self._ends = [found.start() for found in _LINE_END.finditer(text)]

    def about(self, line: int) -> CommentPlace | None:
        """Return the place behind a line, or behind the tag on it, or before an element with a text; None if none."""
        return self._behind(line) or self._before(line)

    def _end_of(self, line: int) -> int:
        return self._ends[line - 1] if line <= len(self._ends) else len(self._text)

    def _last_token(self, offset: int) -> int:
        """Return the number of the last token that begins before an offset; -1 if there is none."""
        return bisect_left(self._starts, offset) - 1

    def _behind(self, line: int) -> CommentPlace | None:
        end = self._end_of(line)
        number = self._last_token(end)
        if number < 0:
            return None
        token = self._tokens[number]
        if token.end() > end:  # the line ends in a tag: the comment goes behind that, if nothing else is there
            end = self._end_of(line + self._text.count("\n", end, token.end()))
            if token["close"] is None or self._last_token(end) != number:
                return None
        is_free = self._is_blank(token.end(), end) and self._is_blank(end, self._next_start(number))
        is_free &= indentation(self._text, end) is None
        return CommentPlace(end, "  ", "") if is_free else None

    def _before(self, line: int) -> CommentPlace | None:
        number = self._last_token(self._end_of(line))
        token = self._tokens[number] if number >= 0 else None
        blanks = indentation(self._text, token.start()) if token else None
        if token is None or token["close"] != "" or blanks is None or not number:
            return None
        if not self._is_blank(self._tokens[number - 1].end(), token.start()):
            return None
        return CommentPlace(token.start(), "", f"{self._line_end}{blanks}")

    def _next_start(self, number: int) -> int:
        return self._starts[number + 1] if number + 1 < len(self._starts) else len(self._text)

    def _is_blank(self, start: int, end: int) -> bool:
        return not self._text[start:end].strip()
