"""Robots with meshes: those of `example-robot-data` and `pybullet_data`, where these packages are installed."""

import sysconfig
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

MISSING = "no robots with meshes are here: pip install '.[robots]'"
_SITE = Path(sysconfig.get_path("purelib"))
_SHARE = _SITE / "cmeel.prefix/share"
_MESH, _JOINT = b"<mesh", b"<joint "
_LEFT_OUT = ("random_urdfs", "objects", "testdata")
"""Folders of things that are no robots: nine hundred shapes for picking, cups, what tests need."""


@dataclass(frozen=True, slots=True)
class Robot:
    """A URDF file, and the folders in which its packages are."""

    name: str
    file: Path
    paths: tuple[Path, ...] = ()


def robots() -> list[Robot]:
    """One of each folder of robots that is installed, by name: its variants have the same meshes."""
    found = sorted([*_example_robot_data(), *_pybullet_data()], key=lambda robot: robot.name)
    return list({robot.name.rpartition("/")[0]: robot for robot in reversed(found)}.values())[::-1]


def _example_robot_data() -> Iterator[Robot]:
    folder = _SHARE / "example-robot-data/robots"
    for file in _with_meshes(folder):
        yield Robot(f"example-robot-data/{file.relative_to(folder).parts[0]}/{file.stem}", file, (_SHARE,))


def _pybullet_data() -> Iterator[Robot]:
    folder = _SITE / "pybullet_data"
    for file in _with_meshes(folder):
        if not set(_LEFT_OUT) & set(file.relative_to(folder).parts):
            yield Robot(f"pybullet_data/{file.relative_to(folder).with_suffix('').as_posix()}", file)


def _with_meshes(folder: Path) -> Iterator[Path]:
    """The files with meshes and at least two joints: one body alone is no robot."""
    for file in sorted(folder.rglob("*.urdf")):
        text = file.read_bytes()
        if _MESH in text and text.count(_JOINT) > 1:
            yield file
