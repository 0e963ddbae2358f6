"""Between versions of URDF: what an older one lacks, and what only a newer one reads."""

import math
from collections.abc import Iterable, Iterator
from functools import partial
from typing import Any, ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, Fate, Severity, rules
from twinform.ir import Document, Inertial, Joint, Link, Node, Opaque, Pose, bits_of, replace_fields, rewrite
from twinform.ir.defaults import UNLIMITED, sizes
from twinform.ir.geometry import Box, Capsule, Cylinder, Sphere
from twinform.ir.joint import Limit
from twinform.ir.transform import Transform
from twinform.ir.versions import Version, parse_version
from twinform.ir.visual import Collision, Visual
from twinform.passes.carriers.carriers import NAMESPACE, PREFIX, Keeper, has_ours
from twinform.passes.framework.pass_base import Pass
from twinform.passes.sdf_versions.replace_shapes import fold_capsules
from twinform.passes.shared.poses import in_radians
from twinform.passes.shared.replaced_shapes import AnyPart, ShapeReplacer, with_ends
from twinform.request_options import UrdfVersion
from twinform.schemas import format_value, parse_value

_QUATERNION = "quat_xyzw"
_LATE_LIMITS = ("acceleration", "deceleration", "jerk")
_STRENGTH = ("effort", "velocity")
_ENDS = ("lower", "upper")
_OF_1_1 = (1, 1)
_OF_1_2 = (1, 2)
_SAME = 1e-9
"""The difference of the elements of two rotation matrices that are the same, written by people or by this pass."""
_HOLDERS = (Inertial, Visual, Collision, Joint)
AnyNode = TypeVar("AnyNode", bound=Node)


class FitUrdfVersion(Pass):
    """Write a robot in another version of URDF.

    Changes, where the version is older:

    1. a rotation by `quat_xyzw` becomes one by `rpy`, and a capsule a cylinder and two spheres (before 1.1);
    2. a limit without effort or velocity gets 1e16 (before 1.2).

    `quat_xyzw`, and limits of acceleration, deceleration and jerk, stay where they are: readers of older versions
    ignore them. Where the version is newer, readers begin to look at them:

    3. the cylinder and the spheres of a capsule become that again;
    4. an attribute that the older version had no meaning for becomes what it says, if it is valid; a `quat_xyzw` that
       turns its part otherwise than the `rpy` beside it goes;
    5. revolute and prismatic joints get the limits that were 0 by default, and an effort or velocity below 0, which
       Gazebo takes for no limit, goes (from 1.2 on).

    Diagnostics: `out-of-range` for a shape with a size of zero, which 1.2 does not have; in the ledger `other-words`,
    `outside-version`, `replaced-shape` and `unbounded-limit`.
    """

    name: ClassVar[str] = "fit-urdf-version"

    version: UrdfVersion = "1.0"
    carriers: bool = True

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document in the version."""
        version = parse_version(self.version)
        if version >= _OF_1_1:
            document = fold_capsules(document, sink)
        for holder in _HOLDERS:
            document = rewrite(document, holder, _with_own_attributes)
        document = rewrite(document, Pose, partial(_fit_pose, version, sink))
        document = rewrite(document, Joint, partial(_fit_joint, version, sink))
        if version < _OF_1_1:
            document = rewrite(
                document, Link, partial(_without_capsules, Keeper(sink, self.carriers)), having=bits_of(Capsule)
            )
        if version >= _OF_1_2:
            _refuse_flat_shapes(document, sink)
        if any(map(has_ours, document.models)) and (PREFIX, NAMESPACE) not in document.namespaces:
            document = document.copy(namespaces=(*document.namespaces, (PREFIX, NAMESPACE)))
        # urdfdom reads a missing version as 1.0, so a plain robot needs no attribute
        return document.copy(version=None if self.version == "1.0" else self.version)


def _with_own_attributes(node: AnyNode) -> AnyNode:
    """The node with the late attributes of its origin at its pose, which are at the node after a trip through SDF."""
    late = [part for part in node.opaque if part.at == "origin" and part.name == f"@{_QUATERNION}"]
    if not late:
        return node
    pose: Pose = getattr(node, "pose", None) or Pose.unchecked()
    own = pose.copy(opaque=(*pose.opaque, *(part.copy(at="") for part in late)))
    return node.copy(pose=own, opaque=_others(node, late))


def _fit_pose(version: Version, sink: DiagnosticSink, pose: Pose) -> Pose:
    if version < _OF_1_1:
        return _without_quaternion(pose, sink)
    late = next(_late_attributes(pose, (_QUATERNION,)), None)
    return pose if late is None else _with_quaternion(pose, late, sink)


def _without_quaternion(pose: Pose, sink: DiagnosticSink) -> Pose:
    if pose.quat_xyzw is None:
        return pose
    message = "an origin gets roll, pitch and yaw, since readers before URDF 1.1 ignore its quaternion"
    sink.account(Fate.CARRIED, rules.OTHER_WORDS, message, pose.location)
    kept = Opaque.unchecked(attribute=(_QUATERNION, format_value(pose.quat_xyzw)))
    plain = in_radians(Transform.from_pose(pose))
    return pose.copy(rpy=plain.rpy, quat_xyzw=None, opaque=(*pose.opaque, kept))


def _with_quaternion(pose: Pose, late: Opaque, sink: DiagnosticSink) -> Pose:
    rest = pose.copy(opaque=_others(pose, [late]))
    value = _valid(late, "quaternion")
    if value is not None:
        turned = rest.copy(rpy=None, quat_xyzw=value)
        if _is_same_rotation(turned, rest):
            return turned
    message = "the quat_xyzw of an origin had no meaning in URDF 1.0, and would turn the part now"
    sink.account(Fate.DROPPED, rules.OUTSIDE_VERSION, message, late.location_in(pose))
    return rest


def _is_same_rotation(one: Pose, other: Pose) -> bool:
    pairs = zip(Transform.from_pose(one).matrix, Transform.from_pose(other).matrix, strict=True)
    return all(abs(a - b) <= _SAME for row, same in pairs for a, b in zip(row[:3], same[:3], strict=True))


def _fit_joint(version: Version, sink: DiagnosticSink, joint: Joint) -> Joint:
    axis = joint.axis
    limit = axis.limit if axis else None
    if axis is None or limit is None:
        return joint
    fitted = _lower_limit(joint, limit, sink) if version < _OF_1_2 else _raise_limit(joint, limit, sink)
    return joint if fitted is limit else joint.copy(axis=axis.copy(limit=fitted))


def _lower_limit(joint: Joint, limit: Limit, sink: DiagnosticSink) -> Limit:
    for name in _LATE_LIMITS:
        if getattr(limit, name) is not None:
            message = f"the {name} of joint {joint.name!r} is ignored by readers before URDF 1.2"
            sink.account(Fate.CARRIED, rules.OUTSIDE_VERSION, message, limit.location.at(f"@{name}"))
    missing = [name for name in _STRENGTH if getattr(limit, name) is None]
    for name in missing:
        message = f"joint {joint.name!r} has no limit of {name}; URDF before 1.2 needs a number: {UNLIMITED:g}"
        sink.account(Fate.APPROXIMATED, rules.UNBOUNDED_LIMIT, message, limit.location, 0)
    return limit.copy(**dict.fromkeys(missing, UNLIMITED)) if missing else limit


def _raise_limit(joint: Joint, limit: Limit, sink: DiagnosticSink) -> Limit:
    late = list(_late_attributes(limit, _LATE_LIMITS))
    update: dict[str, object] = {}
    for part in late:
        value = _valid(part, "double")
        if value is not None and 0 <= value < math.inf:
            update[part.name.removeprefix("@")] = value
            continue
        message = f"{part.name} of joint {joint.name!r} had no meaning before URDF 1.2, and its value is no limit"
        sink.account(Fate.DROPPED, rules.OUTSIDE_VERSION, message, part.location_in(limit))
    if joint.type in {"revolute", "prismatic"}:
        update |= {name: 0.0 for name in _ENDS if getattr(limit, name) is None}
    for name in (name for name in _STRENGTH if (getattr(limit, name) or 0) < 0):
        update[name] = None
        message = f"the {name} of joint {joint.name!r} is below 0, which URDF 1.2 does not have: it has no limit"
        sink.account(Fate.APPROXIMATED, rules.UNBOUNDED_LIMIT, message, limit.location.at(f"@{name}"))
    return limit.copy(**update, opaque=_others(limit, late)) if update or late else limit


def _late_attributes(node: Node, names: Iterable[str]) -> Iterator[Opaque]:
    """The attributes of these names that the file's version has no meaning for."""
    return (part for part in node.opaque if part.attribute and not part.at and part.attribute[0] in names)


