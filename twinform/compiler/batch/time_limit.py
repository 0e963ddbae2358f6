"""A limit of time for what runs in this thread, where nobody can end its process."""

import ctypes
import threading
from collections.abc import Generator
from contextlib import contextmanager


class LateError(BaseException):
    """The time is over; no handler of `Exception` holds it up."""


@contextmanager
def time_limit(seconds: float | None) -> Generator[None]:
    """Raise `LateError` in this thread after so many seconds, at its next step in Python.

    Signals reach the main thread only, and an executor may work in any. What never comes back from C is not ended.

    Raises:
        LateError: the time is over.
    """
    if seconds is None:
        yield
        return
    lock, ended = threading.Lock(), False
    thread = threading.get_ident()

    def end() -> None:
        with lock:
            if not ended:
                # What hangs in C is not reached; the limits on size and depth are there for that.
                ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(LateError))

    timer = threading.Timer(seconds, end)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        with lock:
            ended = True
        timer.cancel()
