"""Where each element, tag, attribute and text stands in the text of a file, also of one that is not well-formed.

Offsets count characters of the text, from 0; lines and columns count from 1. Positions are made when something asks
for them, by expat, which knows where each tag begins.
"""

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import field
from functools import cached_property
from itertools import accumulate, islice
from typing import NamedTuple
from xml.parsers import expat

from twinform.dataclass import dataclass
from twinform.diagnostics import Span
from twinform.lazy import lazy_pattern
from twinform.text.tokens import COMMENT, INSTRUCTION, SECTION, UnplacedError

_ATTRIBUTE = lazy_pattern(r"""\s+([^\s=<>/"']+)\s*=\s*("[^"]*"|'[^']*')""")
_NAME = lazy_pattern(r"</?([^\s<>/]+)")
_REST_OF_TAG = r"[^<>\"']*+(?:\"[^\"]*+\"[^<>\"']*+|'[^']*+'[^<>\"']*+)*+>"
_START_TAG = lazy_pattern(f"<{_REST_OF_TAG}")


class LineColumn(NamedTuple):
    """A line and a column, both from 1."""

    line: int
    column: int


class AttributeSpan(NamedTuple):
    """The position of an attribute; `value` is the part between the quotes."""

    whole: Span
    name: Span
    value: Span


@dataclass(slots=True)
class ElementSpan:
    """The position of an element.

    `end_tag` is None for `<element/>`. `asides` are the comments and processing instructions directly in it. Name and
    attributes are looked for when somebody asks for them, which nobody does for most elements of a file.
    """

    text: str = field(repr=False, compare=False)
    start_tag: Span
    end_tag: Span | None = None
    children: list["ElementSpan"] = field(default_factory=list["ElementSpan"])
    asides: list[Span] = field(default_factory=list[Span])
    _places: dict[str, Span] | None = field(default=None, init=False, repr=False, compare=False)
    """The first place of each text directly in it, once somebody has asked for one."""
    _attributes: dict[str, AttributeSpan] | None = field(default=None, init=False, repr=False, compare=False)

    @property
    def name(self) -> Span:
        """The name in the start tag, with its prefix."""
        found = _NAME.match(self.text, self.start_tag.start)
        assert found is not None  # noqa: S101 - a start tag has a name
        return Span(*found.span(1))

    @property
    def attributes(self) -> dict[str, AttributeSpan]:
        """The attributes by their names, declarations of namespaces included."""
        if self._attributes is None:
            self._attributes = _attributes(self.text, self.name.end)
        return self._attributes

    @property
    def whole(self) -> Span:
        """From `<` to the last `>`."""
        return Span(self.start_tag.start, (self.end_tag or self.start_tag).end)

    @property
    def content(self) -> Span | None:
        """The part between the tags; None for `<element/>`."""
        return Span(self.start_tag.end, self.end_tag.start) if self.end_tag else None

    @property
    def own_attributes(self) -> list[AttributeSpan]:
        """The attributes in their order, without declarations of namespaces."""
        return [each for name, each in self.attributes.items() if name != "xmlns" and not name.startswith("xmlns:")]

    def texts(self) -> Iterator[Span]:
        """The runs of text directly in the element, between children and comments, blank ones and CDATA included."""
        content = self.content
        if content is None:
            return
        here = content.start
        for other in sorted([*(child.whole for child in self.children), *self.asides]):
            if other.start > here:
                yield Span(here, other.start)
            here = other.end
        if content.end > here:
            yield Span(here, content.end)

    def find_text(self, wanted: str, text: str) -> Span | None:
        """Find the first run of text directly in the element that is `wanted`, without the blanks around it."""
        if self._places is None:
            self._places = {}
            for run in self.texts():
                written = run.of(text)
                start = run.start + len(written) - len(written.lstrip())
                self._places.setdefault(written.strip(), Span(start, start + len(written.strip())))
        return self._places.get(wanted)

    def walk(self) -> Iterator["ElementSpan"]:
        """Yield this element and all inside it in the order of their start tags, as `iter` of lxml does."""
        pending: list[ElementSpan] = [self]
        while pending:
            here = pending.pop()
            yield here
            pending.extend(reversed(here.children))


# libxml2 knows the line of an element and nothing else; expat gives the byte at which each tag
# begins. It also refuses what libxml2 repairs, so a file that is not well-formed cannot be changed
# in its place.
def indentation(text: str, offset: int) -> str | None:
    """Return the blanks before something that begins its line; None if something stands before it."""
    start = offset
    # a line may be the whole file, so nothing of it is looked at but the blanks
    while start and text[start - 1] in " \t":
        start -= 1
    return text[start:offset] if not start or text[start - 1] == "\n" else None


_BLOCK = 1024
_END_OF_LINE = lazy_pattern(r"\n|\r(?!\n)")


