"""Convex stand-ins for collisions: near enough to the mesh, and cheaper than it."""

import importlib
from collections.abc import Mapping
from typing import Any, cast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.profile import examples
from twinform.passes.mesh_jobs.convex import hull, reduce_hull
from twinform.passes.mesh_jobs.job import MeshJob, Options
from twinform.passes.mesh_jobs.mesh_making import simplify

pytestmark = pytest.mark.slow

np: Any = importlib.import_module("numpy")
trimesh: Any = importlib.import_module("trimesh")
_OPTIONS: Options = {
    "submesh": None, "center": False, "gltf_up": "z", "scale": [1.0, 1.0, 1.0], "how": ["primitive", "hull", "parts"],
    "shapes": ["box", "sphere", "cylinder", "capsule"], "max_error": None, "max_relative_error": 0.05,
    "triangles": None, "parts": 16,
}  # fmt: skip


def _simplified(mesh: Any, **options: Any) -> Mapping[str, Any]:
    """The facts of the result."""
    return cast("Mapping[str, Any]", simplify(_job(mesh, **options)).facts)


def _job(mesh: Any, **options: Any) -> MeshJob:
    return MeshJob("simplify", {**_OPTIONS, **options}, "stl", mesh.export(file_type="stl"))


def _channel() -> Any:
    """A channel with many triangles, which neither a primitive nor its hull is near to."""
    boxes = [trimesh.creation.box(size) for size in ((4, 1, 0.1), (4, 0.1, 1), (4, 0.1, 1))]
    for box, place in zip(boxes, ((0, 0, 0), (0, -0.45, 0.45), (0, 0.45, 0.45)), strict=True):
        box.apply_translation(place)
    return trimesh.util.concatenate(boxes).subdivide().subdivide()


@examples(0.3)
@given(st.integers(0, 10_000), st.sampled_from([0.3, 0.1, 0.02]))
def test_a_reduced_hull_is_inside_and_no_corner_is_left_out_by_more(seed: int, distance: float) -> None:
    points = np.random.default_rng(seed).normal(size=(80, 3))
    whole, made = hull(points), reduce_hull(hull(points), distance)
    assert {tuple(point) for point in made.points} <= {tuple(point) for point in whole.points}
    sides = made.points[made.faces]
    normals = np.cross(sides[:, 1] - sides[:, 0], sides[:, 2] - sides[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    beyond = np.einsum("tk,ptk->pt", normals, whole.points[:, None] - sides[None, :, 0])
    assert beyond.max() <= distance + 1e-9


@pytest.mark.parametrize("budget", [4, 8, 60])
def test_a_reduced_hull_keeps_a_budget(budget: int) -> None:
    made = reduce_hull(hull(trimesh.creation.icosphere(3).vertices), 0.0, budget)
    assert 4 <= len(made.faces) <= budget


def test_a_hull_has_no_more_triangles_than_its_distance_needs() -> None:
    egg = trimesh.creation.icosphere(4)
    egg.apply_scale((1, 0.5, 0.25))
    found = _simplified(egg, how=["hull"])
    assert found["how"] == "hull"
    assert 0.02 < found["error"] <= found["limit"]
    assert found["after"] < 120


def test_parts_are_cheaper_than_the_mesh() -> None:
    found = _simplified(_channel())
    assert found["how"] == "parts"
    assert found["error"] <= found["limit"]
    assert found["after"] < 120 < found["before"]


def test_parts_that_cost_more_than_the_mesh_are_for_who_asks_for_nothing_else() -> None:
    ring = trimesh.creation.annulus(0.5, 1, 0.4, sections=7)
    assert "kept" in _simplified(ring)
    assert _simplified(ring, how=["parts"])["how"] == "parts"
