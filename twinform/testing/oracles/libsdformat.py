"""libsdformat 12, the reference parser of SDF: its messages on a file, the models and the files that it finds.

It is asked by small C++ programs, which are built with g++ on first use, and kept in the user's cache.
"""

import hashlib
import json
import os
import re
import shutil
import subprocess
from collections.abc import Callable, Generator, Iterable
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import NotRequired, TypedDict

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern

_INCLUDE = lazy_pattern(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Program:
    """A program: its source, and the packages of pkg-config and other libraries that it is built against.

    It is built again when the source changes, or a header that the source includes by a relative path.
    """

    source: Path
    packages: tuple[str, ...]
    libraries: tuple[str, ...] = ()

    def can_be_built(self) -> bool:
        """Whether the libraries and the tools to build against them are installed."""
        return _installed(self.packages)

    def built(self) -> Path:
        """Return the path of the program, and build it first if it is not there yet.

        Raises:
            CalledProcessError: it does not build.
        """
        return _built(self)


@cache
def _installed(packages: tuple[str, ...]) -> bool:
    if not (shutil.which("pkg-config") and shutil.which("g++")):
        return False
    return subprocess.run(["pkg-config", "--exists", *packages], check=False).returncode == 0


@cache
def _built(program: Program) -> Path:
    digest = hashlib.sha256(b"\0".join(path.read_bytes() for path in sources(program.source))).hexdigest()
    folder = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", "twinform", "oracles")
    path = folder / f"{program.source.stem}-{digest[:12]}"
    if not path.exists():
        _build(program, path)
    return path


def sources(path: Path, known: tuple[Path, ...] = ()) -> tuple[Path, ...]:
    """Return a source and all headers that it includes by relative paths, directly or through others."""
    if path in known:
        return known
    known = (*known, path)
    for name in _INCLUDE.findall(path.read_text(encoding="utf-8")):
        known = sources((path.parent / name).resolve(), known)
    return known


def _build(program: Program, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    flags = subprocess.run(
        ["pkg-config", "--cflags", "--libs", *program.packages], capture_output=True, text=True, check=True
    ).stdout.split()
    # two test processes may build at the same time: each builds its own, and the last one wins
    own = path.with_name(f"{path.name}.{os.getpid()}")
    flags += [f"-l{name}" for name in program.libraries]
    subprocess.run(["g++", "-O1", "-std=c++17", str(program.source), "-o", str(own), *flags], check=True)
    own.replace(path)


MISSING = "libsdformat 12 is not here: it needs libsdformat-dev, pkg-config and g++"

_PROGRAM = Program(Path(__file__).with_name("sdf_load.cpp"), ("sdformat12",))


class _Error(TypedDict):
    code: int
    message: str


class ShapeRow(TypedDict):
    """A visual or collision: `pose` as it is written, `place` in the link, each a position and a quaternion.

    `geometry` is the library's number for the kind of shape. `values` are the texts below the shape that differ from
    the library's default, by path, such as `surface/friction/ode/mu`; geometry and plugins are left out.
    """

    kind: str
    name: str
    pose: list[float]
    place: list[float]
    geometry: int
    values: dict[str, str]


class LinkRow(TypedDict):
    """A link: poses are a position and a quaternion, moments are xx, yy, zz, xy, xz, yz about the center of mass.

    `values` are the link's own elements, such as `gravity`, that differ from the library's default.
    """

    name: str
    pose: list[float]
    mass: float
    center: list[float]
    moments: list[float]
    values: dict[str, str]
    shapes: list[ShapeRow]


class JointRow(TypedDict):
    """A joint at its zero position; `kind` is the library's number for the type."""

    name: str
    kind: int
    parent: str
    child: str
    pose: list[float]
    axis: NotRequired[list[float]]
    limits: NotRequired[dict[str, float]]


class SensorRow(TypedDict):
    """A sensor on the link or joint `inside`: its position and quaternion, and its XML without the pose."""

    name: str
    inside: str
    kind: str
    pose: list[float]
    text: str


class PluginRow(TypedDict):
    """A plugin: its XML, the tag of its parent, and the names of all elements around it in the model."""

    inside: str
    parts: list[str]
    text: str


class RobotRow(TypedDict):
    """A model, in its own frame."""

    name: str
    pose: list[float]
    static: bool
    values: dict[str, str]
    links: list[LinkRow]
    joints: list[JointRow]
    sensors: list[SensorRow]
    plugins: list[PluginRow]


class _OutputRow(TypedDict):
    """A line of the program's output."""

    path: str
    ok: bool
    errors: list[_Error]
    console: str
    robot: NotRequired[RobotRow]
    models: NotRequired[list[RobotRow]]


@dataclass(frozen=True, slots=True)
class LibsdformatReading:
    """Whether the file was read without an error, and the errors as `code: message`.

    `console` is what the library prints, its own warnings and all messages of urdfdom, none of which are errors to it.
    """

    ok: bool
    errors: tuple[str, ...] = ()
    console: str = ""


def available() -> bool:
    """Whether the library and the tools to build against it are installed."""
    return _PROGRAM.can_be_built()


def judge(paths: Iterable[Path]) -> dict[Path, LibsdformatReading]:
    """Return the library's messages on each file; a crash or hang of the library is an error of that file."""
    waiting = [Path(path).resolve() for path in paths]
    names = "".join(f"{path}\n" for path in waiting).encode()
    done = subprocess.run([str(_PROGRAM.built())], input=names, stdout=subprocess.PIPE, check=True)
    rows: list[_OutputRow] = [json.loads(line) for line in done.stdout.decode(errors="replace").splitlines()]
    return {path: _reading(row) for path, row in zip(waiting, rows, strict=True)}


def describe(path: Path) -> RobotRow:
    """Return the first model of a file.

    Raises:
        RuntimeError: the library has errors for the file, or there is no model in it.
    """
    with describing() as describe_one:
        return describe_one(path)


@contextmanager
def describing() -> Generator[Callable[[Path], RobotRow]]:
    """Provide `describe` as a function that asks one process for all files, since the library takes long to start."""
    command = [str(_PROGRAM.built()), "--robots"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:

        def describe_one(path: Path) -> RobotRow:
            assert process.stdin is not None
            assert process.stdout is not None
            process.stdin.write(f"{path.resolve()}\n".encode())
            process.stdin.flush()
            return _robot(json.loads(process.stdout.readline().decode(errors="replace")))

        yield describe_one


def _robot(row: _OutputRow) -> RobotRow:
    if errors := _reading(row).errors:
        raise RuntimeError("; ".join(errors))
    if "robot" not in row:
        raise RuntimeError("there is no model in it")
    return row["robot"]


def models_of(path: Path, folders: Iterable[Path] = ()) -> tuple[LibsdformatReading, list[RobotRow]]:
    """Return the messages on a file and all its models, those in worlds too; no models if there are errors.

    Includes are looked up beside the file, and then in the folders.
    """
    path = path.resolve()
    places = os.pathsep.join(str(folder.resolve()) for folder in (path.parent, *folders))
    done = subprocess.run(
        [str(_PROGRAM.built()), "--models", str(path)],
        stdout=subprocess.PIPE,
        check=True,
        cwd=path.parent,
        env={**os.environ, "SDF_PATH": places},
    )
    row: _OutputRow = json.loads(done.stdout.decode(errors="replace"))
    reading = _reading(row)
    return reading, row.get("models", []) if reading.ok else []


def _reading(row: _OutputRow) -> LibsdformatReading:
    errors = tuple(f"{error['code']}: {error['message']}" for error in row["errors"])
    return LibsdformatReading(row["ok"], errors, row["console"])


_FILES_PROGRAM = Program(Path(__file__).with_name("sdf_files.cpp"), ("sdformat12",))


@dataclass(frozen=True, slots=True)
class NamedFiles:
    """The errors of loading a file, and the path of each URI in it; None if the library finds no file."""

    errors: tuple[str, ...]
    paths: dict[str, Path | None]


def named_files(file: Path, folders: Iterable[Path] = ()) -> NamedFiles:
    """Find the meshes, terrains, scripts and textures of all models of a file, in these folders and no others."""
    places = os.pathsep.join(str(folder.resolve()) for folder in folders)
    done = subprocess.run(
        [str(_FILES_PROGRAM.built()), str(file.resolve())],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        check=True,
        cwd="/",
        env={**os.environ, "SDF_PATH": places},
    )
    rows: list[dict[str, str]] = [json.loads(line) for line in done.stdout.decode(errors="replace").splitlines()]
    errors = tuple(row["error"] for row in rows if "error" in row)
    paths = {row["uri"]: Path(row["path"]) if row["path"] else None for row in rows if "uri" in row}
    return NamedFiles(errors, paths)
