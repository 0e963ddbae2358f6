"""The meshes of a file that a shape uses, in meters."""

import math
from collections.abc import Sequence
from typing import Any, cast

from twinform.passes.mesh_jobs.geometry.formats import upright
from twinform.passes.mesh_jobs.geometry.surface import UnusableMeshError, placed_parts, read_scene, selected
from twinform.passes.mesh_jobs.job import MeshJob


def parts_of(job: MeshJob, *, appearance: bool = False, finite: bool = True) -> list[tuple[str, Any]]:
    """The meshes that a shape uses, in meters."""
    scene = read_scene(job.content, job.kind, job.companions, appearance=appearance, finite=finite)
    parts = selected(
        placed_parts(scene), cast("str | None", job.options["submesh"]), center=bool(job.options["center"])
    )
    meter = _meter(parts) if job.kind == "dae" else 1.0
    if meter != 1.0:
        for _, part in parts:
            part.apply_scale(meter)
    return upright(parts) if job.kind in {"glb", "gltf"} and job.options["gltf_up"] == "y" else parts


def _meter(parts: Sequence[tuple[str, Any]]) -> float:
    """The unit of a COLLADA file in meters, which the reader leaves in the notes of its meshes."""
    words = next((str(part.metadata["units"]) for _, part in parts if part.metadata.get("units")), "meters")
    try:
        factor = float(words.partition("*")[0]) if "*" in words else 1.0
    except ValueError:
        factor = math.nan
    if not (math.isfinite(factor) and factor > 0):
        raise UnusableMeshError(f"its unit is {words!r}")
    return factor
