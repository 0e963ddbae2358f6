"""Rigid transforms, vectors, and sums that neither overflow nor underflow on the way."""

import math
from collections.abc import Iterable
from dataclasses import field
from typing import Self

from twinform.dataclass import dataclass
from twinform.ir.node import Quaternion, Vector3
from twinform.ir.pose import Pose

Matrix3 = tuple[float, float, float, float, float, float, float, float, float]
"""A rotation, row by row."""
Row4 = tuple[float, float, float, float]
Matrix4 = tuple[Row4, Row4, Row4, Row4]
"""A homogeneous matrix, row by row."""

_ORIGIN: Vector3 = (0.0, 0.0, 0.0)
_UNTURNED: Matrix3 = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
# With a cosine of the pitch below this, roll and yaw turn about one axis to the last digit, and yaw
# is taken as zero.
_GIMBAL_LOCK = 1e-15

# Between these, the length of a quaternion is computed to the last digit.
_TINY, _HUGE = 1e-290, 1e300

# Hand-written numbers have at most this many decimals, and composing a few of them errs by less
# than the noise.
_DIGITS, _NOISE = 12, 2e-15


@dataclass(frozen=True, slots=True)
class Transform:
    """The pose of a frame in another one: its point p is at `rotation` p + `translation` there, in meters.

    `notation` is the pose that these numbers were written as; composing with the identity keeps it, so that what was
    not moved is written as it was read.
    """

    translation: Vector3 = _ORIGIN
    rotation: Matrix3 = _UNTURNED
    notation: Pose | None = field(default=None, compare=False, repr=False)

    @classmethod
    def from_pose(cls, pose: Pose | None) -> Self:
        """The transform of a pose; its frame (`relative_to`) is ignored."""
        if pose is None:
            return cls()
        return cls(_plus_zero(pose.xyz or _ORIGIN), _rotation(pose), pose)

    def to_pose(self, relative_to: str | None = None) -> Pose:
        """Return the pose in the notation it was read in, otherwise in radians; zeros are left out."""
        written = self.notation
        if written is not None:
            return written.copy(relative_to=relative_to, opaque=())
        xyz = rounded(self.translation) if self.translation != _ORIGIN else None
        rpy = rounded(self.rpy()) if self.rotation != _UNTURNED else None
        return Pose.unchecked(xyz=xyz, rpy=rpy, relative_to=relative_to)

    @property
    def matrix(self) -> Matrix4:
        """The homogeneous matrix, row by row, which `numpy.array` takes as it is."""
        r, (x, y, z) = self.rotation, self.translation
        return ((*r[0:3], x), (*r[3:6], y), (*r[6:9], z), (0.0, 0.0, 0.0, 1.0))

    @property
    def is_identity(self) -> bool:
        """Whether it is exactly the identity."""
        return self.is_unturned and self.translation == _ORIGIN

    @property
    def is_unturned(self) -> bool:
        """Whether its axes are exactly those of the frame that it is in."""
        return self.rotation == _UNTURNED

    def compose(self, inner: "Transform") -> "Transform":
        """Return the transform of `inner`, which stands in the frame placed by this one, in this one's outer frame."""
        if self.is_identity:
            return inner
        if inner.is_identity:
            return self
        return Transform(self.apply(inner.translation), _product(self.rotation, inner.rotation))

    def inverse(self) -> "Transform":
        """Return the outer frame as seen from the inner one."""
        if self.is_identity:
            return self
        back = _transpose(self.rotation)
        x, y, z = _turn(back, self.translation)
        return Transform(_plus_zero((-x, -y, -z)), back)

    def apply(self, point: Vector3) -> Vector3:
        """Return a point of the inner frame in the outer one."""
        x, y, z = self.rotate(point)
        return (x + self.translation[0], y + self.translation[1], z + self.translation[2])

    def rotate(self, direction: Vector3) -> Vector3:
        """Return a direction of the inner frame in the outer one."""
        return _turn(self.rotation, direction)

    def rpy(self) -> Vector3:
        """Roll, pitch and yaw in radians, which give the rotation back to the last digits at every pitch."""
        r00, r01, r02, r10, r11, r12, r20, _, _ = self.rotation
        yaw = math.atan2(r10, r00) if math.hypot(r00, r10) > _GIMBAL_LOCK else 0.0
        cosine, sine = math.cos(yaw), math.sin(yaw)
        # Roll and pitch are read from the rotation with the yaw taken back, where neither loses digits near +-90 deg:
        # Rz(-yaw) R = Ry(pitch) Rx(roll) has the middle row 0, cos(roll), -sin(roll).
        pitch = math.atan2(-r20, cosine * r00 + sine * r10)
        roll = math.atan2(sine * r02 - cosine * r12, cosine * r11 - sine * r01)
        return _plus_zero((roll, pitch, yaw))

    def quaternion(self) -> Quaternion:
        """The rotation as a unit quaternion x, y, z, w."""
        r00, r01, r02, r10, r11, r12, r20, r21, r22 = self.rotation
        # the four squares times four; the largest is at least one, so that no digits are lost in the division
        squares = (1 + r00 - r11 - r22, 1 - r00 + r11 - r22, 1 - r00 - r11 + r22, 1 + r00 + r11 + r22)
        largest = squares.index(max(squares))
        rows = (
            (squares[0], r01 + r10, r02 + r20, r21 - r12),
            (r01 + r10, squares[1], r12 + r21, r02 - r20),
            (r02 + r20, r12 + r21, squares[2], r10 - r01),
            (r21 - r12, r02 - r20, r10 - r01, squares[3]),
        )
        x, y, z, w = rows[largest]
        return _unit((x, y, z, w))


