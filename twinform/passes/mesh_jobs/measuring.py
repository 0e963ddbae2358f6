"""Jobs that only look at a mesh: count its triangles, measure it as a solid, give its triangles for drawing."""

import math
from collections.abc import Sequence
from typing import Any

from twinform.ir.transform import common_exponent, times_power
from twinform.passes.mesh_jobs.job import MeshJob, MeshResult
from twinform.passes.mesh_jobs.libraries import Array, np, trimesh
from twinform.passes.mesh_jobs.mesh_writing import appearance_of
from twinform.passes.mesh_jobs.surface import UnusableMeshError, parts_of, scene_of

_Triangles = Any
"""A `trimesh.Trimesh`."""
_SHARP = 0.6
"""The angle between triangles, in radians, from which on their common side is a visible edge."""
_UNPAINTED = (200, 200, 205, 255)


def count(job: MeshJob) -> MeshResult:
    """Count the triangles of a file, those of a part as often as the file places it."""
    scene = scene_of(job.content, job.kind, companions=job.companions)
    placed = (scene.graph[node][1] for node in scene.graph.nodes_geometry)
    return MeshResult({"triangles": sum(len(getattr(scene.geometry[name], "faces", ())) for name in placed)})


def measure(job: MeshJob) -> MeshResult:
    """Measure the bounding box of a mesh; where `solid`, also its volume, center and inertia of unit density.

    Where `hull`, the convex hull stands in for an open mesh. A mesh without an inside gets the reason instead.
    """
    triangles = _scaled_triangles(job)
    least, greatest = triangles.bounds.tolist()
    facts: dict[str, object] = {"least": least, "greatest": greatest}
    if job.options["solid"]:
        facts |= _solid_facts(triangles, hull=bool(job.options["hull"]))
    return MeshResult(facts)


def _solid_facts(triangles: _Triangles, *, hull: bool) -> dict[str, object]:
    """Volume, center and inertia of a mesh, or why it has none."""
    whole, middle, exponent = _to_unit_size(triangles)
    closed = _close_mesh(whole, hull=hull)
    if isinstance(closed, str):
        return {"open": closed}
    found = closed.mass_properties
    center = [times_power(float(at), exponent) + from_ for at, from_ in zip(found["center_mass"], middle, strict=True)]
    inertia = [[float(entry) + 0.0 for entry in row] for row in found["inertia"]]  # never -0
    return {"volume": float(found["volume"]), "center": center, "inertia": inertia, "exponent": exponent}


def _to_unit_size(triangles: _Triangles) -> tuple[_Triangles, list[float], int]:
    """The mesh with its middle at the origin and about unit size, where its middle was, and the power of two."""
    least, greatest = triangles.bounds.tolist()
    if not all(map(math.isfinite, (*least, *greatest))):
        raise UnusableMeshError("it is too large for numbers")
    middle = [low / 2 + high / 2 for low, high in zip(least, greatest, strict=True)]
    exponent = common_exponent(high / 2 - low / 2 for low, high in zip(least, greatest, strict=True))
    half = math.ldexp(1.0, -exponent // 2)  # in two steps: the power itself may be no double
    # The volume integrals of a mesh far from the origin are differences of large numbers: at 1e8 m
    # nothing but rounding.
    triangles.vertices = (triangles.vertices - middle) * half * math.ldexp(1.0, -exponent - (-exponent // 2))
    return triangles, middle, exponent


def _close_mesh(triangles: _Triangles, *, hull: bool) -> _Triangles | str:
    """The mesh, or its hull if that may stand in, with faces that look outward; a text if there is none."""
    if triangles.is_watertight and triangles.is_winding_consistent and triangles.volume:
        if triangles.volume < 0:  # turned inside out, by the file or by a negative scale
            triangles.invert()
        return triangles
    # A mesh with a hole has no volume. It is never quietly replaced by its hull: that is an option.
    return _hull_of(triangles) if hull else f"has no inside: {_explain_open(triangles)}"


def _explain_open(triangles: _Triangles) -> str:
    """Why a mesh encloses no volume."""
    if not triangles.is_watertight:
        return "its surface has holes"
    return "it encloses nothing" if triangles.is_winding_consistent else "its faces do not agree which side is outside"


def _hull_of(triangles: _Triangles) -> _Triangles | str:
    """The convex hull of a mesh; a text if there is none."""
    try:
        hull = triangles.convex_hull
    except ImportError:
        raise
    except Exception:  # noqa: BLE001 - flat, or of fewer than four points; scipy raises an error of its own
        return "has no convex hull with an inside"
    return hull if hull.volume > 0 else "is flat"


def surface(job: MeshJob) -> MeshResult:
    """The triangles of a mesh: `points`, rows of three doubles, and `faces`, rows of three 64-bit integers."""
    triangles = _scaled_triangles(job, finite=False)  # drawings leave out triangles at infinity
    points, faces = np.asarray(triangles.vertices, dtype=np.float64), np.asarray(triangles.faces, dtype=np.int64)
    return MeshResult({}, {"points": points.tobytes(), "faces": faces.tobytes()})


def _scaled_triangles(job: MeshJob, *, finite: bool = True) -> _Triangles:
    """The triangles of a mesh in the frame of its shape, with equal vertices merged."""
    whole = trimesh.util.concatenate([part for _, part in parts_of(job, finite=finite)])
    # a new mesh without the appearance, so that vertices which differ only in that are merged as well
    triangles = trimesh.Trimesh(vertices=whole.vertices, faces=whole.faces, process=True)
    if not len(triangles.faces):
        raise UnusableMeshError("it has no triangles")
    if job.options["scale"]:
        triangles.vertices = triangles.vertices * job.options["scale"]  # `apply_scale` ignores scales of nearly one
    return triangles


def draw(job: MeshJob) -> MeshResult:
    """The triangles of a mesh as arrays for drawing, with colors where the file has any."""
    return MeshResult({}, _triangle_arrays(parts_of(job, appearance=True)))


def _triangle_arrays(parts: Sequence[tuple[str, Any]]) -> dict[str, bytes]:
    """`points` (rows of three 32-bit floats), `faces` (rows of three 32-bit integers) and, if there are any, `colors`.

    Colors are rows of red, green, blue and alpha, a byte each. Numbers are in the byte order of this machine.
    """
    painted = bool(appearance_of(parts))
    pieces = [(part, _point_colors(part)) if painted else (_merge_except_edges(part), None) for _, part in parts]
    points = np.concatenate([np.asarray(part.vertices, dtype=np.float32) for part, _ in pieces])
    starts = np.cumsum([0, *(len(part.vertices) for part, _ in pieces)])[:-1]
    faces = [np.asarray(part.faces, dtype=np.uint32) + start for (part, _), start in zip(pieces, starts, strict=True)]
    found = {"points": points.tobytes(), "faces": np.concatenate(faces).astype(np.uint32).tobytes()}
    if painted:
        found["colors"] = np.concatenate([colors for _, colors in pieces]).tobytes()
    return found


def _merge_except_edges(part: Any) -> Any:
    """The mesh with equal points merged, except along sharp edges; a large mesh as it is."""
    if len(part.faces) > _MOST_SMOOTHED:
        return part
    merged = trimesh.Trimesh(vertices=part.vertices, faces=part.faces, process=True)
    return trimesh.graph.smooth_shade(merged, angle=_SHARP) if len(merged.faces) else part


def _point_colors(part: Any) -> Array:
    """A color for each point, from the texture, the material or the point itself."""
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


# Larger meshes are _triangle_arrays with the vertices that they have: looking for edges takes time.
_MOST_SMOOTHED = 100_000
