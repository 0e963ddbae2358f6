"""Splits the polygons of OBJ files into triangles as MuJoCo does: other triangles would enclose another volume.

MuJoCo reads OBJ with tinyobjloader, in single precision: a quadrangle is split at its shorter diagonal, and of any
other polygon ears are cut off, seen along the axis that its first corner is turned about most. Where no ear is left,
as in a polygon that crosses itself, the rest of it is missing.
"""

from collections.abc import Sequence

from twinform.passes.mesh_jobs.libraries import np

_Point = tuple[float, float, float]
_Flat = tuple[float, float]
_Corners = list[tuple[bytes, _Point]]
"""The corners of a polygon: the word for each in the file, and where it is."""
_TINY = float(np.finfo(np.float32).eps)
_TRIANGLE, _QUADRANGLE = 3, 4
_MOST_CORNERS = 100
"""A polygon with more of them is missing: of one with 101, MuJoCo 4.0 made nothing."""


def split_polygons(content: bytes) -> bytes:
    """The text of a file of OBJ in which all faces are triangles; a line that cannot be read stays as it is."""
    points: list[_Point | None] = []
    lines: list[bytes] = []
    for line in content.splitlines():
        words = line.split()
        kind = words[0] if words else b""
        corners: _Corners = []
        if kind == b"v":
            points.append(_in_single_precision(words[1:4]))
        elif kind == b"f" and len(words) > _TRIANGLE + 1:
            corners = [(word, at) for word in words[1:] if (at := _point_of_corner(word, points)) is not None]
        if len(corners) > _TRIANGLE and len(corners) == len(words) - 1:
            lines += [b"f " + b" ".join([word for word, _ in each]) for each in _split_polygon(corners)]
        else:
            lines.append(line)
    return b"\n".join(lines) + b"\n"


def _in_single_precision(words: Sequence[bytes]) -> _Point | None:
    """A point in single precision, as MuJoCo computes with it."""
    try:
        x, y, z = (np.float32(word) for word in words)
    except ValueError:
        return None
    return x, y, z


def _point_of_corner(word: bytes, points: Sequence[_Point | None]) -> _Point | None:
    """The point of a corner, which counts from 1, or backwards from the last one."""
    try:
        number = int(word.split(b"/")[0])
        return points[number if number < 0 else number - 1] if number else None
    except (ValueError, IndexError):
        return None


def _split_polygon(corners: _Corners) -> list[_Corners]:
    """The triangles of a polygon of four corners or more."""
    if len(corners) > _QUADRANGLE:
        return _cut_ears(corners) if len(corners) <= _MOST_CORNERS else []
    a, b, c, d = corners
    if _distance(a[1], c[1]) < _distance(b[1], d[1]):
        return [[a, b, c], [a, c, d]]
    return [[a, b, d], [b, c, d]]


def _distance(one: _Point, other: _Point) -> float:
    x, y, z = (b - a for a, b in zip(one, other, strict=True))
    return x * x + y * y + z * z


def _cut_ears(corners: _Corners) -> list[_Corners]:
    """The triangles that are cut off a polygon because they hold no other corner, and the three corners left."""
    first, second = _longest_axes([at for _, at in corners])
    left = [((word, at), (at[first], at[second])) for word, at in corners]
    found: list[_Corners] = []
    start, tries, is_cut = 0, len(left), False
    # An ear that is found at the last try is the last one, since the tries are counted anew only after this condition.
    while len(left) > _TRIANGLE and tries > 0:
        tries = len(left) if is_cut else tries - 1
        start %= len(left)
        turned = [*left[start:], *left[:start]]
        ear, others = turned[:_TRIANGLE], [at for _, at in turned[_TRIANGLE:]]
        is_cut = _is_ear([at for _, at in ear], others)
        if is_cut:
            found.append([corner for corner, _ in ear])
            del left[(start + 1) % len(left)]
        else:
            start += 1
    return [*found, [corner for corner, _ in left]] if len(left) == _TRIANGLE else found


def _longest_axes(points: Sequence[_Point]) -> tuple[int, int]:
    """The two axes in which a polygon is largest, by its first corner that is no straight line."""
    for index, here in enumerate(points):
        there, last = (points[(index + more) % len(points)] for more in (1, 2))
        (ax, ay, az), (bx, by, bz) = (
            [b - a for a, b in zip(one, other, strict=True)] for one, other in ((here, there), (there, last))
        )
        x, y, z = abs(ay * bz - az * by), abs(az * bx - ax * bz), abs(ax * by - ay * bx)
        if max(x, y, z) > _TINY:
            return (1, 2) if x > y and x > z else (0, 1) if z > x and z > y else (0, 2)
    return 1, 2


def _is_ear(triangle: Sequence[_Flat], others: Sequence[_Flat]) -> bool:
    """Whether a corner is turned as it is seen from the origin, and no other corner is inside of its triangle."""
    (ax, ay), (bx, by), (cx, cy) = triangle
    turn = (bx - ax) * (cy - by) - (by - ay) * (cx - bx)
    return turn * (ax * by - ay * bx) >= 0.0 and not any(_holds(triangle, each) for each in others)


def _holds(triangle: Sequence[_Flat], point: _Flat) -> bool:
    """Whether a point is inside of a triangle: a ray from it crosses the border once."""
    x, y = point
    is_inside = False
    for (ax, ay), (bx, by) in zip(triangle, [triangle[-1], *triangle[:-1]], strict=True):
        if (ay > y) != (by > y) and x < (bx - ax) * (y - ay) / (by - ay) + ax:
            is_inside = not is_inside
    return is_inside
