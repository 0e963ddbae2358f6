"""Mesh files as bytes: the formats that are read and written, and the files that are refused before they are read."""

from pathlib import Path, PurePath
from typing import Literal

from twinform.file_access import read_regular

READ = frozenset({"stl", "obj", "dae", "ply", "off", "glb", "msh"})
"""Formats whose triangles are all in one file; other files that they name hold only the appearance."""
LARGEST = 2**28
"""In bytes. A binary STL of this size has five million triangles."""
POINTER = "a pointer of Git LFS and not the file itself"
_POINTER_START = b"version https://git-lfs.github.com/spec/"
MARK = "made by twinform"
"""Stands in the first bytes of every mesh that is written; only a file that has it is ever written over."""
MeshFormat = Literal["obj", "stl", "glb"]


def install_readers() -> str:
    """The command that installs the libraries that read meshes."""
    from twinform.installation import install_command  # noqa: PLC0415 - most have what they need

    return install_command("meshes")


class RefusedMeshError(ValueError):
    """Why a mesh file is not read, or why nothing can be made of it."""


class NoMeshError(ValueError):
    """No mesh can stand for a shape; the text says why, or what to do."""


def kind_of(path: PurePath) -> str:
    """The format of a file by its suffix, in lower case without the dot."""
    return path.suffix.lower().removeprefix(".")


def is_pointer(content: bytes) -> bool:
    """Whether a file is a pointer of Git LFS, whose real content was never fetched."""
    return content.startswith(_POINTER_START)


def content_of(path: Path) -> bytes:
    """Read a mesh file.

    Raises:
        OSError: the file cannot be read.
        RefusedMeshError: it is not a regular file, is too large, or is a pointer of Git LFS.
    """
    if path.exists() and not path.is_file():
        raise RefusedMeshError("it is no file")  # opening a pipe may wait for ever
    if path.stat().st_size > LARGEST:
        raise RefusedMeshError(f"it is larger than {LARGEST >> 20} MiB")
    content = read_regular(path, LARGEST)
    # Repositories of meshes are often checked out without Git LFS.
    if is_pointer(content):
        raise RefusedMeshError(f"it is {POINTER}: run `git lfs pull`")
    return content
