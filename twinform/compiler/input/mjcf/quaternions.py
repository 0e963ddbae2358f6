"""Rotations as unit quaternions w x y z, in all the notations of MJCF.

The IR composes rotations as matrices. Here a chain of frames is composed as quaternions, as MuJoCo does it, so that
both end in the same digits and in the same one of the two quaternions that a rotation has.
"""

import math

from twinform.ir.transform import cross, minus

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

UNTURNED: Quaternion = (1.0, 0.0, 0.0, 0.0)
# MuJoCo's own bound (mjEPS) for axes and points that are too close to zero.
TINY = 1e-14
_PARALLEL = 1e-10
_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


class UnturnableError(ValueError):
    """An orientation cannot be made of the numbers: an axis has no length, or two axes are parallel."""


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the rotation that turns by `b` and then by `a`."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def rotate(quaternion: Quaternion, vector: Vector) -> Vector:
    """Turn a vector."""
    if quaternion == UNTURNED:
        return vector
    w, x, y, z = quaternion
    a, b, c = vector
    # v + 2 w (u x v) + 2 u x (u x v), with u = (x, y, z)
    p, q, r = y * c - z * b, z * a - x * c, x * b - y * a
    return (
        a + 2 * (w * p + y * r - z * q),
        b + 2 * (w * q + z * p - x * r),
        c + 2 * (w * r + x * q - y * p),
    )


def unit(quaternion: Quaternion) -> Quaternion:
    """Return the quaternion with length one.

    Raises:
        UnturnableError: it has no length.
    """
    length = math.hypot(*quaternion)
    if length < TINY:
        raise UnturnableError("the quaternion is zero")
    w, x, y, z = quaternion
    return (w / length, x / length, y / length, z / length)


def from_axis_angle(axis: Vector, angle: float) -> Quaternion:
    """Return the rotation about an axis of any length, by an angle in radians.

    Raises:
        UnturnableError: the axis has no length, or the angle no end.
    """
    x, y, z = _direction(axis, "the axis of axisangle")
    if not math.isfinite(angle):
        raise UnturnableError("an angle is not finite")
    sine = math.sin(angle / 2)
    return (math.cos(angle / 2), x * sine, y * sine, z * sine)


def from_euler(angles: Vector, sequence: str) -> Quaternion:
    """Return the rotation of three angles in radians: lower-case axes turn along, upper-case axes stay fixed."""
    turned = UNTURNED
    for angle, letter in zip(angles, sequence, strict=True):
        step = from_axis_angle(_AXES[letter.lower()], angle)
        turned = multiply(turned, step) if letter.islower() else multiply(step, turned)
    return unit(turned)


def from_axes(x_axis: Vector, y_axis: Vector) -> Quaternion:
    """Return the rotation whose x axis is given, and whose y axis is the part of the other one across it.

    Raises:
        UnturnableError: an axis has no length, or they are parallel.
    """
    x = _direction(x_axis, "the first axis of xyaxes")
    along = sum(a * b for a, b in zip(x, y_axis, strict=True))
    y = _direction(minus(y_axis, (along * x[0], along * x[1], along * x[2])), "the second axis of xyaxes")
    z = cross(x, y)
    return _from_columns(x, y, z)


def from_z_axis(z_axis: Vector) -> Quaternion:
    """Return the shortest rotation that turns the z axis in a direction.

    Raises:
        UnturnableError: the direction has no length.
    """
    direction = _direction(z_axis, "zaxis")
    axis = cross(_AXES["z"], direction)
    sine = math.hypot(*axis)
    x, y, z = (axis[0] / sine, axis[1] / sine, axis[2] / sine) if sine >= _PARALLEL else _AXES["x"]
    half = math.atan2(sine, direction[2]) / 2
    return (math.cos(half), x * math.sin(half), y * math.sin(half), z * math.sin(half))


def _from_columns(x: Vector, y: Vector, z: Vector) -> Quaternion:
    """Return the quaternion of a rotation by its largest part; of two that are equal, MuJoCo takes the same one."""
    if x[0] + y[1] + z[2] > 0:
        found = (1 + x[0] + y[1] + z[2], y[2] - z[1], z[0] - x[2], x[1] - y[0])
    elif x[0] > y[1] and x[0] > z[2]:
        found = (y[2] - z[1], 1 + x[0] - y[1] - z[2], y[0] + x[1], z[0] + x[2])
    elif y[1] > z[2]:
        found = (z[0] - x[2], y[0] + x[1], 1 - x[0] + y[1] - z[2], z[1] + y[2])
    else:
        found = (x[1] - y[0], z[0] + x[2], z[1] + y[2], 1 - x[0] - y[1] + z[2])
    return unit(found)


def _direction(vector: Vector, what: str) -> Vector:
    length = math.hypot(*vector)
    if length < TINY:
        raise UnturnableError(f"{what} is too short to be a direction")
    return (vector[0] / length, vector[1] / length, vector[2] / length)
