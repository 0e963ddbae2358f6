"""Marks of sensors: what cameras see, the rays of lidars, and where all others are."""

import importlib
import math
from collections.abc import Iterator
from typing import Any

from twinform.compiler.scene import Frustum
from twinform.ir import Vector3
from twinform.view.figure import Figure, Handle, Rgb, placed
from twinform.view.shown_names import shortened

np: Any = importlib.import_module("numpy")

_SENSOR: Rgb = (0, 150, 90)
_FAR = 0.6
"""Where frusta and rays are cut, as a share of the whole robot."""


def sensors(figure: Figure) -> Iterator[Handle]:
    """Frusta of cameras, rays of lidars, and axes for all others; what reaches far is cut at the size of the whole."""
    far = figure.size * _FAR
    for number, sensor in enumerate(figure.scene.sensors):
        name = f"{figure.node_name(sensor.link)}/sensors/{number}"
        words = f"sensor {shortened(sensor.name)}", f"{sensor.type} on {shortened(sensor.link)}"
        lines = [piece for frustum in sensor.frustums for piece in _edges(frustum, far)]
        lines += [(ray.start, _cut(ray.start, ray.end, far)) for ray in sensor.rays]
        if not lines:
            yield figure.axes(name, sensor.pose, *words)
            continue
        points = np.asarray(lines, dtype=np.float32)
        thick = figure.size * 0.003
        drawn = figure.api.add_line_segments(name, points, _SENSOR, thickness=thick, **placed(sensor.pose))
        yield figure.called(drawn, *words)


def _edges(frustum: Frustum, far: float) -> Iterator[tuple[Vector3, Vector3]]:
    """The lines of a frustum along x."""
    depth = min(frustum.far, far)
    near, corners = min(frustum.near, depth), [(1, 1), (-1, 1), (-1, -1), (1, -1)]
    y, z = math.tan(frustum.horizontal / 2), math.tan(frustum.vertical / 2)
    front = [frustum.pose.apply((near, near * y * i, near * z * j)) for i, j in corners]
    back = [frustum.pose.apply((depth, depth * y * i, depth * z * j)) for i, j in corners]
    for ring in (front, back):
        yield from zip(ring, [*ring[1:], ring[0]], strict=True)
    yield from zip(front, back, strict=True)


def _cut(start: Vector3, end: Vector3, far: float) -> Vector3:
    length = math.dist(start, end)
    share = min(1.0, far / length) if length else 0.0
    x, y, z = (a + (b - a) * share for a, b in zip(start, end, strict=True))
    return x, y, z
