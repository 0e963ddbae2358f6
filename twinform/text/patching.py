"""Patches: the smallest edits of a text that make its tree another one.

Everything that the two trees have in common stays byte for byte: comments, the order of attributes, quotes, the
spelling of numbers, indentation and line ends. Blanks around texts and between elements do not count as content.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import field, replace

from twinform.dataclass import dataclass
from twinform.diagnostics import Span, TextEdit
from twinform.schemas import XmlElement
from twinform.schemas.text_output import namespace_of
from twinform.text.alignment import BLANKS, ElementContents, aligned, elements, known_by, renamed, texts, with_renamed
from twinform.text.positions import ElementSpan, spans
from twinform.text.serializing import Prefixes, TextSurroundings, contents, serialized, text_of, value_of
from twinform.text.source_text import SourceText, apply


@dataclass(frozen=True, slots=True)
class Editor:
    """Makes edits of a well-formed text with known element positions; nothing but the edited piece changes."""

    around: TextSurroundings
    places: Mapping[XmlElement, ElementSpan] = field(repr=False)

    @property
    def text(self) -> str:
        """The text."""
        return self.around.text

    def text_with(self, element: XmlElement) -> str:
        """Return the text in which an element stands."""
        del element  # there is one text only
        return self.text

    def set_attribute(self, element: XmlElement, name: str, value: str) -> TextEdit:
        """Set an attribute: between its own quotes, or after the last attribute if it is new."""
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
        """Rename an attribute."""
        return TextEdit(self.places[element].attributes[name].name, new)

    def remove_attribute(self, element: XmlElement, name: str) -> TextEdit:
        """Remove an attribute and the blanks before it."""
        whole = self.places[element].attributes[name].whole
        return TextEdit(Span(self.around.before_blanks(whole.start), whole.end), "")

    def rename(self, element: XmlElement, new: str) -> tuple[TextEdit, ...]:
        """Rename an element in its start tag and its end tag."""
        place = self.places[element]
        if place.end_tag is None:
            return (TextEdit(place.name, new),)
        start = place.end_tag.start + len("</")
        return TextEdit(place.name, new), TextEdit(Span(start, start + len(place.name.of(self.text))), new)

    def remove(self, element: XmlElement) -> TextEdit:
        """Remove an element, with its lines if nothing else is on them; comments inside it stay."""
        place = self.places[element]
        comments = [aside.of(self.text) for each in place.walk() for aside in each.asides]
        if comments:
            return TextEdit(place.whole, (self.around.layout(place).indent or " ").join(comments))
        return TextEdit(self.around.with_line(place.whole), "")

    def set_text(self, element: XmlElement, text: str) -> tuple[TextEdit, ...]:
        """Set the text of an element without children; blanks and comments around it stay."""
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
        """Give `<element/>` a content and an end tag."""
        end = place.start_tag.end
        slash = self.text.rindex("/", place.start_tag.start, end)
        return TextEdit(Span(self.around.before_blanks(slash), end), f">{inside}</{name}>")

    def insert(self, parent: XmlElement, new: XmlElement, behind: XmlElement | None = None) -> TextEdit:
        """Insert an element after a child, or as the last one, formatted like its new siblings."""
        place = self.places[parent]
        layout, prefixes = self.around.layout_inside(place), Prefixes.at(parent)
        shown = layout.indent + serialized(new, layout, prefixes)
        if place.content is None:
            return self.fill(place, shown + self.around.layout(place).indent, place.name.of(self.text))
        children = list(place.children)
        end = self._line_end(place, self.places[behind] if behind is not None else children[-1] if children else None)
        closing = "" if children or "\n" in place.content.of(self.text) else self.around.layout(place).indent
        return TextEdit(Span(end, end), shown + closing)

    def _line_end(self, place: ElementSpan, last: ElementSpan | None) -> int:
        """Return the offset behind a child, or the last comment of a childless element, and comments on that line."""
        if last is not None:
            return self.around.behind(last.whole.end)
        return place.asides[-1].end if place.asides else self.around.behind(place.start_tag.end)

    def replace(self, element: XmlElement, span: Span, new: str) -> TextEdit:
        """Replace a piece of an element."""
        del element  # there is one text only
        return TextEdit(span, new)

    def comment_out(self, element: XmlElement, span: Span) -> TextEdit:
        """Turn a piece of the text of an element into a comment."""
        piece = span.of(self.text)
        start = span.start + len(piece) - len(piece.lstrip())
        inside = Span(start, start + len(piece.strip()))
        return self.replace(element, inside, f"<!-- {inside.of(self.text)} -->")


def patch(source: SourceText, before: XmlElement, after: XmlElement) -> SourceText:
    """Make the smallest edits that turn the tree `before`, which the file was parsed to, into `after`.

    Raises:
        UnplacedError: the text is not well-formed, or has a document type declaration.
    """
    return source.with_text(apply(source.text, edits(source, before, after)))


def edits(source: SourceText, before: XmlElement, after: XmlElement) -> list[TextEdit]:
    """Return the edits of `patch`, in no particular order; none overlaps another.

    Raises:
        UnplacedError: as `patch`.
    """
    root = spans(source.text)
    places = dict(zip(before.iter("*"), root.walk(), strict=True))
    patching = _Patching(TextSurroundings.of(source, root), places)
    patching.change(before, after)
    return patching.edits


@dataclass(frozen=True, slots=True)
class _Patching(Editor):
    """One patch of a text, which collects its edits."""

    edits: list[TextEdit] = field(default_factory=list[TextEdit])
    contents: ElementContents = field(default_factory=ElementContents)

    def change(self, before: XmlElement, after: XmlElement) -> None:
        """Add the edits that turn one element into another."""
        pending = [(before, after)]
        while pending:
            old, new = pending.pop()
            if self.contents.number(old) == self.contents.number(new):
                continue
            if old.tag != new.tag and not renamed(old, new, self.contents):
                layout = self.around.layout(self.places[old])
                self._replace(self.places[old].whole, serialized(new, layout, Prefixes.at(old)))
                continue
            if old.tag != new.tag:
                self.edits.extend(self.rename(old, str(new.tag)))
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
                self._replace(Span(self.around.before_blanks(attribute.whole.start), attribute.whole.end), "")
            elif value != old.get(name):
                self._replace(attribute.value, value_of(value, self.text[attribute.value.end]))
        added = {str(name): str(value) for name, value in new.attrib.items() if name not in written}
        if added:
            self._replace(*self._added(place, added, prefixes, new))

    def _added(
        self, place: ElementSpan, added: dict[str, str], prefixes: Prefixes, new: XmlElement
    ) -> tuple[Span, str]:
        """Return where new attributes are inserted, after the last one, and their text."""
        missing = {name: uri for name, uri in prefixes.missing(new).items() if uri != namespace_of(str(new.tag))}
        prefixes = prefixes.with_(missing)
        last = max((each.whole for each in place.attributes.values()), default=None)
        end = last.end if last else place.name.end
        gap = self.text[self.around.before_blanks(last.start) : last.start] if last else " "
        shown = [f'xmlns:{prefix}="{value_of(uri)}"' for prefix, uri in missing.items()]
        shown += [f'{prefixes.of_attribute(name)}="{value_of(value)}"' for name, value in added.items()]
        return Span(end, end), "".join(f"{gap}{each}" for each in shown)

    def _content(self, old: XmlElement, new: XmlElement) -> Iterator[tuple[XmlElement, XmlElement]]:
        """Add the edits between the tags, and return the pairs of children that differ inside."""
        here, there, children = texts(old), texts(new), elements(old)
        place = self.places[old]
        if place.content is None and (any(there) or elements(new)):
            self._open(old, new)
        elif not children and not elements(new):
            self.edits.extend(self.set_text(old, there[0]) if place.content else ())
        elif any(here) or any(there):
            yield from self._mixed(old, new)
        else:
            yield from self._children(old, new)

    def _open(self, old: XmlElement, new: XmlElement) -> None:
        """Give `<element/>` a content and an end tag."""
        place = self.places[old]
        inside = contents(new, self.around.layout(place), Prefixes.at(old))
        self.edits.append(self.fill(place, inside, place.name.of(self.text) if old.tag == new.tag else str(new.tag)))

    def _mixed(self, old: XmlElement, new: XmlElement) -> Iterator[tuple[XmlElement, XmlElement]]:
        """Write a content with text beside its elements anew, comments first, if more than one child differs."""
        before, after = elements(old), elements(new)
        if texts(old) == texts(new) and [each.tag for each in before] == [each.tag for each in after]:
            yield from zip(before, after, strict=True)
            return
        place = self.places[old]
        assert place.content is not None  # noqa: S101 - `_content` has seen to it
        comments = "".join(aside.of(self.text) for each in place.walk() for aside in each.asides)
        self._replace(place.content, comments + contents(new, self.around.layout(self.places[old]), Prefixes.at(old)))

    def _children(self, old: XmlElement, new: XmlElement) -> Iterator[tuple[XmlElement, XmlElement]]:
        before, after = elements(old), elements(new)
        if not after:
            self._empty(old)
            return
        pairs = with_renamed(aligned(before, after, self.contents), before, after, self.contents)
        kept = {j: before[i] for i, j in pairs}
        stay = {i for i, _ in pairs}
        gone = [each for i, each in enumerate(before) if i not in stay]
        # A part that moved takes its own text along, with its comments and spelling.
        moved = {self.contents.number(each): self.places[each].whole.of(self.text) for each in gone}
        counts = Counter(map(known_by, gone))
        single = {known_by(each): each for each in gone if counts[known_by(each)] == 1}
        for each in gone:
            self._replace(self.around.with_line(self.places[each].whole), "")
        layout, at = self.around.layout_inside(self.places[old]), self.around.behind(self.places[old].start_tag.end)
        for j, each in enumerate(after):
            if j in kept:
                at = self.around.behind(self.places[kept[j]].whole.end)
                yield kept[j], each
                continue
            shown = moved.get(self.contents.number(each))
            if shown is None:
                own = single.pop(known_by(each), None)
                shown = serialized(each, layout, Prefixes.at(old)) if own is None else self._changed_text(own, each)
            self._replace(Span(at, at), layout.indent + shown)
        self._close(old)

    def _changed_text(self, old: XmlElement, new: XmlElement) -> str:
        """Return the text of an element that moves, with the edits that turn it into another one."""
        inside = replace(self, edits=[])
        inside.change(old, new)
        start, end = self.places[old].whole
        moved = [TextEdit(Span(span.start - start, span.end - start), new) for span, new, _ in inside.edits]
        return apply(self.text[start:end], moved)

    def _close(self, old: XmlElement) -> None:
        """Put the end tag of an element that had no children on a line of its own."""
        place = self.places[old]
        if not place.children and place.content and "\n" not in place.content.of(self.text):
            end = place.content.end
            self._replace(Span(end, end), self.around.layout(self.places[old]).indent)

    def _empty(self, old: XmlElement) -> None:
        """Remove all children of an element; comments stay."""
        place = self.places[old]
        if place.asides:
            for child in place.children:
                self._replace(self.around.with_line(child.whole), "")
        elif place.end_tag:
            self._replace(Span(place.start_tag.end - 1, place.end_tag.end), "/>")
