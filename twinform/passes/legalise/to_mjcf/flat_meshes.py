"""Meshes without a volume: files whose points are all in one plane or on one line, which MuJoCo refuses.

Only as many points are read as it takes to find three dimensions, which in most files are a few.
"""

import struct
from collections.abc import Iterable, Iterator
from enum import Enum
from math import sqrt
from pathlib import Path

from twinform.file_access import Readable
from twinform.ir.node import Vector3
from twinform.passes.mesh_jobs.mesh_files import LARGEST, kind_of

_PIECES = (2**12, 2**16, 2**20, LARGEST)
"""In bytes: how much of a file is read, each time that less of it is flat."""
_STL_HEADER, _STL_TRIANGLE, _MSH_HEADER = 84, 50, 16
_LEAST = 4
"""MuJoCo wants as many points."""
_EXACT = 1e-12
"""How far from a plane a point is that is in it, for a mesh with a size of 1: MuJoCo takes whatever has a volume."""


class Extent(Enum):
    """What the points of a mesh span."""

    SOLID = "solid"
    PLANE = "plane"
    LINE = "line"


def extent_of(readable: Readable, path: Path) -> Extent:
    """What the points of a mesh file span; one that cannot be read counts as solid."""
    found = Extent.SOLID
    try:
        for size in _PIECES:
            content = readable.read(path, size)
            found = _extent(_points(kind_of(path), content))
            if found is Extent.SOLID or len(content) <= size:
                break
    except (OSError, ValueError, struct.error):
        return Extent.SOLID
    return found


def _points(kind: str, content: bytes) -> Iterator[Vector3]:
    """Yield the points in the beginning of a file."""
    match kind:
        case "stl":
            yield from _packed(content, _STL_HEADER, _STL_TRIANGLE, "<12x9f", len(content))
        case "msh":
            (count,) = struct.unpack_from("<i", content)
            yield from _packed(content, _MSH_HEADER, 12, "<3f", _MSH_HEADER + 12 * count)
        case _:
            for line in content[: content.rfind(b"\n") + 1 or None].splitlines():
                if line.startswith((b"v ", b"v\t")):
                    x, y, z = map(float, line.split()[1:4])
                    yield x, y, z


def _packed(content: bytes, start: int, step: int, layout: str, end: int) -> Iterator[Vector3]:
    for place in range(start, min(end, len(content)) - step + 1, step):
        numbers = iter(struct.unpack_from(layout, content, place))
        yield from zip(numbers, numbers, numbers, strict=True)


def _extent(points: Iterable[Vector3]) -> Extent:
    """What points span: a plane through three of them, a line through two."""
    different = iter(dict.fromkeys(points))
    first = next(different, None)
    rest = [_from(first, each) for each in different] if first else []
    if len(rest) < _LEAST - 1:
        return Extent.LINE
    size = max(map(_length, rest))
    normal = next((made for each in rest if _length(made := _across(rest[0], each)) > _EXACT * size * size), None)
    if normal is None:
        return Extent.LINE
    least = _EXACT * size * _length(normal)
    return Extent.SOLID if any(abs(_along(normal, each)) > least for each in rest) else Extent.PLANE


def _from(first: Vector3, point: Vector3) -> Vector3:
    return (point[0] - first[0], point[1] - first[1], point[2] - first[2])


def _across(one: Vector3, other: Vector3) -> Vector3:
    (a, b, c), (x, y, z) = one, other
    return (b * z - c * y, c * x - a * z, a * y - b * x)


def _along(one: Vector3, other: Vector3) -> float:
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]


def _length(vector: Vector3) -> float:
    return sqrt(_along(vector, vector))
