"""Triangles of the area between outlines in a plane, of which one may be a hole in another."""

from collections.abc import Iterable, Iterator, Sequence

Point = tuple[float, float]
Outline = list[Point]
_SAME = 1e-9
"""The part of the area that rounding may add or take away."""


class OutlineError(ValueError):
    """Why outlines have no area between them."""


def triangulate(outlines: Iterable[Outline]) -> tuple[list[Outline], list[tuple[int, int, int]]]:
    """The outlines, counterclockwise around what is inside, and triangles of their points as one list.

    An outline may be closed by its first point. Time grows with the square of the number of points.

    Raises:
        OutlineError: an outline has no area, or crosses itself or another one.
    """
    loops = [_distinct(each) for each in outlines]
    if not loops or any(len(loop) < 3 or _area(loop) == 0 for loop in loops):
        raise OutlineError("an outline of it has no area")
    around = [[other for other in loops if other is not loop and _is_inside(loop[0], other)] for loop in loops]
    loops = [
        loop if (_area(loop) > 0) == (len(outer) % 2 == 0) else loop[::-1]
        for loop, outer in zip(loops, around, strict=True)
    ]
    depths = [len(outer) for outer in around]
    points = [point for loop in loops for point in loop]
    starts = [sum(map(len, loops[:each])) for each in range(len(loops))]
    rings = [list(range(start, start + len(loop))) for start, loop in zip(starts, loops, strict=True)]
    triangles: list[tuple[int, int, int]] = []
    for each, depth in enumerate(depths):
        if depth % 2 == 0:
            holes = [
                rings[hole]
                for hole, inner in enumerate(depths)
                if inner == depth + 1 and _is_inside(loops[hole][0], loops[each])
            ]
            triangles += _clip_ears(_with_bridges(rings[each], holes, points), points)
    area, covered = sum(map(_area, loops)), sum(_area([points[each] for each in one]) for one in triangles)
    if abs(area - covered) > _SAME * abs(area):
        raise OutlineError("its outlines cross")
    return loops, triangles


def _distinct(outline: Outline) -> Outline:
    """The points of an outline without those that repeat the one before, or the first one at the end."""
    return [point for each, point in enumerate(outline) if point != outline[each - 1] or len(outline) == 1]


def _area(loop: Sequence[Point]) -> float:
    """The area inside, negative where the outline is clockwise."""
    return sum(doubled_area(loop[0], loop[each], loop[each + 1]) for each in range(1, len(loop) - 1)) / 2


def doubled_area(a: Point, b: Point, c: Point) -> float:
    """Twice the area of a triangle, negative where it is clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _is_inside(point: Point, loop: Outline) -> bool:
    x, y = point
    inside = False
    for each, (bx, by) in enumerate(loop):
        ax, ay = loop[each - 1]
        if (ay > y) != (by > y) and x < (bx - ax) * (y - ay) / (by - ay) + ax:
            inside = not inside
    return inside


def _with_bridges(ring: list[int], holes: list[list[int]], points: Sequence[Point]) -> list[int]:
    """The ring with each hole joined to it by an edge there and back, from the rightmost hole to the leftmost.

    Raises:
        OutlineError: a hole sees no point of the ring.
    """
    for hole in sorted(holes, key=lambda one: max(points[each] for each in one), reverse=True):
        first = max(range(len(hole)), key=lambda each: points[hole[each]])
        turned = [*hole[first:], *hole[:first]]
        place = _visible(turned[0], ring, points)
        ring = [*ring[: place + 1], *turned, turned[0], *ring[place:]]
    return ring


def _visible(start: int, ring: list[int], points: Sequence[Point]) -> int:
    """The place in a ring of the point that is seen from the rightmost point of a hole, looking to the right.

    Raises:
        OutlineError: there is none.
    """
    x, y = points[start]
    nearest: tuple[float, int] | None = None
    for each, one in enumerate(ring):
        (ax, ay), (bx, by) = points[one], points[ring[(each + 1) % len(ring)]]
        if ay <= y <= by and ay != by:  # an edge to the right goes up around what is inside
            at = ax + (y - ay) / (by - ay) * (bx - ax)
            if at >= x and (nearest is None or at < nearest[0]):
                nearest = at, each if ax > bx else (each + 1) % len(ring)
    if nearest is None:
        raise OutlineError("its outlines cross")
    hit, place = (nearest[0], y), nearest[1]
    corner = points[ring[place]]
    # What stands in the triangle between the two points and the edge hides the end of the edge:
    # of that, the point nearest to the line of sight is seen.
    inside = [
        each
        for each, one in enumerate(ring)
        if points[one] != corner
        and _is_covered(points[one], _turned_left((x, y), hit, corner))
        and _is_reflex(each, ring, points)
    ]
    return min(inside, key=lambda each: _slope((x, y), points[ring[each]]), default=place)


def _turned_left(a: Point, b: Point, c: Point) -> tuple[Point, Point, Point]:
    return (a, b, c) if doubled_area(a, b, c) >= 0 else (a, c, b)


def _slope(start: Point, point: Point) -> tuple[float, float]:
    x, y = abs(point[0] - start[0]), abs(point[1] - start[1])
    return (y / x if x else float("inf")), x


def _is_reflex(place: int, ring: list[int], points: Sequence[Point]) -> bool:
    before, here, after = ring[place - 1], ring[place], ring[(place + 1) % len(ring)]
    return doubled_area(points[before], points[here], points[after]) <= 0


def _is_covered(point: Point, triangle: tuple[Point, Point, Point]) -> bool:
    a, b, c = triangle
    return doubled_area(a, b, point) >= 0 and doubled_area(b, c, point) >= 0 and doubled_area(c, a, point) >= 0


def _clip_ears(ring: list[int], points: Sequence[Point]) -> Iterator[tuple[int, int, int]]:
    """Triangles of a counterclockwise ring, each cut off at a corner with nothing in it; fewer where edges cross."""
    ring = [*ring]
    place, missed = 0, 0
    while len(ring) > 2 and missed <= len(ring):
        place %= len(ring)
        ear = ring[place - 1], ring[place], ring[(place + 1) % len(ring)]
        if _is_ear(ear, ring, points):
            yield ear
            del ring[place]
            place, missed = place - 1, 0
        else:
            place, missed = place + 1, missed + 1


def _is_ear(ear: tuple[int, int, int], ring: list[int], points: Sequence[Point]) -> bool:
    a, b, c = (points[each] for each in ear)
    if doubled_area(a, b, c) < 0:
        return False
    return doubled_area(a, b, c) == 0 or not any(
        _is_covered(points[each], (a, b, c)) for each in ring if points[each] not in (a, b, c)
    )
