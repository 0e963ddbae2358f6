"""URDFs that name meshes, in a folder of robots, as MuJoCo can read them: all paths absolute, all meshes OBJ or STL.

MuJoCo knows no packages and no COLLADA, so that it loads hardly any robot from where it lies. What is changed here is
changed without the compiler under test: a file is sought in the folders around the robot, and trimesh converts it.
"""

import importlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from lxml import etree

_READ = frozenset({".obj", ".stl"})
_MARKS = (b"<robot", b"<mesh")


class MissingFileError(Exception):
    """A robot names a mesh that is nowhere around it."""


def mesh_robots(folder: Path) -> list[Path]:
    """Return the URDF files below a folder that name meshes, sorted."""
    return sorted(path for path in folder.rglob("*.urdf") if path.is_file() and _has_meshes(path.read_bytes()))


def _has_meshes(text: bytes) -> bool:
    return all(mark in text for mark in _MARKS) and b"<xacro:" not in text


def with_files(path: Path, made: Path) -> bytes:
    """Return the text of a robot with absolute paths of meshes; converted ones are written into the folder `made`.

    Raises:
        MissingFileError: a mesh is not found.
    """
    # broken in ways that others forgive, such as a declaration of version 0.0
    root = etree.fromstring(path.read_bytes(), etree.XMLParser(recover=True, remove_comments=True, remove_pis=True))
    for mesh in root.iter("mesh"):
        mesh.set("filename", str(_readable(_find(mesh.get("filename", ""), path), made)))
    return etree.tostring(root)


def _find(uri: str, path: Path) -> Path:
    """Return the file of a URI.

    Raises:
        MissingFileError: there is none.
    """
    scheme, _, rest = uri.rpartition("://")
    places = [path.parent / rest] if scheme in {"", "file"} else list(_around(path, rest))
    found = next((each for each in places if each.is_file()), None)
    if found is None:
        raise MissingFileError(f"{uri!r} is not found")
    return found


def _around(path: Path, rest: str) -> Iterator[Path]:
    package, _, inside = rest.partition("/")
    for folder in path.parents:
        yield folder / package / inside
        if folder.name == package:
            yield folder / inside


def _readable(file: Path, made: Path) -> Path:
    """Return the file, or a copy of it in a format of MuJoCo."""
    data = file.read_bytes() if file.suffix.lower() == ".stl" else b""
    is_text = bool(data) and len(data) != 84 + 50 * int.from_bytes(data[80:84], "little")
    if file.suffix.lower() in _READ and not is_text:
        return file
    trimesh: Any = importlib.import_module("trimesh")
    copy = made / f"{len(list(made.iterdir()))}_{file.stem}.obj"
    mesh = trimesh.load(file, force="mesh")
    mesh.apply_scale(_unit(file))
    mesh.export(copy, digits=17)
    return copy


def _unit(file: Path) -> float:
    """Return the meters of the unit of a COLLADA file, which trimesh leaves out of its points."""
    if file.suffix.lower() != ".dae":
        return 1.0
    unit = etree.parse(file).find("{*}asset/{*}unit")
    return float(unit.get("meter", "1")) if unit is not None else 1.0
