"""Triangles of a mesh as arrays of bytes, with a color for each point where the file has colors or textures."""

from collections.abc import Sequence
from typing import Any

from twinform.passes.mesh_jobs.geometry.formats import appearance_of
from twinform.passes.mesh_jobs.geometry.libraries import Array, np, trimesh
from twinform.passes.mesh_jobs.geometry.mesh_parts import parts_of
from twinform.passes.mesh_jobs.job import MeshJob, MeshResult

_SHARP = 0.6
"""Angles between triangles, in radians, from which there is an edge to be seen."""
# Larger meshes are drawn with the vertices that they have: looking for edges takes time.
_MOST_SMOOTHED = 100_000
_UNPAINTED = (200, 200, 205, 255)


def draw(job: MeshJob) -> MeshResult:
    """All triangles of a mesh as arrays, for who draws it."""
    return MeshResult({}, drawn(parts_of(job, appearance=True)))


def drawn(parts: Sequence[tuple[str, Any]]) -> dict[str, bytes]:
    """`points` (rows of three 32-bit floats), `faces` (of three 32-bit integers) and, if there are, `colors`.

    The colors are rows of red, green, blue and alpha in a byte each. All is in the byte order of this machine.
    """
    painted = bool(appearance_of(parts))
    pieces = [(part, _colors(part)) if painted else (_smooth(part), None) for _, part in parts]
    points = np.concatenate([np.asarray(part.vertices, dtype=np.float32) for part, _ in pieces])
    starts = np.cumsum([0, *(len(part.vertices) for part, _ in pieces)])[:-1]
    faces = [np.asarray(part.faces, dtype=np.uint32) + start for (part, _), start in zip(pieces, starts, strict=True)]
    found = {"points": points.tobytes(), "faces": np.concatenate(faces).astype(np.uint32).tobytes()}
    if painted:
        found["colors"] = np.concatenate([colors for _, colors in pieces]).tobytes()
    return found


def _smooth(part: Any) -> Any:
    """The mesh with its points merged, except where there is an edge."""
    if len(part.faces) > _MOST_SMOOTHED:
        return part
    merged = trimesh.Trimesh(vertices=part.vertices, faces=part.faces, process=True)
    return trimesh.graph.smooth_shade(merged, angle=_SHARP) if len(merged.faces) else part


def _colors(part: Any) -> Array:
    """A color for each point: of the texture there, of the material, or of the point itself."""
    visual, count = part.visual, len(part.vertices)
    if visual.kind == "texture":
        material = visual.material
        image = getattr(material, "image", None) or getattr(material, "baseColorTexture", None)
        colors = visual.to_color().vertex_colors if image is not None and visual.uv is not None else material.main_color
    elif visual.kind in {"vertex", "face"}:
        colors = visual.vertex_colors
    else:
        colors = _UNPAINTED
    colors = np.asarray(colors, dtype=np.uint8)
    return colors if colors.shape == (count, 4) else np.broadcast_to(colors.reshape(-1)[:4], (count, 4))
