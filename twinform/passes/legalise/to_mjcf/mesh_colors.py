"""Colors in mesh files: the material of an OBJ file, which MuJoCo does not read, as the color of its geom.

Only a file with one material has one color. MuJoCo shows a mesh of several in one color, its own gray.
"""

import re
from enum import Enum
from pathlib import Path, PurePosixPath

from twinform.file_access import Readable
from twinform.passes.mesh_jobs.mesh_files import LARGEST, kind_of

_LIBRARY = re.compile(rb"^mtllib[ \t]+(.+?)[ \t\r]*$", re.MULTILINE)
# a word first, which is looked for much faster than the start of a line
_USED = re.compile(rb"usemtl(?<=^usemtl)[ \t]+(.+?)[ \t\r]*$", re.MULTILINE)
_COLOR = re.compile(rb"^[ \t]*Kd((?:[ \t]+[0-9.eE+-]+){3})", re.MULTILINE)
_OPACITY = re.compile(rb"^[ \t]*(d|Tr)[ \t]+([0-9.eE+-]+)", re.MULTILINE)
_IMAGE = re.compile(rb"^[ \t]*map_Kd", re.MULTILINE)
_HEAD = 2**16
"""In bytes: a file of 20 MB names its materials in the first ones, or has none."""
_MOST = 2**20
"""In bytes: a library of materials is small."""
Rgba = tuple[float, float, float, float]


class Several(Enum):
    """Stands for colors that one geom cannot have: of several materials, or of an image."""

    SEVERAL = "several"


def color_of(readable: Readable, path: Path) -> Rgba | Several | None:
    """The color that a mesh file gives itself; None where it has none, or none that can be read."""
    if kind_of(path) != "obj":
        return None
    try:
        named = _LIBRARY.findall(readable.read(path, _HEAD))
        if not named:
            return None
        names = set(_USED.findall(readable.read(path, LARGEST)))
        libraries = b"\n".join(_library(readable, path, each.decode()) for each in named)
        looks = {look for name, look in _materials(libraries) if name in names}
    except (OSError, ValueError):
        return None
    if len(looks) > 1:
        return Several.SEVERAL
    return looks.pop() if looks else None


def _library(readable: Readable, path: Path, name: str) -> bytes:
    """The content of a file of materials beside a mesh, or nothing if it leads elsewhere."""
    relative = PurePosixPath(name)
    if relative.is_absolute() or ".." in relative.parts:
        return b""
    return readable.read(path.parent / relative, _MOST)


def _materials(library: bytes) -> list[tuple[bytes, Rgba | Several]]:
    """The materials in a library, by their names."""
    found: list[tuple[bytes, Rgba | Several]] = []
    for part in re.split(rb"^[ \t]*newmtl[ \t]+", library, flags=re.MULTILINE)[1:]:
        name, _, content = part.partition(b"\n")
        if _IMAGE.search(content):
            found.append((name.strip(), Several.SEVERAL))
        elif (color := _COLOR.search(content)) is not None:
            red, green, blue = (min(max(float(each), 0.0), 1.0) for each in color[1].split())
            found.append((name.strip(), (red, green, blue, _opacity(content))))
    return found


def _opacity(content: bytes) -> float:
    """How much a material hides; `Tr` is the opposite of `d`."""
    found = _OPACITY.search(content)
    if found is None:
        return 1.0
    value = min(max(float(found[2]), 0.0), 1.0)
    return value if found[1] == b"d" else 1.0 - value
