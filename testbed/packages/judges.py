"""The programs that are shown a package, each with what it has to find there.

A judge gives the reason why it is not content: empty where it is, and None where it cannot judge this robot.
"""

import json
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from posixpath import normpath

from testbed.packages.public_robots import Robot
from twinform.passes.mesh_references import FORMATS
from twinform.testing import oracles
from twinform.testing.oracles.libsdformat import available, named_files

_FOR_LIBSDFORMAT = "model-1_9.sdf"
"""The newest version that libsdformat 12 reads."""
_URI = re.compile(r"\w+://[^\s\"'<>]+")
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_ELSEWHERE = ("http://", "https://", "file://media/")
"""What is no file of the robot: names of namespaces, addresses, and what Gazebo Classic brought."""


@dataclass(frozen=True, slots=True)
class Packaged:
    """A robot, and the folder that it was packaged into."""

    robot: Robot
    folder: Path


@dataclass(frozen=True, slots=True)
class Judge:
    """A program, what it is asked, why it cannot be asked here, if so."""

    name: str
    about: str
    judged: Callable[[Packaged], str | None]
    missing: Callable[[], str] = lambda: ""


def _check(packaged: Packaged) -> str:
    """The errors of the package, and files that are missing; other warnings are those of the robot."""
    command = [sys.executable, "-m", "twinform", "check", "--format", "json", str(packaged.folder)]
    done = subprocess.run(command, capture_output=True, check=False, cwd="/")
    if done.returncode == 2:
        return done.stderr.decode(errors="replace").strip()
    found = [each for file in json.loads(done.stdout)["files"] for each in file["diagnostics"]]
    wrong = [each for each in found if each["severity"] == "error" or each["rule"] == "missing-file"]
    return "; ".join(each["message"] for each in wrong[:2])


def _complete(packaged: Packaged) -> str:
    """Files that texts or meshes of the package name and that are not in it."""
    return "; ".join(list(_absent(packaged.folder))[:2])


def _absent(folder: Path) -> Iterator[str]:
    for file in sorted(folder.rglob("*")):
        if file.is_symlink():
            yield f"{file.name} is a link"
        if file.suffix in {".sdf", ".urdf"}:
            for uri in dict.fromkeys(_URI.findall(_COMMENT.sub("", file.read_text(encoding="utf-8")))):
                inner = uri.partition("://")[2].partition("/")
                if not uri.startswith(_ELSEWHERE) and not (inner[0] == folder.name and (folder / inner[2]).is_file()):
                    yield f"{file.name} names {uri}"
        format_ = FORMATS.get(file.suffix.lower().removeprefix("."))
        for name in format_.references(file.read_bytes()) if format_ and file.is_file() else ():
            path = Path(normpath(file.parent / name))
            if not path.is_relative_to(folder) or not path.is_file():
                yield f"{file.name} names {name}"


def _libsdformat(packaged: Packaged) -> str:
    """What the library reports, and the files that it does not find from the folder around."""
    found = named_files(packaged.folder / _FOR_LIBSDFORMAT, [packaged.folder.parent])
    paths = {uri: path for uri, path in found.paths.items() if not uri.startswith(_ELSEWHERE)}
    lost = [uri for uri, path in paths.items() if path is None or not path.is_relative_to(packaged.folder)]
    return "; ".join((*found.errors, *lost)[:2])


def _included(packaged: Packaged) -> str:
    """What the library reports about a world that includes the model by the name of its folder."""
    world = packaged.folder.with_suffix(".world")
    include = f"<include><uri>model://{packaged.folder.name}</uri></include>"
    world.write_text(f'<sdf version="1.9"><world name="w">{include}</world></sdf>', encoding="utf-8")
    return "; ".join(named_files(world, [packaged.folder.parent]).errors[:2])


def _drake(packaged: Packaged) -> str | None:
    """How the robot differs from its source in Drake; None where Drake cannot read the source."""
    try:
        verdict = oracles.compare(packaged.robot.file, packaged.folder / "model.sdf", engine="drake")
    except oracles.EngineUnreadableError as error:
        return None if error.path == packaged.robot.file.resolve() else error.cause
    return "" if verdict else str(verdict)


JUDGES: tuple[Judge, ...] = (
    Judge("check", "`twinform check` finds no error, and no file that is missing", _check),
    Judge("complete", "every URI, and every file that a mesh names, is in the folder; there are no links", _complete),
    Judge(
        "libsdformat 12",
        "reads the model without an error, and finds all its files with the folder around as its only path",
        _libsdformat,
        lambda: "" if available() else "not installed",
    ),
    Judge(
        "include",
        "libsdformat 12 reads a world that includes the model as `model://NAME`, so it understands model.config",
        _included,
        lambda: "" if available() else "not installed",
    ),
    Judge(
        "Drake",
        "reads the same robot from the package as from the source, where it reads that",
        _drake,
        lambda: "" if oracles.available("drake") else "not installed",
    ),
)
