"""The process of the program `twinform`: what it trusts at the start, its standard streams, and how it ends.

At its end Python frees all modules, classes and schemas one by one, which takes a quarter of a short run. `run` flushes
the streams, calls the exit handlers, and leaves the rest to the system.
"""

import atexit
import errno
import os
import sys
import threading
from collections.abc import Callable, Generator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NoReturn

import twinform

_UNREAD = 128 + 13
"""Exit code of a program that is ended by a broken pipe, as shells give it."""
# How the null device replaces a closed stream: standard output is opened for reading, so that writing is an error.
_CLOSED = {0: ("stdin", os.O_RDONLY, "r"), 1: ("stdout", os.O_RDONLY, "w"), 2: ("stderr", os.O_WRONLY, "w")}


def hold_standard_streams() -> None:
    """Open the null device for standard streams that the caller has closed."""
    # else the next file that is opened gets descriptor 1, and messages are written into it
    for number, (name, flags, mode) in _CLOSED.items():
        try:
            os.fstat(number)
        except OSError:
            opened = os.open(os.devnull, flags)  # the lowest number that is free
            os.set_inheritable(opened, True)  # a child process without the stream cannot start
            setattr(sys, name, open(number, mode, encoding="utf-8", closefd=False))  # noqa: SIM115 - to stay


def end_unwritable(error: OSError) -> NoReturn:
    """End the program after a system error that no command expects, mostly of standard output."""
    what = error.filename or "cannot write standard output"
    reason = "it is closed" if error.errno == errno.EBADF else error.strerror or error
    from twinform.cli.command import UNUSABLE  # noqa: PLC0415 - it seldom happens
    from twinform.cli.printing import print_line  # noqa: PLC0415 - as above

    with suppress(OSError):
        print_line(f"Error: {what}: {reason}", err=True)
    _forget_what_is_left()
    raise SystemExit(UNUSABLE)


@contextmanager
def quiet_when_unread() -> Generator[None]:
    """End the program quietly if nobody reads its output any more, such as `head` once it has enough lines."""
    try:
        yield
    except BrokenPipeError:
        _forget_what_is_left()
        raise SystemExit(_UNREAD) from None


def _forget_what_is_left() -> None:
    """Keep Python from writing the rest at its end, which would fail again with a message."""
    nowhere = Path(os.devnull).open("w", encoding="utf-8")  # noqa: SIM115 - it lives as long as the process
    sys.stdout = nowhere
    sys.stderr = nowhere


def distrust_current_folder() -> None:
    """Import no modules and start no programs from the current folder, unless PYTHONPATH names it.

    The folder may have come with a model. Python looks there for `python -m twinform`, and if PYTHONPATH has an empty
    entry, which scripts that set up a shell leave by accident, in PATH too.
    """
    _filter_entries("PATH", os.path.isabs)
    is_module = sys.modules["__main__"].__spec__ is not None and not sys.flags.safe_path
    if _filter_entries("PYTHONPATH", bool) or is_module:
        with suppress(FileNotFoundError):  # the current folder was deleted
            _stop_importing_from(Path.cwd())


def _filter_entries(variable: str, is_kept: Callable[[str], bool]) -> bool:
    """Remove entries from a search path in the environment, also for child processes; return whether there were any."""
    entries = os.environ.get(variable, "").split(os.pathsep)
    kept = [each for each in entries if is_kept(each)]
    if not any(entries) or kept == entries:
        return False
    os.environ[variable] = os.pathsep.join(kept)
    return True


def _stop_importing_from(folder: Path) -> None:
    named = {os.path.abspath(each) for each in os.environ.get("PYTHONPATH", "").split(os.pathsep) if each}  # noqa: PTH100
    # developers who run twinform from its checkout trust that folder
    if str(folder) not in named and folder != Path(twinform.__file__).parents[1]:
        sys.path[:] = [each for each in sys.path if each not in {"", str(folder)}]


def run(command: Callable[[], object]) -> NoReturn:
    """Run a command line that ends with `SystemExit`, and leave the process with its exit code."""
    try:
        command()
    except SystemExit as end:
        if _may_leave(end):
            # Handlers of third-party passes, of coverage, and of `weakref.finalize`, which removes
            # temporary folders. `__del__` methods of live objects are skipped, as Python may do too.
            atexit._run_exitfuncs()  # noqa: SLF001  # pyright: ignore[reportPrivateUsage] - as Python does at the end
            # If flushing fails, because of a full disk or a closed pipe, Python's own end says so.
            if _flush_streams():
                os._exit(end.code if isinstance(end.code, int) else 0)
        raise
    raise SystemExit


def _may_leave(end: SystemExit) -> bool:
    """Whether nothing needs Python's own end: a message to print, a thread, a tracer, a profiler, `-i` or `-X dev`."""
    others = any(not each.daemon for each in threading.enumerate() if each is not threading.main_thread())
    watched = sys.gettrace() is not None or sys.getprofile() is not None or _is_monitored()
    return isinstance(end.code, int | None) and not (others or watched or sys.flags.inspect or sys.flags.dev_mode)


def _is_monitored() -> bool:
    """Whether a profiler, debugger or coverage uses `sys.monitoring`, which Python has since 3.12."""
    monitoring = getattr(sys, "monitoring", None)
    return monitoring is not None and any(monitoring.get_tool(each) is not None for each in range(6))


def _flush_streams() -> bool:
    """Flush standard output and error; return whether that worked."""
    try:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None and not stream.closed:
                stream.flush()
    except (OSError, ValueError):
        return False
    return True
