"""Convex replacements for the mesh of a collision: its hull, or several parts made by CoACD, with few triangles."""

import importlib
import math
from collections.abc import Iterator, Sequence
from typing import Any

from twinform.passes.mesh_jobs.decimation import fast_simplification
from twinform.passes.mesh_jobs.distances import Nearest, farthest, spatial
from twinform.passes.mesh_jobs.libraries import Array, np
from twinform.passes.mesh_jobs.surface import TriangleSurface, UnusableMeshError

coacd: Any = importlib.import_module("coacd")
_CONCAVITIES = (0.1, 0.05, 0.02, 0.01)
"""Thresholds of CoACD that are tried, from few parts to many."""
# The most triangles that CoACD is given. A finer mesh is decimated first, and the error is still
# measured to all of it.
_MOST_FOR_PARTS = 20_000
# How long CoACD searches for a cut. With more the parts are much the same.
_ITERATIONS = 60
_AT_ONCE = 16
"""For every so many corners that a hull has, one more is added per step."""
_ROUNDING = 1e-9
_BESIDE = 1e-4
"""How far outside of a face another part is looked for, as a fraction of the size."""


def hull(points: Array) -> TriangleSurface:
    """The convex hull of points, with triangles that face outward.

    Raises:
        UnusableMeshError: the points lie in a plane.
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
def reduce_hull(convex: TriangleSurface, distance: float, triangles: int | None = None) -> TriangleSurface:
    """The hull of some corners of a hull: of so few that none is left out by more than a distance, or of a budget.

    It begins with four corners and adds those that stick out most, so it always lies inside of the given hull.
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
    """Convex parts that together make about the same shape, first few and coarse ones, then finer ones."""
    mesh = _coarse_surface(surface)
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
        parts = [each for each in map(_part_hull, made) if each is not None]
        if parts and len(parts) != before:
            yield parts
        before = len(parts)
        if before >= most_parts:
            return


def _part_hull(made: Sequence[Array]) -> TriangleSurface | None:
    """The hull of a part that CoACD made; None where it is flat."""
    try:
        return hull(np.asarray(made[0], dtype=float))
    except UnusableMeshError:
        return None


def _coarse_surface(surface: TriangleSurface) -> TriangleSurface:
    """The surface with as many triangles as CoACD can take."""
    if len(surface.faces) <= _MOST_FOR_PARTS:
        return surface
    points, faces = fast_simplification.simplify(
        surface.points, surface.faces.astype(np.int64), target_count=_MOST_FOR_PARTS
    )
    return TriangleSurface(np.asarray(points, dtype=float), np.asarray(faces))


def error_of(
    surface: TriangleSurface, parts: Sequence[TriangleSurface], tolerance: float, limit: float = math.inf
) -> float:
    """An upper bound of the distance between the outside of a surface and that of some convex parts.

    It is the greater of two distances: from what lies outside of all parts to the parts, and from the outside of all
    parts together to the surface. What a part encloses, or what lies inside of another part, is not counted.
    """
    sides = [spatial.ConvexHull(part.points).equations for part in parts]
    size = surface.diagonal
    # The surface of a housing with a motor in it is far from its hull, inside, where nothing can
    # touch it: only the outsides are compared. Faces along which convex parts meet are inside too.
    outside = farthest(
        surface, Nearest(_join_surfaces(parts)), tolerance, _Inside(sides, 1e-9 * size, grain=tolerance), limit
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


def _join_surfaces(parts: Sequence[TriangleSurface]) -> TriangleSurface:
    """Surfaces as one, without merging their points."""
    starts = np.cumsum([0, *(len(part.points) for part in parts)])
    faces = [part.faces + start for part, start in zip(parts, starts, strict=False)]
    return TriangleSurface(np.concatenate([part.points for part in parts]), np.concatenate(faces))


class _Inside:
    """Says which triangles, moved outward by a step, lie inside of one of some convex parts, within a tolerance.

    Triangles whose sides are shorter than a grain may have their corners in several parts: the gap between is as small.
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
