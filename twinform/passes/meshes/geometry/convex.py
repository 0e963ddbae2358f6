"""Convex stand-ins for the mesh of a collision: its hull, and parts by CoACD, with a budget of triangles."""

import math
from collections.abc import Iterator, Sequence

from twinform.passes.meshes.geometry.distances import Nearest, farthest
from twinform.passes.meshes.geometry.libraries import Array, coacd, fast_simplification, np, spatial
from twinform.passes.meshes.geometry.surface import Surface, UnusableMeshError

_CONCAVITIES = (0.1, 0.05, 0.02, 0.01)
"""Thresholds of CoACD that are tried, from few parts to many."""
_MOST_FOR_PARTS = 20_000
"""Triangles that CoACD is given; a finer mesh is decimated first, and the error still measured to all of it."""
_LEAST_FACES = 4
_BESIDE = 1e-4
"""How far beside a face it is asked whether another part lies there, as part of the size."""


def hull(points: Array) -> Surface:
    """The convex hull of points, its triangles looking outward.

    Raises:
        UnusableMeshError: they lie in a plane.
    """
    try:
        found = spatial.ConvexHull(points)
    except (spatial.QhullError, ValueError) as error:
        raise UnusableMeshError("it is flat, and has no convex hull with an inside") from error
    corners = found.points[found.simplices]
    outward = np.einsum(
        "ti,ti->t", np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), found.equations[:, :3]
    )
    simplices = np.where((outward < 0)[:, None], found.simplices[:, ::-1], found.simplices)
    used, index = np.unique(simplices, return_inverse=True)
    return Surface(found.points[used], index.reshape(-1, 3))


def within_budget(convex: Surface, triangles: int) -> Surface:
    """A hull of so many triangles at most, inside of the one that is given or nearly so."""
    count = triangles
    while len(convex.faces) > triangles and count >= _LEAST_FACES:
        points, _ = fast_simplification.simplify(convex.points, convex.faces.astype(np.int64), target_count=count)
        convex = hull(np.asarray(points, dtype=float))
        count = int(count * 0.8)
    return convex


def decompositions(surface: Surface, most_parts: int) -> Iterator[list[Surface]]:
    """Convex parts that are together about the shape, from coarse to fine; each is the hull of its points."""
    mesh = _for_parts(surface)
    before = 0
    for concavity in _CONCAVITIES:
        coacd.set_log_level("off")
        made = coacd.run_coacd(
            coacd.Mesh(mesh.points, mesh.faces), threshold=concavity, max_convex_hull=most_parts, seed=0
        )
        parts = [each for each in map(_part, made) if each is not None]
        if parts and len(parts) != before:
            yield parts
        before = len(parts)
        if before >= most_parts:
            return


def _part(made: Sequence[Array]) -> Surface | None:
    try:
        return hull(np.asarray(made[0], dtype=float))
    except UnusableMeshError:
        return None


def _for_parts(surface: Surface) -> Surface:
    if len(surface.faces) <= _MOST_FOR_PARTS:
        return surface
    points, faces = fast_simplification.simplify(
        surface.points, surface.faces.astype(np.int64), target_count=_MOST_FOR_PARTS
    )
    return Surface(np.asarray(points, dtype=float), np.asarray(faces))


def error_of(surface: Surface, parts: Sequence[Surface], tolerance: float, limit: float = math.inf) -> float:
    """How far apart the outsides of a surface and of some convex parts are, at most.

    It is the greater of two distances: of what is outside of all parts from them, and of what is outside of the parts
    together from the surface. What a part hides inside of itself, or inside of another one, touches nothing.
    """
    sides = [spatial.ConvexHull(part.points).equations for part in parts]
    size = surface.diagonal
    outside = farthest(
        surface, Nearest(_together(parts)), tolerance, _Inside(sides, 1e-9 * size, grain=tolerance), limit
    )
    if outside > limit:
        return outside
    target = Nearest(surface)
    found = outside
    for index, part in enumerate(parts):
        others = _Inside([*sides[:index], *sides[index + 1 :]], _BESIDE * size / 2, _BESIDE * size, tolerance)
        found = max(found, farthest(part, target, tolerance, others if others.sides else None, limit))
        if found > limit:
            break
    return found


def _together(parts: Sequence[Surface]) -> Surface:
    starts = np.cumsum([0, *(len(part.points) for part in parts)])
    faces = [part.faces + start for part, start in zip(parts, starts, strict=False)]
    return Surface(np.concatenate([part.points for part in parts]), np.concatenate(faces))


class _Inside:
    """Whether triangles, moved outward by a step, lie inside of one of some convex parts, give or take a tolerance.

    One whose sides are shorter than a grain may have its corners in several parts: what lies between these is as small.
    """

    def __init__(self, sides: Sequence[Array], tolerance: float, step: float = 0.0, grain: float = 0.0) -> None:
        self.sides, self._tolerance, self._step, self._grain = sides, tolerance, step, grain

    def __call__(self, triangles: Array) -> Array:
        corners = triangles
        if self._step:
            normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
            lengths = np.linalg.norm(normals, axis=1, keepdims=True)
            corners = triangles + self._step * (normals / np.where(lengths > 0, lengths, 1.0))[:, None]
        inside = np.zeros((len(triangles), 3), dtype=bool)
        whole = np.zeros(len(triangles), dtype=bool)
        for part in self.sides:
            rest = np.flatnonzero(~whole)
            within = np.ones((len(rest), 3), dtype=bool)
            for side in part:
                within &= corners[rest] @ side[:3] + side[3] <= self._tolerance
            whole[rest] |= within.all(axis=1)
            inside[rest] |= within
        small = np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2).max(axis=1) < self._grain
        return whole | (small & inside.all(axis=1))
