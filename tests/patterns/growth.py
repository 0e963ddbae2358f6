"""Whether the time of something grows faster than what it is given: processor time, at sizes that differ much."""

import signal
import time
from collections.abc import Callable
from types import FrameType

_SHORT = 0.002
"""Seconds in which anything linear is done with the first, small size, many times over."""
_TIMES = 4
_MOST = 2.5 * _TIMES
"""How many times longer so many times more may take; the square would be the square."""
_ROUNDS = 3
_PATIENCE = 0.5


class _EndlessError(Exception):
    pass


def grows_too_fast(run: Callable[[int], object], size: int) -> bool:
    """Whether a run with a size, twice and more of it, takes more than in proportion.

    What is quick with the first size passes; so nothing hangs on how exact short times are.
    """
    before = signal.signal(signal.SIGVTALRM, _end)
    try:
        return _seconds(run, size) > _SHORT and all(_is_steep(run, size) for _ in range(_ROUNDS))
    except _EndlessError:
        return True
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def _is_steep(run: Callable[[int], object], size: int) -> bool:
    short, long = (min(_seconds(run, each) for _ in range(_ROUNDS)) for each in (size, _TIMES * size))
    return long > max(_MOST * short, _TIMES * _SHORT)


def _seconds(run: Callable[[int], object], size: int) -> float:
    signal.setitimer(signal.ITIMER_VIRTUAL, _PATIENCE)
    begin = time.thread_time()
    run(size)
    return time.thread_time() - begin


def _end(_: int, __: FrameType | None) -> None:
    raise _EndlessError
