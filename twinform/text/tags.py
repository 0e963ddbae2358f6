"""Where each tag stands, in a text that somebody else has parsed: quick, and also for what parsers repair.

`spans` asks expat, and knows by itself that the text is well-formed. Here only the tags are looked for; what one
element has in it is made out when something asks for it. So few places in a large file cost little.
"""

import re
from functools import cached_property

from twinform.diagnostics import Span
from twinform.text.asides import COMMENT, INSTRUCTION, SECTION
from twinform.text.positions import ElementSpan, UnplacedError, start_tag

_TOKEN = re.compile(
    rf"(?P<aside>{COMMENT}|{INSTRUCTION})|{SECTION}"
    r"|<(?P<end>/)?[^\s<>/!?][^<>\"']*+(?:\"[^\"]*+\"[^<>\"']*+|'[^']*+'[^<>\"']*+)*+>"
)
_NAME = re.compile(r"<([^\s<>/]+)")
_MOST = 4000
"""So many tags are looked at for one element: a hostile file has hundreds of them around a million others."""
_START, _END, _ASIDE = range(3)


class Tags:
    """The elements of a text by their place among all, in the order of their start tags."""

    def __init__(self, text: str) -> None:
        self.text = text
        self._tokens = [
            (_ASIDE if found.lastgroup == "aside" else _END if found.lastgroup == "end" else _START, *found.span())
            for found in _TOKEN.finditer(text)
            if found.lastgroup or not found[0].startswith("<![CDATA[")
        ]
        self._starts = [number for number, (kind, _, _) in enumerate(self._tokens) if kind == _START]
        self._made: dict[int, ElementSpan] = {}

    @cached_property
    def starts(self) -> list[int]:
        """The offset of each start tag."""
        return [self._tokens[number][1] for number in self._starts]

    def __len__(self) -> int:
        return len(self._starts)

    def name(self, place: int) -> str:
        """The name of an element, with its prefix."""
        return start_tag_name(self.text, self.starts[place])

    def element(self, place: int) -> ElementSpan:
        """An element with all in it; of one that has very much in it, the start tag alone.

        Raises:
            UnplacedError: its end is not found.
        """
        if place not in self._made:
            self._made[place] = self._element(self._starts[place])
        return self._made[place]

    def _element(self, number: int) -> ElementSpan:
        open_: list[ElementSpan] = []
        for here in range(number, len(self._tokens)):
            if here - number > _MOST:
                return start_tag(self.text, self._tokens[number][1])
            kind, start, end = self._tokens[here]
            if kind == _ASIDE:
                open_[-1].asides.append(Span(start, end))
                continue
            if kind == _START:
                element = start_tag(self.text, start)
                if open_:
                    open_[-1].children.append(element)
                open_.append(element)
                if self.text[end - 2] != "/":
                    continue
            else:
                open_[-1].end_tag = Span(start, end)
            element = open_.pop()
            if not open_:
                return element
        raise UnplacedError("an element has no end")


def start_tag_name(text: str, start: int) -> str:
    """The name in the start tag at an offset."""
    found = _NAME.match(text, start)
    return found[1] if found else ""
