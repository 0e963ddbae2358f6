"""Reduces the triangles of a mesh by collapsing edges, within a distance that is measured afterwards."""

import importlib
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from twinform.passes.mesh_jobs.distances import Nearest, farthest
from twinform.passes.mesh_jobs.libraries import np
from twinform.passes.mesh_jobs.surface import TriangleSurface, join_parts

fast_simplification: Any = importlib.import_module("fast_simplification")
_STEPS = 4
"""How often the middle between too few and too many triangles is tried."""
_LEAST = 4
WORTH = 0.95
"""A mesh that would keep more than this fraction of its triangles is left as it is."""
# How aggressive the library is. With less aggression it stops early and keeps shapes better.
_HASTY, _CAREFUL = 7.0, 3.0


class Decimated(NamedTuple):
    """The parts of a mesh with fewer triangles, and the greatest distance between both surfaces.

    `reached`: the limit allowed the share that was asked for; otherwise more triangles are left.
    """

    parts: list[tuple[str, Any]]
    triangles: int
    error: float
    reached: bool = False


def decimate_parts(parts: Sequence[tuple[str, Any]], share: float, tolerance: float, limit: float) -> Decimated | None:
    """Each part with this share of its triangles, or more if the limit needs them; None where that saves little."""
    before = sum(len(part.faces) for _, part in parts)
    whole = join_parts(list(parts))
    nearest = Nearest(whole)
    low, high, best = share, 1.0, None
    tried = share
    for _ in range(_STEPS + 1):
        found = _best_within_limit(parts, tried, whole, nearest, tolerance, limit)
        if found is not None:
            best, high = found._replace(reached=tried == share), tried
        else:
            low = tried
        if best is not None and (high == share or high - low < 0.05 * high):
            break
        tried = math.sqrt(low * high)
    return best if best is not None and best.triangles <= WORTH * before else None


def _best_within_limit(
    parts: Sequence[tuple[str, Any]],
    share: float,
    whole: TriangleSurface,
    nearest: Nearest,
    tolerance: float,
    limit: float,
) -> Decimated | None:
    """The decimation with the fewest triangles among those within the limit; None if there is none."""
    found: list[Decimated] = []
    # A skirt keeps more of flat borders than they need, so both ways are tried.
    for careful in (False, True):
        made = _decimate_by_share(parts, share, careful=careful)
        error = _distance_between(whole, nearest, made, tolerance, limit)
        if error <= limit:
            found.append(Decimated(made, sum(len(part.faces) for _, part in made), error))
    return min(found, key=lambda each: each.triangles, default=None)


def _decimate_by_share(parts: Sequence[tuple[str, Any]], share: float, *, careful: bool) -> list[tuple[str, Any]]:
    """The parts with about this share of their triangles; `careful` keeps their borders."""
    found: list[tuple[str, Any]] = []
    for name, part in parts:
        welded = join_parts([(name, part)]) if len(part.faces) > _LEAST else None
        if welded is None or len(welded.faces) <= _LEAST:
            found.append((name, part))
            continue
        count = min(max(_LEAST, round(share * len(part.faces))), len(welded.faces))
        made = _collapse_inner_edges(welded, count) if careful else _collapse_edges(welded, count)
        if len(made.faces):
            found.append((name, _keep_material(part, made.points, made.faces)))
    return found


def _collapse_edges(surface: TriangleSurface, count: int) -> TriangleSurface:
    """A surface with this many triangles."""
    points, faces = fast_simplification.simplify(*_to_near_unit(surface), target_count=count, agg=_HASTY)
    return TriangleSurface(_undo_near_unit(np.asarray(points, dtype=float), surface), faces)


