"""Parsers of usual values, for the generated readers: None for a text that the schema reader must see."""

from collections.abc import Callable
from math import isfinite
from operator import attrgetter
from typing import Any

from twinform.schemas import VALUE_TYPES, XmlElement

__all__ = [
    "BOOLS",
    "color",
    "color4",
    "double",
    "integer",
    "loose_double",
    "natural",
    "only_text",
    "pose",
    "quaternion",
    "stripped",
    "text_of",
    "vector2d",
    "vector3",
]

Vector3 = tuple[float, float, float]

# No validation by Pydantic follows. All that it could refuse is a node without a required field, or
# with a word that its class does not have, and for these there is a finding.
BOOLS: dict[str | None, bool] = {"true": True, "false": False}
"""The usual spellings; others are noted."""


text_of: Callable[[XmlElement], str | None] = attrgetter("text")
"""The text of an element that is known to have nothing else."""


def only_text(element: XmlElement) -> str | None:
    """The text of an element that has nothing else; None where it has."""
    text = element.text
    return None if text is None or len(element) or element.keys() else text


def stripped(text: str | None) -> str | None:
    """The text without the white space around it; None where nothing is left."""
    return None if text is None else text.strip(" \t\r\n") or None


def double(text: str | None) -> float | None:
    """A finite number."""
    if text is None:
        return None
    try:
        value = float(text)
    except ValueError:
        return None
    return value if isfinite(value) and text.isascii() and "_" not in text else None


def loose_double(text: str | None) -> float | None:
    """A number that may be infinite, or none at all."""
    value = double(text)
    return _infinite(text) if value is None else value


_KNOWN: dict[str | None, Vector3] = {
    "0 0 0": (0.0, 0.0, 0.0),
    "0.0 0.0 0.0": (0.0, 0.0, 0.0),
    "0 0 1": (0.0, 0.0, 1.0),
    "0 1 0": (0.0, 1.0, 0.0),
    "1 0 0": (1.0, 0.0, 0.0),
    "1 1 1": (1.0, 1.0, 1.0),
}
"""Most vectors of real files are one of these."""


def vector3(text: str | None) -> Vector3 | None:
    """Three finite numbers."""
    known = _KNOWN.get(text)
    if known is not None or text is None:
        return known
    try:
        first, second, third = text.split(None, 3)  # a fourth is enough to see that it is no vector
        x, y, z = float(first), float(second), float(third)  # quicker than `map`
    except ValueError:
        return None
    return (x, y, z) if isfinite(x + y + z) and text.isascii() and "_" not in text else None


def pose(text: str | None) -> tuple[Vector3, Vector3] | None:
    """Six finite numbers: a translation and a rotation."""
    if text is None:
        return None
    try:
        x, y, z, roll, pitch, yaw = map(float, text.split(None, 6))
    except ValueError:
        return None
    if isfinite(x + y + z + roll + pitch + yaw) and text.isascii() and "_" not in text:
        return (x, y, z), (roll, pitch, yaw)
    return None


def _usual(format: str, type: str) -> Callable[[str | None], Any]:
    """The parser of a value type, which is of SDF where both formats have it."""
    parse = VALUE_TYPES[format][type].parse

    def read(text: str | None) -> Any:
        try:
            return None if text is None else parse(text)
        except ValueError:
            return None

    return read


_infinite = _usual("sdf", "double")
integer = _usual("sdf", "int")
natural = _usual("sdf", "uint")
vector2d = _usual("sdf", "vector2d")
color = _usual("sdf", "color")
color4 = _usual("urdf", "color4")
quaternion = _usual("urdf", "quaternion")
