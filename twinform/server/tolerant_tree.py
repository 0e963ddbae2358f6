"""Tolerant XML tree: the elements of a text that somebody is typing, whatever is wrong with it.

It is made for positions and names, not for validation. Nothing is refused: a tag that breaks off ends where the next
one begins, an end tag closes all elements that are open inside its own, and an unclosed element ends with its parent.
Parsing is linear in the length of any text.
"""

import re
from bisect import bisect_left
from collections import Counter
from dataclasses import dataclass, field

from twinform.diagnostics import Span
from twinform.text import AttributeSpan

_MARKUP = re.compile(r"<(?:(?P<aside>!--|!\[CDATA\[|\?|!)|/(?P<close>[^\s<>/]*)|(?P<open>[^\s<>/!?\"'=]*))")
_ENDS = {"!--": "-->", "![CDATA[": "]]>", "?": "?>", "!": ">"}
# A file in an editor is broken most of the time, so expat, which refuses it, cannot give names and
# completion. A property test holds this scanner to expat for files that are well-formed.
_ATTRIBUTE = re.compile(
    r"""\s*(?P<name>[^\s=<>/"']+)(?:\s*=\s*(?:"(?P<double>[^"<]*)(?P<end>"?)|'(?P<single>[^'<]*)(?P<stop>'?)|(?P<bare>))"""
    r"""|(?P<alone>))"""
)
_JUNK = re.compile(r"[\s\"'=]*")
_BLANKS = re.compile(r"\s*")
_LINE_END = re.compile(r"[\r\n]")


@dataclass(slots=True, eq=False)
class TolerantNode:
    """An element: the places of its tags and attributes, and its children.

    `closed` says whether it has an end tag or ends with `/>`, and `whole_tag` whether its start tag has its `>`.
    """

    tag: str
    start_tag: Span
    name: Span
    attributes: dict[str, AttributeSpan]
    values: dict[str, str]
    parent: "TolerantNode | None"
    whole_tag: bool = True
    empty: bool = False
    closed: bool = False
    end_tag: Span | None = None
    end: int = 0
    children: list["TolerantNode"] = field(default_factory=list["TolerantNode"])

    @property
    def whole(self) -> Span:
        """The whole element, from its `<` to its end."""
        return Span(self.start_tag.start, self.end)

    @property
    def content(self) -> Span:
        """The text between its tags; an empty span behind the start tag for an empty element."""
        return Span(self.start_tag.end, self.end_tag.start if self.end_tag else self.end)

    def get(self, attribute: str) -> str | None:
        """Return the value of an attribute."""
        return self.values.get(attribute)


@dataclass(frozen=True, slots=True)
class Tree:
    """The elements of a text, in the order of their start tags, and its comments, CDATA sections and instructions.

    `whole` says whether the text is well-formed as far as the parser looks: every tag is complete and closed.
    """

    text: str
    root: TolerantNode | None
    nodes: tuple[TolerantNode, ...]
    asides: tuple[Span, ...]
    whole: bool

    def at(self, offset: int) -> TolerantNode | None:
        """Return the innermost element around an offset; its tags, and what follows a broken tag, are part of it."""
        here, found = self.root, None
        while here is not None and here.start_tag.start < offset and _reaches(here, offset):
            found, here = here, _child_at(here, offset)
        return found

    def release(self) -> None:
        """Cut the references between the elements; the tree is of no use afterwards."""
        for node in self.nodes:
            # The garbage collector took 300 ms to find the trees of old states, while somebody typed.
            node.parent = None

    def aside_at(self, offset: int) -> Span | None:
        """Return the comment, CDATA section or instruction around an offset."""
        return next((each for each in self.asides if each.start < offset < each.end), None)

    def text_of(self, node: TolerantNode) -> Span:
        """Return the text of an element without children, without blanks at its ends."""
        inside = node.content
        raw = inside.of(self.text)
        start = inside.start + len(raw) - len(raw.lstrip())
        return Span(start, max(start, inside.start + len(raw.rstrip())))


def _reaches(node: TolerantNode, offset: int) -> bool:
    return offset < node.end or (not node.closed and offset == node.end)


def _child_at(node: TolerantNode, offset: int) -> TolerantNode | None:
    """Return the last child that begins before an offset."""
    place = bisect_left(node.children, offset, key=lambda child: child.start_tag.start)
    return node.children[place - 1] if place else None


