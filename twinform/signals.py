"""Signals that end the program: what is unfinished is undone in the handler, and the process ends there.

Python turns Ctrl-C into an exception at whatever instruction is next. Inside a cleanup it leaves files behind, between
two imports it prints a traceback, and in a callback of the interpreter it is printed and forgotten. So nothing is
raised: whoever has something to undo keeps it in `undone`, and the handler does it.
"""

import os
import sys
from contextlib import contextmanager, suppress

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Generator
    from signal import SIG_DFL, SIG_IGN, default_int_handler, getsignal, signal
    from typing import NoReturn
else:  # until a handler is set Ctrl-C prints a traceback, and `signal` and `typing` take their time
    from _signal import SIG_DFL, SIG_IGN, default_int_handler, getsignal, signal

_SIGINT = 2
_ENDING = (_SIGINT, 15, *(() if sys.platform == "win32" else (1,)))
"""SIGINT, SIGTERM, and SIGHUP, which comes when the terminal goes."""
_unfinished: "list[Callable[[], None]]" = []
_exit_codes: list[int] = []


@contextmanager
def undone(undo: "Callable[[], None]") -> "Generator[None]":
    """Call `undo` at the end of the block, or before if a signal ends the program.

    A signal may come while `undo` runs, which is then called again: it has to look at what is there, and do the rest.
    A signal that raises an exception is raised after that.
    """
    _unfinished.append(undo)
    try:
        yield
    finally:
        try:
            undo()
        except BaseException:
            undo()
            raise
        finally:
            _unfinished.remove(undo)


def end_on_signals() -> None:
    """Let signals end this process from now on; one that was ignored at the start stays ignored."""
    for number in _ENDING:
        if getsignal(number) != SIG_IGN:
            signal(number, _end)


@contextmanager
def signals_exit_with(code: int) -> "Generator[None]":
    """Let signals that end the program at all end it with this exit code."""
    _exit_codes.append(code)
    try:
        yield
    finally:
        _exit_codes.pop()


@contextmanager
def raised_signals() -> "Generator[None]":
    """Turn SIGINT into KeyboardInterrupt and other signals into SystemExit, for a loop that has results to keep."""
    # `batch` has finished results to keep and a summary to print, so there a signal unwinds the
    # stack.
    before = {number: getsignal(number) for number in _ENDING}
    try:
        for number, handler in before.items():
            # Handlers of another program that uses the API are left alone.
            if handler in (_end, SIG_DFL):
                signal(number, default_int_handler if number == _SIGINT else raise_exit)
        yield
    finally:
        for number, handler in before.items():
            if getsignal(number) is not handler:
                signal(number, handler)


def raise_exit(number: int, _frame: object) -> "NoReturn":
    """Raise SystemExit with the exit code that shells give a program which a signal has ended."""
    raise SystemExit(128 + number)


def _end(number: int, _frame: object) -> "NoReturn":
    # A second Ctrl-C must not interrupt the cleanup.
    for each in _ENDING:
        signal(each, SIG_IGN)
    for undo in reversed(_unfinished):
        # No exception is raised here. Of 100 conversions that Ctrl-C interrupted with a
        # KeyboardInterrupt, 82 ended with click's "Aborted!" and exit code 1, eight printed a
        # traceback, and one interrupt inside an import callback was printed and forgotten, so that
        # the program ended with 0. No `try` block can prevent that.
        with suppress(Exception):  # what is left is found by the next run
            undo()
    os._exit(_exit_codes[-1] if _exit_codes else 128 + number)
