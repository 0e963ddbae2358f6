"""The memory and the time that an expansion may take."""

import signal
import sys
from types import FrameType

from twinform.compiler.input.xacro.worker.failures import TimeUpError
from twinform.confinement.resources import limits, set_limit

MEMORY = 2**29
# Of 386 xacro files in the corpus one, a pendulum of 1,201 links, takes 9.3 s and is right; all
# others take less than 0.4 s.
SECONDS = 10
"""Of processor time. The slowest real file that we know takes from one to nine, as machines are."""
# Seconds of processor time to report where the time went.
_GRACE = 2
# Frames of Python. xacro takes about ten for each macro inside a macro.
_DEEPEST = 4000


def limit() -> None:
    """Keep whatever takes long or grows from taking the machine with it."""
    sys.setrecursionlimit(_DEEPEST)
    if limits() is None:
        return
    set_limit("AS", MEMORY)
    set_limit("FSIZE", 0)
    # As an exception, the signal is reported with the element that was being expanded. The hard
    # limit, which kills without a word, comes two seconds later.
    signal.signal(signal.SIGXCPU, _time_is_up)
    set_limit("CPU", SECONDS, _GRACE)


def _time_is_up(signum: int, frame: FrameType | None) -> None:
    del signum, frame
    raise TimeUpError(f"the expansion takes more than {SECONDS} seconds of the processor")
