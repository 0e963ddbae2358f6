"""Verifies rotations for likely mistakes: angles in degrees where radians are read, quaternions not of length one."""

import math

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir.pose import Pose

# Two turns, in radians. An angle beyond is one in degrees: one in 1,489 corpus files has such an
# angle.
_MOST = 4 * math.pi
# How far the length of a quaternion may be from 1: files write three digits.
_ROUNDING = 1e-3


def verify_rotation(pose: Pose | None, sink: DiagnosticSink) -> None:
    """Report what is wrong with the rotation of a pose."""
    if pose is None:
        return
    rpy, quaternion = pose.rpy, pose.quat_xyzw
    if rpy is not None:
        if not pose.degrees and (max(rpy) > _MOST or min(rpy) < -_MOST):
            _degrees(pose, max(rpy, key=abs), sink)
    elif quaternion is not None:
        x, y, z, w = quaternion
        if abs(math.sqrt(x * x + y * y + z * z + w * w) - 1) > _ROUNDING:
            _length(pose, math.hypot(*quaternion), sink)


def _degrees(pose: Pose, angle: float, sink: DiagnosticSink) -> None:
    message = f"an angle of {angle:g} is read as radians, and is more than two turns; are these degrees?"
    is_urdf = bool(pose.source and pose.source.step.endswith("origin"))
    instead = f"write {math.radians(angle):.6g} radians"
    hint = instead if is_urdf else f"{instead}, or from SDF 1.9 on <pose degrees='true'>"
    expected = f"at most {_MOST:.4g}"
    sink.report(rules.ANGLE_IN_DEGREES, message, pose.location, found=f"{angle:g}", expected=expected, help=hint)


def _length(pose: Pose, length: float, sink: DiagnosticSink) -> None:
    found = f"{length:.4g}"
    if length:
        message = f"a quaternion has the length {found}; some readers normalize it, others scale by it"
    else:
        message = "a quaternion of length zero is not a rotation"
    sink.report(rules.UNNORMALISED_QUATERNION, message, pose.location, found=found, expected="1")
