"""Distances by brute force with trimesh, for tests: every drawn point to every triangle."""

import importlib
from typing import Any

np: Any = importlib.import_module("numpy")
trimesh: Any = importlib.import_module("trimesh")
Array = Any


def drawn(triangles: Array, count: int = 400) -> Array:
    """Points on triangles: corners, and others of barycentric coordinates drawn with a fixed seed."""
    draw = np.random.default_rng(7)
    weights = draw.dirichlet((1, 1, 1), count)
    of = draw.integers(len(triangles), size=count)
    return np.concatenate([triangles.reshape(-1, 3), np.einsum("pk,pki->pi", weights, triangles[of])])


def distances(points: Array, triangles: Array) -> Array:
    """How far points are from the nearest of some triangles."""
    found = np.full(len(points), np.inf)
    for triangle in triangles:
        near = trimesh.triangles.closest_point(np.repeat(triangle[None], len(points), axis=0), points)
        found = np.minimum(found, np.linalg.norm(points - near, axis=1))
    return found
