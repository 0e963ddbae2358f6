"""Fewer triangles: parts keep their borders, and each level of detail has fewer than the one before."""

import importlib
from itertools import pairwise
from typing import Any, cast

import pytest

from twinform.passes.mesh_jobs.decimation import decimate_parts
from twinform.passes.mesh_jobs.job import MeshJob, Options
from twinform.passes.mesh_jobs.mesh_making import decimate

pytestmark = pytest.mark.slow

np: Any = importlib.import_module("numpy")
trimesh: Any = importlib.import_module("trimesh")
_OPTIONS: Options = {
    "submesh": None, "center": False, "gltf_up": "z", "scale": [1.0, 1.0, 1.0], "share": 0.5, "triangles": None,
    "max_error": None, "max_relative_error": 0.01, "levels": 1, "stem": "m",
}  # fmt: skip


def _levels(mesh: Any, **options: Any) -> list[dict[str, float]]:
    found = decimate(MeshJob("decimate", {**_OPTIONS, **options}, "stl", mesh.export(file_type="stl")))
    return cast("list[dict[str, float]]", found.facts.get("levels", []))


def test_a_flat_part_keeps_its_border() -> None:
    whole = trimesh.creation.cylinder(1, 1, sections=32).subdivide().subdivide()
    lids = whole.submesh([np.abs(whole.face_normals[:, 2]) > 0.5], append=True)
    found = decimate_parts([("lids", lids)], 0.25, 0.0005, 0.005)
    assert found is not None
    assert found.error <= 0.005
    assert found.triangles < 0.4 * len(lids.faces)
    ((_, made),) = found.parts
    assert np.isclose(made.area, lids.area, rtol=0.005)
    assert len(np.unique(made.faces)) == len(made.vertices), "readers count points without a triangle"
    assert np.allclose(made.bounds, lids.bounds, atol=0.005)


def test_levels_have_fewer_and_fewer_triangles() -> None:
    levels = [
        each["triangles"]
        for each in _levels(trimesh.creation.icosphere(3), levels=3, share=0.3, max_relative_error=0.2)
    ]
    assert len(levels) == 3
    assert levels[0] < 0.31 * 1280
    assert all(b < 0.95 * a for a, b in pairwise(levels))


def test_a_level_that_the_distance_does_not_allow_is_none() -> None:
    (only,) = _levels(trimesh.creation.icosphere(3), levels=4, share=0.1, max_relative_error=0.006)
    assert 0.1 * 1280 < only["triangles"] < 0.95 * 1280
