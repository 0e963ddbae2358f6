"""Masses of geoms as MuJoCo computes them: primitives exactly, meshes by the way that their asset names.

`legacy`, the default, adds the volumes between each triangle and a point inside of the mesh, all of them positive, so
that meshes which are not star-shaped weigh too much; `exact` gives them their signs; `convex` measures the convex hull;
`shell` spreads the mass over the surface.
"""

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, NamedTuple

from twinform.compiler.input.mjcf.assets import AssetTable
from twinform.compiler.input.mjcf.fitted_shapes import MeasuredMesh, fit, is_fitted
from twinform.compiler.input.mjcf.lower_shapes import PlacedShape, lower_shape, mesh_of
from twinform.compiler.input.mjcf.pieces import Piece, placed_at
from twinform.compiler.input.mjcf.shell_solids import shell
from twinform.diagnostics import DiagnosticSink, Rule, rules
from twinform.ir import Box, Mesh
from twinform.ir.solids import NOTHING, Solid, placed, solid
from twinform.passes.shared.mesh_solids import MeshError, Meshes, MeshTriangles

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Points = NDArray[np.float64]
    Faces = NDArray[np.int64]


_FEWEST = 12
"""The numbers of the four vertices that a mesh needs."""
_SIZE_OF_FIELD = 4
"""A height field has two half sides, and heights above and below its origin."""
_LEGACY, _EXACT, _CONVEX, _SHELL = "legacy", "exact", "convex", "shell"


class _Use(NamedTuple):
    """What a mesh is measured for: what comes of one that cannot be read, and the rule for that if it is no error."""

    otherwise: str
    rule: Rule | None = None


_WEIGHED = _Use("counts for no mass")
_SIZED = _Use("gives its size to no shape", rules.UNREADABLE_MESH)


class GeomSolids:
    """Fills geoms with a density; each mesh is measured once."""

    def __init__(self, assets: AssetTable, meshes: Meshes, sink: DiagnosticSink, *, by_bounds: bool = False) -> None:
        self._by_bounds = by_bounds
        self._uncounted: set[tuple[str, str | None]] = set()
        self._unmeasured: set[str | None] = set()
        self._fitted_to: set[Piece] = set()
        self._assets = assets
        self._meshes = meshes
        self._sink = sink
        self._measured: dict[Piece, MeasuredMesh | None] = {}

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
        return None if measured is None else placed(_of_density(measured.solid, density), shape.at)

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
            return None if measured is None else _of_density(measured.solid, density)
        fitted = self.fitted(geom, _WEIGHED)
        return None if fitted is None else self._filled(geom, fitted, density)

    def _filled(self, geom: Piece, shape: PlacedShape, density: float) -> Solid | None:
        fill = shell if geom.peek("shellinertia") == "true" else solid
        found = fill(shape.shape, density)
        return found and placed(found, shape.at)

    def fitted(self, geom: Piece, use: _Use = _SIZED) -> PlacedShape | None:
        """Return the primitive that MuJoCo fits to the mesh of a geom; None where none is, or it cannot be measured."""
        asset = self._assets.find("mesh", geom.peek("mesh"))
        if asset is None or not is_fitted(geom):
            return None
        self._fitted_to.add(asset)
        measured, frame = self._of_asset(asset, use), mesh_of(asset)
        found = None if measured is None else fit(geom, measured, by_bounds=self._by_bounds)
        return found if found is None or frame is None else found._replace(at=frame.at.compose(found.at))

    def keep_what_is_fitted_to(self) -> None:
        """Leave the files of meshes in the remainder too, so that these are there whatever becomes of their shapes."""
        for asset in self._fitted_to:
            asset.leave("file", "scale")

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

    def _of_asset(self, asset: Piece, use: _Use = _WEIGHED) -> MeasuredMesh | None:
        """Return the mesh of an asset; one that cannot be read is reported once, with what comes of that."""
        if asset not in self._measured:
            self._measured[asset] = self._measure(asset, use)
        return self._measured[asset]

    def _measure(self, asset: Piece, use: _Use) -> MeasuredMesh | None:
        found = mesh_of(asset)
        mesh = found.shape if found else None
        way = asset.peek("inertia") or _LEGACY
        if not isinstance(mesh, Mesh):
            return None if asset.has("file") else self._of_vertices(asset, way, use)
        triangles, is_hull = self._triangles(asset, mesh, use)
        if triangles is None:
            return None
        if is_hull and way == _EXACT:
            way = _CONVEX  # a negative scale has turned its faces
        import numpy as np  # noqa: PLC0415 - only meshes need it

        points = np.frombuffer(triangles.points, dtype=np.float64).reshape(-1, 3)
        faces = np.frombuffer(triangles.faces, dtype=np.int64).reshape(-1, 3)
        return _measure_faces(points, faces, way)

    def _of_vertices(self, asset: Piece, way: str, use: _Use) -> MeasuredMesh | None:
        """Measure a mesh whose vertices stand in its asset; report that a hull is needed and nothing makes hulls."""
        needed = ("numpy",) if asset.has("face") and way != _CONVEX else ("numpy", "scipy")
        missing = next((each for each in needed if find_spec(each) is None), None)  # which not everybody installs
        if missing is None or not asset.has("vertex"):
            return _measure_vertices(asset, way) if asset.has("vertex") else None
        message = f"the mesh {asset.name!r} {use.otherwise}: {missing}, which measures its vertices, is not installed"
        hint = "pip install 'twinform[meshes]', or write an <inertial> with the mass of its body"
        self._sink.report(rules.UNREADABLE_MESH, message, asset.location, found=asset.name, help=hint)
        self._unmeasured.add(asset.name)
        return None

    def _triangles(self, asset: Piece, mesh: Mesh, use: _Use) -> tuple[MeshTriangles | None, bool]:
        """Return the triangles of a file, or of the convex hull of its points, and whether it is that hull.

        MuJoCo takes the hull if there are no triangles.
        """
        try:
            return self._meshes.triangles(mesh, as_mujoco=True), False
        except MeshError as error:
            found = self._hull(mesh)
            so = "its mass is that of the convex hull of its points, as in MuJoCo" if found else f"it {use.otherwise}"
            message = f"{error.message}, so that {so}"
            self._sink.report(use.rule or error.rule, message, asset.location, found=mesh.uri, help=error.help)
            return found, True

    def _hull(self, mesh: Mesh) -> MeshTriangles | None:
        try:
            return self._meshes.triangles(mesh, as_mujoco=True, hull_of_points=True)
        except MeshError:
            return None


def _of_density(measured: Solid, density: float) -> Solid:
    return Solid(measured.mass * density, measured.center, _times(measured.inertia, density))


def _measure_vertices(asset: Piece, way: str) -> MeasuredMesh | None:
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


def _measure_faces(points: "Points", faces: "Faces", way: str) -> MeasuredMesh | None:
    found = _solid_of_faces(points, faces, way)
    return None if found is None else MeasuredMesh(found, points.astype(float).tobytes())


def _solid_of_faces(points: "Points", faces: "Faces", way: str) -> Solid | None:
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
