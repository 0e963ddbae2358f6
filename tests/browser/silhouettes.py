"""Where a robot must be on a picture: the outlines of its shapes, projected with nothing but the frame graph.

A shape is the convex hull of points on its surface, from its definition; what a renderer makes of it is not asked.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import scipy.spatial  # pyright: ignore[reportMissingTypeStubs] - it has none
from PIL import Image, ImageDraw

from tests.browser.camera import Camera
from twinform.compiler.kinematics import Positions
from twinform.compiler.scene import Scene
from twinform.ir import Box, Capsule, Cone, Cylinder, Ellipsoid, Sphere
from twinform.ir.defaults import sizes
from twinform.ir.geometry import ShapeNode
from twinform.ir.transform import Transform

Mask = np.ndarray
_AROUND = 64
_STAND_IN = Box(size=(0.1, 0.1, 0.1))
"""Of meshes that are not there."""


def silhouette(scene: Scene, positions: Positions, camera: Camera, width: int, height: int) -> Mask:
    """The pixels that visuals must cover."""
    image = Image.new("1", (width, height))
    poses = scene.kinematics().poses(positions)
    for link in scene.links:
        for shape in link.shapes:
            if shape.role == "visual":
                points = _moved(points_of(shape.shape), poses[link.name].compose(shape.pose))
                _fill(image, camera.pixels(points, width, height))
    return np.asarray(image)


def overlap(a: Mask, b: Mask) -> float:
    """Intersection over union; 1 where both are empty."""
    union = int((a | b).sum())
    return int((a & b).sum()) / union if union else 1.0


def points_of(shape: ShapeNode) -> np.ndarray:
    """Points whose convex hull is the shape, in its frame, rows of x, y, z in meters."""
    if type(shape) not in _POINTS:
        shape = _STAND_IN
    return _POINTS[type(shape)](*sizes(shape))


def _box(x: float, y: float, z: float) -> np.ndarray:
    corners = [(i, j, k) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
    return np.asarray(corners) * (x / 2, y / 2, z / 2)


def _circle(radius: float, height: float) -> np.ndarray:
    angles = np.linspace(0, 2 * math.pi, _AROUND, endpoint=False)
    return np.stack([radius * np.cos(angles), radius * np.sin(angles), np.full(_AROUND, height)], axis=1)


def _cylinder(radius: float, length: float) -> np.ndarray:
    return np.concatenate([_circle(radius, -length / 2), _circle(radius, length / 2)])


def _cone(radius: float, length: float) -> np.ndarray:
    return np.concatenate([_circle(radius, -length / 2), [(0.0, 0.0, length / 2)]])


def _sphere(radius: float) -> np.ndarray:
    rings = [_circle(radius * math.cos(up), radius * math.sin(up)) for up in np.linspace(-1.5, 1.5, 25)]
    return np.concatenate([*rings, [(0.0, 0.0, radius), (0.0, 0.0, -radius)]])


def _capsule(radius: float, length: float) -> np.ndarray:
    ball, up = _sphere(radius), np.asarray((0, 0, length / 2))
    return np.concatenate([ball + up, ball - up])


def _ellipsoid(x: float, y: float, z: float) -> np.ndarray:
    return _sphere(1.0) * (x, y, z)


_POINTS: Mapping[type[ShapeNode], Callable[..., Any]] = {
    Box: _box, Cylinder: _cylinder, Cone: _cone, Sphere: _sphere, Capsule: _capsule, Ellipsoid: _ellipsoid,
}  # fmt: skip


def _moved(points: np.ndarray, pose: Transform) -> np.ndarray:
    return points @ np.asarray(pose.rotation).reshape(3, 3).T + np.asarray(pose.translation)


def _fill(image: Image.Image, pixels: np.ndarray) -> None:
    """Fill the outline of points on a picture; one pixel is a point of its middle."""
    if np.isnan(pixels).any() or np.linalg.matrix_rank(pixels - pixels[0]) < 2:
        return
    outline = pixels[scipy.spatial.ConvexHull(pixels).vertices] - 0.5
    ImageDraw.Draw(image).polygon([(float(x), float(y)) for x, y in outline], fill=1)
