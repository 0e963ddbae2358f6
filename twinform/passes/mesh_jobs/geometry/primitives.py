"""The box, sphere, cylinder or capsule that is nearest to the mesh of a collision, turned as it has to be."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from twinform.passes.mesh_jobs.geometry.convex import hull
from twinform.passes.mesh_jobs.geometry.distances import Nearest, farthest
from twinform.passes.mesh_jobs.geometry.libraries import Array, np, trimesh
from twinform.passes.mesh_jobs.geometry.solver_libraries import optimize
from twinform.passes.mesh_jobs.geometry.surface import TriangleSurface

_AROUND, _FINENESS = 48, 3
# Triangles in a round surface are deepest at their middle or at that of a side, or very near.
_MARGIN = 1.2
_STEPS = 400
_REFINED = 6
"""So many of the candidates are refined."""
_POINTS = 600
"""About so many points of the hull are looked at for that."""
# Of two that fit about as well, the one of the simpler kind is taken.
_AS_GOOD = 1.05
# A primitive that fills the bounding box is preferred to a refined one unless it fits worse by more
# than this factor: most likely it has the numbers that the mesh was made with.
_PLAIN = 2.5
# Only this many candidates have their error bounded, which is expensive. By samples, the others are
# worse.
_CERTIFIED = 2


class Primitive(NamedTuple):
    """A shape with its sizes as IR has them: a box its extents, the others radius and, if they have one, length."""

    kind: str
    sizes: tuple[float, ...]
    center: tuple[float, float, float]
    rotation: Array
    """Its axes, as columns, in the frame of the mesh."""

    def depths(self, points: Array) -> Array:
        """How far points are outside of it; negative inside."""
        return _DEPTHS[self.kind]((points - self.center) @ self.rotation, self.sizes)

    def surface(self) -> tuple[TriangleSurface, float]:
        """Triangles of its surface, and how far these are off it at most."""
        mesh = _MESHES[self.kind](self.sizes)
        points = np.asarray(mesh.vertices, dtype=float) @ self.rotation.T + self.center
        made = TriangleSurface(points, np.asarray(mesh.faces))
        sides = (made.triangles + np.roll(made.triangles, 1, axis=1)) / 2
        deepest = np.concatenate([made.triangles.mean(axis=1), sides.reshape(-1, 3)])
        return made, 0.0 if self.kind == "box" else _MARGIN * float(np.maximum(-self.depths(deepest), 0).max())


def _box_depths(points: Array, sizes: Sequence[float]) -> Array:
    return _outside(np.abs(points) - np.asarray(sizes) / 2)


def _cylinder_depths(points: Array, sizes: Sequence[float]) -> Array:
    radius, length = sizes
    return _outside(
        np.stack([np.linalg.norm(points[:, :2], axis=1) - radius, np.abs(points[:, 2]) - length / 2], axis=1)
    )


def _capsule_depths(points: Array, sizes: Sequence[float]) -> Array:
    radius, length = sizes
    along = np.maximum(np.abs(points[:, 2]) - length / 2, 0.0)
    return np.hypot(np.linalg.norm(points[:, :2], axis=1), along) - radius


def _sphere_depths(points: Array, sizes: Sequence[float]) -> Array:
    return np.linalg.norm(points, axis=1) - sizes[0]


def _outside(beyond: Array) -> Array:
    """The distance to a product of intervals, from how far beyond the end of each a point is."""
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
    """How far apart the outsides of a mesh and of a primitive are, at most: see `convex.error_of`."""
    beyond = max(0.0, float(primitive.depths(surface.points[np.unique(surface.faces)]).max()))
    if beyond > limit:
        return math.inf
    outside, off = primitive.surface()
    return max(beyond, farthest(outside, Nearest(surface), tolerance, limit=limit - off) + off)


def best(
    surface: TriangleSurface, kinds: Sequence[str], tolerance: float, limit: float = math.inf
) -> tuple[Primitive, float] | None:
    """The primitive of these kinds with the least error that was found, and its error; None without a candidate."""
    around = hull(surface.points[np.unique(surface.faces)])
    points = _spread(around)
    near = sorted(_candidates(around, kinds), key=lambda each: _misfit(each, points))[:_REFINED]
    pairs = [(each, _rounded(_refined(each, points), surface.diagonal)) for each in near]
    good = _AS_GOOD * min((_misfit(each, points) for _, each in pairs), default=0.0) + 1e-6 * surface.diagonal

    def rank(pair: tuple[Primitive, Primitive]) -> tuple[float, int, float]:
        plain, refined = pair
        return max(_misfit(refined, points), good), kinds.index(plain.kind), -float(np.trace(plain.rotation))

    measured: list[tuple[Primitive, float]] = []
    for pair in sorted(pairs, key=rank)[:_CERTIFIED]:
        plain = _rounded(pair[0], surface.diagonal)
        tried = (plain, pair[1]) if _misfit(plain, points) <= _PLAIN * max(_misfit(pair[1], points), good) else pair[1:]
        for each in tried:
            measured.append((each, error_of(surface, each, tolerance, limit)))
            if measured[-1][1] <= limit:
                return measured[-1]
    return min(measured, key=lambda each: each[1], default=None)


def _candidates(around: TriangleSurface, kinds: Sequence[str]) -> Iterator[Primitive]:
    for axes in _frames(around.points):
        at = around.points @ axes
        low, high = at.min(axis=0), at.max(axis=0)
        center = tuple(((low + high) / 2 @ axes.T).tolist())
        for kind in kinds:
            yield from _in_frame(kind, high - low, center, axes)


def _frames(points: Array) -> Iterator[Array]:
    yield np.eye(3)
    to_box, _ = trimesh.bounds.oriented_bounds(points, ordered=False)
    yield to_box[:3, :3].T
    _, _, rows = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)
    yield rows.T if np.linalg.det(rows) > 0 else -rows.T


def _in_frame(kind: str, extents: Array, center: tuple[float, float, float], axes: Array) -> Iterator[Primitive]:
    """The primitives of a kind that fill a box of these extents; one with an axis along each of the three."""
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


def _refined(primitive: Primitive, points: Array) -> Primitive:
    """Optimize the sizes and the center of a primitive, so that its surface misses the points by less."""
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


def _rounded(primitive: Primitive, size: float) -> Primitive:
    """Round the numbers of a primitive to a millionth of its size, so that people can read them."""
    digits = 6 - math.floor(math.log10(size))
    x, y, z = (round(each, digits) + 0.0 for each in primitive.center)
    sizes = tuple(max(round(each, digits), 10.0**-digits) for each in primitive.sizes)
    return primitive._replace(sizes=sizes, center=(x, y, z))


def _misfit(primitive: Primitive, points: Array) -> float:
    return float(np.abs(primitive.depths(points)).max())


def _spread(around: TriangleSurface) -> Array:
    """Points of a convex hull: its corners, and the middles of its sides and triangles."""
    triangles = around.triangles
    middles = (triangles + np.roll(triangles, 1, axis=1)) / 2
    every = np.concatenate([around.points, triangles.mean(axis=1), middles.reshape(-1, 3)])
    return every[:: max(1, len(every) // _POINTS)]
