"""Mesh files as solids, in the frame of the shape. They are read and measured in the confined process for meshes."""

from collections.abc import Sequence
from dataclasses import field
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, cast

from twinform.dataclass import dataclass
from twinform.diagnostics import rules
from twinform.ir import Element, Mesh, Vector3
from twinform.ir.solids import Solid, times_each
from twinform.ir.transform import times_power
from twinform.passes.framework.assets import AssetError, Assets, FindingError
from twinform.passes.mesh_jobs.mesh_files import READ, RefusedMeshError, content_of, install_readers, kind_of

if TYPE_CHECKING:
    from twinform.passes.mesh_jobs.job import MeshResult, Options


class MeshError(FindingError):
    """Nothing can be computed from a mesh."""


class MeshTriangles(NamedTuple):
    """The triangles of a mesh: `points`, rows of three doubles, and `faces`, of three 64-bit integers."""

    points: bytes
    faces: bytes


@dataclass(frozen=True, slots=True)
class Meshes:
    """The mesh files of a document, each measured once. With `hull`, an open mesh is replaced by its convex hull.

    Lengths are in meters: a COLLADA file names its unit, and other formats are taken to be in meters, as in simulators.
    Like Gazebo and RViz this does not turn a mesh whose file has another axis than z pointing up.
    """

    assets: Assets
    hull: bool = False
    _known: "dict[tuple[object, ...], MeshResult]" = field(
        default_factory=dict[tuple[object, ...], "MeshResult"], repr=False
    )

    def solid(self, mesh: Mesh, density: float) -> Solid:
        """The mesh filled with a density in kg/m^3, in the frame of its shape.

        Raises:
            MeshError: the file is not there, cannot be read, or its mesh has no inside.
        """
        facts = self._result("measure", mesh, {"solid": True, "hull": self.hull}).facts
        if "open" in facts:
            help = None if self.hull else "close it, or use its convex hull"
            raise MeshError(rules.OPEN_MESH, f"the mesh {mesh.uri!r} {facts['open']}", help)
        # The numbers come back scaled by a power of two: those of very small or large meshes would
        # leave the range of doubles on the way.
        exponent, volume = cast("int", facts["exponent"]), cast("float", facts["volume"])
        rows = [[density * entry for entry in row] for row in cast("Sequence[Sequence[float]]", facts["inertia"])]
        inertia = (rows[0][0], rows[1][1], rows[2][2], rows[0][1], rows[0][2], rows[1][2])
        mass = times_power(density * volume, 3 * exponent)
        return Solid(mass, _vector(facts["center"]), times_each(inertia, 5 * exponent))

    def bounds(self, mesh: Mesh) -> tuple[Vector3, Vector3]:
        """The least and the greatest coordinates of the mesh, in the frame of its shape.

        Raises:
            MeshError: the file is not there, or cannot be read.
        """
        facts = self._result("measure", mesh, {"solid": False, "hull": False}).facts
        return _vector(facts["least"]), _vector(facts["greatest"])

    def triangles(self, mesh: Mesh, *, as_mujoco: bool = False, hull_of_points: bool = False) -> MeshTriangles:
        """The triangles of the mesh, in the frame of the shape.

        With `as_mujoco`, polygons are split as MuJoCo splits them; with `hull_of_points`, a file that has points alone
        is their convex hull.

        Raises:
            MeshError: the file is not there, or cannot be read.
        """
        wanted: Options = {"as_mujoco": as_mujoco, "hull_of_points": hull_of_points}
        files = self._result("surface", mesh, {name: True for name, value in wanted.items() if value}).files
        return MeshTriangles(files["points"], files["faces"])

    def _result(self, name: str, mesh: Mesh, options: "Options") -> "MeshResult":
        """The result of a job on the file of a mesh, run at most once."""
        uri = mesh.uri or ""
        try:
            path = self.assets.find(uri)
        except AssetError as error:
            raise MeshError(error.rule, error.message, error.help) from error
        submesh, center = submesh_of(mesh)
        scale = list(mesh.scale) if mesh.scale else None
        # Most readers of robots take a glTF file's axes as they stand, z up, though the format says
        # y.
        wanted = {**options, "submesh": submesh, "center": center, "scale": scale, "gltf_up": "z"}
        key = (name, path, *map(str, wanted.values()))
        if key not in self._known:
            self._known[key] = _run_job(name, path, uri, wanted)
        return self._known[key]


def _vector(found: object) -> Vector3:
    x, y, z = cast("Sequence[float]", found)
    return x, y, z


def _run_job(name: str, path: Path, uri: str, options: "Options") -> "MeshResult":
    # A FIFO or a device under the name of a mesh would block the reader or never end.
    if not path.is_file():
        raise MeshError(rules.UNREADABLE_MESH, f"the mesh {uri!r} is no file")
    if kind_of(path) not in READ:
        message = f"the mesh {uri!r} is in no format that is read here: {', '.join(sorted(READ))}"
        raise MeshError(rules.UNREADABLE_MESH, message)
    from twinform.passes.mesh_jobs.child_process import do  # noqa: PLC0415 - most runs read no mesh
    from twinform.passes.mesh_jobs.job import MeshJob  # noqa: PLC0415 - as above

    try:
        result = do(MeshJob(name, options, kind_of(path), content_of(path)))
    except OSError as error:
        raise MeshError(rules.UNREADABLE_MESH, f"the mesh {uri!r} cannot be read: {error.strerror}") from error
    except RefusedMeshError as error:
        raise MeshError(rules.UNREADABLE_MESH, f"the mesh {uri!r} cannot be read: {error}") from error
    require_result(result, uri, "read")
    return result


def require_result(result: "MeshResult", uri: str, what: str) -> None:
    """Refuse a mesh that could not be `what` for its content, or for what is not installed.

    Raises:
        MeshError: it says why.
    """
    if result.trouble == "missing":
        message = f"the mesh {uri!r} is not looked into: {result.message} is not installed"
        raise MeshError(rules.MESH_READER_MISSING, message, f"run: {install_readers()}")
    if result.trouble:
        raise MeshError(rules.UNREADABLE_MESH, f"the mesh {uri!r} cannot be {what}: {result.message}")


def submesh_of(mesh: Mesh) -> tuple[str | None, bool]:
    """The name in `<submesh>`, and whether the submesh is moved to the origin."""
    found = next((part.element for part in mesh.opaque if part.element and part.element.name == "submesh"), None)
    if found is None:
        return None, False
    return _text(found, "name"), _text(found, "center") in {"1", "true"}


def _text(element: Element, name: str) -> str | None:
    child = element.find(name)
    return (child.text or "").strip() if child else None
