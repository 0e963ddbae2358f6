"""The shortest spelling of numbers: that with which Python writes the same double, where it is shorter."""

import re
from math import isfinite

_NUMBER = re.compile(r"[-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?", re.ASCII)
_EXPONENT = re.compile(r"e([-+])0*(\d+)")
_NUMBERS = re.compile(rf"\s*+(?:{_NUMBER.pattern}(?:\s++|$))++", re.ASCII)


def all_numbers(text: str) -> bool:
    """Whether a text is of nothing but numbers, and has one."""
    return _NUMBERS.fullmatch(text) is not None


def shortest(text: str) -> str:
    """The text with each number spelled in the fewest characters, where it is of nothing but numbers."""
    return _NUMBER.sub(lambda found: _shortest(found.group()), text) if all_numbers(text) else text


def _shortest(number: str) -> str:
    value = float(number)
    if not isfinite(value):
        return number
    spelled = _EXPONENT.sub(r"e\1\2", repr(value)).replace("e+", "e").removesuffix(".0")
    return spelled if len(spelled) < len(number) and float(spelled) == value else number
