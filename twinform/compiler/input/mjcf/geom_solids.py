"""Masses of geoms as MuJoCo computes them: primitives exactly, meshes by the way that their asset names.

`legacy`, the default, adds the volumes between each triangle and a point inside of the mesh, all of them positive, so
that meshes which are not star-shaped weigh too much; `exact` gives them their signs; `convex` measures the convex hull;
`shell` spreads the mass over the surface.
"""

import math
from collections.abc import Callable, Mapping
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING

from twinform.compiler.input.mjcf.assets import AssetTable
from twinform.compiler.input.mjcf.lower_shapes import PlacedShape, lower_shape, mesh_of
from twinform.compiler.input.mjcf.pieces import Piece, placed_at
from twinform.compiler.input.mjcf.shell_solids import shell
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Box, Capsule, Cylinder, Ellipsoid, Mesh, Sphere
from twinform.ir.geometry import Shape
from twinform.ir.solids import NOTHING, Solid, placed, principal_axes, solid
from twinform.ir.transform import Transform
from twinform.passes.shared.mesh_solids import MeshError, Meshes, MeshTriangles

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Points = NDArray[np.float64]
    Faces = NDArray[np.int64]


def _with_radius(one: float, other: float) -> float:
    return (one + other) / 2


_FITTED: Mapping[str, Callable[[float, float, float], Shape]] = {
    "sphere": lambda x, y, z: Sphere.unchecked(radius=(x + y + z) / 3),
    "capsule": lambda x, y, z: Capsule.unchecked(
        radius=_with_radius(x, y), length=2 * max(z - _with_radius(x, y) / 2, 0.0)
    ),
    "cylinder": lambda x, y, z: Cylinder.unchecked(radius=_with_radius(x, y), length=2 * z),
    "box": lambda x, y, z: Box.unchecked(size=(2 * x, 2 * y, 2 * z)),
    "ellipsoid": lambda x, y, z: Ellipsoid.unchecked(radii=(x, y, z)),
}
"""What is fitted to a box with three half sides, of which the last one is the longest."""
_FEWEST = 12
"""The numbers of the four vertices that a mesh needs."""
_SIZE_OF_FIELD = 4
"""A height field has two half sides, and heights above and below its origin."""
_LEGACY, _EXACT, _CONVEX, _SHELL = "legacy", "exact", "convex", "shell"


