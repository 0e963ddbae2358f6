"""Edits that change one part of a text: set, rename or remove an attribute, set a text, insert or remove an element."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from twinform.diagnostics import Span, TextEdit
from twinform.schemas import XmlElement
from twinform.text.alignment import BLANKS
from twinform.text.positions import ElementSpan
from twinform.text.serializing import Prefixes, serialized, text_of, value_of
from twinform.text.surroundings import TextSurroundings


@dataclass(frozen=True, slots=True)
class Editor:
    """Makes edits of a well-formed text whose elements stand at these places. What an edit does not say stays."""

    around: TextSurroundings
    places: Mapping[XmlElement, ElementSpan] = field(repr=False)

    @property
    def text(self) -> str:
        """The text."""
        return self.around.text

    def set_attribute(self, element: XmlElement, name: str, value: str) -> TextEdit:
        """Write an attribute, between the quotes that it has, or behind the last one where it is not there."""
        place = self.places[element]
        own = place.attributes.get(name)
        if own:
            return TextEdit(own.value, value_of(value, self.text[own.value.end]))
        last = max((each.whole for each in place.attributes.values()), default=None)
        end = last.end if last else place.name.end
        gap = self.text[self.around.before_blanks(last.start) : last.start] if last else " "
        quote = self.text[last.end - 1] if last else '"'
        return TextEdit(Span(end, end), f"{gap}{name}={quote}{value_of(value, quote)}{quote}")

    def rename_attribute(self, element: XmlElement, name: str, new: str) -> TextEdit:
        """Give an attribute another name."""
        return TextEdit(self.places[element].attributes[name].name, new)

    def remove_attribute(self, element: XmlElement, name: str) -> TextEdit:
        """Take an attribute out, and the blanks before it."""
        whole = self.places[element].attributes[name].whole
        return TextEdit(Span(self.around.before_blanks(whole.start), whole.end), "")

    def rename(self, element: XmlElement, new: str) -> tuple[TextEdit, ...]:
        """Give an element another name, in both of its tags."""
        place = self.places[element]
        if place.end_tag is None:
            return (TextEdit(place.name, new),)
        start = place.end_tag.start + len("</")
        return TextEdit(place.name, new), TextEdit(Span(start, start + len(place.name.of(self.text))), new)

    def remove(self, element: XmlElement) -> TextEdit:
        """Take an element out, with its lines where nothing else is on them; the comments in it stay in its place."""
        place = self.places[element]
        comments = [aside.of(self.text) for each in place.walk() for aside in each.asides]
        if comments:
            return TextEdit(place.whole, (self.around.layout(place).indent or " ").join(comments))
        return TextEdit(self.around.with_line(place.whole), "")

    def set_text(self, element: XmlElement, text: str) -> tuple[TextEdit, ...]:
        """Write the text of an element without children; blanks and comments around the old one stay."""
        place = self.places[element]
        if place.content is None:
            return (self.fill(place, text_of(text), place.name.of(self.text)),)
        edits: list[TextEdit] = []
        shown = text_of(text)
        for run in place.texts():
            piece = run.of(self.text)
            if written := piece.strip(BLANKS):
                start = run.start + len(piece) - len(piece.lstrip(BLANKS))
                edits.append(TextEdit(Span(start, start + len(written)), shown))
                shown = ""
        if not edits:
            edits.append(TextEdit(place.content if not place.asides else Span(*[place.content.end] * 2), shown))
        return tuple(edits)

    def fill(self, place: ElementSpan, inside: str, name: str) -> TextEdit:
        """Give `<element/>` a content, and an end tag of that name."""
        end = place.start_tag.end
        slash = self.text.rindex("/", place.start_tag.start, end)
        return TextEdit(Span(self.around.before_blanks(slash), end), f">{inside}</{name}>")

    def insert(self, parent: XmlElement, new: XmlElement, behind: XmlElement | None = None) -> TextEdit:
        """Put a new element into another one, behind one of its children, or last; it is laid out as these are."""
        place = self.places[parent]
        layout, prefixes = self.around.layout_inside(place), Prefixes.at(parent)
        shown = layout.indent + serialized(new, layout, prefixes)
        if place.content is None:
            return self.fill(place, shown + self.around.layout(place).indent, place.name.of(self.text))
        children = list(place.children)
        end = self._end(place, self.places[behind] if behind is not None else children[-1] if children else None)
        closing = "" if children or "\n" in place.content.of(self.text) else self.around.layout(place).indent
        return TextEdit(Span(end, end), shown + closing)

    def _end(self, place: ElementSpan, last: ElementSpan | None) -> int:
        """Behind a child, or the last comment of an element without children, and the comments on its line."""
        if last is not None:
            return self.around.behind(last.whole.end)
        return place.asides[-1].end if place.asides else self.around.behind(place.start_tag.end)

    def comment_out(self, span: Span) -> TextEdit:
        """Make a comment of a text."""
        piece = span.of(self.text)
        start = span.start + len(piece) - len(piece.lstrip())
        inside = Span(start, start + len(piece.strip()))
        return TextEdit(inside, f"<!-- {inside.of(self.text)} -->")
