"""Value types: how the text of an attribute or a leaf becomes a value, and back.

Every parser raises `ValueError` for text that the type's XSD pattern refuses, and for numbers that do not fit a double.
"""

import re
from collections.abc import Callable
from functools import partial
from math import isfinite
from typing import TypeVar

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern

Parser = Callable[[str], object]
_Word = TypeVar("_Word")


@dataclass(frozen=True, slots=True)
class ValueType:
    """A value type: its parser, and its name in the message about a text that does not fit."""

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
    return f"{' '.join(map(repr, values))} ".replace(".0 ", " ")[:-1]  # takes half as long as one by one


_TRUE = frozenset({"true", "1"})
_FALSE = frozenset({"false", "0"})


def _ascii(text: str) -> str:
    """Return the text if it is ASCII: the formats have no blanks and digits of other scripts."""
    if not text.isascii():
        raise ValueError
    return text


def _float(text: str) -> float:
    value = float(text)
    # `float` also takes underscores and the digits of other scripts
    if isfinite(value) and text.isascii() and "_" not in text:
        return value
    raise ValueError


def _loose_float(text: str) -> float:
    value = float(text)
    # 1e400 is no number, although float() gives infinity
    is_meant = isfinite(value) or text.strip().lstrip("+-").lower() in {"inf", "nan"}
    if is_meant and text.isascii() and "_" not in text:
        return value
    raise ValueError


def _vector(counts: tuple[int, ...]) -> Callable[[str], tuple[float, ...]]:
    most = max(counts)

    def parse(text: str) -> tuple[float, ...]:
        # what stands behind the last number remains one word, so that a million of them cost no more than one
        values = tuple(map(float, text.split(None, most)))
        # a finite sum has finite terms, and is quicker to see
        is_finite = isfinite(sum(values)) or all(map(isfinite, values))
        if len(values) in counts and is_finite and text.isascii() and "_" not in text:
            return values
        raise ValueError

    return parse


_any_pose = _vector((6, 7))


def _pose(text: str) -> tuple[float, ...]:
    words = text.split(None, 7)
    if len(words) != 6:
        return _any_pose(text)
    x, y, z, roll, pitch, yaw = map(float, words)
    if isfinite(x + y + z + roll + pitch + yaw) and text.isascii() and "_" not in text:
        return x, y, z, roll, pitch, yaw
    return _any_pose(text)


_any_vector3 = _vector((3,))
_USUAL = {text: _any_vector3(text) for text in ("0 0 0", "0.0 0.0 0.0", "0 0 1", "0 1 0", "1 0 0", "1 1 1")}
"""Most vectors of real files are one of these."""


def _vector3(text: str) -> tuple[float, ...]:
    known = _USUAL.get(text)
    if known is not None:
        return known
    first, second, third = text.split(None, 3)
    x, y, z = float(first), float(second), float(third)  # quicker than `map`
    if isfinite(x + y + z) and text.isascii() and "_" not in text:
        return x, y, z
    return _any_vector3(text)


def parse_bool(text: str) -> bool:
    """Parse `true`, `false`, `1` or `0` in any case, as libsdformat does."""
    word = _ascii(text).strip().lower()
    if word in _TRUE:
        return True
    if word in _FALSE:
        return False
    raise ValueError


_INTEGER = lazy_pattern(r"\s*(?P<hex>[-+]?0[xX][0-9a-fA-F]+)\s*|\s*(?P<decimal>[-+]?[0-9]+)(\.0*)?\s*", re.ASCII)


def _int(text: str) -> int:
    """Parse `640`, `0x280` or `640.0`; many files have whole numbers with a zero fraction."""
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
    "vector3": ValueType(_vector3, "three numbers"),
    "quaternion": ValueType(_vector((4,)), "four numbers: x y z w"),
    "color4": ValueType(_vector((4,)), "four numbers from 0 to 1: red green blue alpha"),
}

_SDF = _URDF | {
    "double": ValueType(_loose_float, "a number"),
    "vector2d": ValueType(_vector((2,)), "two numbers"),
    "vector2i": ValueType(_ints, "two whole numbers"),
    "quaternion": ValueType(_vector((3, 4)), "three or four numbers"),
    "color": ValueType(_vector((3, 4)), "three or four numbers from 0 to 1: red green blue and perhaps alpha"),
    "pose": ValueType(_pose, "six numbers, x y z roll pitch yaw, or seven with a quaternion: x y z qx qy qz qw"),
    "time": ValueType(_time, "seconds, or seconds and nanoseconds"),
}

_SPELLED = {"true": True, "false": False}
_DECIMAL = lazy_pattern(r"[-+]?[0-9]+")
_MEMORY = lazy_pattern(r"-1|[0-9]+[KMGTPEkmgtpe]?")
_AXES = lazy_pattern("[xyzXYZ]{3}")
_BLANKS = lazy_pattern(r"[ \t\n\r]+")
_LARGEST = 2**31


