"""Distances between shapes by Coal, of meshes that assimp has read: they share no code with the passes.

It is asked how far points are that are drawn on the one shape from the other. That is a distance from below: the passes
say one that no point exceeds.
"""

import importlib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from twinform.ir import Mesh, Pose, Shape
from twinform.ir.geometry import Box, Capsule, Cylinder, Sphere
from twinform.ir.transform import Transform

Array = Any
_POINTS = 5_000
_NEAR = 1e-9
_COLLADA = ".dae"
_UNIT = re.compile(r"<unit\b[^>]*\bmeter\s*=\s*[\"']([^\"']+)")


@dataclass(frozen=True, slots=True)
class Body:
    """A shape of Coal, placed; `points` are drawn on its surface."""

    shape: Any
    at: Transform
    points: Array
    convex: bool = False


def unit_of(path: Path) -> float:
    """What a COLLADA file counts as one."""
    is_collada = path.suffix.lower() == _COLLADA
    found = _UNIT.search(path.read_text(encoding="utf-8", errors="replace")) if is_collada else None
    return float(found[1]) if found else 1.0


def mesh(path: Path) -> Body:
    """A mesh file as assimp reads it, in meters; as readers of URDF do, it is not turned for the axis that is up."""
    coal, np = _libraries()
    assimp: Any = importlib.import_module("assimp_py")
    scene = assimp.import_file(str(path), assimp.Process_Triangulate | assimp.Process_SortByPType)
    # of COLLADA, the root has the unit and the axis that is up
    at = np.eye(4) if path.suffix.lower() == _COLLADA else np.array(scene.root_node.transformation)
    corners = np.concatenate([*_triangles(scene, scene.root_node, at, np), np.empty((0, 3, 3))]) * unit_of(path)
    model = coal.BVHModelOBBRSS()
    model.beginModel(len(corners), 3 * len(corners))
    model.addVertices(corners.reshape(-1, 3))
    model.addTriangles(np.arange(3 * len(corners), dtype=np.int32).reshape(-1, 3))
    model.endModel()
    return Body(model, Transform(), _drawn(corners, np))


def _triangles(scene: Any, node: Any, at: Array, np: Any) -> Iterator[Array]:
    """The corners of all triangles at a node and below it, in the frame of the root."""
    for index in node.mesh_indices:
        one = scene.meshes[index]
        points = np.array(one.vertices).reshape(-1, 3) @ at[:3, :3].T + at[:3, 3]
        indices = np.array(one.indices)
        if len(indices) == 3 * one.num_faces:  # or they are points and lines
            yield points[indices.reshape(-1, 3)]
    for child in node.children:
        yield from _triangles(scene, child, at @ np.array(child.transformation), np)


def diagonal(body: Body) -> float:
    """Of the box around a mesh."""
    np = _libraries()[1]
    return float(np.linalg.norm(np.ptp(np.asarray(body.shape.vertices()), axis=0)))


def body_of(shape: Shape | None, pose: Pose | None, folder: Path) -> Body:
    """A collision of the result."""
    coal, np = _libraries()
    at = Transform.from_pose(pose)
    if isinstance(shape, Mesh):
        body = mesh(folder / (shape.uri or ""))
        return Body(body.shape, at, body.points, convex=True)
    made = _primitive(shape, coal)
    return Body(made, at, _on_primitive(made, shape, np), convex=True)


def _primitive(shape: Shape | None, coal: Any) -> Any:
    match shape:
        case Box(size=size) if size:
            return coal.Box(*size)
        case Sphere(radius=radius) if radius:
            return coal.Sphere(radius)
        case Cylinder(radius=radius, length=length) if radius and length:
            return coal.Cylinder(radius, length)
        case Capsule(radius=radius, length=length) if radius and length:
            return coal.Capsule(radius, length)
        case _:
            raise ValueError(f"no such shape: {shape}")


