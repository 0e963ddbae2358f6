"""The program `twinform`: the command line in a process of its own, which it leaves without taking Python down.

Python frees all modules, classes and schemas one by one when it ends, which takes a quarter of a short run. What counts
at the end is done here, and the rest is left to the system.
"""

import atexit
import gc
import os
import sys
import threading
from collections.abc import Callable
from typing import NoReturn

# New objects before the garbage collector looks for cycles. With Python's own 700 it would walk
# every import again.
_MANY = 50_000


def run(command: Callable[[], object]) -> NoReturn:
    """Run a command line that ends by `SystemExit`, and leave the process with its exit code."""
    gc.set_threshold(_MANY)
    try:
        command()
    except SystemExit as end:
        if _may_leave(end):
            # Handlers of third-party passes, of coverage, and of `weakref.finalize`, which removes
            # temporary folders. Not run are `__del__` methods of objects that are still alive,
            # which Python does not promise to call either.
            atexit._run_exitfuncs()  # noqa: SLF001  # pyright: ignore[reportPrivateUsage] - as Python does at the end
            # A full disk or a closed pipe shows up when flushing. Python's own end then prints its
            # message and sets its exit code.
            if _flushed():
                os._exit(end.code if isinstance(end.code, int) else 0)
        raise
    raise SystemExit


def _may_leave(end: SystemExit) -> bool:
    """Whether nothing waits for Python's own end: a message to print, a thread, a tracer or profiler, or a person."""
    # Python waits for threads that are not daemons, and `python -i` and `-X dev` have something to
    # do at the end: all of these get Python's own end.
    others = any(not each.daemon for each in threading.enumerate() if each is not threading.main_thread())
    watched = sys.gettrace() is not None or sys.getprofile() is not None or _is_monitored()
    return isinstance(end.code, int | None) and not (others or watched or sys.flags.inspect or sys.flags.dev_mode)


def _is_monitored() -> bool:
    """Whether a profiler, debugger or measurement of coverage uses `sys.monitoring`, which Python has since 3.12."""
    monitoring = getattr(sys, "monitoring", None)
    return monitoring is not None and any(monitoring.get_tool(each) is not None for each in range(6))


def _flushed() -> bool:
    """Write what is left in standard output and error; where that fails, Python's own end says so."""
    try:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None and not stream.closed:
                stream.flush()
    except (OSError, ValueError):
        return False
    return True
