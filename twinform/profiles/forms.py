"""Forms of values: whether a reader understands a text as a number, as several numbers, or as one of some words.

`stream` is a number that a C++ stream reads completely, `python` is one that Python reads, `atof` takes the beginning
of a text as C does and never fails. A digit after the name is the count of numbers, separated as the reader wants it.
"""

import math
import re
from collections.abc import Callable, Mapping

from twinform.lazy import lazy_pattern

# `\d++` and `*+` never give back what they matched: text from a stranger must not make a match
# quadratic.
_STREAM = lazy_pattern(r"[ \t\n\v\f\r]*[-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?", re.ASCII)
_LEADING = lazy_pattern(r"[ \t\n\v\f\r]*([-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?)", re.ASCII)
_HEXADECIMAL = lazy_pattern(r"[-+]?0[xX](?:[0-9a-fA-F]++\.?[0-9a-fA-F]*+|\.[0-9a-fA-F]++)(?:[pP][-+]?\d++)?", re.ASCII)
_WORDS = lazy_pattern(r"[-+]?(?:inf|infinity|nan(?:\(\w*\))?)", re.ASCII | re.IGNORECASE)
_ASCII_BLANKS = lazy_pattern(r"[ \t\n\v\f\r]+")
_SHORTEST = 1e-8
_LONGEST_NAME = 240
_VERSION = lazy_pattern(r"\s*+[-+]?(?=\d)0*+(\d{0,9})\.\s*+[-+]?(?=\d)0*+(\d{0,9})", re.ASCII)


def _is_stream(text: str) -> bool:
    return _STREAM.fullmatch(text) is not None and math.isfinite(float(text))


