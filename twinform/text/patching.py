"""Patches: the smallest edits of a text that make its tree another one.

Everything that the two trees have in common stays byte for byte: comments, the order of attributes, quotes, the
spelling of numbers, indentation and line ends. Blanks around texts and between elements do not count as content.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from twinform.diagnostics import Span, TextEdit
from twinform.schemas import XmlElement
from twinform.text.alignment import BLANKS, Contents, aligned, elements, texts
from twinform.text.edits import apply
from twinform.text.positions import ElementSpan, spans
from twinform.text.serializing import Layout, Prefixes, contents, serialized, text_of, value_of
from twinform.text.source_text import SourceText

_REST_OF_LINE = re.compile(r"(?:[ \t]*<!--(?:(?!-->)[^\n])*-->)+(?=[ \t]*\r?\n)")
"""Comments behind an element on its line, which are about it."""
_STEP = "  "
"""What new elements are indented by where nothing in the file shows it."""


def patch(source: SourceText, before: XmlElement, after: XmlElement) -> SourceText:
    """The file with the smallest edits that turn the tree `before`, which it was parsed to, into `after`.

    Raises:
        UnplacedError: the text is not well-formed, or has a document type declaration.
    """
    return source.with_text(apply(source.text, edits(source, before, after)))


def edits(source: SourceText, before: XmlElement, after: XmlElement) -> list[TextEdit]:
    """These edits, in no particular order, none of which overlaps another.

    Raises:
        UnplacedError: as `patch`.
    """
    root = spans(source.text)
    patching = _Patching(source.text, source.line_end, _usual_step(source.text, root))
    patching.places.update(zip(before.iter("*"), root.walk(), strict=True))
    patching.change(before, after)
    return patching.edits


@dataclass(slots=True)
class _Patching:
    """One run over a text."""

    text: str
    line_end: str
    step: str
    places: dict[XmlElement, ElementSpan] = field(default_factory=dict[XmlElement, ElementSpan])
    edits: list[TextEdit] = field(default_factory=list[TextEdit])
    contents: Contents = field(default_factory=Contents)

    def change(self, before: XmlElement, after: XmlElement) -> None:
        """Add the edits that make an element another one."""
        pending = [(before, after)]
        while pending:
            old, new = pending.pop()
            if self.contents.number(old) == self.contents.number(new):
                continue
            if old.tag != new.tag:
                self._replace(self.places[old].whole, serialized(new, self._layout(old), Prefixes.at(old)))
                continue
            self._attributes(old, new)
            pending.extend(self._content(old, new))

    def _replace(self, span: Span, new: str) -> None:
        self.edits.append(TextEdit(span, new))

    def _attributes(self, old: XmlElement, new: XmlElement) -> None:
        place, prefixes = self.places[old], Prefixes.at(old)
        written = dict(zip(map(str, old.attrib), place.own_attributes, strict=True))
        for name, attribute in written.items():
            value = new.get(name)
            if value is None:
                self._replace(Span(self._before_blanks(attribute.whole.start), attribute.whole.end), "")
            elif value != old.get(name):
                self._replace(attribute.value, value_of(value, self.text[attribute.value.end]))
        added = {str(name): str(value) for name, value in new.attrib.items() if name not in written}
        if added:
            self._replace(*self._added(place, added, prefixes, new))

    def _added(
        self, place: ElementSpan, added: dict[str, str], prefixes: Prefixes, new: XmlElement
    ) -> tuple[Span, str]:
        """Where attributes are inserted, behind the last one, and their text."""
        missing = {name: uri for name, uri in prefixes.missing(new).items() if uri != _uri(str(new.tag))}
        prefixes = prefixes.with_(missing)
        last = max((each.whole for each in place.attributes.values()), default=None)
        end = last.end if last else place.name.end
        gap = self.text[self._before_blanks(last.start) : last.start] if last else " "
        shown = [f'xmlns:{prefix}="{value_of(uri)}"' for prefix, uri in missing.items()]
        shown += [f'{prefixes.of_attribute(name)}="{value_of(value)}"' for name, value in added.items()]
        return Span(end, end), "".join(f"{gap}{each}" for each in shown)

    def _before_blanks(self, offset: int) -> int:
        while offset and self.text[offset - 1] in BLANKS:
            offset -= 1
        return offset

    def _content(self, old: XmlElement, new: XmlElement) -> Iterator[tuple[XmlElement, XmlElement]]:
        """Add the edits of what is between the tags, and give the pairs of children that differ inside."""
        here, there, children = texts(old), texts(new), elements(old)
        place = self.places[old]
        if place.content is None and (any(there) or elements(new)):
            self._open(old, new)
        elif not children and not elements(new):
            self._text(place, there[0])
        elif any(here) or any(there):
            yield from self._mixed(old, new)
        else:
            yield from self._children(old, new)

    def _open(self, old: XmlElement, new: XmlElement) -> None:
        """Give `<element/>` a content and an end tag."""
        place = self.places[old]
        end = place.start_tag.end
        slash = self.text.rindex("/", place.start_tag.start, end)
        inside = contents(new, self._layout(old), Prefixes.at(old))
        self._replace(Span(self._before_blanks(slash), end), f">{inside}</{place.name.of(self.text)}>")

    def _text(self, place: ElementSpan, text: str) -> None:
        """Put another text into an element without children, into the place of the first one."""
        runs = [run for run in place.texts() if run.of(self.text).strip(BLANKS)]
        shown = text_of(text)
        for run in runs:
            piece = run.of(self.text)
            start = run.start + len(piece) - len(piece.lstrip(BLANKS))
            end = run.end - (len(piece) - len(piece.rstrip(BLANKS)))
            self._replace(Span(start, end), shown)
            shown = ""
        if not runs and place.content:
            end = place.content.end
            self._replace(Span(end, end) if place.asides else place.content, shown)

    def _mixed(self, old: XmlElement, new: XmlElement) -> Iterator[tuple[XmlElement, XmlElement]]:
        """Text beside elements: it is written anew, with the comments in front, where more than a child differs."""
        before, after = elements(old), elements(new)
        if texts(old) == texts(new) and [each.tag for each in before] == [each.tag for each in after]:
            yield from zip(before, after, strict=True)
            return
        place = self.places[old]
        assert place.content is not None  # noqa: S101 - `_content` has seen to it
        comments = "".join(aside.of(self.text) for each in place.walk() for aside in each.asides)
        self._replace(place.content, comments + contents(new, self._layout(old), Prefixes.at(old)))

    def _children(self, old: XmlElement, new: XmlElement) -> Iterator[tuple[XmlElement, XmlElement]]:
        before, after = elements(old), elements(new)
        if not after:
            self._empty(old)
            return
        pairs = aligned(before, after, self.contents)
        kept = {j: before[i] for i, j in pairs}
        stay = {i for i, _ in pairs}
        gone = [each for i, each in enumerate(before) if i not in stay]
        moved = {self.contents.number(each): self.places[each].whole.of(self.text) for each in gone}
        for each in gone:
            self._replace(self._with_line(self.places[each].whole), "")
        layout, at = self._layout_inside(old), self._first_place(old)
        for j, each in enumerate(after):
            if j in kept:
                at = self._behind(self.places[kept[j]].whole.end)
                yield kept[j], each
                continue
            shown = moved.get(self.contents.number(each)) or serialized(each, layout, Prefixes.at(old))
            self._replace(Span(at, at), layout.indent + shown)
        self._close(old)

    def _close(self, old: XmlElement) -> None:
        """Put the end tag of an element that had no children on a line of its own."""
        place = self.places[old]
        if not place.children and place.content and "\n" not in place.content.of(self.text):
            end = place.content.end
            self._replace(Span(end, end), self._layout(old).indent)

    def _empty(self, old: XmlElement) -> None:
        """Take all children out of an element; comments stay."""
        place = self.places[old]
        if place.asides:
            for child in place.children:
                self._replace(self._with_line(child.whole), "")
        elif place.end_tag:
            self._replace(Span(place.start_tag.end - 1, place.end_tag.end), "/>")

    def _with_line(self, span: Span) -> Span:
        """The span and, where nothing else is on its lines, these lines; else the blanks before it."""
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

    def _behind(self, end: int) -> int:
        """Behind an element and the comments on its line."""
        found = _REST_OF_LINE.match(self.text, end)
        return found.end() if found else end

    def _first_place(self, old: XmlElement) -> int:
        """Where the first child may be inserted."""
        return self._behind(self.places[old].start_tag.end)

    def _layout(self, element: XmlElement) -> Layout:
        """How an element itself is laid out."""
        indent = self._indent(self.places[element].whole.start)
        return Layout(indent, self.step) if indent is not None else Layout("", "")

    def _layout_inside(self, element: XmlElement) -> Layout:
        """How new children of an element are laid out: like those that it has."""
        place = self.places[element]
        shown = [self._indent(child.whole.start) for child in place.children]
        own = next((indent for indent in shown if indent is not None), None)
        if own is not None:
            return Layout(own, self.step)
        if place.children:
            gap = self.text[self._before_blanks(place.children[0].whole.start) : place.children[0].whole.start]
            return Layout(gap, "")
        return self._layout(element).inner

    def _indent(self, offset: int) -> str | None:
        """The line end and the blanks before what begins its line; None for what does not."""
        blanks = _column(self.text, offset)
        return None if blanks is None else self.line_end + blanks


def _usual_step(text: str, root: ElementSpan) -> str:
    """By how much the first element that begins a line is indented more than the one around it."""
    for element in root.walk():
        own = _column(text, element.whole.start)
        for child in element.children:
            inner = _column(text, child.whole.start)
            if own is not None and inner is not None and inner.startswith(own) and inner != own:
                return inner[len(own) :]
    return _STEP


def _column(text: str, offset: int) -> str | None:
    """The blanks before what begins its line; None for what does not."""
    blanks = text[text.rfind("\n", 0, offset) + 1 : offset]
    return blanks if not blanks.strip(" \t") else None


def _uri(name: str) -> str:
    return name[1:].partition("}")[0] if name.startswith("{") else ""
