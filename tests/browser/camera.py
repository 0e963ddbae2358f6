"""Cameras of tests: where a point of the world is on a picture, and what the browser draws for a camera."""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from twinform.ir import Quaternion, Vector3
from twinform.ir.motion import unit
from twinform.ir.transform import Transform, cross, minus
from twinform.view.figure import FOV, Figure, viewpoint
from twinform.view.viewer import Viewer

Array = Any
_UP: Vector3 = (0.0, 0.0, 1.0)
_BETWEEN = 0.15
"""Seconds between two pictures that are compared."""


@dataclass(frozen=True, slots=True)
class Camera:
    """Where a camera is and looks at, in meters in the world; `fov` is its vertical angle of view in radians."""

    position: Vector3
    target: Vector3
    fov: float = FOV

    @property
    def pose(self) -> Transform:
        """Its frame in the world: x to the right of the picture, y down, z into it."""
        fx, fy, fz = forward = unit(minus(self.target, self.position))
        right = unit(cross(forward, _UP)) if math.hypot(fx, fy) else (0.0, -1.0, 0.0)
        (rx, ry, rz), (dx, dy, dz) = right, cross(forward, right)
        return Transform(self.position, (rx, dx, fx, ry, dy, fy, rz, dz, fz))

    @property
    def wxyz(self) -> Quaternion:
        """Its rotation, the real part first."""
        x, y, z, w = self.pose.quaternion()
        return w, x, y, z

    def pixels(self, points: Array, width: int, height: int) -> Array:
        """Points of the world, rows of x, y, z, as columns and rows of a picture; what is behind it is not a number."""
        into = self.pose.inverse()
        turned = np.asarray(points) @ np.asarray(into.rotation).reshape(3, 3).T + np.asarray(into.translation)
        depth = np.where(turned[:, 2] > 0, turned[:, 2], np.nan)
        focal = height / 2 / math.tan(self.fov / 2)
        return turned[:, :2] / depth[:, None] * focal + np.asarray([width / 2, height / 2])


def camera_for(figures: Sequence[Figure]) -> Camera:
    """Return the camera that the viewer begins with."""
    return Camera(*viewpoint(figures))


def take_picture(viewer: Viewer, camera: Camera, width: int, height: int, *, seconds: float = 60.0) -> Array:
    """Return what a camera sees of the robots alone, as the first browser that is connected draws it.

    Rows of pixels with red, green, blue and alpha, which is 0 where there is no robot. It is drawn until it stays the
    same: a browser needs some frames for what is new.
    """
    client = next(iter(viewer.server.get_clients().values()))
    grid = viewer.panel.grid if viewer.panel else None
    if grid is None or not grid.visible:
        return _draw_until_settled(viewer, client, camera, width, height, seconds)
    grid.visible = False
    try:
        return _draw_until_settled(viewer, client, camera, width, height, seconds)
    finally:
        grid.visible = True


def _draw_until_settled(viewer: Viewer, client: Any, camera: Camera, width: int, height: int, seconds: float) -> Array:
    end, before = time.monotonic() + seconds, None
    while True:
        viewer.server.flush()
        picture = client.get_render(
            height, width, wxyz=camera.wxyz, position=camera.position, fov=camera.fov, transport_format="png",
            timeout=seconds,
        )  # fmt: skip
        # A renderer without a graphics card draws some frames before everything is there.
        if time.monotonic() > end or (before is not None and np.array_equal(before, picture)):
            return picture
        before = picture
        time.sleep(_BETWEEN)