def rounded(vector: Vector3) -> Vector3:
    """Return the vector without rounding noise: a number next to one with few digits becomes that one."""
    x, y, z = vector
    return (rounded_number(x), rounded_number(y), rounded_number(z))


def rounded_number(number: float) -> float:
    """Return the number without rounding noise, and 0 for -0."""
    # Poses composed along a chain of frames end in 0.30000000000000004.
    short = round(number, _DIGITS)
    if short == number:  # as most are
        return short + 0.0
    return short + 0.0 if abs(number - short) <= _NOISE * max(1.0, abs(number)) else number


def _plus_zero(vector: Vector3) -> Vector3:
    """Return the vector with 0 for -0, which would be written as such."""
    return (vector[0] + 0.0, vector[1] + 0.0, vector[2] + 0.0)


def _rotation(pose: Pose) -> Matrix3:
    if pose.quat_xyzw is not None:
        return _from_quaternion(pose.quat_xyzw)
    if pose.rpy is None or pose.rpy == _ORIGIN:
        return _UNTURNED
    roll, pitch, yaw = map(math.radians, pose.rpy) if pose.degrees else pose.rpy
    cr, sr = math.cos(roll), math.sin(roll)
    cp, sp = math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return (
        cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,
        sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,
        -sp, cp * sr, cp * cr,
    )  # fmt: skip


def _from_quaternion(quaternion: Quaternion) -> Matrix3:
    x, y, z, w = _unit(quaternion)
    if (x, y, z) == _ORIGIN:
        return _UNTURNED
    return (
        1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y),
    )  # fmt: skip


def _unit(quaternion: Quaternion) -> Quaternion:
    """The quaternion with length one; no rotation where it has no length, or is not of numbers."""
    length = math.hypot(*quaternion)
    if length == 0.0 or not all(map(math.isfinite, quaternion)):
        return (0.0, 0.0, 0.0, 1.0)
    if not _TINY < length < _HUGE:
        exponent = common_exponent(quaternion)
        x, y, z, w = (math.ldexp(part, -exponent) for part in quaternion)
        return _unit((x, y, z, w))
    x, y, z, w = quaternion
    return (x / length, y / length, z / length, w / length)


def _turn(m: Matrix3, v: Vector3) -> Vector3:
    if m is _UNTURNED:
        return v
    x, y, z = v
    return (m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z, m[6] * x + m[7] * y + m[8] * z)


def _transpose(m: Matrix3) -> Matrix3:
    return m if m is _UNTURNED else (m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8])


def _product(a: Matrix3, b: Matrix3) -> Matrix3:
    if a is _UNTURNED:
        return b
    if b is _UNTURNED:
        return a
    a00, a01, a02, a10, a11, a12, a20, a21, a22 = a
    b00, b01, b02, b10, b11, b12, b20, b21, b22 = b
    return (
        a00 * b00 + a01 * b10 + a02 * b20, a00 * b01 + a01 * b11 + a02 * b21, a00 * b02 + a01 * b12 + a02 * b22,
        a10 * b00 + a11 * b10 + a12 * b20, a10 * b01 + a11 * b11 + a12 * b21, a10 * b02 + a11 * b12 + a12 * b22,
        a20 * b00 + a21 * b10 + a22 * b20, a20 * b01 + a21 * b11 + a22 * b21, a20 * b02 + a21 * b12 + a22 * b22,
    )  # fmt: skip


def dot(a: Vector3, b: Vector3) -> float:
    """The inner product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector3, b: Vector3) -> Vector3:
    """The vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def minus(a: Vector3, b: Vector3) -> Vector3:
    """Return the vector from b to a."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(vector: Vector3, factor: float) -> Vector3:
    """Return the vector with another length."""
    return (vector[0] * factor, vector[1] * factor, vector[2] * factor)


def across(axis: Vector3, arm: Vector3) -> Vector3:
    """Return the part of a vector perpendicular to a unit vector."""
    return minus(arm, times(axis, dot(axis, arm)))


# Products of masses and squares of lengths leave the range of doubles long before their results do,
# and Python raises at some of these places (`**`, `fsum`, `ldexp`) and not at others.
def common_exponent(numbers: Iterable[float]) -> int:
    """Return the power of two that scales the largest number to between a half and one; 0 if all are zero."""
    return math.frexp(max(map(abs, numbers), default=0.0))[1]


def times_power(number: float, exponent: int) -> float:
    """Multiply a number by a power of two; infinite beyond the range of doubles."""
    try:
        return math.ldexp(number, exponent)
    except OverflowError:
        return math.copysign(math.inf, number)


def safe_sum(numbers: Iterable[float]) -> float:
    """Sum numbers without rounding on the way; infinite or NaN beyond the range of doubles."""
    listed = tuple(numbers)
    try:
        return math.fsum(listed)
    except (OverflowError, ValueError):  # it raises on the way to infinity, and where two infinities cancel
        return sum(listed)
