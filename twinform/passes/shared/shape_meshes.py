"""Meshes that stand for shapes: an ellipsoid or a cone within a distance, a polyline exactly."""

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from twinform.ir import Cone, Ellipsoid, Geometry, Polyline
from twinform.ir.defaults import sizes
from twinform.ir.geometry import Vector2
from twinform.ir.node import Vector3
from twinform.passes.mesh_jobs.mesh_files import MARK, NoMeshError
from twinform.passes.shared.outlines import OutlineError, triangulate

RELATIVE_ERROR = 0.01
"""The distance where none is asked for, as a part of the largest radius."""
_MOST_SIDES = 512
"""Of a circle: an ellipsoid has a quarter of a million triangles then."""
_MOST_POINTS = 500
"""Of a polyline: the time that its triangles take grows with their square."""
_HEIGHT = 1.0
"""Of a polyline without one, in m."""
_DIGITS = 9
"""Of a coordinate: the last digits of a sine differ from machine to machine."""

Face = tuple[int, int, int]


class ShapeMesh(NamedTuple):
    """A closed mesh in the frame of a shape, whose points lie on the surface of the shape, with outward faces.

    `error` is how far a point of either surface is from the other one at most, in m.
    """

    points: Sequence[Vector3]
    faces: Sequence[Face]
    error: float

    def obj(self) -> bytes:
        """The mesh as an OBJ file."""
        points = (" ".join(["v", *(f"{each:.{_DIGITS}g}" for each in point)]) for point in self.points)
        faces = (" ".join(["f", *(str(each + 1) for each in face)]) for face in self.faces)
        return "\n".join([f"# {MARK}", *points, *faces, ""]).encode()


def mesh_of(geometry: Geometry, error: float | None) -> ShapeMesh:
    """The mesh of an ellipsoid, cone or polyline, at most `error` off, in m; by default 1 % of its largest radius.

    Raises:
        NoMeshError: the shape is of another kind or has no inside, or the mesh would be too large.
    """
    shape = geometry.shape
    if isinstance(shape, Polyline):
        return _extruded(geometry, shape)
    if not isinstance(shape, Cone | Ellipsoid):
        raise NoMeshError("no mesh is made of it")
    lengths = sizes(shape)
    if not all(0 < each < math.inf for each in lengths):
        raise NoMeshError("it has a size that is not above 0")
    radius = lengths[0] if isinstance(shape, Cone) else max(lengths)
    share = RELATIVE_ERROR if error is None else error / radius
    return _cone(lengths[0], lengths[1], share) if isinstance(shape, Cone) else _ellipsoid(lengths, share)


def _ellipsoid(radii: Sequence[float], share: float) -> ShapeMesh:
    """A sphere of circles of latitude, scaled; `share` is the allowed error of a unit sphere."""
    # A face between circles of latitude is a flat trapezoid. With n sides to a circle and n/2 bands
    # from pole to pole, its plane is cos(pi/n)^2 from the center of a unit sphere at least. Scaling
    # multiplies no distance by more than the largest radius.
    sides = _even(math.pi / math.asin(math.sqrt(min(share, 0.5))))
    circles = [_circle(math.sin(turn), sides, math.cos(turn)) for turn in _turns(sides // 2, math.pi)][1:]
    unit = [(0.0, 0.0, 1.0), *(point for circle in circles for point in circle), (0.0, 0.0, -1.0)]
    x, y, z = radii
    return ShapeMesh(
        [(x * a, y * b, z * c) for a, b, c in unit],
        list(_faces_of_circles(len(circles), sides)),
        max(radii) * math.sin(math.pi / sides) ** 2,
    )


def _cone(radius: float, length: float, share: float) -> ShapeMesh:
    """A pyramid; `share` is the allowed error of a cone whose radius is 1."""
    # A point of the rim is farthest off: it is 1 - cos(pi/n) from the middle of a side of the base.
    sides = _even(math.pi / math.acos(1 - min(share, 0.5)))
    circle = _circle(radius, sides, -length / 2)
    points = [(0.0, 0.0, length / 2), *circle, (0.0, 0.0, -length / 2)]
    return ShapeMesh(points, list(_faces_of_circles(1, sides)), radius * (1 - math.cos(math.pi / sides)))


def _even(sides: float) -> int:
    """The next even number of sides that is not too large.

    Raises:
        NoMeshError: there is none.
    """
    # An even number has a point at each end of both axes.
    if not sides <= _MOST_SIDES:
        raise NoMeshError("a mesh so near to it would have too many triangles: allow a larger --shape-error")
    return max(4, 2 * math.ceil(sides / 2))


def _turns(count: int, angle: float) -> Iterator[float]:
    return (angle * each / count for each in range(count))


def _circle(radius: float, sides: int, z: float) -> list[Vector3]:
    return [(radius * math.cos(turn), radius * math.sin(turn), z) for turn in _turns(sides, 2 * math.pi)]


def _faces_of_circles(circles: int, sides: int) -> Iterator[Face]:
    """The faces between circles of points, the first point, which is above them, and the last one, below."""
    last = circles * sides + 1
    for each in range(sides):
        following = (each + 1) % sides
        yield 0, 1 + each, 1 + following
        for circle in range(circles - 1):
            here, below = 1 + circle * sides, 1 + (circle + 1) * sides
            yield here + each, below + each, below + following
            yield here + each, below + following, here + following
        yield last, last - sides + following, last - sides + each


def _extruded(geometry: Geometry, shape: Polyline) -> ShapeMesh:
    """The prism that Gazebo makes: outlines from z = 0 to the height of the first one, an outline in another a hole."""
    height = _HEIGHT if shape.height is None else shape.height
    if not 0 < height < math.inf:
        raise NoMeshError("its height is not above 0")
    try:
        outlines = [*_outlines(geometry, shape)]
        if sum(map(len, outlines)) > _MOST_POINTS:
            raise NoMeshError(f"it has more than {_MOST_POINTS} points")
        loops, flat = triangulate(outlines)
    except OutlineError as error:
        raise NoMeshError(str(error)) from error
    floor = [point for loop in loops for point in loop]
    count = len(floor)
    points = [(x, y, z) for z in (0.0, height) for x, y in floor]
    faces: list[Face] = []
    for a, b, c in flat:
        faces += [(c, b, a), (a + count, b + count, c + count)]
    start = 0
    for loop in loops:
        for each in range(len(loop)):
            here, following = start + each, start + (each + 1) % len(loop)
            faces += [(here, following, following + count), (here, following + count, here + count)]
        start += len(loop)
    return ShapeMesh(points, faces, 0.0)


def _outlines(geometry: Geometry, shape: Polyline) -> Iterable[list[Vector2]]:
    """The points of each polyline; only the first one is a shape of the geometry.

    Raises:
        OutlineError: a point is not two numbers.
    """
    others = (part.element for part in geometry.opaque if part.element and part.element.name == "polyline")
    yield [_point(part.element.text) for part in shape.opaque if part.element and part.element.name == "point"]
    for other in others:
        yield [_point(child.text) for child in other.find_all("point")]


def _point(text: str | None) -> Vector2:
    try:
        x, y = (float(word) for word in (text or "0 0").split())
    except ValueError:
        raise OutlineError("a point of it is not two numbers") from None
    if not (math.isfinite(x) and math.isfinite(y)):
        raise OutlineError("a point of it is not finite")
    return x, y


def format_length(meters: float) -> str:
    """A length for people; less than a nanometer is rounding, and differs from machine to machine."""
    return f"{max(1000 * meters, 1e-6):.3g} mm" if meters < 1 else f"{meters:.3g} m"
