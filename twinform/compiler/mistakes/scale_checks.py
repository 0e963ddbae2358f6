"""Checks of units and scale: sizes, offsets, speeds and ways that no robot has, but for millimeters and degrees."""

import math
from collections.abc import Container, Iterator

from twinform.compiler.mistakes.mesh_checks import MeshFiles
from twinform.diagnostics import DiagnosticSink, Severity, rules
from twinform.ir import (
    Collision,
    Document,
    Dynamics,
    Format,
    Inertial,
    Joint,
    Limit,
    Link,
    Mesh,
    Model,
    Pose,
    Shape,
    Vector3,
    Visual,
)
from twinform.ir.bounds import bounds
from twinform.ir.solids import FELT
from twinform.passes.shared.moving_bodies import movable_models

# Of 1,448 corpus files, the longest offset in a robot of URDF is 15 m, but for a model that was made to be large, and
# the longest way of a slider 15 m.
_FAR = 40.0
"""An offset that no robot has, m."""
_LONG = 20.0
"""A way that no slider has, m."""
_FACTOR = 50.0
"""How much larger than its collision a visual can be."""
_LARGE = 3.0
"""A size below which a visual may be as much larger than a collision as it likes: a wand on a dot, m."""
# The fastest joints with limits in the corpus, besides powers of ten for any speed: 32 rad/s, but for one with 100.7.
_FAST = {"revolute": 101.0, "continuous": 2000.0, "prismatic": 30.0}
"""The greatest speed of a kind of joint, rad/s or m/s."""
_LARGE_FIGURE = 1000.0
_UNITS = {"revolute": "rad/s", "continuous": "rad/s", "prismatic": "m/s"}


def report_scale(document: Document, files: MeshFiles, sink: DiagnosticSink) -> set[int]:
    """Report sizes, offsets and limits that must be in other units; return the identities of links with such sizes."""
    odd: set[int] = set()
    for model in movable_models(document):
        for link in model.links:
            if _report_sizes(link, files, sink):
                odd.add(id(link))
            _report_link_offsets(link, document.format, sink)
        for joint in model.joints:
            if _is_far(joint.pose):
                _report_offset(joint, f"joint {joint.name!r}", sink)
            _report_limits(joint, model, document.format, sink)
    return odd


def _report_sizes(link: Link, files: MeshFiles, sink: DiagnosticSink) -> bool:
    """Report a visual or collision that is many times as large as its other half."""
    seen, touched = _largest(link.visuals, files), _largest(link.collisions, files)
    if seen is None or touched is None:
        return False
    (size, shape), (other, twin) = sorted((seen, touched), key=lambda each: -each[0])
    if size < _FACTOR * other or (size < _LARGE and not _same_mesh(shape, twin)):
        return False
    kind, beside = ("visual", "collision") if shape is seen[1] else ("collision", "visual")
    what = f"the {shape.kind}" + (f" {shape.uri!r}" if isinstance(shape, Mesh) and shape.uri else "")
    large, small = f"{what}{_scale_of(shape)}, is {size:.4g} m large", f"its {beside}{_scale_of(twin)} {other:.4g} m"
    message = f"the {kind} of link {link.name!r}, {large}, {small}"
    hint = "write meters; a mesh in millimeters needs scale='0.001 0.001 0.001'"
    where, related = shape.location, (twin.location,)
    if _same_mesh(shape, twin) and size < _LARGE:  # of one mesh with two scales, the smaller one is the odd one
        where, related = twin.location, (shape.location,)
    sink.report(
        rules.IMPLAUSIBLE_SIZE,
        message,
        where,
        found=f"{size:.4g} m",
        expected=f"about {other:.4g} m",
        help=hint,
        related=related,
    )
    return True


def _scale_of(shape: Shape) -> str:
    scale = shape.scale if isinstance(shape, Mesh) else None
    return f" with scale {' '.join(f'{each:g}' for each in scale)}" if scale else ""


def _same_mesh(one: Shape, other: Shape) -> bool:
    return isinstance(one, Mesh) and isinstance(other, Mesh) and one.uri == other.uri


def _largest(holders: tuple[Visual, ...] | tuple[Collision, ...], files: MeshFiles) -> tuple[float, Shape] | None:
    """The largest shape of a link and its size; None where there is none, or one has no known size."""
    found: list[tuple[float, Shape]] = []
    for holder in holders:
        shape = holder.geometry.shape if holder.geometry else None
        size = _size(shape, files) if shape else None
        if shape is None or not size:
            return None
        found.append((size, shape))
    return max(found, key=lambda each: each[0]) if found else None


