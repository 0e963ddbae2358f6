"""Verifies links: masses and inertias that a real body can have, rotations, and shapes with a size."""

import math

from twinform.diagnostics import DiagnosticSink, Location, Rule, Severity, rules
from twinform.ir.geometry import Geometry, Plane
from twinform.ir.link import Inertia, Inertial, Link
from twinform.ir.pose import Pose
from twinform.ir.solids import Symmetric, principal_moments, relative_moments, tensor
from twinform.ir.visual import Collision, Visual

# Ten times the rounding of a double, relative to half the trace: libsdformat forgives no more. Real
# files cut digits off and are refused for it: 26 of 1,448 in the corpus. `check` warns of exactly
# these.
_ROUNDING = 5e-15
_BEYOND_ROUNDING = 1e-3
"""The share of the trace by which a moment below zero is none that was cut off."""
_BALANCE = "or let --passes balance-inertia write the nearest that a body can have"
_HELP = f"correct the numbers, {_BALANCE}"
_SLIGHT = 0.05
"""The share of the largest moment by which it is too large where digits were cut off, or one was copied wrongly."""
_MOMENTS = ("ixx", "iyy", "izz")
# Far above what rounding does to the minors of a matrix, relative to powers of its trace.
_DOUBT = 1e-12
# Traces whose third power is far from the limits of a double.
_USUAL = (1e-90, 1e90)


def verify_inertial(link: Link, default: float | None, sink: DiagnosticSink) -> None:
    """Report a mass or inertia that libsdformat refuses, or takes and cannot simulate.

    `default` is the moment that the format means where none is written; None where it has none.
    """
    inertial = link.inertial
    if inertial is None:
        return
    verify_rotation(inertial.pose, sink)
    mass = inertial.mass
    is_seen = default is None and mass is not None and mass < 0  # the table of URDF has a least value
    if mass is not None and not is_seen and not 0 < mass < math.inf:  # the negation catches what is not a number
        message = f"the mass of link {link.name!r} is {mass:g}"
        severity = Severity.INFO if mass == 0 else None
        where = inertial.location
        expected = "finite" if mass > 0 else "more than 0"
        sink.report(
            rules.NON_POSITIVE_MASS,
            message,
            where,
            found=f"{mass:g}",
            expected=expected,
            severity=severity,
            refused=mass != 0,
        )
    matrix = inertia_matrix(inertial.inertia, default)
    if inertial.auto and not link.collisions:
        message = f"the inertia of link {link.name!r} is to come from its collisions, and it has none"
        sink.report(rules.INERTIA_FROM_NOTHING, message, inertial.location, expected="<collision>")
    if matrix is not None and not inertial.auto and not is_plain(matrix):
        report_moments(link, inertial, matrix, _ROUNDING, sink, in_sdf=default is not None)


def inertia_matrix(inertia: Inertia | None, default: float | None) -> Symmetric | None:
    """The elements with the format's defaults; None where one has no default."""
    if inertia is None or (default is None and None in {inertia.ixx, inertia.iyy, inertia.izz}):
        return None
    return tensor(inertia, default or 0.0)


def is_plain(matrix: Symmetric) -> bool:
    """Tell cheaply whether an inertia is physical beyond doubt, before the expensive question.

    The second moments of the mass about the three planes are J = trace/2 - I; a body has positive ones in every
    direction, which the leading minors tell.
    """
    ixx, iyy, izz, ixy, ixz, iyz = matrix
    xx, yy, zz = (iyy + izz - ixx) / 2, (ixx + izz - iyy) / 2, (ixx + iyy - izz) / 2
    trace = xx + yy + zz
    if not _USUAL[0] < trace < _USUAL[1]:
        return False
    minor = xx * yy - ixy * ixy
    whole = zz * minor - xx * iyz * iyz - yy * ixz * ixz - 2 * ixy * ixz * iyz
    return xx > _DOUBT * trace and minor > _DOUBT * trace**2 and whole > _DOUBT * trace**3


def report_moments(
    link: Link,
    inertial: Inertial,
    matrix: Symmetric,
    eps: float,
    sink: DiagnosticSink,
    *,
    least: float | None = None,
    in_sdf: bool = False,
) -> None:
    """Report principal moments below zero, or one that exceeds the sum of the others by more than `eps` of the trace.

    `least` is the part of the trace that each moment has to exceed; where it is None, they may be zero. libsdformat
    refuses all of them in SDF (Link.cc: "has invalid inertia"); in URDF, what may come from rounding is no error.
    """
    where = _place(inertial)
    if not all(map(math.isfinite, matrix)):
        message = f"the inertia of link {link.name!r} is not finite"
        _report(rules.INDEFINITE_INERTIA, message, where, sink, refused=in_sdf)
        return
    smallest, middle, largest = relative_moments(matrix)
    trace = abs(smallest + middle + largest)
    moments = principal_moments(matrix)
    listed = ", ".join(f"{moment:.6g}" for moment in moments)
    if smallest <= least * trace if least is not None else smallest < -eps * trace:
        message = f"the inertia of link {link.name!r} is not positive definite: its principal moments are {listed}"
        refused = in_sdf or smallest < -_BEYOND_ROUNDING * trace
        _report(rules.INDEFINITE_INERTIA, message, where, sink, listed, "all more than 0", refused=refused)
    elif largest - smallest - middle > eps * trace:
        message = (
            f"the inertia of link {link.name!r} is physically impossible: "
            f"the principal moments {listed} violate the triangle inequality"
        )
        expected = f"at most {moments[0] + moments[1]:.6g}"
        message += "; Gazebo refuses it"
        help = _how_to_correct(matrix)
        _report(rules.IMPOSSIBLE_INERTIA, message, where, sink, listed, expected, refused=in_sdf, help=help)


