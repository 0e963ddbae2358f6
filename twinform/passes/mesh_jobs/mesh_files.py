"""Mesh files as bytes: which formats are read, and what is refused before any reader sees it."""

from pathlib import Path, PurePath

from twinform.file_access import read_regular

READ = frozenset({"stl", "obj", "dae", "ply", "off", "glb"})
"""Formats that hold all of a mesh in one file, or what else they name is only its appearance."""
EXTRA = "pip install 'twinform[meshes]'"
LARGEST = 2**28
"""A file of a quarter of a gigabyte has five million triangles."""
POINTER = "a pointer of Git LFS and not the file itself"
_POINTER = b"version https://git-lfs.github.com/spec/"


class RefusedMeshError(ValueError):
    """A mesh file that is not given to any reader, or that nothing can be made of; the message has the reason."""


def kind_of(path: PurePath) -> str:
    """The format of a file, by its name."""
    return path.suffix.lower().removeprefix(".")


def is_pointer(content: bytes) -> bool:
    """Whether a file only says which one Git LFS would put in its place: that was never fetched."""
    return content.startswith(_POINTER)


def content_of(path: Path) -> bytes:
    """The bytes of a mesh file.

    Raises:
        OSError: the file cannot be read.
        RefusedMeshError: it is no file, is too large, or is a pointer of Git LFS.
    """
    if path.exists() and not path.is_file():
        raise RefusedMeshError("it is no file")  # whoever opens a pipe may wait for ever
    if path.stat().st_size > LARGEST:
        raise RefusedMeshError(f"it is larger than {LARGEST >> 20} MiB")
    content = read_regular(path, LARGEST)
    # Repositories of meshes are often checked out without Git LFS.
    if is_pointer(content):
        raise RefusedMeshError(f"it is {POINTER}: run `git lfs pull`")
    return content
