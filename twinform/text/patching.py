"""Patches: the smallest edits of a text that make its tree another one.

Everything that the two trees have in common stays byte for byte: comments, the order of attributes, quotes, the
spelling of numbers, indentation and line ends. Blanks around texts and between elements do not count as content.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

from twinform.diagnostics import Span, TextEdit
from twinform.schemas import XmlElement
from twinform.text.alignment import ElementContents, aligned, elements, texts
from twinform.text.applying import apply
from twinform.text.element_edits import Editor
from twinform.text.positions import ElementSpan, spans
from twinform.text.renamed_elements import renamed, with_renamed
from twinform.text.serializing import Prefixes, contents, serialized, value_of
from twinform.text.source_text import SourceText
from twinform.text.surroundings import TextSurroundings


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
    places = dict(zip(before.iter("*"), root.walk(), strict=True))
    patching = _Patching(TextSurroundings.of(source, root), places)
    patching.change(before, after)
    return patching.edits


@dataclass(frozen=True, slots=True)
class _Patching(Editor):
    """One run over a text, which collects its edits."""

    edits: list[TextEdit] = field(default_factory=list[TextEdit])
    contents: ElementContents = field(default_factory=ElementContents)

    def change(self, before: XmlElement, after: XmlElement) -> None:
        """Add the edits that make an element another one."""
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
        """Where attributes are inserted, behind the last one, and their text."""
        missing = {name: uri for name, uri in prefixes.missing(new).items() if uri != _uri(str(new.tag))}
        prefixes = prefixes.with_(missing)
        last = max((each.whole for each in place.attributes.values()), default=None)
        end = last.end if last else place.name.end
        gap = self.text[self.around.before_blanks(last.start) : last.start] if last else " "
        shown = [f'xmlns:{prefix}="{value_of(uri)}"' for prefix, uri in missing.items()]
        shown += [f'{prefixes.of_attribute(name)}="{value_of(value)}"' for name, value in added.items()]
        return Span(end, end), "".join(f"{gap}{each}" for each in shown)

    def _content(self, old: XmlElement, new: XmlElement) -> Iterator[tuple[XmlElement, XmlElement]]:
        """Add the edits of what is between the tags, and give the pairs of children that differ inside."""
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
        """Text beside elements: it is written anew, with the comments in front, where more than a child differs."""
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
        for each in gone:
            self._replace(self.around.with_line(self.places[each].whole), "")
        layout, at = self.around.layout_inside(self.places[old]), self.around.behind(self.places[old].start_tag.end)
        for j, each in enumerate(after):
            if j in kept:
                at = self.around.behind(self.places[kept[j]].whole.end)
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
            self._replace(Span(end, end), self.around.layout(self.places[old]).indent)

    def _empty(self, old: XmlElement) -> None:
        """Take all children out of an element; comments stay."""
        place = self.places[old]
        if place.asides:
            for child in place.children:
                self._replace(self.around.with_line(child.whole), "")
        elif place.end_tag:
            self._replace(Span(place.start_tag.end - 1, place.end_tag.end), "/>")


def _uri(name: str) -> str:
    return name[1:].partition("}")[0] if name.startswith("{") else ""
