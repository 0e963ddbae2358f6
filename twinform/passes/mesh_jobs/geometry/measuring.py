"""Jobs that look at a mesh: count its triangles, measure it as a solid, give its triangles."""

import math
from typing import Any

from twinform.ir.transform import common_exponent, times_power
from twinform.passes.mesh_jobs.geometry.libraries import np, trimesh
from twinform.passes.mesh_jobs.geometry.mesh_parts import parts_of
from twinform.passes.mesh_jobs.geometry.open_mesh import scene_of
from twinform.passes.mesh_jobs.geometry.surface import UnusableMeshError
from twinform.passes.mesh_jobs.job import MeshJob, MeshResult

_Triangles = Any
"""A `trimesh.Trimesh`."""


def count(job: MeshJob) -> MeshResult:
    """All triangles of a file, those of a part as often as the file places it."""
    scene = scene_of(job.content, job.kind, companions=job.companions)
    placed = (scene.graph[node][1] for node in scene.graph.nodes_geometry)
    return MeshResult({"triangles": sum(len(getattr(scene.geometry[name], "faces", ())) for name in placed)})


def measure(job: MeshJob) -> MeshResult:
    """The box around a mesh; where `solid`, also its volume, center and inertia of unit density, or why it has none.

    Where `hull`, an open mesh stands for its convex hull.
    """
    triangles = _scaled(job)
    least, greatest = triangles.bounds.tolist()
    facts: dict[str, object] = {"least": least, "greatest": greatest}
    if job.options["solid"]:
        facts |= _solid(triangles, hull=bool(job.options["hull"]))
    return MeshResult(facts)


def surface(job: MeshJob) -> MeshResult:
    """The triangles of a mesh: `points`, rows of three doubles, and `faces`, of three 64-bit integers."""
    triangles = _scaled(job, finite=False)  # whoever draws leaves out what is nowhere
    points, faces = np.asarray(triangles.vertices, dtype=np.float64), np.asarray(triangles.faces, dtype=np.int64)
    return MeshResult({}, {"points": points.tobytes(), "faces": faces.tobytes()})


def _scaled(job: MeshJob, *, finite: bool = True) -> _Triangles:
    """The triangles of a mesh in the frame of its shape, with vertices merged that are at one place."""
    whole = trimesh.util.concatenate([part for _, part in parts_of(job, finite=finite)])
    # made anew, so that vertices which differ in their appearance are merged as well
    triangles = trimesh.Trimesh(vertices=whole.vertices, faces=whole.faces, process=True)
    if not len(triangles.faces):
        raise UnusableMeshError("it has no triangles")
    if job.options["scale"]:
        triangles.vertices = triangles.vertices * job.options["scale"]  # `apply_scale` leaves out what is nearly one
    return triangles


def _solid(triangles: _Triangles, *, hull: bool) -> dict[str, object]:
    whole, middle, exponent = _in_units(triangles)
    closed = _closed(whole, hull=hull)
    if isinstance(closed, str):
        return {"open": closed}
    found = closed.mass_properties
    center = [times_power(float(at), exponent) + from_ for at, from_ in zip(found["center_mass"], middle, strict=True)]
    inertia = [[float(entry) + 0.0 for entry in row] for row in found["inertia"]]  # never -0
    return {"volume": float(found["volume"]), "center": center, "inertia": inertia, "exponent": exponent}


def _in_units(triangles: _Triangles) -> tuple[_Triangles, list[float], int]:
    """The mesh with its middle at the origin and of about unit size, where its middle was, and the power of two.

    The integrals of a mesh that is far from the origin are differences of large numbers.

    Raises:
        UnusableMeshError: it is larger than doubles say.
    """
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


def _closed(triangles: _Triangles, *, hull: bool) -> _Triangles | str:
    """The mesh, or its hull, with faces that look outward; a text where there is none."""
    if triangles.is_watertight and triangles.is_winding_consistent and triangles.volume:
        if triangles.volume < 0:  # turned inside out, by the file or by a negative scale
            triangles.invert()
        return triangles
    # A mesh with a hole has no volume. It is never quietly replaced by its hull: that is an option.
    return _hull(triangles) if hull else f"has no inside: {_fault(triangles)}"


def _fault(triangles: _Triangles) -> str:
    if not triangles.is_watertight:
        return "its surface has holes"
    return "it encloses nothing" if triangles.is_winding_consistent else "its faces do not agree which side is outside"


def _hull(triangles: _Triangles) -> _Triangles | str:
    try:
        hull = triangles.convex_hull
    except ImportError:
        raise
    except Exception:  # noqa: BLE001 - flat, or of fewer than four points; scipy raises an error of its own
        return "has no convex hull with an inside"
    return hull if hull.volume > 0 else "is flat"