def _size(shape: Shape, files: MeshFiles) -> float | None:
    """The greatest extent of a shape, m; of a mesh the least that it can be."""
    if not isinstance(shape, Mesh):
        box = bounds(shape)
        return max(box.size) if box else None
    box = files.box(shape.uri or "", whole=False)
    if box is None:
        return None
    return max(abs(length * scale) for length, scale in zip(box.size, shape.scale or (1.0, 1.0, 1.0), strict=True))


def _report_link_offsets(link: Link, format_: Format, sink: DiagnosticSink) -> None:
    if format_ is Format.SDF and _is_far(link.pose):  # in URDF a link has no pose of its own
        _report_offset(link, f"link {link.name!r}", sink)
    if link.inertial and _is_far(link.inertial.pose):
        _report_offset(link.inertial, f"the center of mass of link {link.name!r}", sink)
    for shape in (*link.visuals, *link.collisions):
        if _is_far(shape.pose):
            kind = "visual" if isinstance(shape, Visual) else "collision"
            _report_offset(shape, f"a {kind} of link {link.name!r}", sink)


def _is_far(pose: Pose | None) -> bool:
    return pose is not None and pose.xyz is not None and max(map(abs, pose.xyz)) >= _FAR


def _report_offset(placed: Collision | Inertial | Joint | Link | Visual, what: str, sink: DiagnosticSink) -> None:
    pose = placed.pose
    if pose is None or pose.xyz is None:
        return
    far = max(pose.xyz, key=abs)
    message = f"{what} is {far:g} m off; are these millimeters?"
    where = (pose if pose.source else placed).location
    hint = f"write meters, such as {' '.join(f'{each / 1000:g}' for each in pose.xyz)}"
    sink.report(rules.IMPLAUSIBLE_OFFSET, message, where, found=f"{far:g}", expected=f"less than {_FAR:g}", help=hint)


def _report_limits(joint: Joint, model: Model, format_: Format, sink: DiagnosticSink) -> None:
    for axis in (joint.axis, joint.axis2):
        if axis is None:
            continue
        if axis.limit and joint.type in {"revolute", "prismatic"}:
            _report_locked(joint, axis.limit, model, sink)
        if axis.limit and joint.type in _FAST:
            for name, message in _odd_limits(joint, axis.limit):
                where = axis.limit.location.at(name if format_ is Format.SDF else f"@{name}")
                found = f"{getattr(axis.limit, name):g}"
                # The pass `check-limits` notes any limit that is large; this one has other units.
                severity = Severity.WARNING
                sink.report(rules.IMPLAUSIBLE_LIMIT, message, where, found=found, severity=severity)
    has_negative = any(axis.dynamics and _is_negative(axis.dynamics) for axis in (joint.axis, joint.axis2) if axis)
    if has_negative or any(part.element and part.element.name == "safety_controller" for part in joint.opaque):
        from twinform.passes.joints.check_limits import find_faults  # noqa: PLC0415 - few joints have either

        for each in find_faults(joint):
            severity = Severity.INFO if each.may_be_meant else None
            sink.report(
                each.rule, each.message, each.where, found=each.found, expected=each.expected, severity=severity
            )


def _is_negative(dynamics: Dynamics) -> bool:
    return (dynamics.damping or 0.0) < 0 or (dynamics.friction or 0.0) < 0


def _report_locked(joint: Joint, limit: Limit, model: Model, sink: DiagnosticSink) -> None:
    """Report limits that are written and equal; URDF means 0 where neither is, as some write for none."""
    if limit.lower is not None and limit.lower == limit.upper:
        message = f"joint {joint.name!r} cannot move: both of its limits are {limit.lower:g}"
        hint = "write the limits, or the type fixed if it is not to move"
        severity = Severity.INFO if limit.lower == 0 and _is_mount(joint, limit, model) else None
        sink.report(rules.EMPTY_RANGE, message, limit.location, found=f"{limit.lower:g}", help=hint, severity=severity)


def _is_mount(joint: Joint, limit: Limit, model: Model) -> bool:
    """Whether a joint that cannot move holds another model, all of this one, or a sensor: some write fixed joints so.

    Gazebo Classic would lump a link on a fixed joint of URDF, and had no fixed joint in SDF before 1.5.
    """
    if joint.parent == "world" or "::" in (joint.child or ""):
        return True
    held = next((link for link in model.links if link.name == joint.child), None)
    if held is None:
        return True  # it is in a model that is included
    if any(other.parent == held.name for other in model.joints):
        return False
    if limit.effort == limit.velocity == 0 and any(map(_has_range, model.joints)):
        return True  # an exporter that knows no limits writes four zeros for all joints
    return bool(held.sensors) or (held.inertial is not None and not held.visuals and not held.collisions)


