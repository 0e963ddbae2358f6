"""How much work a command does: the number of function calls in Python and C, which no other program disturbs."""

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


def growth(command: str, document: GrowingDocument, folder: Path, line_end: str = "\n") -> float:
    """Return the exponent by which the work of a command grows when a document doubles: 1 is linear."""
    _count_calls_on(command, document.format, _write(document, 1, folder, line_end))  # imports and caches
    shorter, longer = (
        _count_calls_on(command, document.format, _write(document, size, folder, line_end)) for size in SIZES
    )
    return log2(longer / shorter)


def _write(document: GrowingDocument, size: int, folder: Path, line_end: str) -> Path:
    path = folder / f"in{size}.{document.format}"
    path.write_text(document.text(size, line_end), encoding="utf-8")
    return path


def _count_calls_on(command: str, format: str, path: Path) -> int:
    other = "sdf" if format == "urdf" else "urdf"
    places = {
        "IN": path,
        "OUT": path.with_name(f"out.{other}"),
        "SAME": path.with_name(f"same.{format}"),
        "JSON": path.with_name("out.json"),
        "REPORT": path.with_name("report.md"),
    }
    arguments = [str(places.get(each, each)) for each in COMMANDS[command]]
    return count_calls(*arguments)


def count_calls(*arguments: str) -> int:
    """Run a command line and count the calls of functions.

    Raises:
        Exception: the command failed with it.
    """
    profile = Profile()
    profile.enable()
    try:
        result = CliRunner().invoke(main, arguments)
    finally:
        profile.disable()
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    return sum(each.callcount for each in profile.getstats())
