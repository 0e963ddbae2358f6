"""Numbers in texts, and texts of numbers as a person would write them."""

import math
from collections.abc import Iterable

from twinform.schemas import format_value

_DIGITS = 15


def numbers_of(text: str | None) -> tuple[float, ...]:
    """The numbers of a text; none where something else is in it."""
    try:
        found = tuple(map(float, (text or "").split()))
    except ValueError:
        return ()
    return found if all(map(math.isfinite, found)) else ()


def text_of_number(value: float) -> str:
    """The shortest text of a number that is equal to it in all but the last of its digits."""
    rounded = float(f"{value:.{_DIGITS}g}") + 0.0
    return format_value(rounded)


def text_of_numbers(values: Iterable[float]) -> str:
    """Write several numbers in their shortest spelling, with blanks between them."""
    return " ".join(map(text_of_number, values))