def apart(old: Body, new: Sequence[Body], *, outside: bool) -> float:
    """The greatest distance that was met, both ways; for collisions only of what is `outside` of the new shapes."""
    np = _libraries()[1]
    to_new = np.min([_distances(old.points, each) for each in new], axis=0)
    hulls: list[Any] = []
    if outside:
        hulls = [_halves(each, np) for each in new]
        to_new = to_new[~_inside(old.points, hulls, np)]
    found = float(to_new.max(initial=0.0))
    for index, each in enumerate(new):
        points = _placed(each, np)
        if outside and len(new) > 1:
            others = [half for other, half in enumerate(hulls) if other != index]
            points = points[~_inside(points, others, np, margin=1e-4 * diagonal(old))]
        found = max(found, float(_distances(points, old).max(initial=0.0)))
    return found


def _halves(body: Body, np: Any) -> Any:
    """The planes around a convex mesh, in the frame of the link; a primitive itself."""
    if not hasattr(body.shape, "vertices"):
        return body
    spatial: Any = importlib.import_module("scipy.spatial")
    return spatial.ConvexHull(_moved(np.asarray(body.shape.vertices()), body.at, np)).equations


def _inside(points: Array, bodies: Sequence[Any], np: Any, margin: float = 0.0) -> Array:
    """Which points lie in one of some convex shapes, give or take a margin."""
    found = np.zeros(len(points), dtype=bool)
    for each in bodies:
        if isinstance(each, Body):
            found |= _distances(points, each) <= margin
        else:
            found |= (points @ each[:, :3].T + each[:, 3] <= margin).all(axis=1)
    return found


def _distances(points: Array, body: Body) -> Array:
    coal, np = _libraries()
    probe, here, there = coal.Sphere(_NEAR), coal.Transform3s(), coal.Transform3s()
    here.setTranslation(np.array(body.at.translation))
    here.setRotation(np.array(body.at.rotation).reshape(3, 3))
    request, found = coal.DistanceRequest(), np.empty(len(points))
    for index, point in enumerate(points):
        there.setTranslation(point)
        found[index] = coal.distance(body.shape, here, probe, there, request, coal.DistanceResult()) + _NEAR
    return found


def _placed(body: Body, np: Any) -> Array:
    return _moved(body.points, body.at, np)


def _moved(points: Array, at: Transform, np: Any) -> Array:
    return points @ np.array(at.rotation).reshape(3, 3).T + np.array(at.translation)


def _drawn(corners: Array, np: Any) -> Array:
    """Points drawn on triangles, by area, and corners of them."""
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    used = np.unique(corners.reshape(-1, 3), axis=0)
    draw = np.random.default_rng(1)
    if not areas.sum() > 0:
        return used
    of = draw.choice(len(corners), _POINTS, p=areas / areas.sum())
    weights = draw.dirichlet((1, 1, 1), _POINTS)
    return np.concatenate([np.einsum("pk,pki->pi", weights, corners[of]), used[:: max(1, len(used) // _POINTS)]])


def _on_primitive(made: Any, shape: Shape | None, np: Any) -> Array:
    """Points on a primitive: drawn in the box around it, and moved to where a ray from its axis leaves it."""
    draw = np.random.default_rng(1)
    rays = draw.normal(size=(_POINTS, 3))
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    match shape:
        case Box(size=size) if size:
            return rays * np.min(np.array(size) / 2 / np.maximum(np.abs(rays), 1e-12), axis=1, keepdims=True)
        case Sphere(radius=radius) if radius:
            return rays * radius
        case Cylinder(radius=radius, length=length) if radius and length:
            across = np.linalg.norm(rays[:, :2], axis=1)
            out = np.minimum(radius / np.maximum(across, 1e-12), length / 2 / np.maximum(np.abs(rays[:, 2]), 1e-12))
            return rays * out[:, None]
        case Capsule(radius=radius, length=length) if radius and length:
            along = draw.uniform(-0.5, 0.5, _POINTS) * length
            side = rays * (1, 1, 0) / np.linalg.norm(rays[:, :2], axis=1, keepdims=True) * radius + along[:, None] * (
                0,
                0,
                1,
            )
            ends = rays * radius + np.sign(rays[:, 2:]) * (0, 0, length / 2)
            return np.concatenate([side, ends])
        case _:
            raise ValueError(f"no such shape: {made}")


def _libraries() -> tuple[Any, Any]:
    return importlib.import_module("coal"), importlib.import_module("numpy")