class GeomSolids:
    """Fills geoms with a density; each mesh is measured once."""

    def __init__(self, assets: AssetTable, meshes: Meshes, sink: DiagnosticSink, *, by_bounds: bool = False) -> None:
        self._by_bounds = by_bounds
        self._uncounted: set[tuple[str, str | None]] = set()
        self._unmeasured: set[str | None] = set()
        self._assets = assets
        self._meshes = meshes
        self._sink = sink
        self._measured: dict[Piece, Solid | None] = {}

    def __call__(self, geom: Piece, density: float) -> Solid | None:
        """Return the geom filled with a density in kg/m^3, in its own frame; None where nothing can be computed."""
        shape = lower_shape(geom, self._assets)
        if geom.peek("type") == "plane":
            return NOTHING
        if geom.peek("type") == "hfield":
            return self._of_height_field(geom, density)
        asset = self._assets.find("mesh", geom.peek("mesh"))
        if shape is None:
            found = None if asset is None else self._of_no_shape(geom, asset, density)
            if found is None:
                self._report_uncounted(geom)
            return found
        if not isinstance(shape.shape, Mesh):
            return self._filled(geom, shape, density)
        measured = None if asset is None else self._of_asset(asset)
        return None if measured is None else placed(_of_density(measured, density), shape.at)

    def _of_height_field(self, geom: Piece, density: float) -> Solid | None:
        """Return the box that MuJoCo takes for a height field, whatever its elevations, with half of its height."""
        asset = self._assets.find("hfield", geom.peek("hfield"))
        numbers = asset.peek_numbers("size") if asset else ()
        if len(numbers) != _SIZE_OF_FIELD:
            return NOTHING
        x, y, top, bottom = numbers
        return self._filled(geom, PlacedShape(Box.unchecked(size=(2 * x, 2 * y, top / 2 + bottom))), density)

    def _of_no_shape(self, geom: Piece, asset: Piece, density: float) -> Solid | None:
        """Return the mass of a geom that has no shape in SDF: a mesh without file, or what is fitted to a mesh."""
        if geom.peek("type") in {"mesh", "sdf"}:  # a plugin computes only what has no vertices
            measured = self._of_asset(asset)
            return None if measured is None else _of_density(measured, density)
        fitted = self._fitted(geom, asset)
        return None if fitted is None else self._filled(geom, fitted, density)

    def _filled(self, geom: Piece, shape: PlacedShape, density: float) -> Solid | None:
        fill = shell if geom.peek("shellinertia") == "true" else solid
        found = fill(shape.shape, density)
        return found and placed(found, shape.at)

    def _fitted(self, geom: Piece, asset: Piece) -> PlacedShape | None:
        """Return the primitive that MuJoCo fits to the equivalent box of a mesh; None where it is fitted otherwise."""
        kind, measured = geom.peek("type") or "sphere", None if self._by_bounds else self._of_asset(asset)
        frame = mesh_of(asset)
        asset.leave("file", "scale", "refpos", "refquat")  # a document has no place for what is only fitted to
        if kind not in _FITTED or measured is None or not measured.mass > 0:
            return None
        moments, axes = principal_axes(measured.inertia)
        ordered = sorted(zip(moments, axes, strict=True), reverse=True)
        whole = sum(moments)
        # half the sides of a box with these moments: the shortest first
        half = [math.sqrt(max(whole - 2 * moment, 0.0) * 1.5 / measured.mass) for moment, _ in ordered]
        scale = next(iter(geom.peek_numbers("fitscale")), 1.0)
        (u, v, w) = (axis for _, axis in ordered)
        columns = (u[0], v[0], w[0], u[1], v[1], w[1], u[2], v[2], w[2])
        at = Transform(measured.center, columns)
        return PlacedShape(_FITTED[kind](*(scale * each for each in half)), frame.at.compose(at) if frame else at)

    def _report_uncounted(self, geom: Piece) -> None:
        """Report a geom whose mass is not known, once for each mesh."""
        kind, mesh = geom.peek("type") or "sphere", geom.peek("mesh")
        if (kind, mesh) in self._uncounted or mesh in self._unmeasured:
            return
        self._uncounted.add((kind, mesh))
        what = f"geom {geom.name!r}" if geom.name else "this geom"
        message = f"{what} is a {kind} that only MuJoCo can measure, so that it counts for no mass"
        hint = "write an <inertial> with the mass of its body"
        self._sink.report(rules.UNREADABLE_MESH, message, geom.location, found=kind, help=hint)

    def _of_asset(self, asset: Piece) -> Solid | None:
        """Return the mesh of an asset filled with a density of one; one that cannot be read is reported once."""
        if asset not in self._measured:
            self._measured[asset] = self._measure(asset)
        return self._measured[asset]

    def _measure(self, asset: Piece) -> Solid | None:
        found = mesh_of(asset)
        mesh = found.shape if found else None
        way = asset.peek("inertia") or _LEGACY
        if not isinstance(mesh, Mesh):
            return None if asset.has("file") else self._of_vertices(asset, way)
        triangles, is_hull = self._triangles(asset, mesh)
        if triangles is None:
            return None
        if is_hull and way == _EXACT:
            way = _CONVEX  # a negative scale has turned its faces
        import numpy as np  # noqa: PLC0415 - only meshes need it

        points = np.frombuffer(triangles.points, dtype=np.float64).reshape(-1, 3)
        faces = np.frombuffer(triangles.faces, dtype=np.int64).reshape(-1, 3)
        return _measure_faces(points, faces, way)

    def _of_vertices(self, asset: Piece, way: str) -> Solid | None:
        """Measure a mesh whose vertices stand in its asset; report that a hull is needed and nothing makes hulls."""
        needed = ("numpy",) if asset.has("face") and way != _CONVEX else ("numpy", "scipy")
        missing = next((each for each in needed if find_spec(each) is None), None)  # which not everybody installs
        if missing is None or not asset.has("vertex"):
            return _measure_vertices(asset, way) if asset.has("vertex") else None
        message = (
            f"the mesh {asset.name!r} counts for no mass: {missing}, which measures its vertices, is not installed"
        )
        hint = "pip install 'twinform[meshes]', or write an <inertial> with the mass of its body"
        self._sink.report(rules.UNREADABLE_MESH, message, asset.location, found=asset.name, help=hint)
        self._unmeasured.add(asset.name)
        return None

    def _triangles(self, asset: Piece, mesh: Mesh) -> tuple[MeshTriangles | None, bool]:
        """Return the triangles of a file, or of the convex hull of its points, and whether it is that hull.

        MuJoCo takes the hull if there are no triangles.
        """
        try:
            return self._meshes.triangles(mesh), False
        except MeshError as error:
            found = self._hull(mesh)
            so = "its mass is that of the convex hull of its points, as in MuJoCo" if found else "it counts for no mass"
            message = f"{error.message}, so that {so}"
            self._sink.report(error.rule, message, asset.location, found=mesh.uri, help=error.help)
            return found, True

    def _hull(self, mesh: Mesh) -> MeshTriangles | None:
        try:
            return self._meshes.triangles(mesh, hull_of_points=True)
        except MeshError:
            return None


