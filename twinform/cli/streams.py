"""Standard output that cannot be written: disk full, closed, or a broken pipe."""

import errno
import os
import sys
from collections.abc import Generator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NoReturn

# A copy of `twinform.cli.failure.UNUSABLE`, which would import the commands.
_UNUSABLE = 2
_UNREAD = 128 + 13
"""The exit code of a program that is ended by a broken pipe, as shells give it."""
# How the null device replaces a closed stream. Standard output is opened for reading, so that
# writing to it is an error.
_CLOSED = {0: ("stdin", os.O_RDONLY, "r"), 1: ("stdout", os.O_RDONLY, "w"), 2: ("stderr", os.O_WRONLY, "w")}


def hold_standard_streams() -> None:
    """Let no file that is opened later become a standard stream that the caller has closed."""
    # With descriptor 1 closed by the caller, the next file that is opened would become standard
    # output, and messages would be written into it.
    for number, (name, flags, mode) in _CLOSED.items():
        try:
            os.fstat(number)
        except OSError:
            opened = os.open(os.devnull, flags)  # the lowest number that is free
            os.set_inheritable(opened, True)  # a child process without the stream cannot start
            setattr(sys, name, open(number, mode, encoding="utf-8", closefd=False))  # noqa: SIM115 - to stay


def end_unwritable(error: OSError) -> NoReturn:
    """End after an error of the system that no command expects: mostly of a stream, which has no name."""
    what = error.filename or "cannot write standard output"
    reason = "it is closed" if error.errno == errno.EBADF else error.strerror or error
    from twinform.cli.printing import print_line  # noqa: PLC0415 - it seldom happens

    with suppress(OSError):
        print_line(f"Error: {what}: {reason}", err=True)
    _forget_what_is_left()
    raise SystemExit(_UNUSABLE)


@contextmanager
def quiet_when_unread() -> Generator[None]:
    """End the program quietly where nobody reads its output any more: `head` closes the pipe once it has enough."""
    try:
        yield
    except BrokenPipeError:
        _forget_what_is_left()
        raise SystemExit(_UNREAD) from None


def _forget_what_is_left() -> None:
    """Keep Python from trying to write once more, and complaining, when it ends."""
    nowhere = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115 - it lives as long as the process
    sys.stdout = nowhere
    sys.stderr = nowhere
