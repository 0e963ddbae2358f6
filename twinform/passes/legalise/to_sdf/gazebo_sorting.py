"""Sorting the content of `<gazebo>` elements by how it is converted."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, NamedTuple

from twinform.diagnostics import DiagnosticSink, Fate, Location, Severity, Source, rules
from twinform.ir import Element, GazeboExtension, Link
from twinform.passes.shared.gazebo_tags import FALSE, LINK_TAGS, TRUE, TRUTHS, Tag, value_text
from twinform.schemas import format_value

_TOUCHED = frozenset({"surface", "collision"})
_HOLDING = {"surface": "surface", "visual": "material"}
"""The fields of shapes in which tags set something, by the target of these."""
_DECAY = LINK_TAGS["dampingFactor"].target, LINK_TAGS["dampingFactor"].field
_OF_AXES = frozenset({"axis", "axis2", "springReference", "springStiffness"})


def place_of(element: Element, extension: GazeboExtension) -> Location:
    """Where an element of an extension stands; where the extension does, if a pass has made the element."""
    return element.location if element.source else extension.location


class Blob(NamedTuple):
    """What goes into every visual or collision of a link, from the extension of this number."""

    kind: str
    content: tuple[Element, ...]
    extension: GazeboExtension
    where: Location
    number: int

    def places_of(self, name: str) -> tuple[Location, ...]:
        """Where elements of this name stand in it."""
        found = (each for part in self.content for each in part.walk() if each.name == name)
        return tuple(place_of(each, self.extension) for each in found)


class TagValue(NamedTuple):
    """The value of a tag, from the extension of this number."""

    tag: Tag
    value: Any
    element: Element
    extension: GazeboExtension
    number: int

    @property
    def where(self) -> Location:
        """Where the tag stands."""
        return place_of(self.element, self.extension)

    def places_of(self, name: str) -> tuple[Location, ...]:
        """Where it stands, if it sets the field of this name or something in it."""
        return (self.where,) if name in {self.tag.field, _HOLDING.get(self.tag.target)} else ()


def places_of(name: str, before: Sequence[Blob | TagValue]) -> Iterator[Location]:
    """Where a field of shapes is set, from the last one on: by tags, and by the last element in a blob."""
    for each in reversed(before):
        if places := each.places_of(name):
            yield places[-1]
            if isinstance(each, Blob):
                return


class OverriddenTag(NamedTuple):
    """A tag behind which another one sets the same field."""

    element: Element
    extension: GazeboExtension
    message: str


def is_part_of_axis(element: Element) -> bool:
    """Whether it is about an axis, which a fixed joint has not."""
    return element.name in _OF_AXES


def lacks_shapes(link: Link, element: Element) -> bool:
    """Whether it is about visuals or collisions, of which the link has none."""
    if element.name in {"visual", "collision"}:
        return not (link.visuals if element.name == "visual" else link.collisions)
    tag = LINK_TAGS.get(element.name)
    if tag is None:
        return False
    return (tag.target == "visual" and not link.visuals) or (tag.target in _TOUCHED and not link.collisions)


class Sorter:
    """Takes the content of the extensions of one link, joint or model, one after the other.

    `tags` are those that mean something here, `elsewhere` those that do at another kind of reference. What is `unfit`
    means nothing here either; what is `idle` would, if there were anything for it to act on.
    """

    def __init__(
        self,
        tags: dict[str, Tag],
        elsewhere: frozenset[str],
        sink: DiagnosticSink,
        *,
        shapes: bool = False,
        unfit: Callable[[Element], bool] | None = None,
        idle: Callable[[Element], bool] | None = None,
    ) -> None:
        self._tags = tags
        self._elsewhere = elsewhere
        self._notes = sink
        self._shapes = shapes
        self._unfit = unfit
        self._idle = idle
        self._read: dict[tuple[str, str], TagValue] = {}
        self.overruled: list[OverriddenTag] = []
        self.blobs: list[Blob] = []
        self.rest: list[GazeboExtension] = []
        self.misplaced: list[tuple[GazeboExtension, list[Element]]] = []
        self.ignored: list[tuple[GazeboExtension, list[Element]]] = []
        self.without_use: list[tuple[GazeboExtension, list[Element]]] = []

    @property
    def values(self) -> list[tuple[Tag, Any]]:
        """The tags that were there and their values."""
        return [(read.tag, read.value) for read in self._read.values()]

    def in_order(self) -> list[tuple[list[Blob], list[TagValue]]]:
        """What sets something of shapes, one extension after the other: what goes into shapes, and then the tags.

        So libsdformat applies them, and a later one overrules an earlier one (parser_urdf.cc,
        InsertSDFExtensionCollision).
        """
        found: defaultdict[int, tuple[list[Blob], list[TagValue]]] = defaultdict(lambda: ([], []))
        for blob in self.blobs:
            found[blob.number][0].append(blob)
        for read in self._read.values():
            found[read.number][1].append(read)
        return [found[number] for number in sorted(found)]

    def forget(self, names: Iterable[str]) -> None:
        """Leave out of the rest what somebody else takes."""
        gone = frozenset(names)
        self.rest = [
            _refilled(extension, [e for e in extension.content if e.name not in gone]) for extension in self.rest
        ]

    def sort(self, extension: GazeboExtension) -> None:
        """Take the content of an extension."""
        rest: list[Element] = []
        misplaced: list[Element] = []
        ignored: list[Element] = []
        without_use: list[Element] = []
        for element in extension.content:
            tag = self._tags.get(element.name)
            if element.name in self._elsewhere or (self._unfit and self._unfit(element)):
                misplaced.append(element)
            elif self._idle and self._idle(element):
                without_use.append(element)
            elif self._is_blob(element):
                self._blob(element, extension)
            elif tag is None or element.children:
                rest.append(element)
            elif tag.target == "ignored":
                ignored.append(element)
            else:
                self._value(tag, element, extension)
        # libsdformat writes an element for each extension with this tag, and readers take the first:
        # parser_urdf.cc, InsertSDFExtensionLink
        if (decay := self._read.pop(_DECAY, None)) is not None:
            rest.insert(0, _decayed(decay))
        self.rest.append(_refilled(extension, rest))
        sorted_out = ((self.misplaced, misplaced), (self.ignored, ignored), (self.without_use, without_use))
        for place, elements in sorted_out:
            if elements:
                place.append((extension, elements))

    def _is_blob(self, element: Element) -> bool:
        return self._shapes and (
            element.name in {"visual", "collision"} or (element.name == "material" and bool(element.children))
        )

    def _blob(self, element: Element, extension: GazeboExtension) -> None:
        where = place_of(element, extension)
        if element.name == "material":
            self.blobs.append(Blob("visual", (element,), extension, where, len(self.rest)))
            return
        self._extra_attributes(element, extension, ())
        if element.text:
            message = f"text {element.text[:40]!r} in <{element.name}> of <gazebo>"
            self._notes.report(rules.STRAY_TEXT, message, where, found=element.text[:40])
            self._notes.account(Fate.DROPPED, rules.STRAY_TEXT, message, where)
        above = extension.source
        source = above and Source(above.file, where.line, above, element.name)
        inside = extension.copy(source=source)
        self.blobs.append(Blob(element.name, element.children, inside, where, len(self.rest)))

    def _value(self, tag: Tag, element: Element, extension: GazeboExtension) -> None:
        self._extra_attributes(element, extension, ("value",))
        text = value_text(element)
        try:
            value = tag.read(text)
        except ValueError:
            message = f"<{element.name}> in <gazebo> is {text!r}; expected a value of its type"
            self._notes.report(rules.INVALID_VALUE, message, place_of(element, extension), found=text)
            return
        # libsdformat compares the text with a few words and takes all others for the same value, so
        # a slip changes the robot silently.
        if tag.read in TRUTHS and text.lower() not in TRUE | FALSE:
            message = f"<{element.name}> in <gazebo> is {text!r}, which Gazebo takes for {str(value).lower()}"
            expected = "true or false"
            warning = Severity.ERROR if self._notes.strict else Severity.WARNING
            where = place_of(element, extension)
            self._notes.report(rules.INVALID_VALUE, message, where, found=text, expected=expected, severity=warning)
        self._set(TagValue(tag, value, element, extension, len(self.rest)))

    def _set(self, read: TagValue) -> None:
        """The last one counts, as in libsdformat."""
        key = (read.tag.target, read.tag.field)
        before = self._read.get(key)
        if before is not None and before.value != read.value:
            message = f"<{read.element.name}> in <gazebo> has another value than before; the last one is used"
            related = (before.where,)
            self._notes.report(
                rules.GAZEBO_CONFLICT, message, read.where, found=value_text(read.element), related=related
            )
            self.overruled.append(OverriddenTag(before.element, before.extension, message))
        self._read[key] = read

    def _extra_attributes(self, element: Element, extension: GazeboExtension, known: tuple[str, ...]) -> None:
        for name, value in element.attributes:
            if name not in known:
                message = f"{name!r} is not an attribute of <{element.name}> in <gazebo>"
                where = place_of(element, extension).at(f"@{name}")
                self._notes.report(rules.UNKNOWN_ATTRIBUTE, message, where, found=value)
                self._notes.account(Fate.DROPPED, rules.UNKNOWN_ATTRIBUTE, message, where)


def _decayed(read: TagValue) -> Element:
    """The element of SDF that a `<dampingFactor>` means."""
    text = format_value(read.value)
    parts = (Element.unchecked(name="linear", text=text), Element.unchecked(name="angular", text=text))
    return read.element.copy(name="velocity_decay", attributes=(), text=None, children=parts)


def _refilled(extension: GazeboExtension, content: list[Element]) -> GazeboExtension:
    return extension.copy(content=tuple(content))
