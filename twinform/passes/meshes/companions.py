"""Files that a mesh file names itself: materials, textures and buffers, as far as they may be read.

Whoever made the mesh may be a stranger, and what it names is copied into results. So only images, materials and buffers
are taken, where the document may read them, and not too much of them.
"""

from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote

from twinform.file_access import Readable
from twinform.passes.mesh_references import FORMATS

_IMAGES = frozenset({".png", ".jpg", ".jpeg", ".tga", ".bmp", ".tif", ".tiff", ".webp"})
_OTHERS = frozenset({".mtl", ".bin"})
_NAMING = frozenset({"dae", "gltf", "mtl", "obj"})
_MOST_BYTES = 2**27
_MOST = 256


class Companions(NamedTuple):
    """Contents by the names that the mesh has for them, and which of these are not there or may not be read."""

    files: dict[str, bytes]
    missing: tuple[str, ...]


def companions_of(path: Path, kind: str, content: bytes, readable: Readable | None = None) -> Companions:
    """What a mesh file names, of the files that are `readable`, or without this one belong to the mesh."""
    readable = readable or Readable.of(path)
    files, missing, left = dict[str, bytes](), list[str](), _MOST_BYTES
    todo = _named(kind, content)[:_MOST]
    for name in todo:
        if name in files or name in missing:
            continue
        data = _read(path, name, left, readable) if len(files) < _MOST else None
        if data is None:
            missing.append(name)
            continue
        files[name], left = data, left - len(data)
        if name.lower().endswith(".mtl"):
            todo += _named("mtl", data)[:_MOST]
    return Companions(files, tuple(missing))


def _named(kind: str, content: bytes) -> list[str]:
    """The files that a file of a format names."""
    try:
        names = FORMATS[kind].references(content) if kind in _NAMING else []
    except ValueError:
        return []  # the reader will say what is wrong
    return [name for name in names if kind != "dae" or Path(name).suffix.lower() in _IMAGES]


def _read(mesh: Path, name: str, most: int, readable: Readable) -> bytes | None:
    relative = Path(unquote(name.removeprefix("file://").replace("\\", "/")))
    if relative.is_absolute() or relative.suffix.lower() not in _IMAGES | _OTHERS or "\0" in name:
        return None
    try:
        data = readable.read(mesh.parent / relative, most)
    except OSError:
        return None
    return data if len(data) <= most else None
