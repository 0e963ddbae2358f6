"""Powers of two taken out of numbers before they are multiplied, so that nothing overflows or underflows on the way.

Taking out a power of two changes no digit, so that the results are those of the plain formula wherever that holds.
"""

import math
from collections.abc import Iterable


# Products of masses and squares of lengths leave the range of doubles long before their results do,
# and Python raises at some of these places (`**`, `fsum`, `ldexp`) and not at others.
def common_exponent(numbers: Iterable[float]) -> int:
    """The power of two that brings the largest of some numbers to between a half and one; 0 where all are zero."""
    return math.frexp(max(map(abs, numbers), default=0.0))[1]


def times_power(number: float, exponent: int) -> float:
    """A number times a power of two; infinite where no double is large enough."""
    try:
        return math.ldexp(number, exponent)
    except OverflowError:
        return math.copysign(math.inf, number)


def safe_sum(numbers: Iterable[float]) -> float:
    """The sum without rounding on the way; infinite or not a number where no double is large enough."""
    listed = tuple(numbers)
    try:
        return math.fsum(listed)
    except (OverflowError, ValueError):  # it raises on the way to infinity, and where two infinities cancel
        return sum(listed)
