"""Fewer triangles by collapsing edges, within a distance that is measured after it."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from twinform.passes.meshes.geometry.distances import Nearest, farthest
from twinform.passes.meshes.geometry.libraries import fast_simplification, np
from twinform.passes.meshes.geometry.surface import Surface, joined

_STEPS = 4
"""Between a number of triangles that is too small and one that is too large, this often the middle is tried."""
_LEAST = 4
_WORTH = 0.95
"""A mesh that keeps more of its triangles than this is left as it is."""


class Decimated(NamedTuple):
    """The parts of a mesh with fewer triangles, and how far both surfaces are apart at most."""

    parts: list[tuple[str, Any]]
    triangles: int
    error: float


def decimated(parts: Sequence[tuple[str, Any]], share: float, tolerance: float, limit: float) -> Decimated | None:
    """Each part with this share of its triangles, or with more as the limit asks for; None where that saves little."""
    before = sum(len(part.faces) for _, part in parts)
    whole = joined(list(parts))
    nearest = Nearest(whole)
    low, high, best = share, 1.0, None
    tried = share
    for _ in range(_STEPS + 1):
        made = _fewer(parts, tried)
        error = _apart(whole, nearest, made, tolerance, limit)
        if error <= limit:
            best, high = Decimated(made, sum(len(part.faces) for _, part in made), error), tried
        else:
            low = tried
        if best is not None and (high == share or high - low < 0.05 * high):
            break
        tried = math.sqrt(low * high)
    return best if best is not None and best.triangles <= _WORTH * before else None


def _fewer(parts: Sequence[tuple[str, Any]], share: float) -> list[tuple[str, Any]]:
    found: list[tuple[str, Any]] = []
    for name, part in parts:
        welded = joined([(name, part)]) if len(part.faces) > _LEAST else None
        if welded is None or len(welded.faces) <= _LEAST:
            found.append((name, part))
            continue
        count = max(_LEAST, round(share * len(part.faces)))
        points, faces = fast_simplification.simplify(*_near_unit(welded), target_count=min(count, len(welded.faces)))
        if len(faces):
            found.append((name, _with_material(part, _restored(np.asarray(points, dtype=float), welded), faces)))
    return found


def _near_unit(surface: Surface) -> tuple[Any, Any]:
    """Points about the origin and of about unit size: the library has single precision inside."""
    middle, size = _box(surface)
    return np.ascontiguousarray((surface.points - middle) / size), np.ascontiguousarray(surface.faces.astype(np.int64))


def _restored(points: Any, surface: Surface) -> Any:
    middle, size = _box(surface)
    return points * size + middle


def _box(surface: Surface) -> tuple[Any, float]:
    low, high = surface.points.min(axis=0), surface.points.max(axis=0)
    return (low + high) / 2, float((high - low).max()) or 1.0


def _with_material(part: Any, points: Any, faces: Any) -> Any:
    """The new triangles with the one material that the part has."""
    made = type(part)(vertices=points, faces=faces, process=False)
    material = getattr(part.visual, "material", None)
    if material is not None:
        made.visual = type(part.visual)(material=material)
    return made


def _apart(whole: Surface, nearest: Nearest, made: Sequence[tuple[str, Any]], tolerance: float, limit: float) -> float:
    surface = joined(list(made))
    there = farthest(surface, nearest, tolerance, limit=limit)
    return there if there > limit else max(there, farthest(whole, Nearest(surface), tolerance, limit=limit))
