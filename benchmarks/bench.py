"""How fast it is: `make bench`. Writes docs/evidence/performance.md; asserts nothing."""

import os
import platform
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from statistics import median

from lxml import etree

import twinform
from benchmarks import robots
from benchmarks.stages import profile_urdf_to_sdf
from reports.harness.pages import table, write
from tests.corpus.files import ROOT

PAGE = ROOT / "docs" / "reference" / "performance.md"
SDF_VERSION = "1.11"
SIZES = (10, 30, 100, 300, 1000, 3000, 10000)
PROFILED = 1000
COMMAND_LINKS, COMMAND_RUNS = 30, 9
SECONDS_PER_FIGURE = 3.0
INTRODUCTION = f"""# How fast it is

Made by `make bench`. The robots are trees with {robots.ELEMENTS_PER_LINK} elements for each link; each figure is the
median of several runs in one process, the garbage collector left as a user has it. *Floor* is what lxml needs to parse
and serialize the same bytes. *Load* is parsing, both checks of the input (facts table and XSD) and the IR; *convert* is
load, the passes, writing, and the check of the output against its XSD."""


def main() -> int:
    """Measure and write the page."""
    texts = {links: robots.urdf(links).encode() for links in SIZES}
    write(
        PAGE,
        INTRODUCTION,
        f"Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores.",
        "## Sizes\n\n" + _sizes(texts),
        f"## Where the time goes\n\nURDF to SDF, {PROFILED:,} links.\n\n" + _stages(texts[PROFILED]),
        "## The whole command\n\n" + _command(texts[COMMAND_LINKS]),
    )
    print(PAGE.read_text(encoding="utf-8"))
    return 0


def _sizes(texts: dict[int, bytes]) -> str:
    head = ["links", "kB", "floor ms", "load ms", "load / floor"]
    head += ["URDF to SDF ms", "ms per link", "SDF to URDF ms", "ms per link"]
    return table(head, (_size(links, text) for links, text in texts.items()))


def _size(links: int, text: bytes) -> Sequence[object]:
    sdf = _to_sdf(text)
    floor = _seconds(lambda: etree.tostring(etree.fromstring(text)))
    load = _seconds(lambda: twinform.loads(text))
    there = _seconds(lambda: _to_sdf(text))
    back = _seconds(lambda: twinform.convert(sdf, name="robot.sdf", to="urdf"))
    print(f"{links} links: {there / links * 1e3:.3f} ms per link", file=sys.stderr)
    return (
        links,
        len(text) // 1000,
        *(_ms(floor), _ms(load), f"{load / floor:.1f}"),
        *(_ms(there), _ms(there / links), _ms(back), _ms(back / links)),
    )


def _to_sdf(text: bytes) -> bytes:
    return twinform.convert(text, name="robot.urdf", to="sdf", sdf_version=SDF_VERSION).text.encode()


def _stages(text: bytes) -> str:
    seconds = profile_urdf_to_sdf(text, sdf_version=SDF_VERSION, runs=9)
    whole = sum(seconds.values())
    rows = [
        (name, _ms(value), f"{value / PROFILED * 1e6:.0f}", f"{value / whole:.0%}") for name, value in seconds.items()
    ]
    rows.append(("all", _ms(whole), f"{whole / PROFILED * 1e6:.0f}", "100%"))
    return table(["stage", "ms", "us per link", "share"], rows)


def _command(text: bytes) -> str:
    with tempfile.TemporaryDirectory() as folder:
        source, result = Path(folder, "robot.urdf"), Path(folder, "robot.sdf")
        source.write_bytes(text)
        rows = [
            (
                f"twinform convert, {COMMAND_LINKS} links",
                _run("convert", str(source), "--to", "sdf", "-o", str(result)),
            ),
            (f"twinform check, {COMMAND_LINKS} links", _run("check", str(source))),
            ("twinform --version", _run("--version")),
        ]
    return f"Median of {COMMAND_RUNS} processes.\n\n" + table(["command", "ms"], rows)


def _run(*arguments: str) -> str:
    command = [sys.executable, "-c", "import sys; from twinform.cli import main; sys.exit(main())", *arguments]

    def once() -> None:
        subprocess.run(command, check=True, capture_output=True)

    once()  # writes the byte code
    return _ms(median(_timed(once) for _ in range(COMMAND_RUNS)))


def _seconds(action: Callable[[], object]) -> float:
    """The median of as many runs as fit into the time for a figure; at least three."""
    first = _timed(action)
    runs = max(3, min(50, int(SECONDS_PER_FIGURE / max(first, 1e-9))))
    return median(_timed(action) for _ in range(runs))


def _timed(action: Callable[[], object]) -> float:
    start = time.perf_counter()
    action()
    return time.perf_counter() - start


def _ms(seconds: float) -> str:
    return f"{seconds * 1e3:.3g}" if seconds < 1 else f"{seconds * 1e3:.0f}"


if __name__ == "__main__":
    sys.exit(main())
