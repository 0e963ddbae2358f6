"""Triangles of a mesh file as arrays, and the checks that every mesh has to pass."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from twinform.passes.mesh_jobs.geometry.libraries import Array, np
from twinform.passes.mesh_jobs.geometry.open_mesh import scene_of
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError

MOST_TRIANGLES = 5_000_000


class UnusableMeshError(RefusedMeshError):
    """Why nothing can be made of a mesh."""


class TriangleSurface(NamedTuple):
    """Triangles: points as rows of x, y, z in meters, and three indices of points for each."""

    points: Array
    faces: Array

    @property
    def triangles(self) -> Array:
        """The corners of each triangle."""
        return self.points[self.faces]

    @property
    def diagonal(self) -> float:
        """The length of the diagonal of the box around it."""
        return float(np.linalg.norm(np.ptp(self.points[np.unique(self.faces)], axis=0)))


def placed_parts(scene: Any) -> list[tuple[str, Any]]:
    """The meshes of a scene by their names, copied to where it puts them; lines and points are left out."""
    found: list[tuple[str, Any]] = []
    for node in scene.graph.nodes_geometry:
        at, name = scene.graph[node]
        if len(getattr(scene.geometry[name], "faces", ())):
            part = scene.geometry[name].copy()
            if not np.array_equal(at, np.eye(4)):
                part.apply_transform(at)
            found.append((str(name), part))
    return found


def read_scene(
    content: bytes, kind: str, companions: Mapping[str, bytes], *, appearance: bool = False, finite: bool = True
) -> Any:
    """The scene in a file, in its own unit; where not `finite`, coordinates may be no numbers.

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
        < sum(len(each[1].faces) for each in _named(scene))
    ):
        raise UnusableMeshError(f"it has more than {MOST_TRIANGLES:,} triangles")
    for each in meshes:
        if finite and not np.isfinite(each.vertices[each.faces.ravel()]).all():
            raise UnusableMeshError("it has coordinates that are no finite numbers")
    return scene


def _named(scene: Any) -> list[tuple[str, Any]]:
    nodes = (scene.graph[node][1] for node in scene.graph.nodes_geometry)
    return [(name, scene.geometry[name]) for name in nodes if len(getattr(scene.geometry[name], "faces", ()))]


def selected(parts: list[tuple[str, Any]], submesh: str | None, *, center: bool) -> list[tuple[str, Any]]:
    """The parts of a file that a shape uses: all, or the one that it names, moved to the origin if it is to be.

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


def joined(parts: list[tuple[str, Any]]) -> TriangleSurface:
    """All triangles of some meshes, with points that are at one place merged, without those that have no area.

    Raises:
        UnusableMeshError: nothing is left.
    """
    triangles = np.concatenate([np.asarray(part.vertices, dtype=float)[part.faces] for _, part in parts])
    surface = merged(triangles)
    if not len(surface.faces) or not surface.diagonal > 0:
        raise UnusableMeshError("its triangles have no area")
    return surface


def merged(triangles: Array) -> TriangleSurface:
    """Triangles of corners as a surface, without those of which two corners are one."""
    points, index = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    faces = index.reshape(-1, 3)
    apart = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return TriangleSurface(points, faces[apart])


def scaled(surface: TriangleSurface, scale: Any) -> TriangleSurface:
    """A surface stretched along x, y and z; its triangles still look outward where it is mirrored.

    Raises:
        UnusableMeshError: nothing is left of it.
    """
    factors = np.asarray(scale, dtype=float)
    if not np.isfinite(factors).all() or not factors.all():
        raise UnusableMeshError("its scale is zero or no number")
    faces = surface.faces if np.prod(factors) > 0 else surface.faces[:, ::-1]
    return TriangleSurface(surface.points * factors, faces)
