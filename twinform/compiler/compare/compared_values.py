"""The kinds of values that are compared, and how far two values are apart."""

import math
from collections.abc import Iterator, Sequence
from typing import Self

from twinform.dataclass import dataclass
from twinform.ir import Vector3
from twinform.ir.solids import ELEMENTS, Symmetric, turned
from twinform.ir.transform import Transform
from twinform.passes.legalise.changed_names import with_alpha
from twinform.schemas import format_value, parse_value

_DIGITS = 10
# Numbers that are closer than this are equal: libsdformat reads none below, and conversions round them up.
_NOTHING = 1e-37


@dataclass(frozen=True, slots=True)
class Delta:
    """How far two values are apart.

    The tolerance is a share of `scale`. `size` is the larger of the two magnitudes, and `aspect` names the part of the
    values that differs.
    """

    absolute: float
    scale: float
    a: str
    b: str
    unit: str = ""
    aspect: str = ""
    size: float = 0.0

    @property
    def relative(self) -> float | None:
        """The distance as a share of the size; None where the values have no size."""
        return self.absolute / self.size if self.size and math.isfinite(self.absolute) else None

    def exceeds(self, tolerance: float) -> bool:
        """Whether the distance is more than rounding."""
        return self.absolute > tolerance * self.scale


class Value:
    """A value of some kind. Points, directions, poses and tensors can be expressed in another frame."""

    __slots__ = ()

    def seen_from(self, base: Transform) -> Self:
        """Return the value expressed in a frame that `base` places in the model."""
        return self


@dataclass(frozen=True, slots=True)
class Text(Value):
    """A text."""

    text: str


@dataclass(frozen=True, slots=True)
class Flag(Value):
    """A boolean."""

    on: bool


@dataclass(frozen=True, slots=True)
class Numbers(Value):
    """One or several numbers, in a unit; `floor` is the least scale for their tolerance."""

    values: tuple[float, ...]
    unit: str = ""
    floor: float = 0.0


@dataclass(frozen=True, slots=True)
class Point(Value):
    """A point in the model's frame, in meters."""

    xyz: Vector3

    def seen_from(self, base: Transform) -> "Point":
        """Return the point in another frame."""
        return Point(base.inverse().apply(self.xyz))


@dataclass(frozen=True, slots=True)
class UnitVector(Value):
    """A unit vector in the model's frame."""

    xyz: Vector3

    def seen_from(self, base: Transform) -> "UnitVector":
        """Return the direction in another frame."""
        return UnitVector(base.inverse().rotate(self.xyz))


@dataclass(frozen=True, slots=True)
class PoseValue(Value):
    """A pose in the model's frame."""

    pose: Transform

    def seen_from(self, base: Transform) -> "PoseValue":
        """Return the pose in another frame."""
        return PoseValue(base.inverse().compose(self.pose))


@dataclass(frozen=True, slots=True)
class Tensor(Value):
    """A rotational inertia, kg m^2: xx, yy, zz, xy, xz, yz in the axes of the model's frame."""

    moments: Symmetric

    def seen_from(self, base: Transform) -> "Tensor":
        """Return the tensor in the axes of another frame."""
        return Tensor(turned(self.moments, base.inverse()))


def gaps(a: Value, b: Value) -> Iterator[Delta]:
    """Yield how far two values are apart, for each aspect; nothing where they are exactly equal."""
    if a == b:
        return
    match a, b:
        case (Flag(), Numbers()) | (Numbers(), Flag()) if _number_of(a) == _number_of(b):
            return  # free content has no types, and 1 is as good as true
        case Numbers(), Numbers() if len(a.values) == len(b.values):
            yield from _number_gaps(a, b)
        case PoseValue(), PoseValue():
            yield from _pose_gaps(a.pose, b.pose)
        case Point(), Point():
            yield _distance(a.xyz, b.xyz)
        case UnitVector(), UnitVector():
            yield Delta(_angle_between(a.xyz, b.xyz), 1.0, _format_row(a.xyz), _format_row(b.xyz), "rad")
        case Tensor(), Tensor():
            yield from _tensor_gaps(a, b)
        case _:
            yield Delta(math.inf, 1.0, show(a), show(b))


def _number_of(value: Flag | Numbers) -> tuple[float, ...]:
    return (float(value.on),) if isinstance(value, Flag) else value.values


