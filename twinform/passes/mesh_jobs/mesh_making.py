"""Jobs that make new meshes of a mesh: simplify a collision, decimate a visual, convert a file."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, cast

from twinform.passes.mesh_jobs import convex, primitives
from twinform.passes.mesh_jobs.decimation import WORTH, decimate_parts
from twinform.passes.mesh_jobs.job import MeshJob, MeshResult, allow_work
from twinform.passes.mesh_jobs.libraries import np, trimesh
from twinform.passes.mesh_jobs.mesh_writing import appearance_of, write_mesh
from twinform.passes.mesh_jobs.surface import TriangleSurface, join_parts, parts_of, scale_surface

_ACCURACY = 0.05
"""How far a bound may lie above the greatest distance that was seen, as a fraction of the allowed distance."""
# How much of a convex shape is left out, as fractions of the allowed distance. The largest one that
# stays within that distance is taken: it leaves the fewest triangles.
_LEFT_OUT = (0.5, 0.2, 0.1, 0.05)


def simplify(job: MeshJob) -> MeshResult:
    """Replace a collision by the first of the wanted kinds of shapes that is within the limit."""
    parts = parts_of(job)
    allow_work()
    surface = scale_surface(join_parts(parts), job.options["scale"])
    limit, tried = _error_limit(job, surface), list[str]()
    facts: dict[str, object] = {"before": len(surface.faces), "limit": limit if math.isfinite(limit) else None}
    # The first way within the distance is taken, since the cheapest is known beforehand: a
    # primitive costs less than a hull, and a hull less than parts.
    for how in cast("Sequence[str]", job.options["how"]):
        found = _WAYS[how](job, surface, limit)
        if isinstance(found, MeshResult):
            return MeshResult({**facts, **found.facts}, found.files)
        tried.append(found)
    return MeshResult({**facts, "kept": ", ".join(tried)})


def _fit_primitive(job: MeshJob, surface: TriangleSurface, limit: float) -> MeshResult | str:
    found = primitives.best_primitive(
        surface, cast("Sequence[str]", job.options["shapes"]), _error_tolerance(limit, surface), limit
    )
    if found is None or found[1] > limit:
        return "no primitive is near enough"
    primitive, error = found
    facts = {
        "how": "primitive", "error": error, "after": 0, "kind": primitive.kind, "sizes": list(primitive.sizes),
        "center": list(primitive.center), "rotation": np.asarray(primitive.rotation, dtype=float).ravel().tolist(),
    }  # fmt: skip
    return MeshResult(facts)


def _fit_hull(job: MeshJob, surface: TriangleSurface, limit: float) -> MeshResult | str:
    budget = cast("int | None", job.options["triangles"])
    whole = convex.hull(surface.points[np.unique(surface.faces)])
    for distance in _allowed_distances(limit):
        found = convex.reduce_hull(whole, distance, budget)
        if len(found.faces) >= len(surface.faces):
            return "it has no more triangles than its convex hull"
        error = convex.error_of(surface, [found], _error_tolerance(limit, surface), limit)
        if error <= limit:
            return _convex_result("hull", [found], error)
    return "its convex hull is farther off" if budget is None else "so is a convex hull with so few triangles"


def _fit_parts(job: MeshJob, surface: TriangleSurface, limit: float) -> MeshResult | str:
    budget = cast("int | None", job.options["triangles"])
    most = len(surface.faces) if len(cast("Sequence[str]", job.options["how"])) > 1 else math.inf
    why = f"{job.options['parts']} convex parts are farther off"
    for parts in convex.decompositions(surface, cast("int", job.options["parts"])):
        each = None if budget is None else max(4, budget // len(parts))
        for distance in _allowed_distances(limit):
            made = [convex.reduce_hull(part, distance, each) for part in parts]
            total = sum(len(part.faces) for part in made)
            if total > (budget or math.inf) or total >= (most if len(made) > 1 else len(surface.faces)):
                why = "convex parts have more triangles"
                break
            error = convex.error_of(surface, made, _error_tolerance(limit, surface), limit)
            if error <= limit:
                return _convex_result("parts", made, error)
    return why


def _allowed_distances(limit: float) -> Iterator[float]:
    """How much of a convex shape to leave out: at first much of what is allowed, for fewer triangles."""
    if math.isfinite(limit):
        yield from (share * limit for share in _LEFT_OUT)
    yield 0.0


def _convex_result(how: str, parts: Sequence[TriangleSurface], error: float) -> MeshResult:
    meshes = [trimesh.Trimesh(vertices=part.points, faces=part.faces, process=False) for part in parts]
    files = {f"{index}": write_mesh([("convex", mesh)], "obj")[".obj"] for index, mesh in enumerate(meshes)}
    after = sum(len(part.faces) for part in parts)
    return MeshResult({"how": how, "error": error, "after": after, "each": [len(part.faces) for part in parts]}, files)


_WAYS: Mapping[str, Callable[[MeshJob, TriangleSurface, float], MeshResult | str]] = {
    "primitive": _fit_primitive, "hull": _fit_hull, "parts": _fit_parts,
}  # fmt: skip


def decimate(job: MeshJob) -> MeshResult:
    """Make levels of detail of a visual, each with a share of the triangles of the level before."""
    parts = parts_of(job, appearance=True)
    allow_work()
    surface = join_parts(parts)
    before = sum(len(part.faces) for _, part in parts)
    facts: dict[str, object] = {"before": before, "appearance": sorted(appearance_of(parts))}
    # Texture coordinates and colors of vertices do not survive the collapse of edges.
    if appearance_of(parts) & {"textures", "vertex colors"}:
        return MeshResult({**facts, "kept": f"it has {' and '.join(sorted(appearance_of(parts) - {'colors'}))}"})
    stretch = max(abs(float(each)) for each in cast("Sequence[float]", job.options["scale"]))
    limit = _error_limit(job, scale_surface(surface, job.options["scale"])) / stretch
    files: dict[str, bytes] = {}
    levels: list[dict[str, object]] = []
    kind = "stl" if job.kind == "stl" else "obj"
    for level in range(1, cast("int", job.options["levels"]) + 1):
        share = _wanted_share(job, before) ** level
        found = decimate_parts(parts, max(share, 4 / before), _error_tolerance(limit, surface), limit)
        if found is None or (levels and found.triangles > WORTH * cast("int", levels[-1]["triangles"])):
            break
        levels.append({"triangles": found.triangles, "error": found.error * stretch})
        for suffix, data in write_mesh(found.parts, kind, stem=f"{job.options['stem']}_lod{level}").items():
            files[f"_lod{level}{suffix}"] = data
        if not found.reached:
            break  # the distance allows no coarser one
    if not levels:
        return MeshResult({**facts, "kept": "no fewer triangles are within the distance"})
    return MeshResult({**facts, "levels": levels, "kind": kind}, files)


def _wanted_share(job: MeshJob, before: int) -> float:
    count = cast("int | None", job.options["triangles"])
    return min(1.0, cast("float", job.options["share"]) if count is None else count / before)


def convert(job: MeshJob) -> MeshResult:
    """Write a mesh in another format."""
    parts = parts_of(job, appearance=True)
    allow_work()
    kind = str(job.options["to"])
    appearance = appearance_of(parts)
    if not appearance:
        parts = [(name, _merge_equal_points(name, part)) for name, part in parts]
    files = write_mesh(parts, kind, stem=str(job.options["stem"]), y_up=job.options["gltf_up"] == "y")
    lost = appearance if kind == "stl" else set[str]()
    return MeshResult({"before": sum(len(part.faces) for _, part in parts), "lost": sorted(lost)}, files)


def _merge_equal_points(name: str, part: Any) -> Any:
    surface = join_parts([(name, part)])
    return type(part)(vertices=surface.points, faces=surface.faces, process=False)


def _error_limit(job: MeshJob, surface: TriangleSurface) -> float:
    """How far the new surface may be from the old one, in the frame of the shape."""
    limits = [cast("float | None", job.options["max_error"])]
    relative = cast("float | None", job.options["max_relative_error"])
    limits.append(None if relative is None else relative * surface.diagonal)
    return min((each for each in limits if each is not None), default=math.inf)


def _error_tolerance(limit: float, surface: TriangleSurface) -> float:
    return _ACCURACY * min(limit, 0.05 * surface.diagonal) or 1e-9 * surface.diagonal