def parse(text: str) -> Tree:
    """Parse a text."""
    return _Parser(text).run()


class _Parser:
    """One run over a text."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.root: TolerantNode | None = None
        self.nodes: list[TolerantNode] = []
        self.asides: list[Span] = []
        self.open: list[TolerantNode] = []
        self.names: Counter[str] = Counter()
        self.whole = True

    def run(self) -> Tree:
        here = 0
        while (found := _MARKUP.search(self.text, here)) is not None:
            if found["aside"] is not None:
                here = self._aside(found.start(), found.end(), _ENDS[found["aside"]])
            elif found["close"] is not None:
                here = self._close(found.start(), found.end(), found["close"])
            else:
                here = self._start(found.start(), found.end(), found["open"])
        self._end_all(len(self.text))
        return Tree(self.text, self.root, tuple(self.nodes), tuple(self.asides), self.whole and self.root is not None)

    def _aside(self, start: int, inside: int, ending: str) -> int:
        end = self.text.find(ending, inside)
        self.whole = self.whole and end >= 0
        end = len(self.text) if end < 0 else end + len(ending)
        self.asides.append(Span(start, end))
        return end

    def _close(self, start: int, end: int, name: str) -> int:
        blanks = _BLANKS.match(self.text, end)
        here = blanks.end() if blanks else end
        if self.text.startswith(">", here):
            end = here + 1
        else:
            self.whole = False
        # A counter of open names instead of a search in the stack keeps end tags without start tags linear.
        if not self.names[name]:
            self.whole = False
            return end
        while self.open[-1].tag != name:
            self.whole = False
            self._end(start)
        node = self.open[-1]
        node.end_tag, node.closed = Span(start, end), True
        self._end(end)
        return end

    def _end(self, offset: int) -> None:
        node = self.open.pop()
        node.end = offset
        self.names[node.tag] -= 1

    def _end_all(self, offset: int) -> None:
        self.whole = self.whole and not self.open
        while self.open:
            self._end(offset)

    def _start(self, start: int, end: int, name: str) -> int:
        parent = self.open[-1] if self.open else None
        attributes, values, end = self._attributes(end)
        empty = self.text.startswith("/>", end)
        whole = empty or self.text.startswith(">", end)
        end += 2 if empty else 1 if whole else 0
        tag = Span(start, end)
        node = TolerantNode(
            name, tag, Span(start + 1, start + 1 + len(name)), attributes, values, parent, whole, empty, empty
        )
        node.end = end
        self.whole = self.whole and whole and bool(name)
        self._add(node, parent)
        if whole and not empty and name:
            self.open.append(node)
            self.names[name] += 1
        return end

    def _add(self, node: TolerantNode, parent: TolerantNode | None) -> None:
        self.nodes.append(node)
        if parent is not None:
            parent.children.append(node)
        elif self.root is None and node.tag:
            self.root = node
        else:
            self.whole = False

    def _attributes(self, here: int) -> tuple[dict[str, AttributeSpan], dict[str, str], int]:
        """Parse the attributes of a start tag; return their spans and values, and where the rest begins."""
        spans: dict[str, AttributeSpan] = {}
        values: dict[str, str] = {}
        while (found := _ATTRIBUTE.match(self.text, here)) is not None:
            here = found.end()
            value = self._value(found)
            name = found["name"]
            cut = not (found["end"] or found["stop"])
            if cut:
                self.whole = False
                here = max(found.end("name"), value.end)
            if name not in spans:
                spans[name] = AttributeSpan(Span(found.start("name"), here), Span(*found.span("name")), value)
                values[name] = self.text[value.start : value.end]
            if cut and (junk := _JUNK.match(self.text, here)) is not None:
                here = junk.end()
        junk = _JUNK.match(self.text, here)
        return spans, values, junk.end() if junk else here

    def _value(self, found: re.Match[str]) -> Span:
        """Return the text between the quotes; if the value is not closed, the rest of its line."""
        for group in ("double", "single"):
            start, end = found.span(group)
            if start >= 0:
                if not (found["end"] or found["stop"]):
                    line_end = _LINE_END.search(self.text, start, end)
                    end = line_end.start() if line_end else end
                return Span(start, end)
        return Span(found.end(), found.end())
