"""The meshes of a file that a shape uses, as a list of named parts in meters, and as one surface of triangles."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, cast

from twinform.passes.mesh_jobs.job import MeshJob
from twinform.passes.mesh_jobs.libraries import Array, np
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError
from twinform.passes.mesh_jobs.mesh_writing import turn_z_up
from twinform.passes.mesh_jobs.open_mesh import scene_of

MOST_TRIANGLES = 5_000_000


class UnusableMeshError(RefusedMeshError):
    """Why nothing can be made of a mesh that could be read."""


class TriangleSurface(NamedTuple):
    """Triangles as arrays: points as rows of x, y, z in meters, and for each triangle three indices of points."""

    points: Array
    faces: Array

    @property
    def triangles(self) -> Array:
        """The corners of each triangle."""
        return self.points[self.faces]

    @property
    def diagonal(self) -> float:
        """The length of the diagonal of the bounding box."""
        return float(np.linalg.norm(np.ptp(self.points[np.unique(self.faces)], axis=0)))


def parts_of(job: MeshJob, *, appearance: bool = False, finite: bool = True) -> list[tuple[str, Any]]:
    """The meshes that the shape of a job uses, by name, in meters and in their places."""
    scene = _read_scene(job.content, job.kind, job.companions, appearance=appearance, finite=finite)
    parts = _select_submesh(
        _place_parts(scene), cast("str | None", job.options["submesh"]), center=bool(job.options["center"])
    )
    meter = _unit_in_meters(parts) if job.kind == "dae" else 1.0
    if meter != 1.0:
        for _, part in parts:
            part.apply_scale(meter)
    return turn_z_up(parts) if job.kind in {"glb", "gltf"} and job.options["gltf_up"] == "y" else parts


def _read_scene(
    content: bytes, kind: str, companions: Mapping[str, bytes], *, appearance: bool = False, finite: bool = True
) -> Any:
    """Read the scene of a file, in its own unit; coordinates may be infinite or NaN where not `finite`.

    Raises:
        UnusableMeshError: it has no triangles, too many, or coordinates that are no numbers.
    """
    scene = scene_of(content, kind, companions=companions, appearance=appearance)
    meshes = [each for each in scene.geometry.values() if len(getattr(each, "faces", ()))]
    if not meshes:
        raise UnusableMeshError("it has no triangles")
    uses = len(scene.graph.nodes_geometry)
    # Checked before the parts are copied to their places: a part may be placed any number of times.
    if (
        uses * max(len(each.faces) for each in meshes)
        > MOST_TRIANGLES
        < sum(len(each[1].faces) for each in _used_meshes(scene))
    ):
        raise UnusableMeshError(f"it has more than {MOST_TRIANGLES:,} triangles")
    for each in meshes:
        if finite and not np.isfinite(each.vertices[each.faces.ravel()]).all():
            raise UnusableMeshError("it has coordinates that are no finite numbers")
    return scene


def _used_meshes(scene: Any) -> list[tuple[str, Any]]:
    """The meshes of a scene, each as often as it is placed."""
    nodes = (scene.graph[node][1] for node in scene.graph.nodes_geometry)
    return [(name, scene.geometry[name]) for name in nodes if len(getattr(scene.geometry[name], "faces", ()))]


def _place_parts(scene: Any) -> list[tuple[str, Any]]:
    """Copies of the meshes of a scene at the places where it puts them, without lines and points."""
    found: list[tuple[str, Any]] = []
    for node in scene.graph.nodes_geometry:
        at, name = scene.graph[node]
        if len(getattr(scene.geometry[name], "faces", ())):
            part = scene.geometry[name].copy()
            if not np.array_equal(at, np.eye(4)):
                part.apply_transform(at)
            found.append((str(name), part))
    return found


def _select_submesh(parts: list[tuple[str, Any]], submesh: str | None, *, center: bool) -> list[tuple[str, Any]]:
    """The parts of a file that have the name of a submesh, moved to the origin if `center`; all parts if it is None.

    Raises:
        UnusableMeshError: there is no part of this name.
    """
    if submesh is None:
        return parts
    found = [(name, part) for name, part in parts if name == submesh]
    if not found:
        known = ", ".join(sorted({name for name, _ in parts})[:6])
        raise UnusableMeshError(f"it has no submesh {submesh!r}, it has {known}")
    if center:
        middle = np.mean(
            [np.min([p.bounds[0] for _, p in found], axis=0), np.max([p.bounds[1] for _, p in found], axis=0)], axis=0
        )
        for _, part in found:
            part.apply_translation(-middle)
    return found


def _unit_in_meters(parts: Sequence[tuple[str, Any]]) -> float:
    """The unit of a COLLADA file in meters, which its reader leaves in the metadata of the meshes."""
    words = next((str(part.metadata["units"]) for _, part in parts if part.metadata.get("units")), "meters")
    try:
        factor = float(words.partition("*")[0]) if "*" in words else 1.0
    except ValueError:
        factor = math.nan
    if not (math.isfinite(factor) and factor > 0):
        raise UnusableMeshError(f"its unit is {words!r}")
    return factor


def join_parts(parts: list[tuple[str, Any]]) -> TriangleSurface:
    """All triangles of some meshes as one surface, with equal points merged and triangles without area left out.

    Raises:
        UnusableMeshError: nothing is left.
    """
    triangles = np.concatenate([np.asarray(part.vertices, dtype=float)[part.faces] for _, part in parts])
    surface = merge_points(triangles)
    if not len(surface.faces) or not surface.diagonal > 0:
        raise UnusableMeshError("its triangles have no area")
    return surface


def merge_points(triangles: Array) -> TriangleSurface:
    """A surface of triangles given by corners; triangles of which two corners are one point are left out."""
    points, index = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    faces = index.reshape(-1, 3)
    apart = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return TriangleSurface(points, faces[apart])


def scale_surface(surface: TriangleSurface, scale: Any) -> TriangleSurface:
    """A surface scaled along x, y and z; its triangles still face outward where the scale mirrors it.

    Raises:
        UnusableMeshError: nothing is left of it.
    """
    factors = np.asarray(scale, dtype=float)
    if not np.isfinite(factors).all() or not factors.all():
        raise UnusableMeshError("its scale is zero or no number")
    faces = surface.faces if np.prod(factors) > 0 else surface.faces[:, ::-1]
    return TriangleSurface(surface.points * factors, faces)