def _collapse_inner_edges(surface: TriangleSurface, count: int) -> TriangleSurface:
    """A surface with about this many triangles and the same borders.

    The library moves borders at no cost where the surface is flat, until nothing is left. So a border gets a strip of
    triangles (a skirt) that stands upright on it and is removed afterwards: an edge with a skirt is as sharp as others.
    """
    # Parts are decimate_parts one by one, so that colors stay where they are, and such parts are open:
    # of a wrist of a UR5 with 14,074 triangles nothing could be saved within 1.6 mm, and with
    # skirts 3,579 are left.
    skirted, is_skirt = _with_skirt(surface)
    target = round(count * len(skirted.faces) / len(surface.faces))
    points, faces = _to_near_unit(skirted)
    _, _, collapses = fast_simplification.simplify(
        points, faces, target_count=target, agg=_CAREFUL, return_collapses=True
    )
    points, faces, became = fast_simplification.replay_simplification(points, faces, collapses)
    of_skirt = np.zeros(len(points), dtype=bool)
    of_skirt[became[is_skirt & (became >= 0)]] = True
    faces = faces[~of_skirt[faces].any(axis=1)]
    used, faces = np.unique(faces, return_inverse=True)  # the skirt's points are far from the surface
    return TriangleSurface(_undo_near_unit(np.asarray(points[used], dtype=float), skirted), faces.reshape(-1, 3))


def _with_skirt(surface: TriangleSurface) -> tuple[TriangleSurface, Any]:
    """A surface with an upright strip along each border, and which points belong to the strips."""
    edges = np.concatenate([surface.faces[:, [at, (at + 1) % 3]] for at in range(3)])
    _, index, uses = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    is_border = uses[index.ravel()] == 1
    a, b = edges[is_border].T
    corners = surface.triangles
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    upward = np.zeros_like(surface.points)
    for ends in (a, b):
        np.add.at(upward, ends, np.tile(normals, (3, 1))[is_border])
    on_border = np.unique(np.concatenate([a, b]))
    lengths = np.linalg.norm(upward[on_border], axis=1, keepdims=True)
    steps = surface.diagonal * upward[on_border] / np.where(lengths > 0, lengths, 1.0)
    above = np.zeros(len(surface.points), dtype=int)
    above[on_border] = len(surface.points) + np.arange(len(on_border))
    strip = np.concatenate([np.stack([b, a, above[a]], axis=1), np.stack([b, above[a], above[b]], axis=1)])
    points = np.concatenate([surface.points, surface.points[on_border] + steps])
    return TriangleSurface(points, np.concatenate([surface.faces, strip])), np.arange(len(points)) >= len(
        surface.points
    )


def _to_near_unit(surface: TriangleSurface) -> tuple[Any, Any]:
    """Points about the origin and of about unit size: the library has single precision inside."""
    middle, size = _middle_and_size(surface)
    return np.ascontiguousarray((surface.points - middle) / size), np.ascontiguousarray(surface.faces.astype(np.int64))


def _undo_near_unit(points: Any, surface: TriangleSurface) -> Any:
    """Points in the place and the size of the surface that was scaled."""
    middle, size = _middle_and_size(surface)
    return points * size + middle


def _middle_and_size(surface: TriangleSurface) -> tuple[Any, float]:
    low, high = surface.points.min(axis=0), surface.points.max(axis=0)
    return (low + high) / 2, float((high - low).max()) or 1.0


def _keep_material(part: Any, points: Any, faces: Any) -> Any:
    """A mesh of new triangles with the one material that the part has."""
    made = type(part)(vertices=points, faces=faces, process=False)
    material = getattr(part.visual, "material", None)
    if material is not None:
        made.visual = type(part.visual)(material=material)
    return made


def _distance_between(
    whole: TriangleSurface, nearest: Nearest, made: Sequence[tuple[str, Any]], tolerance: float, limit: float
) -> float:
    """The greatest distance between the old surface and new parts, either way; infinite above the limit."""
    surface = join_parts(list(made))
    there = farthest(surface, nearest, tolerance, limit=limit)
    return there if there > limit else max(there, farthest(whole, Nearest(surface), tolerance, limit=limit))