def _others(node: Node, parts: list[Opaque]) -> tuple[Opaque, ...]:
    return tuple(each for each in node.opaque if each not in parts)


def _valid(part: Opaque, kind: str) -> Any:
    """The value of an attribute; None where its text is none of the kind."""
    try:
        return parse_value(kind, part.attribute[1] if part.attribute else "", "urdf")
    except ValueError:
        return None


def _refuse_flat_shapes(document: Document, sink: DiagnosticSink) -> None:
    for link in (link for model in document.models for link in model.links):
        for part in (*link.visuals, *link.collisions):
            shape = part.geometry.shape if part.geometry else None
            if isinstance(shape, (Box, Capsule, Cylinder, Sphere)) and (least := min(sizes(shape))) <= 0:
                message = (
                    f"a {shape.kind} of link {link.name!r} has a size of {least:g}, and URDF 1.2 wants more than 0"
                )
                hint = "write version 1.1, or leave it out with --passes tidy-shapes"
                severity = Severity.ERROR
                sink.report(rules.OUT_OF_RANGE, message, shape.location, help=hint, severity=severity)


def _without_capsules(keeper: Keeper, link: Link) -> Link:
    visuals, collisions = _split(link, link.visuals, keeper), _split(link, link.collisions, keeper)
    return replace_fields(link, visuals=visuals, collisions=collisions)


def _split(link: Link, parts: tuple[AnyPart, ...], keeper: Keeper) -> tuple[AnyPart, ...]:
    replacer = ShapeReplacer(keeper, "URDF 1.0", lambda kind: kind == "capsule", None, None, side_files=False)
    return with_ends([replacer.replace(part, link.name) for part in parts], annotated=keeper.carriers)[0]
