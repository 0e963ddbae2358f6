"""Distances between surfaces: no point is farther than is said, judged by brute force."""

import importlib
import math
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from tests.profile import examples
from tests.unit.passes.mesh_jobs.judge import distances, drawn
from twinform.passes.mesh_jobs.convex import error_of, hull
from twinform.passes.mesh_jobs.distances import Nearest, farthest
from twinform.passes.mesh_jobs.surface import TriangleSurface, merge_points

np: Any = importlib.import_module("numpy")
trimesh: Any = importlib.import_module("trimesh")

_numbers = st.integers(-20, 20).map(lambda number: number / 10)
_points = st.tuples(_numbers, _numbers, _numbers)
soups = st.lists(st.tuples(_points, _points, _points), min_size=1, max_size=8).map(
    lambda triangles: merge_points(np.array(triangles, dtype=float))
).filter(lambda surface: len(surface.faces) > 0)  # fmt: skip


@examples(0.3)
@given(soups, soups, st.sampled_from([0.5, 0.1, 0.02]))
def test_no_point_is_farther_than_the_distance_and_some_point_nearly_is(
    a: TriangleSurface, b: TriangleSurface, tolerance: float
) -> None:
    said = farthest(a, Nearest(b), tolerance)
    met = distances(drawn(a.triangles), b.triangles).max()
    assert met <= said + 1e-9
    assert said <= _true(a, b) + tolerance + 1e-9


def _true(a: TriangleSurface, b: TriangleSurface) -> float:
    """The greatest distance of a fine grid of points, which is off by half of its width at most."""
    steps = 24
    weights = np.array([(i, j, steps - i - j) for i in range(steps + 1) for j in range(steps + 1 - i)]) / steps
    points = np.einsum("wk,tki->twi", weights, a.triangles).reshape(-1, 3)
    longest = np.linalg.norm(a.triangles - np.roll(a.triangles, 1, axis=1), axis=2).max()
    return float(distances(points, b.triangles).max() + longest / steps)


@examples(0.3)
@given(soups)
def test_a_surface_is_at_no_distance_from_itself(surface: TriangleSurface) -> None:
    assert farthest(surface, Nearest(surface), 1e-3) <= 1e-3 + 1e-9


def test_a_limit_that_is_exceeded_says_infinity() -> None:
    a, b = (merge_points(np.array([[[0, 0, z], [1, 0, z], [0, 1, z]]], dtype=float)) for z in (0.0, 0.5))
    assert farthest(a, Nearest(b), 0.01) == 0.5
    assert farthest(a, Nearest(b), 0.01, limit=0.4) == math.inf
    assert farthest(a, Nearest(b), 0.01, limit=0.5) == 0.5


def test_what_a_hull_hides_does_not_count_and_what_it_covers_does() -> None:
    outer, inner = trimesh.creation.box((1, 1, 1)), trimesh.creation.box((0.2, 0.2, 0.2))
    both = merge_points(np.concatenate([outer.triangles, inner.triangles]))
    assert error_of(both, [hull(both.points)], 0.001) <= 0.001
    open_box = merge_points(np.asarray(outer.triangles)[outer.face_normals[:, 2] < 0.5])
    assert math.isclose(error_of(open_box, [hull(open_box.points)], 0.001), 0.5, abs_tol=0.002)


def test_faces_between_convex_parts_are_inside() -> None:
    whole = trimesh.creation.box((2, 1, 1))
    parts = [hull(trimesh.creation.box((1, 1, 1)).vertices + np.array((x, 0, 0))) for x in (-0.5, 0.5)]
    assert error_of(merge_points(np.asarray(whole.triangles)), parts, 0.001) <= 0.002
    assert math.isclose(error_of(merge_points(np.asarray(whole.triangles)), parts[:1], 0.001), 1.0, abs_tol=0.002)
