"""Elements of canonical MJCF while they are lowered, which know what of them the document expresses by now.

Whoever lowers an attribute takes it; what nobody has taken is the remainder, which travels in `<tf:mjcf>` and stands in
the ledger. So nothing of a file can be forgotten: what no code knows is a remainder.
"""

import math
from collections import Counter
from collections.abc import Iterator

from twinform.compiler.input.mjcf.number_lists import Numbers
from twinform.diagnostics import Location, Source
from twinform.ir import Element, Pose
from twinform.ir.transform import Transform, rounded, rounded_number
from twinform.schemas import XmlElement
from twinform.schemas.xml import children


class Piece:
    """An element of canonical MJCF.

    Attributes:
        tag: the name of the element.
        name: the attribute `name`; `None` where it is missing or empty.
        source: where it was written.
        inside: the elements in it, in their order.
        taken: the attributes that the document expresses.
        kept: the attributes that are in a remainder.
        is_settled: whether the document expresses the element, or holds its remainder.
    """

    __slots__ = ("_attributes", "inside", "is_settled", "kept", "name", "source", "tag", "taken")

    def __init__(self, element: XmlElement, file: str, above: Source | None = None, place: int | None = None) -> None:
        self.tag = str(element.tag)
        self._attributes = {str(name): str(value) for name, value in element.items()}
        self.name = self._attributes.get("name") or None
        self.source = Source(file, element.sourceline or 0, above, self.tag, self.name or place)
        self.inside = tuple([Piece(child, file, self.source, place) for child, place in _placed(element)])
        self.taken: set[str] = set()
        self.kept: set[str] = set()
        self.is_settled = False

    @property
    def location(self) -> Location:
        """Where it was written."""
        return self.source.location

    def has(self, attribute: str) -> bool:
        """Tell whether an attribute is written, without taking it."""
        return attribute in self._attributes

    def peek(self, attribute: str) -> str | None:
        """Return the value of an attribute without taking it."""
        return self._attributes.get(attribute)

    def take(self, attribute: str) -> str | None:
        """Return the value of an attribute, which the document expresses from now on."""
        value = self._attributes.get(attribute)
        if value is not None:
            self.taken.add(attribute)
        return value

    def leave(self, *attributes: str) -> None:
        """Give taken attributes back, because the document expresses them only in part."""
        self.taken.difference_update(attributes)

    def numbers(self, attribute: str) -> Numbers:
        """Take an attribute of numbers; none where it is missing."""
        return numbers_in(self.take(attribute))

    def number(self, attribute: str) -> float | None:
        """Take an attribute of one number, or the first of several."""
        found = self.numbers(attribute)
        return found[0] if found else None

    def peek_numbers(self, attribute: str) -> Numbers:
        """Return the numbers of an attribute without taking it."""
        return numbers_in(self.peek(attribute))

    def is_true(self, attribute: str, *, default: bool = False) -> bool:
        """Take a boolean attribute."""
        value = self.take(attribute)
        return default if value is None else value == "true"

    def transform(self) -> Transform:
        """Take `pos` and `quat`: the pose in the frame of the element around it."""
        xyz, quat = self.numbers("pos"), self.numbers("quat")
        return placed_at(xyz, quat)

    def all_of(self, *tags: str) -> Iterator["Piece"]:
        """Yield the elements in it that have one of these names, in their order."""
        return (each for each in self.inside if each.tag in tags)

    def find(self, tag: str) -> "Piece | None":
        """Return the first element in it that has this name."""
        return next(self.all_of(tag), None)

    def bodies(self) -> "Iterator[Piece]":
        """Yield this body and all bodies in it, outer ones first, but not what stands where no body can be."""
        waiting: list[Piece] = [self]
        while waiting:
            here = waiting.pop()
            yield here
            waiting.extend(reversed(tuple(here.all_of("body"))))

    def walk(self) -> "Iterator[Piece]":
        """Yield this element and all below it, outer elements first."""
        waiting: list[Piece] = [self]
        while waiting:
            here = waiting.pop()
            yield here
            waiting.extend(reversed(here.inside))

    @property
    def untaken(self) -> tuple[tuple[str, str], ...]:
        """The attributes that the document does not express, in their order."""
        return tuple(pair for pair in self._attributes.items() if pair[0] not in self.taken)

    @property
    def forgotten(self) -> tuple[str, ...]:
        """The attributes that are neither expressed nor kept, which nothing should have when a file is lowered."""
        return tuple(name for name in self._attributes if name not in self.taken and name not in self.kept)

    @property
    def attributes(self) -> tuple[str, ...]:
        """The names of the attributes, in their order."""
        return tuple(self._attributes)

    def whole(self) -> Element:
        """Return the element with all in it."""
        inside = tuple(each.whole() for each in self.inside)
        return Element.unchecked(name=self.tag, attributes=tuple(self._attributes.items()), children=inside)


def _placed(element: XmlElement) -> Iterator[tuple[XmlElement, int | None]]:
    """Yield the elements in an element, each with its place among its like, or None where it is the only one."""
    inside = list(children(element))
    if not inside:  # as in most, and a counter takes longer than the rest
        return
    alike = Counter(str(child.tag) for child in inside)
    places = Counter[str]()
    for child in inside:
        places[str(child.tag)] += 1
        yield child, places[str(child.tag)] if alike[str(child.tag)] > 1 else None


def numbers_in(text: str | None) -> Numbers:
    """Return the numbers in the value of an attribute."""
    return tuple(map(float, (text or "").split()))


def placed_at(xyz: Numbers, wxyz: Numbers = ()) -> Transform:
    """Return the transform of a position in m and a quaternion w x y z, either of which may be missing."""
    at = (xyz[0], xyz[1], xyz[2]) if xyz else None
    turn = (wxyz[1], wxyz[2], wxyz[3], wxyz[0]) if wxyz else None
    return Transform.from_pose(Pose.unchecked(xyz=at, quat_xyzw=turn))


def pose_of(at: Transform, relative_to: str | None = None, source: Source | None = None) -> Pose | None:
    """Return the pose of a transform, or None for one that is the identity in the frame of its holder.

    Orientations are quaternions: roll, pitch and yaw would lose a digit on the way back.
    """
    if at.is_identity and relative_to is None:
        return None
    xyz = rounded(at.translation) if any(at.translation) else None
    if at.is_unturned:
        return Pose.unchecked(xyz=xyz, relative_to=relative_to, source=source)
    quat = _unit(at.notation.quat_xyzw if at.notation and at.notation.quat_xyzw else at.quaternion())
    x, y, z, w = map(rounded_number, quat)
    return Pose.unchecked(
        xyz=xyz,
        quat_xyzw=(x, y, z, w),
        rotation_format="quat_xyzw",
        relative_to=relative_to,
        source=source,
    )


def _unit(quat: tuple[float, float, float, float]) -> tuple[float, float, float, float]:
    """Return a quaternion of length one; one that is so but for rounding stays as it is."""
    length = math.hypot(*quat)
    if math.isclose(length, 1.0, rel_tol=1e-15):
        return quat
    x, y, z, w = quat
    return (x / length, y / length, z / length, w / length)
