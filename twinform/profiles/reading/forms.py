"""Forms of values: whether a reader understands a text as a number, as so many numbers, or as one of some words.

`stream` is a number as a C++ stream reads it in full, `python` as Python does, `atof` as C does, which takes the
beginning and never fails. A digit after the name is how many there have to be, separated as that reader does it.
"""

import math
import re
from collections.abc import Callable, Mapping

# `\d++` and `*+` never give back what they matched: text from a stranger must not make a match
# quadratic.
_STREAM = re.compile(r"[ \t\n\v\f\r]*[-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?", re.ASCII)
_LEADING = re.compile(r"[ \t\n\v\f\r]*([-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?)", re.ASCII)
_HEXADECIMAL = re.compile(r"[-+]?0[xX](?:[0-9a-fA-F]++\.?[0-9a-fA-F]*+|\.[0-9a-fA-F]++)(?:[pP][-+]?\d++)?", re.ASCII)
_WORDS = re.compile(r"[-+]?(?:inf|infinity|nan(?:\(\w*\))?)", re.ASCII | re.IGNORECASE)
_ASCII_BLANKS = re.compile(r"[ \t\n\v\f\r]+")
_SHORTEST = 1e-8
_LONGEST_NAME = 240
_VERSION = re.compile(r"\s*+[-+]?(?=\d)0*+(\d{0,9})\.\s*+[-+]?(?=\d)0*+(\d{0,9})", re.ASCII)


def _stream(text: str) -> bool:
    return _STREAM.fullmatch(text) is not None and math.isfinite(float(text))


def _python(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _streamed(text: str) -> int:
    """How many numbers a C++ stream reads one after the other, until something is none."""
    count, at = 0, 0
    while (found := _LEADING.match(text, at)) is not None and math.isfinite(float(found[1])):
        count, at = count + 1, found.end()
        if text[at : at + 1] in {"e", "E"}:
            return count - 1  # the stream takes the letter for an exponent, and then there is none
    return count


def _strtods(text: str, *counts: int) -> bool:
    """Whether the text is so many numbers as C reads them: also in hexadecimal, infinite, or none."""
    pieces = _ASCII_BLANKS.sub(" ", text).split(" ")
    pieces = [piece for piece in pieces if piece]
    return len(pieces) in counts and all(map(_strtod, pieces))


def _strtod(piece: str) -> bool:
    if _HEXADECIMAL.fullmatch(piece) or _WORDS.fullmatch(piece):
        return True
    return _STREAM.fullmatch(piece) is not None and math.isfinite(float(piece))


def _numbers(text: str) -> list[float]:
    """The numbers in a text, by the beginning of each piece, as C reads them; what begins with none is left out."""
    found = (_beginning(piece) for piece in text.split())
    return [number for number in found if number is not None]


def number_in(text: str) -> float | None:
    """The number that a text begins with, or None."""
    return _beginning(text.strip())


def _beginning(piece: str) -> float | None:
    if found := _HEXADECIMAL.match(piece):
        return float.fromhex(found[0])
    if found := _WORDS.match(piece) or _LEADING.match(piece):
        return float(found[0].split("(")[0])
    return None


def _positive(text: str) -> bool:
    return all(number > 0 for number in _numbers(text))


def _long(text: str) -> bool:
    """Whether it is the direction of something, and not of nothing."""
    numbers = _numbers(text)
    return not numbers or any(math.isnan(number) for number in numbers) or math.hypot(*numbers) >= _SHORTEST


def _unreserved(text: str) -> bool:
    return text != "world" and not (len(text) > 3 and text.startswith("__") and text.endswith("__"))


def _finite(text: str) -> bool:
    return not _python(text) or math.isfinite(float(text))


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
        return found is not None and (int(found[1] or 0), int(found[2] or 0)) in known

    return reads


def fits_bytes(text: str) -> bool:
    """Whether there are four numbers, or one, that fit into bytes when they are multiplied by 255."""
    pieces = text.split()
    if len(pieces) not in {1, 4} or not all(map(_python, pieces)):
        return False
    return all(-1 < float(piece) * 255 < 256 for piece in pieces)


def _bounded(text: str) -> bool:
    """Whether no number is infinite; NaN is none."""
    return not any(_python(piece) and math.isinf(float(piece)) for piece in text.replace(",", " ").split())


def _directed(text: str) -> bool:
    """Whether the first three numbers are not all 0."""
    pieces = text.split()[:3]
    return not pieces or not all(_python(piece) and float(piece) == 0 for piece in pieces)


FORMS: Mapping[str, tuple[str, Callable[[str], bool]]] = {
    "text": ("any text", lambda _: True),
    "words": ("a text that is not empty", bool),
    "stream": ("a number such as 0.5 or 1e-3", _stream),
    "stream3": ("three numbers with blanks between them", lambda text: _streams(text) == [True] * 3),
    "unit": ("numbers from 0 to 1 with blanks between them", _of_unit),
    "blank4": ("four numbers with blanks between them", lambda text: len(_pieces(text)) == 4),
    "blank3": ("three numbers with blanks between them", lambda text: len(_pieces(text)) >= 3),
    "at-least-0": ("a number that is not negative", lambda text: not _stream(text) or float(text) >= 0),
    "streams1": ("one number such as 0.5 or 1e-3", lambda text: _streamed(text) == 1),
    "streams1+": ("a number such as 0.5 or 1e-3", lambda text: _streamed(text) > 0),
    "streams3": ("three numbers", lambda text: _streamed(text) == 3),
    "streams4": ("four numbers", lambda text: _streamed(text) == 4),
    "strtod": ("a number such as 0.5 or 1e-3", lambda text: _strtods(text, 0, 1)),
    "strtod+": ("a number such as 0.5 or 1e-3", lambda text: _strtods(text, 1)),
    "strtods3": ("three numbers", lambda text: _strtods(text, 0, 3)),
    "strtods3+": ("three numbers", lambda text: _strtods(text, 3)),
    "strtods4+": ("four numbers", lambda text: _strtods(text, 4)),
    "zeros": ("0", lambda text: not any(_numbers(text))),
    "share": ("numbers from 0 to 1", lambda text: all(0 <= number <= 1 for number in _numbers(text))),
    "one": ("1", lambda text: text in {"", "1"}),
    "positive": ("more than 0", _positive),
    "long": ("a direction", _long),
    "finite": ("a finite number", _finite),
    "finites": ("finite numbers", lambda text: all(map(_finite, text.split()))),
    "printable": ("a short name in one line", lambda text: text.isprintable() and len(text) < _LONGEST_NAME),
    "strtods3?": ("three numbers", lambda text: not text or _strtods(text, 3)),
    "unreserved": ("a name without two underscores at both ends, and not world", _unreserved),
    "unblank": ("a name", lambda text: not text or bool(text.strip())),
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
    "zero": ("0", lambda text: not any(_numbers(text))),
    "directed": ("a direction", _directed),
    "urdf-1.0": ("1.0", _versions((1, 0))),
    "urdf-1.2": ("1.0, 1.1 or 1.2", _versions((1, 0), (1, 1), (1, 2))),
    "exactly-1.0": ("1.0", lambda text: text == "1.0"),
}
"""What is expected, in words, and whether a text is of the form."""