def _has_range(joint: Joint) -> bool:
    limit = joint.axis.limit if joint.axis else None
    return joint.type == "continuous" or (limit is not None and limit.lower != limit.upper)


def _odd_limits(joint: Joint, limit: Limit) -> Iterator[tuple[str, str]]:
    """Find the limits that no joint has, each with its name."""
    speed, most = limit.velocity, _FAST[joint.type]
    if speed and most < speed < math.inf and not _is_power_of_ten(speed) and not is_made_up(limit):
        unit = _UNITS[joint.type]
        other = "mm/s" if joint.type == "prismatic" else "degrees per second or turns per minute"
        message = f"joint {joint.name!r} has a velocity of {speed:g} {unit}, which no such joint reaches"
        yield "velocity", f"{message}; are these {other}?"
    for name in ("lower", "upper") if joint.type == "prismatic" else ():
        way = getattr(limit, name)
        if way is not None and _LONG < abs(way) < math.inf and not _is_power_of_ten(way):
            yield name, f"joint {joint.name!r} slides as far as {way:g} m; are these millimeters?"


def is_made_up(limit: Limit) -> bool:
    """Whether effort and velocity are one large number, 50000, which is no figure of either."""
    return limit.effort == limit.velocity and (limit.velocity or 0.0) >= _LARGE_FIGURE


def _is_power_of_ten(value: float) -> bool:
    """Whether a number stands for any: people write 1000 or 1e8 where there is no limit."""
    return math.log10(abs(value)) % 1 == 0


# Each leaves more room than `unit_check` does: whatever that reports passes this.
_HEAVY = 50000.0
"""A mass in the boxes around shapes, kg/m^3."""
_LARGE_MOMENT = 300.0
_SMALL_MOMENT = 1e-3
_OFF = 0.5
"""How far a center of mass may be away from the link, m."""


def report_masses(document: Document, files: MeshFiles, odd: Container[int], sink: DiagnosticSink) -> None:
    """Report masses and inertias that the shapes of their links are far from, but for links with `odd` shapes."""
    for model in movable_models(document):
        for link in model.links:
            inertial = link.inertial
            if inertial and not inertial.auto and id(link) not in odd and _is_suspect(link, inertial, files):
                # few robots have such a link, and the exact check has many modules
                from twinform.compiler.mistakes.unit_check import report_mass  # noqa: PLC0415 - see above

                report_mass(link, inertial, (model, document.format), files, sink)


def _is_suspect(link: Link, inertial: Inertial, files: MeshFiles) -> bool:
    """Tell cheaply whether a mass or inertia may be far from what the shapes of a link suggest."""
    holders = (*link.collisions, *link.visuals)
    mass, inertia = inertial.mass, inertial.inertia
    if not holders or not mass or mass < 0 or inertia is None:
        return False
    sizes = [_box_size(each, files) for each in holders]
    known = [each for each in sizes if each is not None]
    if len(known) < len(sizes):
        return False
    trace = sum(abs(each or 0.0) for each in (inertia.ixx, inertia.iyy, inertia.izz))
    thin, wide = min(map(min, known)), sum(map(max, known)) + sum(map(_offset, holders))
    volume = min(math.prod(each) for each in known)
    return (
        trace > max(_LARGE_MOMENT * mass * thin * thin / 4, FELT)
        or 0 < trace < _SMALL_MOMENT * mass * wide * wide
        or mass > _HEAVY * volume
        or _offset(inertial) > _OFF
    )


def _box_size(holder: Visual | Collision, files: MeshFiles) -> Vector3 | None:
    shape = holder.geometry.shape if holder.geometry else None
    if not isinstance(shape, Mesh):
        box = bounds(shape)
        return box.size if box else None
    box = files.box(shape.uri or "")
    if box is None:
        return None
    x, y, z = (abs(length * factor) for length, factor in zip(box.size, shape.scale or (1.0, 1.0, 1.0), strict=True))
    return x, y, z


def _offset(placed: Visual | Collision | Inertial) -> float:
    """How far a part is away from its link; 0 where its pose names another frame."""
    return math.hypot(*placed.pose.xyz) if placed.pose and placed.pose.xyz else 0.0
