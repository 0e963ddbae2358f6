"""Capsules, ellipsoids and cones of any size, balls that touch them, and how deep these are by definition."""

import math
import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import twinform
from testbed.engines.gazebo.contacts import Point
from twinform.ir import Capsule, Cone, Ellipsoid, Geometry, Pose, Shape
from twinform.ir.defaults import sizes
from twinform.ir.transform import Transform
from twinform.passes.shared.shape_meshes import mesh_of

KINDS = ("capsule", "ellipsoid", "cone")
BALLS = 10
"""So many balls touch each shape."""
_LEAST, _MOST = 0.02, 0.5
_BALL = 0.2
"""The radius of a ball, as a part of the largest size of the shape."""
# parser_urdf.cc takes a pitch of a URDF that is within 0.26 degrees of 90 for 90.
_TURN = 1.5
_TEXT = """<sdf version="{version}"><model name="touched"><link name="a">
<inertial><mass>1</mass></inertial>
<collision name="c"><pose>{pose}</pose><geometry>{shape}</geometry></collision>
</link></model></sdf>
"""


@dataclass(frozen=True, slots=True)
class Touched:
    """A shape in a file of SDF, the URDF that it is converted to, and the balls that touch it.

    `error` is how far a mesh that stands for it may be off, in m; it is 0 for a capsule. `depths` are those of the
    balls by the definition of the shape.
    """

    kind: str
    sdf: Path
    urdf: Path
    error: float
    radius: float
    centers: Sequence[Point]
    depths: Sequence[float]


def touched_shapes(kind: str, count: int, seed: int, folder: Path) -> Iterator[Touched]:
    """Write shapes of a kind and what they are converted to, until balls touch them `count` times."""
    chance = random.Random(f"{kind} {seed}")
    for number in range(-(-count // BALLS)):
        shape = _SHAPES[kind](*(chance.uniform(_LEAST, _MOST) for _ in range(3)))
        xyz = [chance.uniform(-1, 1) for _ in range(3)]
        rpy = [chance.uniform(-_TURN, _TURN) for _ in range(3)]
        sdf = folder / f"{kind}_{number}.sdf"
        version = "1.12" if kind == "cone" else "1.9"
        sdf.write_text(_TEXT.format(version=version, pose=" ".join(map(repr, (*xyz, *rpy))), shape=_element(shape)))
        made = twinform.convert(sdf, to="urdf")
        for each in made.side_files:
            twinform.write_atomically(folder / each.path, each.data)
        urdf = sdf.with_suffix(".urdf")
        urdf.write_text(made.text)
        place = Transform.from_pose(Pose(xyz=(xyz[0], xyz[1], xyz[2]), rpy=(rpy[0], rpy[1], rpy[2])))
        radius = _BALL * max(sizes(shape))
        balls = [_ball(shape, radius, chance) for _ in range(min(BALLS, count - number * BALLS))]
        error = 0.0 if kind == "capsule" else mesh_of(Geometry(shape=shape), None).error
        yield Touched(kind, sdf, urdf, error, radius, [place.apply(at) for at, _ in balls], [deep for _, deep in balls])


_SHAPES: Mapping[str, Callable[[float, float, float], Shape]] = {
    "capsule": lambda x, y, _: Capsule(radius=x, length=y),
    "ellipsoid": lambda x, y, z: Ellipsoid(radii=(x, y, z)),
    "cone": lambda x, y, _: Cone(radius=x, length=y),
}


def _element(shape: Shape) -> str:
    if isinstance(shape, Ellipsoid):
        return f"<ellipsoid><radii>{' '.join(map(repr, sizes(shape)))}</radii></ellipsoid>"
    radius, length = sizes(shape)
    return f"<{shape.kind}><radius>{radius!r}</radius><length>{length!r}</length></{shape.kind}>"


def _ball(shape: Shape, radius: float, chance: random.Random) -> tuple[Point, float]:
    """The center of a ball that touches a shape, outside of it, and how deep the ball is in it."""
    extent = radius + sum(sizes(shape))
    while True:
        x, y, z = (chance.uniform(-extent, extent) for _ in range(3))
        distance = distance_to(shape, (x, y, z))
        if 0.05 * radius < distance < 0.95 * radius:
            return (x, y, z), radius - distance


def distance_to(shape: Shape, point: Point) -> float:
    """How far a point is from a shape, in the frame of the shape; 0 in an ellipsoid or cone."""
    x, y, z = point
    if isinstance(shape, Ellipsoid):
        return _to_ellipsoid(sizes(shape), point)
    radius, length = sizes(shape)
    if isinstance(shape, Capsule):
        return math.hypot(x, y, max(abs(z) - length / 2, 0.0)) - radius
    return _to_cone(radius, length, math.hypot(x, y), z)


def _to_ellipsoid(radii: Sequence[float], point: Point) -> float:
    """By bisection: the nearest point is radii^2 * point / (radii^2 + t) for the t that puts it on the surface."""
    squares = [each * each for each in radii]
    if sum(p * p / s for p, s in zip(point, squares, strict=True)) <= 1:
        return 0.0
    low, high = 0.0, max(radii) * math.hypot(*point)
    for _ in range(200):
        middle = (low + high) / 2
        outside = sum(s * (p / (s + middle)) ** 2 for p, s in zip(point, squares, strict=True)) > 1
        low, high = (middle, high) if outside else (low, middle)
    return math.hypot(*(p - s * p / (s + low) for p, s in zip(point, squares, strict=True)))


def _to_cone(radius: float, length: float, away: float, z: float) -> float:
    """In the half plane through the axis: how far from the base, and from the side."""
    if -length / 2 <= z and away <= radius * (0.5 - z / length):
        return 0.0
    base = math.hypot(max(away - radius, 0.0), z + length / 2)
    share = ((radius - away) * radius + (z + length / 2) * length) / (radius * radius + length * length)
    share = min(max(share, 0.0), 1.0)
    return min(base, math.hypot(away - radius * (1 - share), z + length / 2 - share * length))
