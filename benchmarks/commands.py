"""CPU time of whole commands, from start to exit: `python -m benchmarks.commands [--beside CHECKOUT]...`.

Every command is run in turns with the others, so that what else the machine does hits all of them alike. The figures
are CPU time of the process and its children, user and system, with byte code present.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from statistics import median
from typing import NamedTuple

from testbed import robots
from testbed.corpus.files import ROOT
from testbed.markdown import table
from twinform.text import SourceText
from twinform.text.formatting import FormatOptions, format_text

LINKS, RUNS = 30, 15
_TWINFORM = ("-m", "twinform")  # as people start it: `cli.main` is for other programs
_XACRO = ("-c", "import sys; from xacro import main; sys.exit(main())")
BARE = "python -c pass"
LIMITS = (
    (f"twinform check, {LINKS} links", BARE, 140),
    (f"twinform convert, {LINKS} links", BARE, 190),
    (f"twinform format --check, {LINKS} links", BARE, 110),
    (f"twinform diff, {LINKS} links", BARE, 230),
    (f"twinform check, {LINKS} links of xacro", "xacro", 90),
    ("import twinform", BARE, 25),
)
"""What a command may take, in ms over another one."""


class Command(NamedTuple):
    """A command line of Python, and the checkout that it is run from."""

    name: str
    arguments: Sequence[str]
    checkout: Path


def main() -> int:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--beside", type=Path, action="append", default=[], help="another checkout of twinform")
    parser.add_argument("--runs", type=int, default=RUNS)
    asked = parser.parse_args()
    checkouts = [*(path.resolve() for path in asked.beside), ROOT]
    with tempfile.TemporaryDirectory() as folder:
        found = measured(Path(folder), checkouts, asked.runs)
    print(page(found, checkouts))
    return 0


def page(found: Mapping[Command, float], checkouts: Sequence[Path]) -> str:
    """The table: a row for each command, a column for each checkout."""
    bare = next(ms for command, ms in found.items() if command.name == BARE)
    head = ["CPU ms, and over bare Python", *(path.name for path in checkouts)]
    names = dict.fromkeys(command.name for command in found)
    rows = [[name, *(_cell(found, name, checkout, bare) for checkout in checkouts)] for name in names]
    return table(head, rows)


def _cell(found: Mapping[Command, float], name: str, checkout: Path, bare: float) -> str:
    ms = next((ms for command, ms in found.items() if (command.name, command.checkout) == (name, checkout)), None)
    return "" if ms is None else f"{ms:.0f} (+{ms - bare:.0f})"


def measured(folder: Path, checkouts: Sequence[Path], runs: int = RUNS) -> dict[Command, float]:
    """The median of the CPU time of each command, in ms."""
    found = {command: list[float]() for command in commands(folder, checkouts)}
    for _ in range(2):
        for command in found:
            cpu_ms(command, folder)  # writes the byte code
    for _ in range(runs):
        for command, times in found.items():
            times.append(cpu_ms(command, folder))
    return {command: median(times) for command, times in found.items()}


def commands(folder: Path, checkouts: Sequence[Path]) -> list[Command]:
    """What is measured; its files are made in the folder."""
    text = robots.urdf(LINKS)
    robot, xacro = folder / "robot.urdf", folder / "robot.urdf.xacro"
    robot.write_text(text, encoding="utf-8")
    declared = text.replace("<robot ", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" ')
    xacro.write_text(declared.replace("0.5 0.5 0.5 1", "${1 / 2} 0.5 0.5 1"), encoding="utf-8")
    common = [Command(BARE, ("-c", "pass"), ROOT), Command("xacro", (*_XACRO, xacro.name), ROOT)]
    common += [Command("import twinform", ("-c", "import twinform"), checkout) for checkout in checkouts]
    tidy, other = folder / "tidy.urdf", folder / "other.urdf"
    tidy.write_text(format_text(SourceText(text), FormatOptions()).text, encoding="utf-8")
    other.write_text(text + "<!-- the same robot -->", encoding="utf-8")
    ours = {
        "twinform --version": ["--version"],
        f"twinform check, {LINKS} links": ["check", robot.name],
        f"twinform convert, {LINKS} links": ["convert", robot.name, "--to", "sdf", "-o", "robot.sdf"],
        f"twinform format --check, {LINKS} links": ["format", "--check", tidy.name],
        f"twinform diff, {LINKS} links": ["diff", robot.name, other.name],
        f"twinform check, {LINKS} links of xacro": ["check", xacro.name],
        f"twinform convert, {LINKS} links of xacro": ["convert", xacro.name, "--to", "sdf", "-o", "expanded.sdf"],
    }
    return common + [
        Command(name, (*_TWINFORM, *arguments), checkout) for name, arguments in ours.items() for checkout in checkouts
    ]


def cpu_ms(command: Command, folder: Path) -> float:
    """The CPU time of one run, with that of its children.

    Raises:
        RuntimeError: the command failed.
    """
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    environment["PYTHONPATH"] = str(command.checkout)
    process = subprocess.Popen(
        [sys.executable, *command.arguments],
        cwd=folder,
        env=environment,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise RuntimeError(f"{command.name} ended with {process.returncode}")
    return (used.ru_utime + used.ru_stime) * 1e3


if __name__ == "__main__":
    sys.exit(main())
