"""Opening untrusted mesh files with `trimesh`."""

import importlib
import io
from collections.abc import Iterable, Mapping
from pathlib import Path, PurePath
from typing import Any

from twinform.file_access import read_regular

READ = frozenset({"stl", "obj", "dae", "ply", "off", "glb"})
"""Formats that hold all of a mesh in one file, or what else they name is only its appearance."""
EXTRA = "pip install 'twinform[meshes]'"
READERS = frozenset({"trimesh", "collada"})
"""What the extra brings."""
LARGEST = 2**28
"""A file of a quarter of a gigabyte has five million triangles."""
POINTER = "a pointer of Git LFS and not the file itself"
_POINTER = b"version https://git-lfs.github.com/spec/"

Scene = Any
"""A `trimesh.Scene`."""


class RefusedMeshError(ValueError):
    """A mesh file that is not given to any reader, or that nothing can be made of; the message has the reason."""


def kind_of(path: PurePath) -> str:
    """The format of a file, by its name."""
    return path.suffix.lower().removeprefix(".")


def is_pointer(content: bytes) -> bool:
    """Whether a file only says which one Git LFS would put in its place: that was never fetched."""
    return content.startswith(_POINTER)


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
    if path.stat().st_size > LARGEST:
        raise RefusedMeshError(f"it is larger than {LARGEST >> 20} MiB")
    return scene_of(read_regular(path), kind_of(path), process=process)


def scene_of(
    content: bytes,
    kind: str,
    *,
    process: bool = True,
    companions: Mapping[str, bytes] | None = None,
    appearance: bool = False,
) -> Scene:
    """The scene in the bytes of a file; with `appearance` also its materials. Only these `companions` are read besides.

    Raises:
        ImportError: the extra is not installed.
        RefusedMeshError: it is a pointer of Git LFS, or declares a document type.
        Exception: what the reader of the format raises.
    """
    if is_pointer(content):
        raise RefusedMeshError(f"it is {POINTER}: run `git lfs pull`")
    if kind == "dae" and b"\0" in content:
        raise RefusedMeshError("it is not in UTF-8")  # where the next line would not see what it looks for
    if kind == "dae" and b"<!" in content.replace(b"<!--", b"").replace(b"<![CDATA[", b""):
        raise RefusedMeshError("it declares a document type, which may name other files")
    trimesh: Any = importlib.import_module("trimesh")
    resolver = _Companions(companions) if companions else None  # without one nothing is read but these bytes
    return trimesh.load_scene(
        io.BytesIO(content), file_type=kind, resolver=resolver, skip_materials=not appearance, process=process
    )


class _Companions:
    """Files that a mesh names, for `trimesh`: they are in memory, and there are no others."""

    def __init__(self, files: Mapping[str, bytes]) -> None:
        self._files = files

    def get(self, name: str) -> bytes:
        """The bytes of one; raises KeyError where it is not there."""
        return self._files[name]

    __getitem__ = get

    def keys(self) -> Iterable[str]:
        """The names of all."""
        return self._files.keys()
