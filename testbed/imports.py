"""What commands import: the modules that `python -X importtime` names, with the time of each and who asked for it."""

import os
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

from testbed import robots

_LINE = re.compile(r"import time:\s+(?P<own>\d+) \|\s+\d+ \|(?P<indent> +)(?P<name>\S+)")
_LINKS = 30
COMMANDS: Mapping[str, Sequence[str]] = {
    "check": ["check", "robot.urdf"],
    "convert": ["convert", "robot.urdf", "--to", "sdf", "-o", "robot.sdf"],
    "format": ["format", "--check", "robot.urdf"],
    "diff": ["diff", "robot.urdf", "other.urdf"],
}
"""The commands that people and editors start all day, by their names."""

_ALL = {
    "signal": "Ctrl-C and SIGTERM undo what is unfinished",
    "gc": "a short run collects no garbage",
    "atexit": "handlers of others are called where the process ends early",
    "contextvars": "which files a run depends on",
    "dataclasses": "all that is no node",
    "unicodedata": "names that look alike; columns of findings",
    "xml": "the tokens of a text, with their places",
    "array": "offsets of tokens and lines",
    "bisect": "the line of an offset",
    "locale": "click asks which language its messages are in",
}
REASONS: Mapping[str, Mapping[str, str]] = {
    "check": _ALL,
    "convert": _ALL | {
        "shutil": "the temporary folder of results is removed",
        "fcntl": "one process at a time writes into a folder",
        "difflib": "click takes `-o` for a long option first, and looks for similar ones",
    },
    "format": _ALL,
    "diff": _ALL,
}  # fmt: skip
"""Why a command imports modules of the standard library beside those that click and lxml import."""


class Imported(NamedTuple):
    """A module, the milliseconds that it took without those that it imported, and the module that imported it."""

    name: str
    milliseconds: float
    by: str


def imported(command: str, folder: Path) -> Sequence[Imported]:
    """What a command imports; its files are made in the folder."""
    robot = robots.urdf(_LINKS)
    (folder / "robot.urdf").write_text(robot, encoding="utf-8")
    (folder / "other.urdf").write_text(f"{robot}<!-- the same robot -->", encoding="utf-8")
    return _imported(["-m", "twinform", *COMMANDS[command]], folder)


@cache
def of_libraries() -> frozenset[str]:
    """What click and lxml import, and Python itself."""
    # the first three are what click brings on Python 3.11 and 3.12 and no more after that
    program = "import math, pathlib, urllib.parse; import click; from lxml import etree"
    return frozenset(each.name for each in _imported(["-c", program], Path.cwd()))


def packages_beside(found: Sequence[Imported]) -> Mapping[str, str]:
    """The packages that our modules import beside each other and what click and lxml bring, each with who does.

    Nobody is known for what a function imports while the command runs.
    """
    known = {name.partition(".")[0] for name in of_libraries()} | {"twinform", "runpy"}
    ours = [(each.name.partition(".")[0], each.by) for each in found if not each.by or each.by.startswith("twinform")]
    return {name: by for name, by in reversed(ours) if name not in known and not name.startswith("_")}


def _imported(arguments: Sequence[str], folder: Path) -> Sequence[Imported]:
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    command = [sys.executable, "-P", "-X", "importtime", *arguments]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    return list(_parsed(done.stderr))[::-1]


def _parsed(text: str) -> Iterator[Imported]:
    """Read the lines from the last one on: each stands behind those that it imported, which are indented further."""
    above: list[tuple[int, str]] = []
    for found in reversed(list(_LINE.finditer(text))):
        depth = len(found["indent"])
        while above and above[-1][0] >= depth:
            above.pop()
        yield Imported(found["name"], int(found["own"]) / 1e3, above[-1][1] if above else "")
        above.append((depth, found["name"]))