def _is_python(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _count_streamed(text: str) -> int:
    """How many numbers a C++ stream reads one after the other, up to the first that is none."""
    count, at = 0, 0
    while (found := _LEADING.match(text, at)) is not None and math.isfinite(float(found[1])):
        count, at = count + 1, found.end()
        if text[at : at + 1] in {"e", "E"}:
            return count - 1  # the stream takes the letter for an exponent, and fails when none follows
    return count


def _are_strtods(text: str, *counts: int) -> bool:
    """Whether a text is one of these counts of numbers as C reads them: also hexadecimal, infinite, or NaN."""
    pieces = _ASCII_BLANKS.sub(" ", text).split(" ")
    pieces = [piece for piece in pieces if piece]
    return len(pieces) in counts and all(map(_is_strtod, pieces))


def _is_strtod(piece: str) -> bool:
    if _HEXADECIMAL.fullmatch(piece) or _WORDS.fullmatch(piece):
        return True
    return _STREAM.fullmatch(piece) is not None and math.isfinite(float(piece))


def _leading_numbers(text: str) -> list[float]:
    """The numbers at which the pieces of a text begin, as C reads them; other pieces are left out."""
    found = (_leading_number(piece) for piece in text.split())
    return [number for number in found if number is not None]


def number_in(text: str) -> float | None:
    """The number that a text begins with, or None."""
    return _leading_number(text.strip())


def _leading_number(piece: str) -> float | None:
    if found := _HEXADECIMAL.match(piece):
        return float.fromhex(found[0])
    if found := _WORDS.match(piece) or _LEADING.match(piece):
        return float(found[0].split("(")[0])
    return None


def _are_positive(text: str) -> bool:
    return all(number > 0 for number in _leading_numbers(text))


def _is_direction(text: str) -> bool:
    """Whether a vector has a length; a text without numbers passes."""
    numbers = _leading_numbers(text)
    return not numbers or any(math.isnan(number) for number in numbers) or math.hypot(*numbers) >= _SHORTEST


def _is_unreserved(text: str) -> bool:
    return text != "world" and not (len(text) > 3 and text.startswith("__") and text.endswith("__"))


def _is_finite(text: str) -> bool:
    return not _is_python(text) or math.isfinite(float(text))


def _split_at_blanks(text: str) -> list[str]:
    """The pieces between blanks; a tab or a new line belongs to a piece."""
    return [piece for piece in text.split(" ") if piece]


def _are_from_0_to_1(text: str) -> bool:
    """Whether every number is from 0 to 1, as urdfdom requires in colors."""
    return all(_is_stream(piece) and 0 <= float(piece) <= 1 for piece in _split_at_blanks(text))


def _are_python(text: str, *counts: int) -> bool:
    pieces = text.split()
    return all(map(_is_python, pieces)) and (not counts or len(pieces) in counts)


def _version_in(*known: tuple[int, int]) -> Callable[[str], bool]:
    def reads(text: str) -> bool:
        found = _VERSION.fullmatch(text)
        return found is not None and (int(found[1] or 0), int(found[2] or 0)) in known

    return reads


def fits_bytes(text: str) -> bool:
    """Whether a text is one number or four, which multiplied by 255 fit into bytes."""
    pieces = text.split()
    if len(pieces) not in {1, 4} or not all(map(_is_python, pieces)):
        return False
    return all(-1 < float(piece) * 255 < 256 for piece in pieces)


def _is_opacity(text: str) -> bool:
    """Whether the fourth number, if there is one, is from 0 to 1."""
    fourth = text.split()[3:4]
    return not fourth or not _is_python(fourth[0]) or 0 <= float(fourth[0]) <= 1


def _are_bounded(text: str) -> bool:
    """Whether no number is infinite; NaN passes."""
    return not any(_is_python(piece) and math.isinf(float(piece)) for piece in text.replace(",", " ").split())


def _is_directed(text: str) -> bool:
    """Whether the first three numbers are not all 0; a text without numbers passes."""
    pieces = text.split()[:3]
    return not pieces or not all(_is_python(piece) and float(piece) == 0 for piece in pieces)


FORMS: Mapping[str, tuple[str, Callable[[str], bool]]] = {
    "text": ("any text", lambda _: True),
    "words": ("a text that is not empty", bool),
    "stream": ("a number such as 0.5 or 1e-3", _is_stream),
    "stream3": (
        "three numbers with blanks between them",
        lambda text: [*map(_is_stream, _split_at_blanks(text))] == [True] * 3,
    ),
    "stream4": (
        "four numbers with blanks between them",
        lambda text: [*map(_is_stream, _split_at_blanks(text))] == [True] * 4,
    ),
    "unit": ("numbers from 0 to 1 with blanks between them", _are_from_0_to_1),
    "blank4": ("four numbers with blanks between them", lambda text: len(_split_at_blanks(text)) == 4),
    "blank3": ("three numbers with blanks between them", lambda text: len(_split_at_blanks(text)) >= 3),
    "at-least-0": ("a number that is not negative", lambda text: not _is_stream(text) or float(text) >= 0),
    "streams1": ("one number such as 0.5 or 1e-3", lambda text: _count_streamed(text) == 1),
    "streams1+": ("a number such as 0.5 or 1e-3", lambda text: _count_streamed(text) > 0),
    "streams3": ("three numbers", lambda text: _count_streamed(text) == 3),
    "streams4": ("four numbers", lambda text: _count_streamed(text) == 4),
    "strtod": ("a number such as 0.5 or 1e-3", lambda text: _are_strtods(text, 0, 1)),
    "strtod+": ("a number such as 0.5 or 1e-3", lambda text: _are_strtods(text, 1)),
    "strtods3": ("three numbers", lambda text: _are_strtods(text, 0, 3)),
    "strtods3+": ("three numbers", lambda text: _are_strtods(text, 3)),
    "strtods4+": ("four numbers", lambda text: _are_strtods(text, 4)),
    "zeros": ("0", lambda text: not any(_leading_numbers(text))),
    "share": ("numbers from 0 to 1", lambda text: all(0 <= number <= 1 for number in _leading_numbers(text))),
    "one": ("1", lambda text: text in {"", "1"}),
    "positive": ("more than 0", _are_positive),
    "long": ("a direction", _is_direction),
    "finite": ("a finite number", _is_finite),
    "finites": ("finite numbers", lambda text: all(map(_is_finite, text.split()))),
    "printable": ("a short name in one line", lambda text: text.isprintable() and len(text) < _LONGEST_NAME),
    "strtods3?": ("three numbers", lambda text: not text or _are_strtods(text, 3)),
    "unreserved": ("a name without two underscores at both ends, and not world", _is_unreserved),
    "unblank": ("a name", lambda text: not text or bool(text.strip())),
    "python": ("a number such as 0.5 or 1e-3", _is_python),
    "python3": ("three numbers", lambda text: _are_python(text, 3)),
    "python4": ("four numbers", lambda text: _are_python(text, 4)),
    "python?": ("a number such as 0.5 or 1e-3", lambda text: not text or _is_python(text)),
    "python3?": ("three numbers", lambda text: not text or _are_python(text, 3)),
    "python3+?": ("three numbers", lambda text: not text or (_are_python(text) and len(text.split()) >= 3)),
    "opaque": ("a last number from 0 to 1", _is_opacity),
    "python34": ("three or four numbers", lambda text: _are_python(text, 3, 4)),
    "pythons": ("numbers", _are_python),
    "python1or3+": ("three numbers", lambda text: _are_python(text) and len(text.split()) not in {0, 2}),
    "python3+": ("three numbers", lambda text: _are_python(text) and len(text.split()) >= 3),
    "commas": ("numbers", lambda text: _are_python(text.replace(",", " "))),
    "commas3": ("three numbers", lambda text: _are_python(text.replace(",", " "), 3)),
    "bounded": ("finite numbers", _are_bounded),
    "zero": ("0", lambda text: not any(_leading_numbers(text))),
    "directed": ("a direction", _is_directed),
    "hull": ("a mesh in OBJ, VTK or glTF", lambda text: not text or text.lower().endswith((".obj", ".vtk", ".gltf"))),
    "urdf-1.0": ("1.0", _version_in((1, 0))),
    "urdf-1.1": ("1.0 or 1.1", _version_in((1, 0), (1, 1))),
    "urdf-1.2": ("1.0, 1.1 or 1.2", _version_in((1, 0), (1, 1), (1, 2))),
    "exactly-1.0": ("1.0", lambda text: text == "1.0"),
}
"""By name: what is expected, in words, and a function that says whether a text has this form."""
