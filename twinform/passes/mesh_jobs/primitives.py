"""The box, sphere, cylinder or capsule that is nearest to the mesh of a collision, turned as it has to be."""

import importlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from twinform.passes.mesh_jobs.convex import hull
from twinform.passes.mesh_jobs.distances import Nearest, farthest
from twinform.passes.mesh_jobs.libraries import Array, np, trimesh
from twinform.passes.mesh_jobs.surface import TriangleSurface

optimize: Any = importlib.import_module("scipy.optimize")
_AROUND, _FINENESS = 48, 3
# Triangles inscribed in a round surface are deepest at or near their middle, or the middle of a side.
_MARGIN = 1.2
_STEPS = 400
_REFINED = 6
"""How many of the candidates are refined."""
_POINTS = 600
"""About how many points of the hull are compared for that."""
# Of two primitives whose misfits differ by less than this factor, the simpler one is taken.
_AS_GOOD = 1.05
# A primitive that fills the bounding box is preferred to a refined one unless it fits worse by more
# than this factor: most likely it has the numbers that the mesh was made with.
_PLAIN = 2.5
# Only this many candidates have their error bounded, which is expensive. By samples, the others are
# worse.
_CERTIFIED = 2


class Primitive(NamedTuple):
    """A shape with its sizes as in the IR: the extents of a box, or the radius and, if it has one, the length."""

    kind: str
    sizes: tuple[float, ...]
    center: tuple[float, float, float]
    rotation: Array
    """The axes of the shape, as columns, in the frame of the mesh."""

    def depths(self, points: Array) -> Array:
        """How far points are outside of the shape; negative inside."""
        return _DEPTHS[self.kind]((points - self.center) @ self.rotation, self.sizes)

    def surface(self) -> tuple[TriangleSurface, float]:
        """Triangles of the surface, and how far these are from the true surface at most."""
        mesh = _MESHES[self.kind](self.sizes)
        points = np.asarray(mesh.vertices, dtype=float) @ self.rotation.T + self.center
        made = TriangleSurface(points, np.asarray(mesh.faces))
        sides = (made.triangles + np.roll(made.triangles, 1, axis=1)) / 2
        deepest = np.concatenate([made.triangles.mean(axis=1), sides.reshape(-1, 3)])
        return made, 0.0 if self.kind == "box" else _MARGIN * float(np.maximum(-self.depths(deepest), 0).max())


def _box_depths(points: Array, sizes: Sequence[float]) -> Array:
    return _distance_to_intervals(np.abs(points) - np.asarray(sizes) / 2)


def _cylinder_depths(points: Array, sizes: Sequence[float]) -> Array:
    radius, length = sizes
    return _distance_to_intervals(
        np.stack([np.linalg.norm(points[:, :2], axis=1) - radius, np.abs(points[:, 2]) - length / 2], axis=1)
    )


def _capsule_depths(points: Array, sizes: Sequence[float]) -> Array:
    radius, length = sizes
    along = np.maximum(np.abs(points[:, 2]) - length / 2, 0.0)
    return np.hypot(np.linalg.norm(points[:, :2], axis=1), along) - radius


def _sphere_depths(points: Array, sizes: Sequence[float]) -> Array:
    return np.linalg.norm(points, axis=1) - sizes[0]


def _distance_to_intervals(beyond: Array) -> Array:
    """The distance of points to a product of intervals, from how far they are beyond the end of each interval."""
    return np.linalg.norm(np.maximum(beyond, 0.0), axis=1) + np.minimum(beyond.max(axis=1), 0.0)


