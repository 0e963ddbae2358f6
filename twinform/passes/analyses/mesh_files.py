"""Opening untrusted mesh files with `trimesh`."""

import importlib
import io
from pathlib import Path
from typing import Any

READ = frozenset({"stl", "obj", "dae", "ply", "off", "glb"})
"""Formats that hold all of a mesh in one file, or what else they name is only its appearance."""
EXTRA = "pip install 'twinform[meshes]'"
READERS = frozenset({"trimesh", "collada"})
"""What the extra brings."""
_LARGEST = 2**28
"""A file of a quarter of a gigabyte has five million triangles."""

Scene = Any
"""A `trimesh.Scene`."""


class RefusedMeshError(ValueError):
    """A mesh file that is not given to any reader; the message has the reason."""


def kind_of(path: Path) -> str:
    """The format of a file, by its name."""
    return path.suffix.lower().removeprefix(".")


def open_scene(path: Path, *, process: bool = True) -> Scene:
    """The meshes of a file and where it puts them; with `process`, vertices at one place are merged.

    Raises:
        ImportError: the extra is not installed.
        OSError: the file cannot be read.
        RefusedMeshError: it is no file, is too large, or declares a document type.
        Exception: what the reader of the format raises.
    """
    if path.exists() and not path.is_file():
        raise RefusedMeshError("it is no file")  # whoever opens a pipe may wait for ever
    if path.stat().st_size > _LARGEST:
        raise RefusedMeshError(f"it is larger than {_LARGEST >> 20} MiB")
    content, kind = path.read_bytes(), kind_of(path)
    if kind == "dae" and b"<!" in content.replace(b"<!--", b"").replace(b"<![CDATA[", b""):
        raise RefusedMeshError("it declares a document type, which may name other files")
    trimesh: Any = importlib.import_module("trimesh")
    # without a resolver nothing is read but this file
    return trimesh.load_scene(io.BytesIO(content), file_type=kind, resolver=None, skip_materials=True, process=process)
