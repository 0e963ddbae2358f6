"""Upper bounds of the distance between surfaces: no point of one is farther from the other than the result.

Samples alone would give a lower bound. Here every triangle gets a bound for all of its points, and is split where the
bound is not good enough: the distance of a point to a triangle is convex, so over a triangle it is greatest at a
corner; and it changes by no more than the point moves, so near the middle of a triangle it is close to that of the
middle. The triangles to measure to are those of the nearest samples of the other surface; where these miss the nearest
triangle, the distance comes out larger, never smaller. Nothing is random.
"""

import importlib
import math
from collections.abc import Callable, Iterator
from typing import Any

from twinform.passes.mesh_jobs.libraries import Array, np
from twinform.passes.mesh_jobs.surface import TriangleSurface

spatial: Any = importlib.import_module("scipy.spatial")
_SAMPLES = 60_000
"""About how many samples of a surface are kept, by which near triangles are found."""
_FINEST = 24
"""The most samples along the side of a triangle."""
_NEAREST, _NEAREST_TO_CORNER = 4, 2
_CHUNK = 20_000
# With this many triangles left to split, the bound found so far is taken.
_MOST_OPEN = 300_000
_DEEPEST = 20
_TINY = 1e-3
_WORTH, _ALIKE = 0.02, 3.0
"""A triangle is cut where both pieces have more than this fraction of its size."""

Covered = Callable[[Array], Array]
"""Says which triangles, given by their corners, lie inside of a solid and are not counted."""


class Nearest:
    """A surface to which distances are measured, with an index of samples."""

    def __init__(self, surface: TriangleSurface) -> None:
        self.triangles = surface.triangles
        samples, self._owners = _sample_triangles(self.triangles)
        self._tree = spatial.cKDTree(samples)

    def owners(self, points: Array, count: int) -> Array:
        """The triangles whose samples are nearest to each point."""
        _, found = self._tree.query(points, k=min(count, len(self._owners)))
        return self._owners[found.reshape(len(points), -1)]

    def distances(self, points: Array) -> Array:
        """Upper bounds of the distances of points from the surface; nearly always exact."""
        parts = [self._chunk_distances(points[at : at + _CHUNK]) for at in range(0, len(points), _CHUNK)]
        return np.concatenate(parts) if parts else np.zeros(0)

    def _chunk_distances(self, points: Array) -> Array:
        corners = self.triangles[self.owners(points, 2 * _NEAREST)]
        return distances_to_triangles(points[:, None], corners).min(axis=1)


def farthest(
    surface: TriangleSurface,
    nearest: Nearest,
    tolerance: float,
    covered: Covered | None = None,
    limit: float = math.inf,
) -> float:
    """An upper bound of the distance of all points of a surface, at most about a tolerance above the greatest distance.

    It is infinite as soon as one point is farther away than the limit.
    """
    found, bound, triangles = 0.0, 0.0, surface.triangles
    for depth in range(_DEEPEST + 1):
        if covered is not None and len(triangles):
            triangles = triangles[~covered(triangles)]
        still: list[Array] = []
        for part in _chunks(triangles):
            at_points, bounds, below = _bounds(part, nearest)
            found = max(found, *(_greatest_counted(part, *each, covered) for each in at_points))
            if found > limit:
                return math.inf
            closed = bounds <= found + tolerance
            if depth == _DEEPEST or len(triangles) > _MOST_OPEN:
                closed[:] = True
            bound = max(bound, float(bounds[closed].max(initial=0.0)))
            still.append(_split_triangles(part[~closed], below[~closed]))
        triangles = np.concatenate(still) if still else np.zeros((0, 3, 3))
        if not len(triangles):
            break
    return bound


def _chunks(triangles: Array) -> Iterator[Array]:
    return (triangles[at : at + _CHUNK] for at in range(0, len(triangles), _CHUNK))


def _greatest_counted(triangles: Array, points: Array, distances: Array, covered: Covered | None) -> float:
    """The greatest distance of points, one of each triangle, without those whose triangle is covered."""
    if covered is None:
        return float(distances.max(initial=0.0))
    around = points[:, None] + _TINY * (triangles - points[:, None])
    return float(distances[~covered(around)].max(initial=0.0))


def _bounds(triangles: Array, nearest: Nearest) -> tuple[list[tuple[Array, Array]], Array, Array]:
    """Middles and corners of triangles with their distances, a bound for each triangle, and its nearest triangle."""
    middles = triangles.mean(axis=1)
    own = nearest.owners(middles, _NEAREST)
    at_corners = [nearest.owners(triangles[:, corner], _NEAREST_TO_CORNER) for corner in range(3)]
    others = nearest.triangles[np.concatenate([own, *at_corners], axis=1)]
    of_corners = np.stack([distances_to_triangles(triangles[:, corner, None], others) for corner in range(3)], axis=1)
    to_others = distances_to_triangles(middles[:, None], others)
    of_middles, below = to_others.min(axis=1), others[np.arange(len(others)), to_others.argmin(axis=1)]
    radius = np.linalg.norm(triangles - middles[:, None], axis=2).max(axis=1)
    corners = [(triangles[:, at], of_corners[:, at].min(axis=1)) for at in range(3)]
    # A sampled Hausdorff distance says how far two surfaces are apart at least, and a bound that
    # somebody asks for is about the most.
    bounds = np.minimum(of_corners.max(axis=1).min(axis=1), of_middles + radius)
    return [(middles, of_middles), *corners], bounds, below