class Lines:
    """The lines of a text. Each ends with a line feed, a carriage return, or both."""

    # A list of all lines of ten million would fill 400 MB, and few of them are asked for. So line
    # ends are counted in blocks of the text.
    def __init__(self, text: str) -> None:
        self._text = text
        self._has_returns = "\r" in text
        counts = (self._count(start, start + _BLOCK) for start in range(0, len(text), _BLOCK))
        self._before = [*accumulate(counts, initial=0)]

    def _count(self, start: int, end: int) -> int:
        """Count the line ends of which the last character lies between two offsets."""
        count = self._text.count("\n", start, end)
        if self._has_returns:
            count += self._text.count("\r", start, end) - self._text.count("\r\n", start, end + 1)
        return count

    def place(self, offset: int) -> LineColumn:
        """The line and column of an offset."""
        block = min(offset // _BLOCK, len(self._before) - 1)
        line = self._before[block] + self._count(block * _BLOCK, offset) + 1
        return LineColumn(line, offset - self.start(line) + 1)

    def start(self, line: int) -> int:
        """Where a line begins.

        Raises:
            IndexError: there is no such line.
        """
        if not 1 <= line <= len(self):
            raise IndexError(f"there is no line {line}")
        if line == 1:
            return 0
        block = bisect_left(self._before, line - 1) - 1
        ends = _END_OF_LINE.finditer(self._text, block * _BLOCK)
        return next(islice(ends, line - 2 - self._before[block], None)).end()

    def __len__(self) -> int:
        return self._before[-1] + 1


def spans(text: str) -> ElementSpan:
    """Find the position of the root element and of all inside it.

    Raises:
        UnplacedError: the text is not well-formed, or has a document type declaration.
    """
    return _PositionScan(text).run()


class _PositionScan:
    """One run of expat over a text, which it gets as UTF-8 whatever the encoding of the file."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.data = text.encode("utf-8", "surrogatepass")
        self.ascii = len(self.data) == len(text)
        self.seen = (0, 0)
        self.root: ElementSpan | None = None
        self.open: list[ElementSpan] = []
        self.parser = parser = expat.ParserCreate("utf-8")
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CommentHandler = self._comment
        parser.ProcessingInstructionHandler = self._instruction
        parser.StartDoctypeDeclHandler = self._doctype

    def run(self) -> ElementSpan:
        """Parse it all."""
        try:
            self.parser.Parse(self.data, True)
        except expat.ExpatError as error:
            raise UnplacedError(str(error), error.lineno, error.offset + 1) from error
        finally:
            # it holds this object by its handlers: Python would look for such a circle only after many more texts
            del self.parser
        assert self.root is not None  # noqa: S101 - a well-formed text has a root
        return self.root

    def _offset(self) -> int:
        """Return the offset in characters of expat's position in bytes; each byte is looked at once."""
        byte = self.parser.CurrentByteIndex
        if self.ascii:
            return byte
        seen_bytes, seen = self.seen
        seen += len(self.data[seen_bytes:byte].decode("utf-8", "surrogatepass"))
        self.seen = (byte, seen)
        return seen

    def _start(self, _: str, __: dict[str, str]) -> None:
        element = start_tag(self.text, self._offset())
        if self.open:
            self.open[-1].children.append(element)
        else:
            self.root = element
        self.open.append(element)

    def _end(self, _: str) -> None:
        element = self.open.pop()
        start = self._offset()
        if not self.text.endswith("/>", 0, element.start_tag.end):
            element.end_tag = Span(start, self.text.index(">", start) + 1)

    def _comment(self, _: str) -> None:
        self._aside("<!--", "-->")

    def _instruction(self, _: str, __: str) -> None:
        self._aside("<?", "?>")

    def _aside(self, begin: str, end: str) -> None:
        start = self._offset()
        if self.open:
            self.open[-1].asides.append(Span(start, self.text.index(end, start + len(begin)) + len(end)))

    def _doctype(self, *_: object) -> None:
        raise UnplacedError("the document has a DOCTYPE")


def start_tag(text: str, start: int) -> ElementSpan:
    """Find the start tag at an offset, as an element without content."""
    found = _START_TAG.match(text, start)
    assert found is not None  # noqa: S101 - expat has found a tag there
    return ElementSpan(text, Span(start, found.end()))


def _attributes(text: str, here: int) -> dict[str, AttributeSpan]:
    """Find the attributes in a start tag from an offset on."""
    attributes: dict[str, AttributeSpan] = {}
    while found := _ATTRIBUTE.match(text, here):
        (begin, end), here = found.span(2), found.end()
        attributes[found[1]] = AttributeSpan(Span(found.start(1), end), Span(*found.span(1)), Span(begin + 1, end - 1))
    return attributes


# The groups are numbered as the kinds below; a section has none.
_TOKEN = lazy_pattern(rf"({COMMENT}|{INSTRUCTION})|{SECTION}|<(/)[^\s<>/!?]{_REST_OF_TAG}|<([^\s<>/!?]){_REST_OF_TAG}")
_ASIDE, _END, _START = 1, 2, 3
_TAG_NAME = lazy_pattern(r"<([^\s<>/]+)")
_TAG_NAMES = lazy_pattern(r"<(?![!?])([^\s<>/]+)")
_MOST = 4000
"""So many tags are looked at for one element: a hostile file has hundreds of them around a million others."""


class Tags:
    """The elements of a text that need not be well-formed, by number in the order of their start tags."""

    def __init__(self, text: str) -> None:
        self.text = text
        self._tokens = [
            (kind, found.start(), found.end()) for found in _TOKEN.finditer(text) if (kind := found.lastindex)
        ]
        self._starts = [number for number, (kind, _, _) in enumerate(self._tokens) if kind == _START]
        self._made: dict[int, ElementSpan] = {}

    @cached_property
    def starts(self) -> list[int]:
        """The offset of each start tag."""
        return [self._tokens[number][1] for number in self._starts]

    def __len__(self) -> int:
        return len(self._starts)

    @cached_property
    def names(self) -> list[str]:
        """The name of each element, with its prefix."""
        found: list[str] = _TAG_NAMES.findall(self.text)
        # there are more where some stand in comments
        return found if len(found) == len(self) else [start_tag_name(self.text, start) for start in self.starts]

    def element(self, place: int) -> ElementSpan:
        """Find an element with all inside it; of a very large one, the start tag alone.

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
    """Return the name in the start tag at an offset."""
    found = _TAG_NAME.match(text, start)
    return found[1] if found else ""
