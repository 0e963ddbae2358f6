"""Masses of geoms as MuJoCo computes them: primitives exactly, meshes by the way that their asset names.

`legacy`, the default, adds the volumes between each triangle and a point inside of the mesh, all of them positive, so
that meshes which are not star-shaped weigh too much; `exact` gives them their signs; `convex` measures the convex hull;
`shell` spreads the mass over the surface.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from twinform.compiler.input.mjcf.assets import AssetTable
from twinform.compiler.input.mjcf.lower_shapes import lower_shape, mesh_of
from twinform.compiler.input.mjcf.pieces import Piece
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Heightmap, Mesh, Plane
from twinform.ir.solids import NOTHING, Solid, placed, solid
from twinform.passes.shared.mesh_solids import MeshError, Meshes

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Points = NDArray[np.float64]
    Faces = NDArray[np.int64]

_LEGACY, _EXACT, _CONVEX, _SHELL = "legacy", "exact", "convex", "shell"


class GeomSolids:
    """Fills geoms with a density; each mesh is measured once."""

    def __init__(self, assets: AssetTable, meshes: Meshes, sink: DiagnosticSink) -> None:
        self._assets = assets
        self._meshes = meshes
        self._sink = sink
        self._measured: dict[Piece, Solid | None] = {}

    def __call__(self, geom: Piece, density: float) -> Solid | None:
        """Return the geom filled with a density in kg/m^3, in its own frame; None where nothing can be computed."""
        shape = lower_shape(geom, self._assets)
        if shape is None:
            return None
        if isinstance(shape.shape, Plane | Heightmap):
            return NOTHING
        if not isinstance(shape.shape, Mesh):
            return solid(shape.shape, density)
        asset = self._assets.find("mesh", geom.peek("mesh"))
        measured = None if asset is None else self._of_asset(asset)
        if measured is None:
            return None
        of_density = Solid(measured.mass * density, measured.center, _times(measured.inertia, density))
        return placed(of_density, shape.at)

    def _of_asset(self, asset: Piece) -> Solid | None:
        """Return the mesh of an asset filled with a density of one; one that cannot be read is reported once."""
        if asset not in self._measured:
            self._measured[asset] = self._measure(asset)
        return self._measured[asset]

    def _measure(self, asset: Piece) -> Solid | None:
        found = mesh_of(asset)
        mesh = found.shape if found else None
        if not isinstance(mesh, Mesh):
            return None
        way = asset.peek("inertia") or _LEGACY
        try:
            triangles = self._meshes.triangles(mesh)
        except MeshError as error:
            message = f"{error.message}, so that it counts for no mass"
            self._sink.report(error.rule, message, asset.location, found=mesh.uri, help=error.help)
            return None
        import numpy as np  # noqa: PLC0415 - only meshes need it

        points = np.frombuffer(triangles.points, dtype=np.float64).reshape(-1, 3)
        faces = np.frombuffer(triangles.faces, dtype=np.int64).reshape(-1, 3)
        return _measure_faces(points, faces, way)


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
    """Return the faces of the convex hull, outward."""
    import numpy as np  # noqa: PLC0415 - as above

    hull = import_module("scipy.spatial").ConvexHull(points)  # few meshes ask for it
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
