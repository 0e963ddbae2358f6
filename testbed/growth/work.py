"""How much work a command does, in figures that no other program disturbs.

One is the number of function calls in Python and C. It does not show what a call does inside C: a set of all names that
is made again for each element, or a slice of a long line. The other one is the number of bytes that a command
allocates, which shows every copy. Neither shows how long C searches in a list or a text.
"""

import tracemalloc
from collections.abc import Callable, Iterator, Sequence
from cProfile import Profile
from math import log2
from pathlib import Path

from click.testing import CliRunner

from testbed.growth.documents import GrowingDocument
from twinform.cli import main

SIZES = (300, 600)
"""The numbers of parts whose work is compared."""
COMMANDS = {
    "check": ("check", "IN"),
    "check --for": ("check", "--for", "gazebo", "IN"),
    "check --fix": ("check", "--fix", "--diff", "IN"),
    "convert": ("convert", "IN", "-o", "OUT"),
    "convert to itself": ("convert", "IN", "-o", "SAME"),
    "convert to JSON": ("convert", "IN", "--to", "json", "-o", "JSON"),
    "diff": ("diff", "IN", "IN"),
    "format": ("format", "--check", "IN"),
    "stats": ("stats", "IN"),
    "graph": ("graph", "IN"),
    "advise": ("advise", "IN"),
    "report": ("report", "IN", "-o", "REPORT"),
}


def count_calls(*arguments: str) -> int:
    """Run a command line and count the calls of functions.

    Raises:
        Exception: the command failed with it.
    """
    profile = Profile()
    _run(profile, arguments)
    return sum(each.callcount for each in profile.getstats())


def count_bytes(*arguments: str) -> int:
    """Run a command line and count the bytes that it allocates, whether they are freed soon or not.

    The profile takes them for its time, so its statistics tell which function allocates how much.

    Raises:
        Exception: the command failed with it.
    """
    tracemalloc.start()
    try:
        profile = Profile(_allocated().__next__, 1.0)
        _run(profile, arguments)
    finally:
        tracemalloc.stop()
    return round(sum(each.inlinetime for each in profile.getstats()))


def growth(
    command: str,
    document: GrowingDocument,
    folder: Path,
    line_end: str = "\n",
    count: Callable[..., int] = count_calls,
) -> float:
    """Return the exponent by which the work of a command grows when a document doubles: 1 is linear."""
    paths = [document.write(folder, size, line_end) for size in (1, *SIZES)]
    _, shorter, longer = (count(*arguments_on(command, path)) for path in paths)  # the first one imports modules
    return log2(longer / shorter)


def _allocated() -> Iterator[int]:
    """Yield the bytes that were allocated until now: between two calls, the most that there was more than before."""
    allocated = before = 0
    while True:
        now, peak = tracemalloc.get_traced_memory()
        allocated += peak - before
        before = now
        tracemalloc.reset_peak()
        yield allocated


def _run(profile: Profile, arguments: Sequence[str]) -> None:
    profile.enable()
    try:
        run_command(arguments)
    finally:
        profile.disable()


def run_command(arguments: Sequence[str]) -> None:
    """Run a command line.

    Raises:
        Exception: the command failed with it.
    """
    result = CliRunner().invoke(main, arguments)
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception


def arguments_on(command: str, path: Path) -> list[str]:
    """Return the arguments of a command on a document; results are written beside it."""
    format = path.suffix[1:]
    other = "sdf" if format == "urdf" else "urdf"
    places = {
        "IN": path,
        "OUT": path.with_name(f"out.{other}"),
        "SAME": path.with_name(f"same.{format}"),
        "JSON": path.with_name("out.json"),
        "REPORT": path.with_name("report.md"),
    }
    return [str(places.get(each, each)) for each in COMMANDS[command]]
