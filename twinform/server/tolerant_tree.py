"""Tolerant XML tree: the elements of a text that somebody is typing, whatever is wrong with it.

It is made for positions and names, not for validation: nothing is refused, a tag that breaks off ends where the next
begins, an end tag closes what is open in it, and what is not closed ends with the element around it. Each character is
looked at a few times at most, however the text is made.
"""

import re
from collections import Counter
from collections.abc import Iterator
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


@dataclass(slots=True, eq=False)
class TolerantNode:
    """An element: where its tags, attributes and children stand.

    `closed` is whether it has its end tag or ends with `/>`, and `whole_tag` whether its start tag has its `>`.
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
        """From the `<` to where it ends."""
        return Span(self.start_tag.start, self.end)

    @property
    def content(self) -> Span:
        """What is between its tags; nothing, behind the start tag, for an empty element."""
        return Span(self.start_tag.end, self.end_tag.start if self.end_tag else self.end)

    def get(self, attribute: str) -> str | None:
        """The value of an attribute."""
        return self.values.get(attribute)

    def walk(self) -> Iterator["TolerantNode"]:
        """This element and all in it, in the order of their start tags."""
        pending: list[TolerantNode] = [self]
        while pending:
            here = pending.pop()
            yield here
            pending.extend(reversed(here.children))

    def above(self) -> Iterator["TolerantNode"]:
        """The elements around it, from the nearest on."""
        here = self.parent
        while here is not None:
            yield here
            here = here.parent


@dataclass(frozen=True, slots=True)
class Tree:
    """The elements of a text. `root` is None where there is none; `asides` are comments and the like.

    `whole` is whether nothing was missing: no tag broke off, and each was closed.
    """

    text: str
    root: TolerantNode | None
    nodes: tuple[TolerantNode, ...]
    asides: tuple[Span, ...]
    whole: bool

    def at(self, offset: int) -> TolerantNode | None:
        """The innermost element around an offset; a tag is in its element, and so is what follows a tag cut off."""
        here, found = self.root, None
        while here is not None and here.start_tag.start < offset and _reaches(here, offset):
            found, here = here, _child_at(here, offset)
        return found

    def release(self) -> None:
        """Let go of the elements, which hold each other; the tree is of no use afterwards."""
        for node in self.nodes:
            # Parents and children hold each other. Left to the garbage collector, the trees of old
            # states took 300 ms to find, in the middle of a key.
            node.parent = None

    def aside_at(self, offset: int) -> Span | None:
        """The comment, section or instruction around an offset."""
        return next((each for each in self.asides if each.start < offset < each.end), None)

    def text_of(self, node: TolerantNode) -> Span:
        """The text directly in an element without children, without the blanks around it."""
        inside = node.content
        raw = inside.of(self.text)
        start = inside.start + len(raw) - len(raw.lstrip())
        return Span(start, max(start, inside.start + len(raw.rstrip())))


def _reaches(node: TolerantNode, offset: int) -> bool:
    return offset < node.end or (not node.closed and offset == node.end)


def _child_at(node: TolerantNode, offset: int) -> TolerantNode | None:
    """The last child that begins before an offset."""
    low, high = 0, len(node.children)
    while low < high:
        middle = (low + high) // 2
        if node.children[middle].start_tag.start < offset:
            low = middle + 1
        else:
            high = middle
    return node.children[low - 1] if low else None


def parse(text: str) -> Tree:
    """The tree of a text."""
    return _Scan(text).run()


class _Scan:
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
        # The counter of open names keeps a text of end tags without start tags linear: the stack is
        # not searched.
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
        """The attributes of a start tag, and where what is behind them begins."""
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
        """What is between the quotes; of a value that is not closed, what is left of its line."""
        for group in ("double", "single"):
            start, end = found.span(group)
            if start >= 0:
                if not (found["end"] or found["stop"]):
                    line_end = min(
                        (at for at in (self.text.find("\n", start, end), self.text.find("\r", start, end)) if at >= 0),
                        default=end,
                    )
                    return Span(start, line_end)
                return Span(start, end)
        return Span(found.end(), found.end())
