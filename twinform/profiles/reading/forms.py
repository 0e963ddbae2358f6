"""Forms of values: whether a reader understands a text as a number, as so many numbers, or as one of some words.

`stream` is a number as a C++ stream reads it in full, `python` as Python does, `atof` as C does, which takes the
beginning and never fails. A digit after the name is how many there have to be, separated as that reader does it.
"""

import math
import re
from collections.abc import Callable, Mapping

_STREAM = re.compile(r"[ \t\n\v\f\r]*[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", re.ASCII)
_C = re.compile(
    r"[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|0[xX][0-9a-fA-F]+|inf(?:inity)?|nan)", re.ASCII | re.IGNORECASE
)
_SHORTEST = 1e-6
"""Engines take no direction from a shorter vector."""
_VERSION = re.compile(r"\s*[-+]?0*(\d+)\.\s*[-+]?0*(\d+)", re.ASCII)


def _stream(text: str) -> bool:
    return _STREAM.fullmatch(text) is not None and math.isfinite(float(text))


def _python(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _pieces(text: str) -> list[str]:
    """At blanks alone: a tab or a new line belongs to the number."""
    return [piece for piece in text.split(" ") if piece]


def _streams(text: str) -> list[bool]:
    return [_stream(piece) for piece in _pieces(text)]


def _of_unit(text: str) -> bool:
    """Whether every number is one from 0 to 1, as urdfdom wants them in colors."""
    return all(_stream(piece) and 0 <= float(piece) <= 1 for piece in _pieces(text))


def _pythons(text: str, *counts: int) -> bool:
    pieces = text.split()
    return all(map(_python, pieces)) and (not counts or len(pieces) in counts)


def _versions(*known: tuple[int, int]) -> Callable[[str], bool]:
    def reads(text: str) -> bool:
        found = _VERSION.fullmatch(text)
        return found is not None and (int(found[1]), int(found[2])) in known

    return reads


def fits_bytes(text: str) -> bool:
    """Whether there are four numbers, or one, that fit into bytes when they are multiplied by 255."""
    pieces = text.split()
    if len(pieces) not in {1, 4} or not all(map(_python, pieces)):
        return False
    return all(math.isfinite(float(piece)) and 0 <= int(float(piece) * 255) <= 255 for piece in pieces)


def _bounded(text: str) -> bool:
    """Whether no number is infinite; NaN is none."""
    return not any(_python(piece) and math.isinf(float(piece)) for piece in text.replace(",", " ").split())


def _directed(text: str) -> bool:
    """Whether the numbers are not all 0."""
    pieces = text.split()
    return not pieces or not all(_python(piece) and float(piece) == 0 for piece in pieces)


def _begun(*counts: int) -> Callable[[str], bool]:
    """So many numbers at the beginning, whatever follows: a C++ stream that is read until it fails."""
    return lambda text: len(_beginning(text)) in counts


def _beginning(text: str) -> list[str]:
    found, at = list[str](), 0
    while number := _STREAM.match(text, at):
        found.append(number[0])
        at = number.end()
    return found if all(math.isfinite(float(each)) for each in found) else []


def _c_numbers(text: str) -> list[bool]:
    """Whether `strtod` takes each piece in full; it knows hexadecimal ones, `inf` and `nan`, and MuJoCo no overflow."""
    return [_C.fullmatch(piece) is not None and not _overflows(piece) for piece in text.split()]


def _overflows(piece: str) -> bool:
    return _python(piece) and math.isinf(float(piece)) and "inf" not in piece.lower()


def _c(*counts: int) -> Callable[[str], bool]:
    return lambda text: all(found := _c_numbers(text)) and len(found) in counts


def _all_of(text: str, holds: Callable[[float], bool]) -> bool:
    """Whether all numbers at the beginning are such."""
    return all(holds(float(each)) for each in _beginning(text))


def _has_length(text: str) -> bool:
    numbers = [float(each) for each in _beginning(text)]
    return len(numbers) != 3 or math.hypot(*numbers) > _SHORTEST


FORMS: Mapping[str, tuple[str, Callable[[str], bool]]] = {
    "text": ("any text", lambda _: True),
    "words": ("a text that is not empty", bool),
    "stream": ("a number such as 0.5 or 1e-3", _stream),
    "stream3": ("three numbers with blanks between them", lambda text: _streams(text) == [True] * 3),
    "unit": ("numbers from 0 to 1 with blanks between them", _of_unit),
    "blank4": ("four numbers with blanks between them", lambda text: len(_pieces(text)) == 4),
    "blank3": ("three numbers with blanks between them", lambda text: len(_pieces(text)) >= 3),
    "at-least-0": ("a number that is not negative", lambda text: not _stream(text) or float(text) >= 0),
    "python": ("a number such as 0.5 or 1e-3", _python),
    "python3": ("three numbers", lambda text: _pythons(text, 3)),
    "python4": ("four numbers", lambda text: _pythons(text, 4)),
    "python34": ("three or four numbers", lambda text: _pythons(text, 3, 4)),
    "pythons": ("numbers", _pythons),
    "python1or3+": ("three numbers", lambda text: _pythons(text) and len(text.split()) not in {0, 2}),
    "python3+": ("three numbers", lambda text: _pythons(text) and len(text.split()) >= 3),
    "commas": ("numbers", lambda text: _pythons(text.replace(",", " "))),
    "commas3": ("three numbers", lambda text: _pythons(text.replace(",", " "), 3)),
    "bounded": ("finite numbers", _bounded),
    "directed": ("a direction", _directed),
    "begun1": ("a number such as 0.5 or 1e-3", _begun(1)),
    "begun3": ("three numbers", _begun(3)),
    "begun1or3": ("one number, or three", _begun(1, 3)),
    "begun4": ("four numbers", _begun(4)),
    "begins": ("a number such as 0.5 or 1e-3", lambda text: bool(_beginning(text))),
    "c1": ("a number such as 0.5 or 1e-3", _c(1)),
    "c3": ("three numbers", _c(0, 3)),
    "c4": ("four numbers", _c(4)),
    "not-nan": ("numbers", lambda text: "nan" not in text.lower()),
    "positive": ("numbers above 0", lambda text: _all_of(text, lambda number: number > 0)),
    "not-negative": ("numbers that are not negative", lambda text: _all_of(text, lambda number: number >= 0)),
    "not-0": ("numbers other than 0", lambda text: _all_of(text, lambda number: abs(number) >= 1e-8)),
    "zero": ("0", lambda text: _all_of(text, lambda number: number == 0)),
    "of-unit": ("numbers from 0 to 1", lambda text: _all_of(text, lambda number: 0 <= number <= 1)),
    "long": ("a direction", _has_length),
    "urdf-1.0": ("1.0", _versions((1, 0))),
    "urdf-1.2": ("1.0, 1.1 or 1.2", _versions((1, 0), (1, 1), (1, 2))),
    "exactly-1.0": ("1.0", lambda text: text == "1.0"),
}
"""What is expected, in words, and whether a text is of the form."""