def _of_density(measured: Solid, density: float) -> Solid:
    return Solid(measured.mass * density, measured.center, _times(measured.inertia, density))


def _measure_vertices(asset: Piece, way: str) -> Solid | None:
    """Measure a mesh whose vertices stand in its asset; without faces it is their convex hull."""
    numbers = asset.peek_numbers("vertex")
    back = placed_at(asset.peek_numbers("refpos"), asset.peek_numbers("refquat")).inverse()
    scale = asset.peek_numbers("scale") or (1.0, 1.0, 1.0)
    if len(numbers) < _FEWEST or len(numbers) % 3:
        return None
    import numpy as np  # noqa: PLC0415 - only meshes need it

    corners = [(numbers[at], numbers[at + 1], numbers[at + 2]) for at in range(0, len(numbers), 3)]
    points = np.array([back.apply(each) for each in corners]) * scale
    faces = np.array(asset.peek_numbers("face"), dtype=np.int64).reshape(-1, 3)
    if faces.size and not 0 <= faces.min() <= faces.max() < len(points):
        return None
    return _measure_faces(points, faces if faces.size else _hull(points), way)


def _times(inertia: tuple[float, ...], factor: float) -> tuple[float, float, float, float, float, float]:
    xx, yy, zz, xy, xz, yz = (factor * each for each in inertia)
    return xx, yy, zz, xy, xz, yz


def _measure_faces(points: "Points", faces: "Faces", way: str) -> Solid | None:
    import numpy as np  # noqa: PLC0415 - only meshes need it

    corners = points[_hull(points) if way == _CONVEX else faces]
    crossed = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(crossed, axis=1) / 2
    if not areas.sum() > 0:
        return None
    middle = (corners.mean(axis=1) * areas[:, None]).sum(axis=0) / areas.sum()
    if way == _SHELL:
        return _solid_of(*_shell(corners, areas))
    signed = way in {_EXACT, _CONVEX}
    volumes = _volumes(corners - middle, signed=signed)
    if not volumes.sum() > 0:
        return None
    # the center of a tetrahedron is a quarter of the way from its face's three corners to the apex
    center = middle + ((corners - middle).sum(axis=1) / 4 * volumes[:, None]).sum(axis=0) / volumes.sum()
    # MuJoCo adds the volumes once more about that center: of a mesh that is not star-shaped about both points, the mass
    # is another one then.
    moved = corners - center
    volumes = _volumes(moved, signed=signed)
    return _solid_of(float(volumes.sum()), center, _moments(moved, volumes, 20))


def _hull(points: "Points") -> "Faces":
    """Return the faces of the convex hull, outward; none where all points are in a plane."""
    import numpy as np  # noqa: PLC0415 - as above

    spatial = import_module("scipy.spatial")  # few meshes ask for it
    try:
        hull = spatial.ConvexHull(points)
    except spatial.QhullError:
        return np.zeros((0, 3), dtype=np.int64)
    faces = np.array(hull.simplices, dtype=np.int64)
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inward = (normals * hull.equations[:, :3]).sum(axis=1) < 0
    faces[inward] = faces[inward][:, ::-1]
    return faces


def _volumes(corners: "Points", *, signed: bool) -> "Points":
    """Return the volumes of the tetrahedra between the triangles and the origin."""
    import numpy as np  # noqa: PLC0415 - as above

    volumes = (corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum(axis=1) / 6
    return volumes if signed else np.abs(volumes)


def _moments(corners: "Points", weights: "Points", parts: int) -> "Points":
    """Return the integral of x x^T over tetrahedra with the origin (20 parts) or over triangles (12 parts)."""
    import numpy as np  # noqa: PLC0415 - as above

    sums = corners.sum(axis=1)
    each = np.einsum("nik,nil->nkl", corners, corners) + np.einsum("nk,nl->nkl", sums, sums)
    return (each * weights[:, None, None]).sum(axis=0) / parts


def _shell(corners: "Points", areas: "Points") -> "tuple[float, Points, Points]":
    center = (corners.mean(axis=1) * areas[:, None]).sum(axis=0) / areas.sum()
    return float(areas.sum()), center, _moments(corners - center, areas, 12)


def _solid_of(mass: float, center: "Points", moments: "Points") -> Solid:
    xx, yy, zz = (float(moments[i, i]) for i in range(3))
    inertia = (yy + zz, xx + zz, xx + yy, *(-float(moments[i, j]) for i, j in ((0, 1), (0, 2), (1, 2))))
    x, y, z = map(float, center)
    return Solid(mass, (x, y, z), _times(inertia, 1.0))