def _split_triangles(triangles: Array, below: Array) -> Array:
    """Cut triangles where the nearest ones end, so that each piece has one nearest triangle; cut others in four."""
    sides = below - np.roll(below, 1, axis=1)
    normals = np.cross(sides, np.cross(sides[:, 0], sides[:, 1])[:, None])
    lengths = np.linalg.norm(normals, axis=2, keepdims=True)
    normals = normals / np.where(lengths > 0, lengths, 1.0)
    heights = np.einsum("tsi,tcsi->tcs", normals, triangles[:, :, None] - below[:, None])
    across = np.minimum(heights.max(axis=1), -heights.min(axis=1))
    best = across.argmax(axis=1)
    size = np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2).max(axis=1)
    alike = size < _ALIKE * np.linalg.norm(sides, axis=2).max(
        axis=1
    )  # beside many small triangles, each cut would help with only one of them
    cut = alike & (across.max(axis=1) > _WORTH * size)
    chosen = heights[np.arange(len(triangles)), :, best]
    return np.concatenate([_cut_in_four(triangles[~cut]), _cut_in_three(triangles[cut], chosen[cut])])


def _cut_in_three(triangles: Array, heights: Array) -> Array:
    """Cut triangles by planes, given the heights of their corners above the planes."""
    alone = np.where((heights > 0).sum(axis=1) == 1, heights.argmax(axis=1), heights.argmin(axis=1))
    rows, order = np.arange(len(triangles))[:, None], (alone[:, None] + np.arange(3)) % 3
    corners, up = triangles[rows, order], heights[rows, order]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    ab = a + (up[:, :1] / (up[:, :1] - up[:, 1:2])) * (b - a)
    ac = a + (up[:, :1] / (up[:, :1] - up[:, 2:3])) * (c - a)
    return np.concatenate([np.stack(each, axis=1) for each in ((a, ab, ac), (ab, b, c), (ab, c, ac))])


def _cut_in_four(triangles: Array) -> Array:
    """Cut triangles at the middles of their sides."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    quarters = ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
    return np.concatenate([np.stack(each, axis=1) for each in quarters])


def distances_to_triangles(points: Array, corners: Array) -> Array:
    """The distance of each point to the triangle at the same index."""
    a, b, c = corners[..., 0, :], corners[..., 1, :], corners[..., 2, :]
    normal = np.cross(b - a, c - a)
    area = np.einsum("...i,...i", normal, normal)
    beside = np.minimum(
        np.minimum(_distances_to_side(points, a, b), _distances_to_side(points, b, c)), _distances_to_side(points, c, a)
    )
    above = (
        (area > 0) & _is_left(points, a, b, normal) & _is_left(points, b, c, normal) & _is_left(points, c, a, normal)
    )
    height = np.abs(np.einsum("...i,...i", points - a, normal)) / np.sqrt(np.where(area > 0, area, 1.0))
    return np.where(above, height, beside)


def _is_left(points: Array, start: Array, end: Array, normal: Array) -> Array:
    return np.einsum("...i,...i", np.cross(end - start, points - start), normal) >= 0


def _distances_to_side(points: Array, start: Array, end: Array) -> Array:
    """The distance of each point to a side of a triangle."""
    side = end - start
    length = np.einsum("...i,...i", side, side)
    along = np.einsum("...i,...i", points - start, side) / np.where(length > 0, length, 1.0)
    return np.linalg.norm(points - start - np.clip(along, 0.0, 1.0)[..., None] * side, axis=-1)


def _sample_triangles(triangles: Array) -> tuple[Array, Array]:
    """Points spread over triangles, and the index of the triangle that each point is on."""
    sides = np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2).max(axis=1)
    areas = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1) / 2
    apart = float(np.sqrt(areas.sum() / _SAMPLES)) or 1.0
    steps = np.clip(np.ceil(sides / (2 * apart)), 1, _FINEST).astype(int)
    points, owners = list[Array](), list[Array]()
    for count in np.unique(steps):
        of = np.flatnonzero(steps == count)
        weights = _grid_weights(int(count))
        points.append(np.einsum("wk,tki->twi", weights, triangles[of]).reshape(-1, 3))
        owners.append(np.repeat(of, len(weights)))
    return np.concatenate(points), np.concatenate(owners)


def _grid_weights(count: int) -> Array:
    """The middles of the equal triangles that cut a triangle, `count` along a side, as weights of its corners."""
    upward = [(i + 1 / 3, j + 1 / 3) for i in range(count) for j in range(count - i)]
    downward = [(i + 2 / 3, j + 2 / 3) for i in range(count - 1) for j in range(count - 1 - i)]
    return np.array([(x, y, count - x - y) for x, y in (*upward, *downward)]) / count
