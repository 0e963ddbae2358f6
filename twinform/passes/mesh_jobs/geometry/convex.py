"""Convex stand-ins for the mesh of a collision: its hull, and parts by CoACD, with a budget of triangles."""

import math
from collections.abc import Iterator, Sequence

from twinform.passes.mesh_jobs.geometry.distances import Nearest, farthest
from twinform.passes.mesh_jobs.geometry.libraries import Array, np
from twinform.passes.mesh_jobs.geometry.solver_libraries import coacd, fast_simplification, spatial
from twinform.passes.mesh_jobs.geometry.surface import TriangleSurface, UnusableMeshError

_CONCAVITIES = (0.1, 0.05, 0.02, 0.01)
"""Thresholds of CoACD that are tried, from few parts to many."""
# The most triangles that CoACD is given. A finer mesh is decimated first, and the error is still
# measured to all of it.
_MOST_FOR_PARTS = 20_000
# How long CoACD searches for a cut. With more the parts are much the same.
_ITERATIONS = 60
_AT_ONCE = 16
"""Of a hull with this many corners, one more is added at once."""
_ROUNDING = 1e-9
_BESIDE = 1e-4
"""How far beside a face it is asked whether another part lies there, as part of the size."""


def hull(points: Array) -> TriangleSurface:
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
    return TriangleSurface(found.points[used], index.reshape(-1, 3))


# The parts that CoACD makes have up to thousands of corners: the seven collisions of a UR5, with
# 5,328 triangles, became 43,586. With the corners that the distance needs it is 1,820, in a third
# of the time.
def reduced(convex: TriangleSurface, distance: float, triangles: int | None = None) -> TriangleSurface:
    """The hull of some corners of a hull: of as few as leave none out by more than a distance, or a budget allows.

    It begins with four, and what sticks out most is added; so it lies inside of the hull that is given.
    """
    most = len(convex.points) if triangles is None else (triangles + 4) // 2  # n corners make 2 n - 4 triangles
    points, chosen = convex.points, _four_corners(convex.points)
    left = points
    while len(chosen) < most:
        try:
            sides = spatial.ConvexHull(chosen).equations
        except spatial.QhullError:  # so thin that four corners have nothing between them
            return convex
        above = left @ sides[:, :3].T + sides[:, 3]
        out = above.max(axis=1)
        peaks = np.unique(above.argmax(axis=0))
        # What sticks out most comes first. The result lies inside of the hull, so that it grows no
        # robot; the error is measured afterwards.
        peaks = peaks[np.argsort(-out[peaks], kind="stable")][: min(most - len(chosen), 1 + len(chosen) // _AT_ONCE)]
        peaks = peaks[out[peaks] > max(distance, _ROUNDING * convex.diagonal)]
        if not len(peaks):
            break
        chosen, left = np.concatenate([chosen, left[peaks]]), left[out > distance]
    return hull(chosen)


def _four_corners(points: Array) -> Array:
    """Corners that are far apart: two, the one farthest from their line, and the one farthest from these three."""
    a = points[points[:, 0].argmin()]
    b = points[np.linalg.norm(points - a, axis=1).argmax()]
    c = points[np.linalg.norm(np.cross(points - a, b - a), axis=1).argmax()]
    d = points[np.abs((points - a) @ np.cross(b - a, c - a)).argmax()]
    return np.stack([a, b, c, d])


def decompositions(surface: TriangleSurface, most_parts: int) -> Iterator[list[TriangleSurface]]:
    """Convex parts that are together about the shape, from coarse to fine; each is the hull of its points."""
    mesh = _for_parts(surface)
    before = 0
    for concavity in _CONCAVITIES:
        coacd.set_log_level("off")
        made = coacd.run_coacd(
            coacd.Mesh(mesh.points, mesh.faces),
            threshold=concavity,
            max_convex_hull=most_parts,
            mcts_iterations=_ITERATIONS,
            seed=0,
        )
        parts = [each for each in map(_part, made) if each is not None]
        if parts and len(parts) != before:
            yield parts
        before = len(parts)
        if before >= most_parts:
            return


def _part(made: Sequence[Array]) -> TriangleSurface | None:
    try:
        return hull(np.asarray(made[0], dtype=float))
    except UnusableMeshError:
        return None


def _for_parts(surface: TriangleSurface) -> TriangleSurface:
    if len(surface.faces) <= _MOST_FOR_PARTS:
        return surface
    points, faces = fast_simplification.simplify(
        surface.points, surface.faces.astype(np.int64), target_count=_MOST_FOR_PARTS
    )
    return TriangleSurface(np.asarray(points, dtype=float), np.asarray(faces))


def error_of(
    surface: TriangleSurface, parts: Sequence[TriangleSurface], tolerance: float, limit: float = math.inf
) -> float:
    """How far apart the outsides of a surface and of some convex parts are, at most.

    It is the greater of two distances: of what is outside of all parts from them, and of what is outside of the parts
    together from the surface. What a part hides inside of itself, or inside of another one, touches nothing.
    """
    sides = [spatial.ConvexHull(part.points).equations for part in parts]
    size = surface.diagonal
    # The surface of a housing with a motor in it is far from its hull, inside, where nothing can
    # touch it: only the outsides are compared. Faces along which convex parts meet are inside too.
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


def _together(parts: Sequence[TriangleSurface]) -> TriangleSurface:
    starts = np.cumsum([0, *(len(part.points) for part in parts)])
    faces = [part.faces + start for part, start in zip(parts, starts, strict=False)]
    return TriangleSurface(np.concatenate([part.points for part in parts]), np.concatenate(faces))


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
