"""A camera: where it is, where it looks, and where on its picture a point of the world is."""

import importlib
import math
from dataclasses import dataclass
from typing import Any

from twinform.ir import Quaternion, Vector3
from twinform.ir.motion import unit
from twinform.ir.transform import Transform, cross, minus

np: Any = importlib.import_module("numpy")
Array = Any
_UP: Vector3 = (0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True)
class Camera:
    """Where a camera is and looks at, in meters in the world; `fov` is its vertical angle of view in radians."""

    position: Vector3
    target: Vector3
    fov: float = math.radians(45)

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