def show(value: Value) -> str:
    """Return a value as text."""
    match value:
        case Text():
            return repr(value.text)
        case Flag():
            return format_value(value.on)
        case Numbers():
            return _format_row(value.values) + (f" {value.unit}" if value.unit else "")
        case Point() | UnitVector():
            return _format_row(value.xyz)
        case PoseValue():
            return f"{_format_row(value.pose.translation)} m, {_format_row(value.pose.rpy())} rad"
        case Tensor():
            return f"{_format_row(value.moments)} kg*m^2"
        case _:
            return ""


def _number_gaps(a: Numbers, b: Numbers) -> Iterator[Delta]:
    apart = [_number_distance(one, other) for one, other in zip(a.values, b.values, strict=True)]
    if any(apart):
        unit = a.unit or b.unit
        size = _size((*a.values, *b.values))
        yield Delta(max(apart), max(a.floor, b.floor, size), show(a), show(b), unit, size=size)


def _size(numbers: Sequence[float]) -> float:
    """Return the largest magnitude of the finite numbers: a NaN among them would make every gap small."""
    return max((abs(number) for number in numbers if math.isfinite(number)), default=0.0)


def _number_distance(one: float, other: float) -> float:
    """Return the distance of two numbers; two NaN are equal, and one is infinitely far from any number."""
    if one == other or (math.isnan(one) and math.isnan(other)):
        return 0.0
    gap = abs(one - other)
    return 0.0 if gap < _NOTHING else gap if math.isfinite(gap) else math.inf


def _pose_gaps(a: Transform, b: Transform) -> Iterator[Delta]:
    yield _distance(a.translation, b.translation)
    yield Delta(
        _rotation_angle(a, b), 1.0, f"{_format_row(a.rpy())} rad", f"{_format_row(b.rpy())} rad", "rad", "rotation"
    )


def _distance(a: Vector3, b: Vector3) -> Delta:
    size = max(math.hypot(*a), math.hypot(*b))
    return Delta(math.dist(a, b), max(1.0, size), f"{_format_row(a)} m", f"{_format_row(b)} m", "m", "position", size)


def _rotation_angle(a: Transform, b: Transform) -> float:
    """Return the angle between two rotations: |A - B| is 2 sqrt(2) sin(angle / 2), which is exact for small angles."""
    chord = math.dist(a.rotation, b.rotation)
    return 2 * math.asin(min(1.0, chord / math.sqrt(8)))


def _angle_between(a: Vector3, b: Vector3) -> float:
    return 2 * math.asin(min(1.0, math.dist(a, b) / 2))


def _tensor_gaps(a: Tensor, b: Tensor) -> Iterator[Delta]:
    """Yield the gap of the element that differs most, with the largest element as its scale."""
    apart = [_number_distance(one, other) for one, other in zip(a.moments, b.moments, strict=True)]
    worst = apart.index(max(apart))
    scale = _size((*a.moments, *b.moments))
    one, other = (f"{_format_number(each.moments[worst])} kg*m^2" for each in (a, b))
    yield Delta(apart[worst], scale, one, other, "kg*m^2", ELEMENTS[worst], scale)


def _format_row(values: Sequence[float]) -> str:
    return " ".join(map(_format_number, values))


def _format_number(value: float) -> str:
    """Format a number to ten digits, with zero for what rounding leaves of zero."""
    return f"{0.0 if abs(value) < 1e-15 else value:.{_DIGITS}g}"


NUMBERS = frozenset({"double", "int", "uint", "vector3", "vector2d", "vector2i", "quaternion", "time"})
_LISTS = ("double", "int.", "ints")
"""How the types of lists of numbers begin, such as `double.1-3`."""
COLORS = frozenset({"color", "color4"})


def typed_value(type: str | None, text: str, format: str = "sdf", unit: str = "") -> Value | None:
    """Read a text of a boolean or numeric type; return None for other types.

    A text that is not of its type is kept as text.
    """
    if type is None or not (type == "bool" or type in NUMBERS or type in COLORS or type.startswith(_LISTS)):
        return None
    try:
        parsed = parse_value(type, text, format)
    except ValueError:
        return Text(text)
    if isinstance(parsed, bool):
        return Flag(parsed)
    numbers = tuple(map(float, text.split())) if isinstance(parsed, tuple) else (float(str(parsed)),)
    return Numbers(with_alpha(numbers) if type in COLORS else numbers, unit)