def _how_to_correct(matrix: Symmetric) -> str:
    """Say which moment is too large by how much; where the axes are turned, no number of the file is one."""
    moments, products = matrix[:3], matrix[3:]
    largest = max(range(3), key=lambda axis: moments[axis])
    others = [axis for axis in range(3) if axis != largest]
    excess = moments[largest] - sum(moments[axis] for axis in others)
    if any(products) or excess <= 0:
        return _HELP
    slight = "it was rounded or copied wrongly: " if excess < _SLIGHT * moments[largest] else ""
    one, other = (_MOMENTS[axis] for axis in others)
    return f"{slight}raise {one} + {other} by at least {excess:.3g}, lower {_MOMENTS[largest]}, {_BALANCE}"


def _report(
    rule: Rule,
    message: str,
    where: Location,
    sink: DiagnosticSink,
    found: str | None = None,
    expected: str | None = None,
    *,
    refused: bool = False,
    help: str = _HELP,
) -> None:
    if not sink.has(rule, where):  # a pass that is stricter looks again at what `check` has looked at
        sink.report(rule, message, where, found=found, expected=expected, help=help if found else None, refused=refused)


def _place(inertial: Inertial) -> Location:
    """Return where the moments are written."""
    inertia = inertial.inertia
    return inertia.location if inertia is not None and inertia.source else inertial.location


# Two turns, in radians. An angle beyond is one in degrees: one in 1,489 corpus files has such an
# angle.
_MOST = 4 * math.pi
# How far the length of a quaternion may be from 1: files write three digits.
_QUATERNION_ROUNDING = 1e-3


def verify_rotation(pose: Pose | None, sink: DiagnosticSink) -> None:
    """Report what is wrong with the rotation of a pose."""
    if pose is None:
        return
    rpy, quaternion = pose.rpy, pose.quat_xyzw
    if rpy is not None and quaternion is not None:
        message = "a rotation is given by rpy and by quat_xyzw; readers refuse both together"
        sink.report(rules.TWO_ROTATIONS, message, pose.location, found="rpy and quat_xyzw", expected="one of them")
    elif rpy is not None:
        if not pose.degrees and (max(rpy) > _MOST or min(rpy) < -_MOST):
            _degrees(pose, max(rpy, key=abs), sink)
    elif quaternion is not None:
        x, y, z, w = quaternion
        if abs(math.sqrt(x * x + y * y + z * z + w * w) - 1) > _QUATERNION_ROUNDING:
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


_ROUND = ("radius", "length")
_SIZES = {
    "box": ("size",),
    "sphere": ("radius",),
    "ellipsoid": ("radii",),
    "mesh": ("scale",),
    **dict.fromkeys(("cylinder", "capsule", "cone"), _ROUND),
}


def verify_shapes(link: Link, sink: DiagnosticSink, *, geometry_is_required: bool) -> None:
    """Report shapes that are missing or without extent.

    Where the schema requires `<geometry>`, its absence is reported already.
    """
    for shape in link.visuals:
        _verify_shape("visual", shape, link, sink, required=geometry_is_required)
    for shape in link.collisions:
        _verify_shape("collision", shape, link, sink, required=geometry_is_required)


def _verify_shape(kind: str, shape: Visual | Collision, link: Link, sink: DiagnosticSink, *, required: bool) -> None:
    geometry = shape.geometry
    if geometry is not None and geometry.shape is not None:
        _verify_sizes(geometry, kind, link, sink)
    elif _is_empty(shape, required=required):
        message = f"a {kind} of link {link.name!r} has no shape"
        sink.report(rules.MISSING_SHAPE, message, shape.location, expected="<geometry> with a shape in it")


def _is_empty(shape: Visual | Collision, *, required: bool) -> bool:
    """Whether no shape is written, not even one that the schema does not know."""
    if shape.geometry is not None:
        return not any(part.element for part in shape.geometry.opaque)
    empty = [part.element for part in shape.opaque if part.element and part.element.name == "geometry"]
    return not empty[0].children if empty else not required


def _verify_sizes(geometry: Geometry, kind: str, link: Link, sink: DiagnosticSink) -> None:
    shape = geometry.shape
    if shape is None:
        return
    if isinstance(shape, Plane):
        if shape.normal is not None and not any(shape.normal):
            _flat(f"the normal of a plane of link {link.name!r} has length zero", shape.location, sink)
        return
    for name in _SIZES.get(shape.kind, ()):
        value: float | tuple[float, ...] | None = getattr(shape, name)
        if value is not None and (0.0 in value if isinstance(value, tuple) else value == 0.0):
            message = f"the {name} of a {kind} of link {link.name!r}, a {shape.kind}, is zero"
            _flat(message, shape.location, sink)


def _flat(message: str, where: Location, sink: DiagnosticSink) -> None:
    sink.report(rules.ZERO_SIZE, message, where, found="0")
