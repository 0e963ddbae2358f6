"""Writes elements as text between others: where they go, indented like their neighbors, with the prefixes there."""

from collections.abc import Mapping

from twinform.dataclass import dataclass
from twinform.diagnostics import Span
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement
from twinform.text.alignment import BLANKS, elements, texts
from twinform.text.positions import ElementSpan, indentation
from twinform.text.source_text import SourceText

_IN_TEXT = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", "\r": "&#13;"})
_IN_VALUE = {"&": "&amp;", "<": "&lt;", "\t": "&#9;", "\n": "&#10;", "\r": "&#13;"}
_QUOTES = {'"': "&quot;", "'": "&apos;"}
_XML = "http://www.w3.org/XML/1998/namespace"


def text_of(value: str) -> str:
    """Escape a string for the text of an element."""
    return value.translate(_IN_TEXT)


def value_of(value: str, quote: str = '"') -> str:
    """Escape a string for an attribute value between the given quotes."""
    return value.translate(str.maketrans({**_IN_VALUE, quote: _QUOTES[quote]}))


@dataclass(frozen=True, slots=True)
class Prefixes:
    """The prefixes declared at one place, by namespace; "" is the key without a namespace."""

    known: Mapping[str, str]

    @classmethod
    def at(cls, element: XmlElement) -> "Prefixes":
        """Return the prefixes that an element may use."""
        return cls({_XML: "xml", **{uri: prefix or "" for prefix, uri in element.nsmap.items()}})

    def of_tag(self, name: str) -> str | None:
        """Return the tag with its prefix; None if its namespace is not declared."""
        uri, _, local = name[1:].rpartition("}") if name.startswith("{") else ("", "", name)
        if not uri:
            return local
        prefix = self.known.get(uri)
        return None if prefix is None else f"{prefix}:{local}" if prefix else local

    def of_attribute(self, name: str) -> str | None:
        """Return the name of an attribute with its prefix; without a prefix it is in no namespace."""
        shown = self.of_tag(name)
        return None if name.startswith("{") and shown is not None and ":" not in shown else shown

    def missing(self, element: XmlElement) -> dict[str, str]:
        """Return the declarations that an element needs itself, by prefix."""
        needed = [name for name in map(str, element.attrib) if self.of_attribute(name) is None]
        needed += [str(element.tag)] * (self.of_tag(str(element.tag)) is None)
        uris = dict.fromkeys(name[1:].partition("}")[0] for name in needed)
        own = {uri: prefix for prefix, uri in element.nsmap.items() if prefix}
        made: dict[str, str] = {}
        for uri in uris:
            prefix, count = own.get(uri, "ns"), 0
            taken = {*made, *self.known.values()}
            while (name := f"{prefix}{count or ''}") in taken:
                count += 1
            made[name] = uri
        return made

    def with_(self, declarations: Mapping[str, str]) -> "Prefixes":
        """Return the prefixes with more declarations added."""
        return Prefixes({**self.known, **{uri: prefix for prefix, uri in declarations.items()}})


@dataclass(frozen=True, slots=True)
class ElementLayout:
    """How a new element is laid out: the line end and blanks before it, and the extra indentation of its children.

    `indent` begins with a line end, or is what separates elements that share a line.
    """

    indent: str
    step: str

    @property
    def inner(self) -> "ElementLayout":
        """The layout of its children."""
        return ElementLayout(self.indent + self.step, self.step) if self.step else self


def serialized(element: XmlElement, layout: ElementLayout, prefixes: Prefixes) -> str:
    """Return the text of an element, without the blanks before it."""
    declarations = prefixes.missing(element)
    prefixes = prefixes.with_(declarations)
    tag = prefixes.of_tag(str(element.tag))
    written = [f'xmlns:{prefix}="{value_of(uri)}"' for prefix, uri in declarations.items()]
    written += [
        f'{prefixes.of_attribute(str(name))}="{value_of(str(value))}"' for name, value in element.attrib.items()
    ]
    start = " ".join((f"<{tag}", *written))
    inside = contents(element, layout, prefixes)
    return f"{start}>{inside}</{tag}>" if inside else f"{start}/>"


def contents(element: XmlElement, layout: ElementLayout, prefixes: Prefixes) -> str:
    """Return the text between the tags of an element; blanks are ours unless there is text beside the elements."""
    children, (first, *others) = elements(element), texts(element)
    if not children:
        return text_of(first)
    mixed = bool(first or any(others))
    inner = layout.inner
    pieces = [text_of(first)]
    for child, tail in zip(children, others, strict=True):
        pieces += ("" if mixed else inner.indent, serialized(child, inner, prefixes), text_of(tail))
    return "".join((*pieces, "" if mixed else layout.indent))


_REST_OF_LINE = lazy_pattern(r"(?:[ \t]*<!--(?:(?!-->)[^\n])*-->)+(?=[ \t]*\r?\n)")
"""Comments behind an element on its line, which are about it."""
_STEP = "  "
"""What new elements are indented by where nothing in the file shows it."""


@dataclass(frozen=True, slots=True)
class TextSurroundings:
    """A text with its line end and the indentation of one level."""

    text: str
    line_end: str
    step: str

    @classmethod
    def of(cls, source: SourceText, root: ElementSpan) -> "TextSurroundings":
        """Find out how a file is formatted: its line ends and its usual indentation."""
        return cls(source.text, source.line_end, _usual_step(source.text, root))

    def before_blanks(self, offset: int) -> int:
        """Return where the blanks before an offset begin."""
        while offset and self.text[offset - 1] in BLANKS:
            offset -= 1
        return offset

    def with_line(self, span: Span) -> Span:
        """Extend a span to whole lines if nothing else is on them, otherwise to the blanks before it."""
        start = span.start
        while start and self.text[start - 1] in " \t":
            start -= 1
        end = span.end
        while end < len(self.text) and self.text[end] in " \t\r":
            end += 1
        if start and self.text[start - 1] == "\n" and self.text[end : end + 1] == "\n":
            before = start - 1
            return Span(before - (self.text[before - 1 : before] == "\r"), end - (self.text[end - 1] == "\r"))
        return Span(start, span.end)

    def behind(self, end: int) -> int:
        """Return the offset after an element and the comments on its line."""
        found = _REST_OF_LINE.match(self.text, end)
        return found.end() if found else end

    def layout(self, place: ElementSpan) -> ElementLayout:
        """Return the layout of an element itself."""
        indent = self._indent(place.whole.start)
        return ElementLayout(indent, self.step) if indent is not None else ElementLayout("", "")

    def layout_inside(self, place: ElementSpan) -> ElementLayout:
        """Return the layout of new children of an element: like the ones that it has."""
        shown = (self._indent(child.start_tag.start) for child in place.children)
        own = next((indent for indent in shown if indent is not None), None)
        if own is not None:
            return ElementLayout(own, self.step)
        if place.children:
            first = place.children[0].whole.start
            return ElementLayout(self.text[self.before_blanks(first) : first], "")
        return self.layout(place).inner

    def _indent(self, offset: int) -> str | None:
        """Return the line end and blanks before something that begins its line; None if something stands before it."""
        blanks = indentation(self.text, offset)
        return None if blanks is None else self.line_end + blanks


def _usual_step(text: str, root: ElementSpan) -> str:
    """Return how much deeper the first indented element is than the one around it."""
    for element in root.walk():
        own = indentation(text, element.start_tag.start)
        if own is None:
            continue
        for child in element.children:
            inner = indentation(text, child.start_tag.start)
            if inner is not None and inner.startswith(own) and inner != own:
                return inner[len(own) :]
    return _STEP
