"""Files that a mesh file names itself: materials, textures and buffers, as far as they may be read.

Whoever made the mesh may be a stranger, and what it names is copied into results. So only images, materials and buffers
are taken, where the document may read them, and not too much of them.
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple, cast
from urllib.parse import unquote

from twinform.file_access import Readable

_IMAGES = frozenset({".png", ".jpg", ".jpeg", ".tga", ".bmp", ".tif", ".tiff", ".webp"})
_OTHERS = frozenset({".mtl", ".bin"})
_MOST_BYTES = 2**27
_MOST = 256
_LIBRARY = re.compile(rb"(?m)^[ \t]*+mtllib[ \t]++([^\r\n]++)")
_MAP = re.compile(
    rb"(?m)^[ \t]*+(?:map_\w++|bump|norm|disp|decal)[ \t]++(?:-\S++[ \t]++(?:[-\d.]++[ \t]++)*+)*+([^\r\n]++)"
)
"""A texture behind its options, such as `-s 1 1 1`. That numbers can be negative is why it never goes back."""
_IMAGE = re.compile(rb"<init_from>([^<]++)</init_from>")
_GLTF = re.compile(rb"^glTF")


class Companions(NamedTuple):
    """Contents by the names that the mesh has for them, and which of these are not there or may not be read."""

    files: dict[str, bytes]
    missing: tuple[str, ...]


def companions_of(path: Path, kind: str, content: bytes, readable: Readable | None = None) -> Companions:
    """What a mesh file names, of the files that are `readable`, or without this one belong to the mesh."""
    readable = readable or Readable.of(path)
    files, missing, left = dict[str, bytes](), list[str](), _MOST_BYTES
    todo = list(_named(kind, content))
    for name in todo:
        if name in files or name in missing:
            continue
        data = _read(path, name, left, readable) if len(files) < _MOST else None
        if data is None:
            missing.append(name)
            continue
        files[name], left = data, left - len(data)
        if name.lower().endswith(".mtl"):
            todo += _texts(_MAP, data)
    return Companions(files, tuple(missing))


def _named(kind: str, content: bytes) -> Iterator[str]:
    if kind == "obj":
        yield from _texts(_LIBRARY, content)
    elif kind == "dae":
        yield from (name for name in _texts(_IMAGE, content) if Path(name).suffix.lower() in _IMAGES)
    elif kind == "gltf":
        yield from _of_gltf(content)


def _texts(pattern: re.Pattern[bytes], content: bytes) -> Iterator[str]:
    return (found.strip().decode(errors="replace") for found in pattern.findall(content) if found.strip())


def _of_gltf(content: bytes) -> Iterator[str]:
    try:
        tree = cast("object", json.loads(content))
    except (ValueError, RecursionError):
        return  # the reader will say what is wrong
    for key in ("buffers", "images"):
        entries = cast("dict[str, object]", tree).get(key) if isinstance(tree, dict) else None
        for entry in cast("list[object]", entries) if isinstance(entries, list) else []:
            uri = cast("dict[str, object]", entry).get("uri") if isinstance(entry, dict) else None
            if isinstance(uri, str) and not uri.startswith("data:"):
                yield uri


def _read(mesh: Path, name: str, most: int, readable: Readable) -> bytes | None:
    relative = Path(unquote(name.removeprefix("file://").replace("\\", "/")))
    if relative.is_absolute() or relative.suffix.lower() not in _IMAGES | _OTHERS or "\0" in name:
        return None
    try:
        data = readable.read(mesh.parent / relative, most)
    except OSError:
        return None
    return data if len(data) <= most else None
