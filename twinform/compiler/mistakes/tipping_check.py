"""Checks whether a robot on wheels tips over: whether its center of mass is beside what it stands on."""

import math
from collections.abc import Iterator, Sequence

from twinform.compiler.mistakes.placed_tree import PlacedTree
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Box, Collision, Cylinder, Model, Sphere, Vector3
from twinform.ir.transform import Transform
from twinform.passes.shared.outlines import Point, doubled_area

_LEVEL = 0.2
"""The vertical part of the axis of a wheel, at most."""
_PLAY = 0.02
"""How much higher than the lowest point of a robot another one may be that it stands on, m: it leans that little."""
_LEAST = 0.01
"""How far beside its support a center of mass has to be, m."""
_WIDE = 0.02
"""The least width of a support: what stands on two wheels balances."""
_FEWEST_WHEELS = 2


def report_tipping(model: Model, tree: PlacedTree, sink: DiagnosticSink) -> None:
    """Report a robot with wheels that falls over at once, with all joints at zero; its collisions have to be known."""
    placed = (each for each in model.joints if each.type == "continuous" and each.child in tree.frames)
    wheels = [each for each in placed if abs(tree.axis(each)[2]) < _LEVEL]
    wheels = [each for each in wheels if each.child and _is_round(tree.links[each.child].collisions)]
    if len(wheels) < _FEWEST_WHEELS or "world" in tree.links:
        return
    points = list(_lowest_points(tree))
    if not points:
        return
    ground = min(point[2] for point in points)
    support = _hull(sorted({(x, y) for x, y, z in points if z <= ground + _PLAY}))
    masses = list(tree.mass_points(list(tree.frames)))
    total = sum(mass for mass, _ in masses)
    if not total or _width(support) < _WIDE:
        return
    center = (sum(mass * at[0] for mass, at in masses) / total, sum(mass * at[1] for mass, at in masses) / total)
    beside = _distance(center, support)
    if beside > _LEAST:
        place = f"{center[0]:.3g} {center[1]:.3g}"
        message = f"robot {model.name!r} tips over: its center of mass, {place}, is {beside:.2g} m beside its wheels"
        help = "correct masses and their places, or add the collision of a caster"
        sink.report(rules.TIPS_OVER, message, model.location, found=place, help=help)


def _is_round(collisions: Sequence[Collision]) -> bool:
    return any(each.geometry and isinstance(each.geometry.shape, Cylinder | Sphere) for each in collisions)


def _lowest_points(tree: PlacedTree) -> Iterator[Vector3]:
    """Yield the points on which the collisions of a robot can stand; none where one of them is not known."""
    found: list[Vector3] = []
    for name, frame in tree.frames.items():
        for collision in tree.links[name].collisions:
            points = _points_of(collision, frame.compose(Transform.from_pose(collision.pose)))
            if points is None:
                return
            found += points
    yield from found


def _points_of(collision: Collision, at: Transform) -> list[Vector3] | None:
    shape = collision.geometry.shape if collision.geometry else None
    match shape:
        case Box(size=(x, y, z)):
            corners = ((i * x / 2, j * y / 2, k * z / 2) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1))
            return [at.apply(each) for each in corners]
        case Sphere(radius=float(radius)):
            x, y, z = at.translation
            return [(x, y, z - radius)]
        case Cylinder(radius=float(radius), length=float(length)):
            return _points_of_cylinder(radius, length, at)
        case _:
            return None


def _points_of_cylinder(radius: float, length: float, at: Transform) -> list[Vector3]:
    """Return the lowest point of each end, or the rim of the ends of one that stands upright."""
    axis = at.rotate((0.0, 0.0, 1.0))
    level = math.hypot(axis[0], axis[1])
    if level < _LEVEL:
        turns = [math.tau * each / 16 for each in range(16)]
        return [
            at.apply((radius * math.cos(each), radius * math.sin(each), end * length / 2))
            for each in turns
            for end in (-1, 1)
        ]
    down = (axis[0] * axis[2] / level, axis[1] * axis[2] / level, -level)
    ends = [at.apply((0.0, 0.0, end * length / 2)) for end in (-1, 1)]
    return [(x + radius * down[0], y + radius * down[1], z + radius * down[2]) for x, y, z in ends]


def _hull(points: Sequence[Point]) -> list[Point]:
    """Return the corners of the convex hull of points in order, counterclockwise (Andrew's monotone chain)."""
    if len(points) < 3:
        return list(points)
    return [*_chain(points), *_chain(points[::-1])]


def _chain(points: Sequence[Point]) -> list[Point]:
    made: list[Point] = []
    for point in points:
        while len(made) > 1 and doubled_area(made[-2], made[-1], point) <= 0:
            made.pop()
        made.append(point)
    return made[:-1]


def _edges(hull: Sequence[Point]) -> Iterator[tuple[Point, Point, float]]:
    """Yield the edges of a hull with their lengths."""
    for a, b in zip(hull, (*hull[1:], hull[0]), strict=True):
        length = math.dist(a, b)
        if length:
            yield a, b, length


def _width(hull: Sequence[Point]) -> float:
    """Return the least distance of two parallel lines with a hull between them."""
    widths = [max(doubled_area(a, b, each) / length for each in hull) for a, b, length in _edges(hull)] if hull else []
    return min(widths, default=0.0)


def _distance(point: Point, hull: Sequence[Point]) -> float:
    """Return how far a point is outside of a hull; negative inside."""
    return max(-doubled_area(a, b, point) / length for a, b, length in _edges(hull))
