"""Reads the binary mesh files of MuJoCo, `.msh`: four counts, then points, normals, texture coordinates and faces."""

import struct
from typing import Any

from twinform.passes.mesh_jobs.libraries import np, trimesh
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError

KIND = "msh"
"""The suffix of such files, which other formats have too; a text of another format is refused by its size."""
_HEADER = struct.Struct("<4i")


def scene_of_msh(content: bytes) -> Any:
    """Read a file into a scene of one mesh; one without faces is the convex hull of its points.

    Raises:
        RefusedMeshError: its size is not that of its counts, or a face names a point that there is not.
    """
    if len(content) < _HEADER.size:
        raise RefusedMeshError("it is too short for a mesh of MuJoCo")
    points, normals, coordinates, faces = _HEADER.unpack_from(content)
    sizes = (12 * points, 12 * normals, 8 * coordinates, 12 * faces)
    if min(sizes) < 0 or len(content) != _HEADER.size + sum(sizes):
        raise RefusedMeshError("it is no mesh of MuJoCo: its size is not that of the points and faces it should have")
    vertices = np.frombuffer(content, "<f4", 3 * points, _HEADER.size).reshape(-1, 3).astype(float)
    start = _HEADER.size + sum(sizes[:3])
    triangles = np.frombuffer(content, "<i4", 3 * faces, start).reshape(-1, 3)
    if faces and not (triangles.min() >= 0 and triangles.max() < points):
        raise RefusedMeshError("a face of it names a point that it does not have")
    mesh = trimesh.Trimesh(vertices=vertices, faces=triangles, process=False)
    return trimesh.Scene(mesh if faces else mesh.convex_hull)