_DEPTHS: Mapping[str, Callable[[Array, Sequence[float]], Array]] = {
    "box": _box_depths, "cylinder": _cylinder_depths, "capsule": _capsule_depths, "sphere": _sphere_depths,
}  # fmt: skip
_MESHES: Mapping[str, Callable[[Sequence[float]], Any]] = {
    "box": trimesh.creation.box,
    "cylinder": lambda sizes: trimesh.creation.cylinder(sizes[0], sizes[1], sections=_AROUND),
    "capsule": lambda sizes: trimesh.creation.capsule(sizes[1], sizes[0], count=[_AROUND // 2, _AROUND]),
    "sphere": lambda sizes: trimesh.creation.icosphere(_FINENESS, sizes[0]),
}


def error_of(surface: TriangleSurface, primitive: Primitive, tolerance: float, limit: float = math.inf) -> float:
    """An upper bound of the distance between the outside of a mesh and a primitive; see `convex.error_of`."""
    beyond = max(0.0, float(primitive.depths(surface.points[np.unique(surface.faces)]).max()))
    if beyond > limit:
        return math.inf
    outside, off = primitive.surface()
    return max(beyond, farthest(outside, Nearest(surface), tolerance, limit=limit - off) + off)


def best_primitive(
    surface: TriangleSurface, kinds: Sequence[str], tolerance: float, limit: float = math.inf
) -> tuple[Primitive, float] | None:
    """The best primitive of these kinds, and its error; None without a candidate."""
    around = hull(surface.points[np.unique(surface.faces)])
    points = _spread_points(around)
    near = sorted(_candidates(around, kinds), key=lambda each: _misfit(each, points))[:_REFINED]
    pairs = [(each, _round_numbers(_refine(each, points), surface.diagonal)) for each in near]
    good = _AS_GOOD * min((_misfit(each, points) for _, each in pairs), default=0.0) + 1e-6 * surface.diagonal

    def rank(pair: tuple[Primitive, Primitive]) -> tuple[float, int, float]:
        plain, refined = pair
        return max(_misfit(refined, points), good), kinds.index(plain.kind), -float(np.trace(plain.rotation))

    measured: list[tuple[Primitive, float]] = []
    for pair in sorted(pairs, key=rank)[:_CERTIFIED]:
        plain = _round_numbers(pair[0], surface.diagonal)
        tried = (plain, pair[1]) if _misfit(plain, points) <= _PLAIN * max(_misfit(pair[1], points), good) else pair[1:]
        for each in tried:
            measured.append((each, error_of(surface, each, tolerance, limit)))
            if measured[-1][1] <= limit:
                return measured[-1]
    return min(measured, key=lambda each: each[1], default=None)


def _candidates(around: TriangleSurface, kinds: Sequence[str]) -> Iterator[Primitive]:
    """Primitives of these kinds that fill the bounding box, in some frames."""
    for axes in _candidate_frames(around.points):
        at = around.points @ axes
        low, high = at.min(axis=0), at.max(axis=0)
        center = tuple(((low + high) / 2 @ axes.T).tolist())
        for kind in kinds:
            yield from _primitives_in_frame(kind, high - low, center, axes)


def _candidate_frames(points: Array) -> Iterator[Array]:
    """Rotations to try: that of the file, that of the smallest bounding box, and that of the principal axes."""
    yield np.eye(3)
    to_box, _ = trimesh.bounds.oriented_bounds(points, ordered=False)
    yield to_box[:3, :3].T
    _, _, rows = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
    yield rows.T if np.linalg.det(rows) > 0 else -rows.T


def _primitives_in_frame(
    kind: str, extents: Array, center: tuple[float, float, float], axes: Array
) -> Iterator[Primitive]:
    """The primitives of a kind that fill a box of these extents: three where they have an axis, one along each side."""
    if kind == "box":
        yield Primitive("box", tuple(extents.tolist()), center, axes)
    elif kind == "sphere":
        yield Primitive("sphere", (float(extents.mean() / 2),), center, np.eye(3))
    else:
        for axis in range(3):
            order = [(axis + 1) % 3, (axis + 2) % 3, axis]
            radius, length = float(extents[order[:2]].mean() / 2), float(extents[axis])
            length = length - 2 * radius if kind == "capsule" else length
            if length > 0:
                yield Primitive(kind, (radius, length), center, axes[:, order])


def _refine(primitive: Primitive, points: Array) -> Primitive:
    """Change the sizes and the center of a primitive so that its surface misses the points by less."""
    size = max(primitive.sizes)
    start = np.array([*primitive.sizes, *primitive.center]) / size
    count = len(primitive.sizes)

    def changed(numbers: Array) -> Primitive:
        sizes = tuple(float(max(each, 1e-9)) * size for each in numbers[:count])
        x, y, z = (float(each) * size for each in numbers[count:])
        return primitive._replace(sizes=sizes, center=(x, y, z))

    def misfit(numbers: Array) -> float:
        return _misfit(changed(numbers), points)

    found = optimize.minimize(
        misfit,
        start,
        method="Nelder-Mead",
        options={
            "maxiter": _STEPS,
            "xatol": 1e-7,
            "fatol": 1e-9 * size,
            "initial_simplex": np.vstack([start, start + 0.02 * np.eye(len(start))]),
        },
    )
    made = changed(found.x)
    return made if _misfit(made, points) < _misfit(primitive, points) else primitive


def _round_numbers(primitive: Primitive, size: float) -> Primitive:
    """Round the numbers of a primitive to a millionth of its size, so that people can read them."""
    digits = 6 - math.floor(math.log10(size))
    x, y, z = (round(each, digits) + 0.0 for each in primitive.center)
    sizes = tuple(max(round(each, digits), 10.0**-digits) for each in primitive.sizes)
    return primitive._replace(sizes=sizes, center=(x, y, z))


def _misfit(primitive: Primitive, points: Array) -> float:
    """The greatest distance of points from the surface of a primitive."""
    return float(np.abs(primitive.depths(points)).max())


def _spread_points(around: TriangleSurface) -> Array:
    """Points on a convex hull: its corners, and the middles of its sides and triangles."""
    triangles = around.triangles
    middles = (triangles + np.roll(triangles, 1, axis=1)) / 2
    every = np.concatenate([around.points, triangles.mean(axis=1), middles.reshape(-1, 3)])
    return every[:: max(1, len(every) // _POINTS)]
