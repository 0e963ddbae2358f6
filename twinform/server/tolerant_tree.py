"""Tolerant XML tree: the elements of a text that somebody is typing, whatever is wrong with it.

It is made for positions and names, not for validation. Nothing is refused: a tag that breaks off ends where the next
one begins, an end tag closes all elements that are open inside its own, and an unclosed element ends with its parent.
Parsing is linear in the length of any text.
"""

import re
from bisect import bisect_left
from collections import Counter

from twinform.compiler.input.loading import garbage_collection_paused
from twinform.dataclass import dataclass
from twinform.diagnostics import Span
from twinform.lazy import lazy_pattern
from twinform.text import AttributeSpan

_ATTRIBUTES = r"""(?:\s++[^\s=<>/"']++\s*+=\s*+(?:"[^"<]*+"|'[^'<]*+'))*+"""
_MARKUP = lazy_pattern(
    r"<(?:(?P<aside>!--|!\[CDATA\[|\?|!)|/(?P<close>[^\s<>/]*+)"
    rf"|(?P<open>[^\s<>/!?\"'=]*+)(?:{_ATTRIBUTES}\s*+(?P<ending>/?>))?+)"
)
"""Markup; a start tag whole, where nothing is wrong with it, or else its name."""
_ENDS = {"!--": "-->", "![CDATA[": "]]>", "?": "?>", "!": ">"}
# A file in an editor is broken most of the time, so expat, which refuses it, cannot give names and
# completion. A property test holds this scanner to expat for files that are well-formed.
_ATTRIBUTE = lazy_pattern(
    r"""\s*(?P<name>[^\s=<>/"']+)(?:\s*=\s*(?:"(?P<double>[^"<]*)(?P<end>"?)|'(?P<single>[^'<]*)(?P<stop>'?)|(?P<bare>))"""
    r"""|(?P<alone>))"""
)
_JUNK = lazy_pattern(r"[\s\"'=]*")
_BLANKS = lazy_pattern(r"\s*")
_LINE_END = lazy_pattern(r"[\r\n]")


class TolerantNode:
    """An element: the places of its tags and attributes, and its children.

    Attributes:
        parent: the element around it.
        children: the elements directly inside it, in the order of the text.
        whole_tag: whether its start tag has its `>`.
        empty: whether it ends with `/>`.
        closed: whether it has an end tag or ends with `/>`.
        start: the offset where it begins.
        end: the offset behind it.
    """

    __slots__ = (
        "_attributes",
        "_end_tag",
        "_tag_end",
        "_text",
        "children",
        "closed",
        "empty",
        "end",
        "parent",
        "start",
        "tag",
        "whole_tag",
    )

    def __init__(self, text: str, start: int, tag: str, parent: "TolerantNode | None") -> None:
        self.tag = tag
        self.parent = parent
        self.children: list[TolerantNode] = []
        self.whole_tag = self.empty = self.closed = False
        self.end = start
        self._text = text
        self.start = self._tag_end = start
        self._end_tag: tuple[int, int] | None = None
        self._attributes: TagAttributes | None = None

    @property
    def start_tag(self) -> Span:
        """The start tag, from its `<` to its `>`."""
        return Span(self.start, self._tag_end)

    @property
    def end_tag(self) -> Span | None:
        """The end tag."""
        return Span(*self._end_tag) if self._end_tag else None

    @property
    def name(self) -> Span:
        """The name in the start tag."""
        return Span(self.start + 1, self.start + 1 + len(self.tag))

    @property
    def attributes(self) -> dict[str, AttributeSpan]:
        """The places of its attributes."""
        return self._parsed().spans

    @property
    def values(self) -> dict[str, str]:
        """The values of its attributes, as they are written."""
        return self._parsed().values

    @property
    def whole(self) -> Span:
        """The whole element, from its `<` to its end."""
        return Span(self.start, self.end)

    @property
    def content(self) -> Span:
        """The text between its tags; an empty span behind the start tag for an empty element."""
        return Span(self._tag_end, self._end_tag[0] if self._end_tag else self.end)

    def get(self, attribute: str) -> str | None:
        """Return the value of an attribute."""
        return self.values.get(attribute)

    def mentions(self, word: str) -> bool:
        """Tell whether a word stands in its start tag, without parsing attributes."""
        return self._text.find(word, self.start, self._tag_end) >= 0

    def end_start_tag(self, end: int, *, whole: bool, empty: bool, attributes: "TagAttributes | None" = None) -> None:
        """Set where the start tag ends; attributes that are not given are parsed when they are asked for."""
        self._tag_end = self.end = end
        self.whole_tag, self.empty, self.closed = whole, empty, empty
        self._attributes = attributes

    def close(self, start: int, end: int) -> None:
        """Set the place of the end tag."""
        self._end_tag, self.closed = (start, end), True

    def _parsed(self) -> "TagAttributes":
        # Of the thousands of elements of a file a request looks at the attributes of few.
        if self._attributes is None:
            self._attributes = TagAttributes(self._text, self.start + 1 + len(self.tag))
        return self._attributes


