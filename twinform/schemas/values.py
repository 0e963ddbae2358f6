"""Value types: how the text of an attribute or a leaf becomes a value, and back.

Every parser raises `ValueError` for text that the type's XSD pattern refuses, and for numbers that do not fit a double.
"""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

Parser = Callable[[str], object]


@dataclass(frozen=True, slots=True)
class ValueType:
    """A value type: its parser, and what to call it when the text does not fit."""

    parse: Parser
    expected: str


def format_number(value: float) -> str:
    """The shortest text that reads back as the same double."""
    return repr(value).removesuffix(".0")


def format_value(value: object) -> str:
    """The text of a value of any type."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return format_number(value)
    if isinstance(value, tuple):
        return " ".join(map(format_value, value))  # pyright: ignore[reportUnknownArgumentType]
    return str(value)


def format_numbers(values: tuple[float, ...]) -> str:
    """The text of a vector."""
    return " ".join(map(format_number, values))


_TRUE = frozenset({"true", "1"})
_FALSE = frozenset({"false", "0"})


def _ascii(text: str) -> str:
    """The text, if it is ASCII: blanks and digits of other scripts are none of the formats'."""
    if not text.isascii():
        raise ValueError
    return text


def _is_plain(text: str) -> bool:
    """Whether none of what `float` takes beyond plain numbers is there: underscores and the digits of other scripts."""
    return text.isascii() and "_" not in text


def _float(text: str) -> float:
    value = float(text)
    if not math.isfinite(value) or not _is_plain(text):
        raise ValueError
    return value


def _loose_float(text: str) -> float:
    value = float(text)
    if math.isfinite(value):
        return _float(text)
    # 1e400 is no number, although float() gives infinity
    if _ascii(text).strip().lstrip("+-").lower() not in {"inf", "nan"}:
        raise ValueError
    return value


def _vector(counts: tuple[int, ...]) -> Parser:
    most = max(counts)

    def parse(text: str) -> tuple[float, ...]:
        # what stands behind the last number remains one word, so that a million of them cost no more than one
        words = text.split(None, most)
        if len(words) not in counts:
            raise ValueError
        values = tuple(map(float, words))
        # a finite sum has finite terms, and is quicker to see
        if (math.isfinite(sum(values)) or all(map(math.isfinite, values))) and _is_plain(text):
            return values
        raise ValueError

    return parse


def parse_bool(text: str) -> bool:
    """`true`, `false`, `1` or `0` in any case, as libsdformat reads them."""
    word = _ascii(text).strip().lower()
    if word in _TRUE:
        return True
    if word in _FALSE:
        return False
    raise ValueError


_INTEGER = re.compile(r"\s*(?P<hex>[-+]?0[xX][0-9a-fA-F]+)\s*|\s*(?P<decimal>[-+]?[0-9]+)(\.0*)?\s*", re.ASCII)


def _int(text: str) -> int:
    """`640`, `0x280` or `640.0`, as many files have it; a fraction of zero is none."""
    found = _INTEGER.fullmatch(text)
    if not found:
        raise ValueError
    return int(found["hex"], 16) if found["hex"] else int(found["decimal"])


def _uint(text: str) -> int:
    value = _int(text)
    if value < 0:
        raise ValueError
    return value


def _ints(text: str) -> tuple[int, ...]:
    first, second = map(_int, _ascii(text).split(None, 2))
    return first, second


def _time(text: str) -> tuple[float, ...] | float:
    words = _ascii(text).split(None, 2)
    return tuple(map(_float, words)) if len(words) == 2 else _float(text)


def _string(text: str) -> str:
    return text


_URDF = {
    "string": ValueType(_string, "text"),
    "bool": ValueType(parse_bool, "true or false"),
    "int": ValueType(_int, "a whole number"),
    "uint": ValueType(_uint, "a whole number that is not negative"),
    "double": ValueType(_float, "a finite number"),
    "vector3": ValueType(_vector((3,)), "three numbers"),
    "quaternion": ValueType(_vector((4,)), "four numbers: x y z w"),
    "color4": ValueType(_vector((4,)), "four numbers from 0 to 1: red green blue alpha"),
}

_SDF = _URDF | {
    "double": ValueType(_loose_float, "a number"),
    "vector2d": ValueType(_vector((2,)), "two numbers"),
    "vector2i": ValueType(_ints, "two whole numbers"),
    "quaternion": ValueType(_vector((3, 4)), "three or four numbers"),
    "color": ValueType(_vector((3, 4)), "three or four numbers from 0 to 1: red green blue and perhaps alpha"),
    "pose": ValueType(
        _vector((6, 7)), "six numbers, x y z roll pitch yaw, or seven with a quaternion: x y z qx qy qz qw"
    ),
    "time": ValueType(_time, "seconds, or seconds and nanoseconds"),
}

VALUE_TYPES = {"urdf": _URDF, "sdf": _SDF}


def parse_value(type: str, text: str, format: str = "sdf") -> object:
    """The value of a text.

    Raises:
        ValueError: the text is not of the type.
    """
    return VALUE_TYPES[format][type].parse(text)