def _exact_bool(text: str) -> bool:
    """Parse `true` or `false` as MuJoCo does, which takes nothing else."""
    if text not in _SPELLED:
        raise ValueError
    return _SPELLED[text]


def _parse_whole_number(text: str) -> int:
    """Parse a decimal number of 32 bits."""
    word = text.strip(" \t\n\r")
    if not _DECIMAL.fullmatch(word) or len(word) > 11 or not -_LARGEST <= int(word) < _LARGEST:
        raise ValueError
    return int(word)


def _spelled(pattern: re.Pattern[str]) -> Parser:
    """Return the parser of texts that a pattern describes."""

    def parse(text: str) -> str:
        if not pattern.fullmatch(text):
            raise ValueError
        return text

    return parse


def _list(parse_word: Callable[[str], _Word], least: int, most: int | None) -> Callable[[str], tuple[_Word, ...]]:
    """Return the parser of several words with blanks between them; `most` is None for any number."""

    def parse(text: str) -> tuple[_Word, ...]:
        words = _ascii(text).split(None, -1 if most is None else most)
        if len(words) < least or (most is not None and len(words) > most):
            raise ValueError
        return tuple(map(parse_word, words))

    return parse


def _loose_numbers(least: int, most: int | None) -> Callable[[str], tuple[float, ...]]:
    """Return the parser of several numbers, which may be infinite or none."""
    parse_each = _list(_loose_float, least, most)

    def parse(text: str) -> tuple[float, ...]:
        try:
            values = tuple(map(float, text.split(None, -1 if most is None else most)))
        except ValueError:
            return parse_each(text)
        # a finite sum has finite terms, and is quicker to see
        is_plain = isfinite(sum(values)) and text.isascii() and "_" not in text
        if is_plain and len(values) >= least and (most is None or len(values) <= most):
            return values
        return parse_each(text)

    return parse


def _words(text: str) -> tuple[str, ...]:
    return tuple(filter(None, _BLANKS.split(text)))  # names may have blanks of other scripts


def list_type(base: str, least: int, most: int) -> str:
    """Return the name of the type of lists of `double` or `int` with some length: `double.3`, `int.1-31`."""
    return f"{base}.{least}" if least == most else f"{base}.{least}-{most}"


LENGTHS = {
    "double": ((2, 2), (4, 4), (6, 6), (7, 7), (1, 2), (1, 3), (1, 5), (1, 6), (1, 10)),
    "int": ((2, 2), (3, 3), (1, 31)),
}
"""The lengths of the lists that MJCF has, beside vectors of three numbers and of any number."""
_COUNTED = {1: "one", 2: "two", 3: "three", 4: "four", 5: "five", 6: "six", 7: "seven", 10: "ten"}


def _counted_lists(base: str, parser: Callable[[int, int], Parser], called: str) -> dict[str, ValueType]:
    """Return the types of lists by their names; `parser` makes the parser of a length, `called` stands in messages."""
    made: dict[str, ValueType] = {}
    for least, most in LENGTHS[base]:
        count = _COUNTED.get(most, str(most))
        count = count if least == most else f"{_COUNTED[least]} to {count}"
        made[list_type(base, least, most)] = ValueType(parser(least, most), f"{count} {called}")
    return made


_MJCF = {
    "string": ValueType(_string, "text"),
    "words": ValueType(_words, "words"),
    "bool": ValueType(_exact_bool, "true or false"),
    "int": ValueType(_parse_whole_number, "a whole number"),
    "double": ValueType(_loose_float, "a number"),
    "vector3": ValueType(_loose_numbers(3, 3), "three numbers"),
    "quaternion": ValueType(_loose_numbers(4, 4), "four numbers: w x y z"),
    "color4": ValueType(_loose_numbers(4, 4), "four numbers: red green blue alpha"),
    "doubles": ValueType(_loose_numbers(0, None), "numbers"),
    "ints": ValueType(_list(_parse_whole_number, 0, None), "whole numbers"),
    "memory": ValueType(_spelled(_MEMORY), "a number of bytes, perhaps with K, M, G, T, P or E behind it, or -1"),
    "axes": ValueType(_spelled(_AXES), "three letters of x, y, z, X, Y, Z"),
    **_counted_lists("double", _loose_numbers, "numbers"),
    **_counted_lists("int", partial(_list, _parse_whole_number), "whole numbers"),
}

VALUE_TYPES = {"urdf": _URDF, "sdf": _SDF, "mjcf": _MJCF}


def type_name(type: str) -> str:
    """Return what people call a value type: `double.1-3` is one to three numbers."""
    return _MJCF[type].expected if "." in type else type


def parse_value(type: str, text: str, format: str = "sdf") -> object:
    """The value of a text.

    Raises:
        ValueError: the text is not of the type.
    """
    return VALUE_TYPES[format][type].parse(text)