class TagAttributes:
    """The attributes of a start tag, parsed from where its name ends; `end` is where they end.

    `whole` says whether each value has both of its quotes.
    """

    __slots__ = ("end", "spans", "values", "whole")

    def __init__(self, text: str, here: int) -> None:
        self.spans: dict[str, AttributeSpan] = {}
        self.values: dict[str, str] = {}
        self.whole = True
        while (found := _ATTRIBUTE.match(text, here)) is not None:
            here = found.end()
            value = _value(text, found)
            name = found["name"]
            cut = not (found["end"] or found["stop"])
            if cut:
                self.whole = False
                here = max(found.end("name"), value.end)
            if name not in self.spans:
                self.spans[name] = AttributeSpan(Span(found.start("name"), here), Span(*found.span("name")), value)
                self.values[name] = text[value.start : value.end]
            if cut and (junk := _JUNK.match(text, here)) is not None:
                here = junk.end()
        junk = _JUNK.match(text, here)
        self.end = junk.end() if junk else here


def _value(text: str, found: re.Match[str]) -> Span:
    """Return the text between the quotes; if the value is not closed, the rest of its line."""
    for group in ("double", "single"):
        start, end = found.span(group)
        if start >= 0:
            if not (found["end"] or found["stop"]):
                line_end = _LINE_END.search(text, start, end)
                end = line_end.start() if line_end else end
            return Span(start, end)
    return Span(found.end(), found.end())


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
        while here is not None and here.start < offset and _reaches(here, offset):
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
    place = bisect_left(node.children, offset, key=lambda child: child.start)
    return node.children[place - 1] if place else None


def parse(text: str) -> Tree:
    """Parse a text."""
    with garbage_collection_paused():
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
        here, search = 0, _MARKUP.search
        while (found := search(self.text, here)) is not None:
            kind = found.lastgroup
            if kind == "ending":
                here = self._start(found)
            elif kind == "close":
                here = self._close(found.start(), found.end(), found["close"])
            elif kind == "open":
                here = self._broken_start(found)
            else:
                here = self._aside(found.start(), found.end(), _ENDS[found["aside"]])
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
        self.open[-1].close(start, end)
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

    def _start(self, found: re.Match[str]) -> int:
        """Add an element whose start tag is as XML wants it, but for attributes that repeat."""
        node = self._add(found.start(), found["open"])
        node.end_start_tag(found.end(), whole=True, empty=found["ending"] == "/>")
        self._go_into(node)
        return found.end()

    def _broken_start(self, found: re.Match[str]) -> int:
        """Add an element whose start tag breaks off, or has attributes that are none."""
        node = self._add(found.start(), found["open"])
        attributes = TagAttributes(self.text, found.end())
        end = attributes.end
        empty = self.text.startswith("/>", end)
        whole = empty or self.text.startswith(">", end)
        end += 2 if empty else 1 if whole else 0
        node.end_start_tag(end, whole=whole, empty=empty, attributes=attributes)
        self.whole = self.whole and whole and attributes.whole
        self._go_into(node)
        return end

    def _add(self, start: int, name: str) -> TolerantNode:
        parent = self.open[-1] if self.open else None
        node = TolerantNode(self.text, start, name, parent)
        self.nodes.append(node)
        if parent is not None:
            parent.children.append(node)
        elif self.root is None and node.tag:
            self.root = node
        else:
            self.whole = False
        return node

    def _go_into(self, node: TolerantNode) -> None:
        self.whole = self.whole and bool(node.tag)
        if node.whole_tag and not node.empty and node.tag:
            self.open.append(node)
            self.names[node.tag] += 1
