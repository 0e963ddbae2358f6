"""Makes edits of xacro files for fixes of what they expand to: of a text in its place, of a value where it is written.

An edit changes all parts of the robot that come from what it changes: all calls of a macro, all uses of a property. So
it is right only where each of them wants it.
"""

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import field
from functools import cached_property

from twinform.compiler.fixing.xacro_values import (
    MADE,
    ComputedError,
    Slot,
    Written,
    XacroSource,
    XacroValues,
    default_of,
)
from twinform.compiler.input.expansion import Expansion, PartOrigin
from twinform.compiler.input.xacro_mistakes import EXPRESSION
from twinform.dataclass import dataclass
from twinform.diagnostics import Fix, Span, TextEdit
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement
from twinform.text import Editor, ElementSpan
from twinform.text.serializing import value_of

_BARE = lazy_pattern(r"[\w.+/:-]+")
"""What needs no quotes as the default of a parameter."""
_TRUTHS = frozenset({"false", "true"})


@dataclass(frozen=True)  # no slots: what is found out once is kept in the dictionary
class ExpandedEditor(Editor):
    """Makes edits of the xacro files that elements come from; `main` is the file that was expanded."""

    main: str
    values: XacroValues = field(repr=False)
    origins: dict[XmlElement, PartOrigin] = field(repr=False)
    made: defaultdict[TextEdit, set[XmlElement]] = field(
        default_factory=lambda: defaultdict[TextEdit, set[XmlElement]](set), repr=False
    )
    """The elements for which each edit was made."""
    wanted: dict[TextEdit, set[XmlElement]] = field(default_factory=dict[TextEdit, set[XmlElement]], repr=False)
    """The elements that each edit changes."""

    @classmethod
    def of(cls, root: XmlElement, expansion: Expansion, main: str) -> "ExpandedEditor":
        """Make an editor for the elements of an expanded text.

        Raises:
            UnreadableError, ValueError: a file cannot be read as XML.
        """
        values = XacroValues(expansion)
        origins = {element: part for element, part in zip(root.iter("*"), expansion.parts, strict=True) if part}
        places: dict[XmlElement, ElementSpan] = {}
        for element, part in origins.items():
            source = values.sources[part.file]
            # an element that xacro has given its name has no place
            if _local(source.elements[part.number]) == _local(element):
                places[element] = source.places[part.number]
        return cls(values.sources[main].around, places, main, values, origins)

    def is_agreed(self, fix: Fix) -> bool:
        """Tell whether all parts that a fix changes want the same edits; what is of xacro itself is no part."""
        return all(self._is_wanted_everywhere(edit) for edit in fix.edits)

    def _is_wanted_everywhere(self, edit: TextEdit) -> bool:
        if edit not in self._agreed:
            self._agreed[edit] = self.wanted.get(edit, set()) <= self.made[edit]
        return self._agreed[edit]

    @cached_property
    def _agreed(self) -> dict[TextEdit, bool]:
        """What is wanted everywhere, as far as somebody has asked: thousands of parts may come from one place."""
        return {}

    def source_of(self, edit: TextEdit) -> str:
        """Return the text that an edit changes."""
        return self.values.sources[edit.file or self.main].source.text

    def line_of(self, edit: TextEdit) -> tuple[str, int]:
        """Return the file and line of an edit."""
        name = edit.file or self.main
        return name, self.values.sources[name].lines.place(edit.span.start).line

    def place_of(self, element: XmlElement) -> tuple[str, int] | None:
        """Return the file and line where an element was written."""
        return self.origins[element][:2] if element in self.origins else None

    def text_with(self, element: XmlElement) -> str:
        """Return the text of the file in which an element is written."""
        return self._source(element).source.text

    def set_attribute(self, element: XmlElement, name: str, value: str) -> TextEdit:
        """Set an attribute where its value is written; a new one in the element."""
        self._require_place(element)
        if name not in element.attrib:
            return self._everywhere(element, self._editor(element).set_attribute(element, name, value))
        written = self._written(element, name, element.get(name, ""))
        return self._set_written(element, written, value)

    def rename_attribute(self, element: XmlElement, name: str, new: str) -> TextEdit:
        """Rename an attribute."""
        self._require_attribute(element, name)
        return self._everywhere(element, self._editor(element).rename_attribute(element, name, new))

    def remove_attribute(self, element: XmlElement, name: str) -> TextEdit:
        """Remove an attribute that has a text as its value."""
        self._require_attribute(element, name)
        self._require_text(self.places[element].attributes[name].value.of(self.text_with(element)))
        return self._everywhere(element, self._editor(element).remove_attribute(element, name))

    def rename(self, element: XmlElement, new: str) -> tuple[TextEdit, ...]:
        """Rename an element."""
        self._require_place(element)
        return tuple(self._everywhere(element, edit) for edit in self._editor(element).rename(element, new))

    def remove(self, element: XmlElement) -> TextEdit:
        """Remove an element."""
        self._require_place(element)
        return self._everywhere(element, self._editor(element).remove(element))

    def set_text(self, element: XmlElement, text: str) -> tuple[TextEdit, ...]:
        """Set the text of an element where it is written."""
        self._require_place(element)
        if self.places[element].children:
            raise ComputedError(MADE)
        if (element.text or "").strip():
            written = self._written(element, "", element.text or "")
            if written.names:
                return (self._set_written(element, written, text),)
        return tuple(self._everywhere(element, edit) for edit in self._editor(element).set_text(element, text))

    def insert(self, parent: XmlElement, new: XmlElement, behind: XmlElement | None = None) -> TextEdit:
        """Insert an element behind another one, if that is written in the same element, or as the last one."""
        self._require_place(parent)
        place = None if behind is None else self.places.get(behind)
        behind = behind if place in self.places[parent].children else None
        return self._everywhere(parent, self._editor(parent).insert(parent, new, behind))

    def replace(self, element: XmlElement, span: Span, new: str) -> TextEdit:
        """Replace a piece of an element that is a text."""
        self._require_place(element)
        if not new.startswith("<!--"):
            self._require_text(span.of(self.text_with(element)))
        return self._everywhere(element, TextEdit(span, new))

    def comment_out(self, element: XmlElement, span: Span) -> TextEdit:
        """Turn a piece of the text of an element into a comment."""
        edit = self._editor(element).comment_out(element, span)
        return self.replace(element, edit.span, edit.new)

    def _source(self, element: XmlElement) -> XacroSource:
        self._require_place(element)
        return self.values.sources[self.origins[element].file]

    def _editor(self, element: XmlElement) -> Editor:
        """Return an editor of the file in which an element is written."""
        return Editor(self._source(element).around, self.places)

    def _require_place(self, element: XmlElement) -> None:
        if element not in self.places:
            raise ComputedError(MADE)

    def _require_attribute(self, element: XmlElement, name: str) -> None:
        self._require_place(element)
        if name not in self.places[element].attributes:
            raise ComputedError(MADE)

    def _require_text(self, piece: str) -> None:
        found = EXPRESSION.search(piece)
        if found:
            raise ComputedError(f"the value comes from {found[0]}")

    def _everywhere(self, element: XmlElement, edit: TextEdit) -> TextEdit:
        """Note an edit of an element in its file, which changes all parts that this element becomes."""
        origin = self.origins[element]
        return self._note(element, edit, origin.file, self._copies[origin.file, origin.number])

    def _note(self, element: XmlElement, edit: TextEdit, file: str, changed: set[XmlElement]) -> TextEdit:
        edit = edit._replace(file="" if file == self.main else file)
        self.made[edit].add(element)
        self.wanted.setdefault(edit, changed)
        return edit

    def _written(self, element: XmlElement, attribute: str, value: str) -> Written:
        """Return where a value of an element is written.

        Raises:
            ComputedError: nowhere, or it is used otherwise too.
        """
        origin = self.origins[element]
        written = self.values.written(Slot(origin.file, origin.number, attribute), origin.call)
        if not _is_same(self.values.value(written.slot), value):
            raise ComputedError(MADE)
        tangled = next((each for each in written.names if self.values.is_tangled(each)), None)
        if tangled is not None:
            place = self.values.place(written.slot)
            raise ComputedError(f"the value comes from {tangled.name!r} ({place}), which is used otherwise too")
        return written

    def _set_written(self, element: XmlElement, written: Written, value: str) -> TextEdit:
        slot = written.slot
        source = self.values.sources[slot.file]
        if written.names and value.lower() in _TRUTHS:  # xacro makes `True` of a property that is `true`
            raise ComputedError(f"the value comes from {written.names[0].name!r}, and xacro writes it with a capital")
        span = source.places[slot.number].attributes[slot.attribute].value
        edit = TextEdit(span, value_of(value, source.source.text[span.end]))
        if slot.parameter:
            edit = _set_default(edit, slot.parameter, span.of(source.source.text), value)
        users = self._users[slot] if written.names else self._copies[slot.file, slot.number]
        return self._note(element, edit, slot.file, users)

    @cached_property
    def _copies(self) -> dict[tuple[str, int], set[XmlElement]]:
        """The parts of the robot that an element of a file has become."""
        found: defaultdict[tuple[str, int], set[XmlElement]] = defaultdict(set)
        for element, origin in self.origins.items():
            found[origin.file, origin.number].add(element)
        return found

    @cached_property
    def _users(self) -> dict[Slot, set[XmlElement]]:
        """The parts of the robot that have the value of a property, an argument or a call."""
        found: defaultdict[Slot, set[XmlElement]] = defaultdict(set)
        for element, origin in self.origins.items():
            for attribute, value in self._values_of(element):
                if "$" not in value:
                    continue
                try:
                    found[self.values.written(Slot(origin.file, origin.number, attribute), origin.call).slot].add(
                        element
                    )
                except ComputedError:
                    continue
        return found

    def _values_of(self, element: XmlElement) -> Iterable[tuple[str, str]]:
        origin = self.origins[element]
        source = self.values.sources[origin.file].elements[origin.number]
        return (*((str(key), str(value)) for key, value in source.items()), ("", source.text or ""))


def _set_default(edit: TextEdit, parameter: str, written: str, value: str) -> TextEdit:
    """Return an edit of the default of one parameter, of one that would replace them all."""
    default = default_of(parameter, written)
    if default is None or not _BARE.fullmatch(value):
        raise ComputedError(f"the value is the default of the parameter {parameter!r}")
    start = edit.span.start
    return TextEdit(Span(start + default.start, start + default.end), value)


def _local(element: XmlElement) -> str:
    return str(element.tag).rpartition("}")[2]


def _is_same(written: str, value: str) -> bool:
    """Whether a value is the one that is written, as xacro writes numbers and truth values."""
    if written.split() == value.split() or (value.lower() in _TRUTHS and written.strip().lower() == value.lower()):
        return True
    try:
        return float(written) == float(value)
    except ValueError:
        return False
