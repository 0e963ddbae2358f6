"""What libsdformat 12, the reference parser of SDF, says of a file."""

import hashlib
import json
import os
import shutil
import subprocess
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from itertools import islice
from pathlib import Path
from typing import NotRequired, TypedDict

MISSING = "libsdformat 12 is not here: it needs libsdformat-dev, pkg-config and g++"

_SOURCE = Path(__file__).with_name("sdf_load.cpp")
_AT_ONCE = 50
_SECONDS_PER_FILE = 20


class _Error(TypedDict):
    code: int
    message: str


class ShapeRow(TypedDict):
    """A visual or collision; its pose is as it is written, a position and a quaternion."""

    kind: str
    name: str
    pose: list[float]


class LinkRow(TypedDict):
    """A link: poses are a position and a quaternion, moments are xx, yy, zz, xy, xz, yz about the centre of mass."""

    name: str
    pose: list[float]
    mass: float
    centre: list[float]
    moments: list[float]
    shapes: list[ShapeRow]


class JointRow(TypedDict):
    """A joint at its zero position, with the number that the library has for its kind."""

    name: str
    kind: int
    parent: str
    child: str
    pose: list[float]
    axis: NotRequired[list[float]]
    limits: NotRequired[dict[str, float]]


class SensorRow(TypedDict):
    """A sensor: the pose is a position and a quaternion, the text is its XML without the pose."""

    name: str
    kind: str
    pose: list[float]
    text: str


class PluginRow(TypedDict):
    """A plugin: its XML, and the tag of the element that it is in."""

    inside: str
    text: str


class RobotRow(TypedDict):
    """A model, in its own frame."""

    pose: list[float]
    static: bool
    links: list[LinkRow]
    joints: list[JointRow]
    sensors: list[SensorRow]
    plugins: list[PluginRow]


class _Row(TypedDict):
    """A line of the program's output."""

    path: str
    ok: bool
    errors: list[_Error]
    robot: NotRequired[RobotRow]


@dataclass(frozen=True, slots=True)
class Reading:
    """Whether the file was read without an error, and the errors as `code: message`."""

    ok: bool
    errors: tuple[str, ...] = ()


@cache
def available() -> bool:
    """Whether the library and the tools to build against it are installed."""
    if not (shutil.which("pkg-config") and shutil.which("g++")):
        return False
    return subprocess.run(["pkg-config", "--exists", "sdformat12"], check=False).returncode == 0


def judge(paths: Iterable[Path]) -> dict[Path, Reading]:
    """The verdict on each file. A file on which the library crashes or hangs gets an error of its own."""
    waiting = [Path(path).resolve() for path in paths]
    verdicts: dict[Path, Reading] = {}
    for chunk in _chunks(waiting):
        while rest := [path for path in chunk if path not in verdicts]:
            verdicts |= _run(rest)
    return verdicts


def describe(path: Path) -> RobotRow:
    """The first model of a file.

    Raises:
        RuntimeError: the library has errors for the file, or there is no model in it.
    """
    command = [str(_program()), "--robots", str(path)]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    if done.returncode:
        raise RuntimeError(f"libsdformat ended with {done.returncode}")
    row: _Row = json.loads(done.stdout.decode(errors="replace"))
    if errors := _reading(row).errors:
        raise RuntimeError("; ".join(errors))
    if "robot" not in row:
        raise RuntimeError("there is no model in it")
    return row["robot"]


def _chunks(paths: list[Path]) -> Iterator[list[Path]]:
    upcoming = iter(paths)
    while chunk := list(islice(upcoming, _AT_ONCE)):
        yield chunk


def _run(paths: list[Path]) -> dict[Path, Reading]:
    """The verdicts up to and including the first file that the library does not survive."""
    command = [str(_program()), *map(str, paths)]
    try:
        seconds = _SECONDS_PER_FILE * len(paths)
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False, timeout=seconds)
        output, failure = done.stdout, f"libsdformat ended with {done.returncode}"
    except subprocess.TimeoutExpired as expired:
        output, failure = expired.stdout or b"", "libsdformat did not come to an end"
    rows: list[_Row] = [json.loads(line) for line in output.decode(errors="replace").splitlines()]
    verdicts = {path: _reading(row) for path, row in zip(paths, rows, strict=False)}
    return verdicts if len(verdicts) == len(paths) else verdicts | {paths[len(verdicts)]: Reading(False, (failure,))}


def _reading(row: _Row) -> Reading:
    return Reading(row["ok"], tuple(f"{error['code']}: {error['message']}" for error in row["errors"]))


@cache
def _program() -> Path:
    program = _folder() / f"sdf_load-{hashlib.sha256(_SOURCE.read_bytes()).hexdigest()[:12]}"
    if not program.exists():
        _build(program)
    return program


def _folder() -> Path:
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(cache) / "twinform" / "oracles"


def _build(program: Path) -> None:
    program.parent.mkdir(parents=True, exist_ok=True)
    flags = subprocess.run(
        ["pkg-config", "--cflags", "--libs", "sdformat12"], capture_output=True, text=True, check=True
    ).stdout.split()
    # two test processes may build at the same time: each builds its own, and the last one wins
    own = program.with_name(f"{program.name}.{os.getpid()}")
    subprocess.run(["g++", "-O1", "-std=c++17", str(_SOURCE), "-o", str(own), *flags], check=True)
    own.replace(program)
