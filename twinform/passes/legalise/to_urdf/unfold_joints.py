"""Unfolding multi-axis and coupled SDF joints into chains of URDF joints."""

import math
from functools import partial
from typing import ClassVar, NamedTuple

from twinform.diagnostics import Fate, rules
from twinform.diagnostics.wording import plural
from twinform.ir import Axis, Dynamics, Format, Joint, JointType, Limit, Link, Mimic, Model, Opaque, Pose, count_parts
from twinform.ir.defaults import AXIS, UNLIMITED
from twinform.passes.carriers.annotations import with_annotation
from twinform.passes.carriers.carriers import carry, is_carrier, to_element, unpack
from twinform.passes.carriers.joint_chains import (
    BALL_AXES,
    CHAIN,
    CHAINS,
    PART,
    PITCHES,
    TWO_AXES,
    metres_per_radian,
    split_axes,
)
from twinform.passes.carriers.token_mass import CHAIN_MASS, CHAIN_TOKEN
from twinform.passes.legalise.drake_joints import fit_for_drake
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.legalise.urdf_pieces import BALLS
from twinform.passes.shared.nodes import reserve_name, text_piece
from twinform.schemas import format_value

_Z = Axis.unchecked(xyz=AXIS[Format.SDF])


class ChainStep(NamedTuple):
    """The type and axis of one joint of a chain."""

    type: JointType
    axis: Axis


def _two_axes(joint: Joint) -> tuple[ChainStep, ...]:
    """The steps of a universal or revolute2 joint: a turn about `axis`, fixed in the parent, then about `axis2`.

    `axis2` has the same direction in the link between and in the child, since a turn leaves its own axis in place.
    """
    return (ChainStep("revolute", joint.axis or _Z), ChainStep("revolute", joint.axis2 or _Z))


def _ball(joint: Joint) -> tuple[ChainStep, ...]:
    """The steps of a ball joint: turns about z, y and x, together Rz Ry Rx as in URDF's yaw, pitch and roll.

    Damping acts on the angular velocity of a ball joint, and here on the three rates, which are its components for
    small angles.
    """
    written = joint.axis.dynamics if joint.axis else None
    damped = None
    if written is not None and (written.damping is not None or written.friction is not None):
        damped = Dynamics.unchecked(damping=written.damping, friction=written.friction)
    return tuple(ChainStep("revolute", Axis.unchecked(xyz=xyz, dynamics=damped)) for xyz in BALL_AXES)


def _screw(joint: Joint) -> tuple[ChainStep, ...]:
    """The steps of a screw joint: a slide along the axis that mimics the turn by `metres_per_radian`."""
    # SDF does not say whether the limits of a screw joint are angles or lengths. Drake and DART count
    # the angle, so the turning joint leads and has the limits in rad; the sliding one has them times
    # the pitch.
    axis = joint.axis or _Z
    ratio = metres_per_radian(joint) or 0.0
    slide = Axis.unchecked(
        xyz=axis.xyz, limit=_slide_limit(axis.limit, ratio), mimic=Mimic.unchecked(joint=joint.name, multiplier=ratio)
    )
    return (ChainStep("prismatic", slide), ChainStep("revolute", axis))


def _slide_limit(limit: Limit | None, ratio: float) -> Limit:
    """The limits of the slide: those of the turn times the ratio."""
    values = limit or Limit.unchecked()
    ends = sorted((_scaled(values.lower, -UNLIMITED, ratio), _scaled(values.upper, UNLIMITED, ratio)))
    speed = values.velocity if values.velocity is not None and values.velocity >= 0 else UNLIMITED
    return Limit.unchecked(lower=ends[0], upper=ends[1], effort=UNLIMITED, velocity=min(UNLIMITED, speed * abs(ratio)))


def _scaled(value: float | None, unbounded: float, ratio: float) -> float:
    if value is None or not abs(value) < UNLIMITED:
        return math.copysign(UNLIMITED, unbounded * ratio)
    return value * ratio + 0.0


_STEPS = {"universal": _two_axes, "revolute2": _two_axes, "ball": _ball, "screw": _screw}
_WORDS = {
    "universal": "two turning joints",
    "revolute2": "two turning joints",
    "ball": "three turning joints",
    "screw": "a turning joint and a sliding one that mimics it",
}


class UnfoldJoints(ToUrdfPass):
    """Say ball, universal, revolute2 and screw joints by chains of joints that URDF has.

    Changes: 1. a universal or revolute2 joint turns about its first axis, then about its second; 2. a ball joint turns
    about z, y and x of its frame; 3. a screw joint slides by a joint that mimics the one that turns; 4. the last joint
    of a chain keeps name, place and child, and links of 2e-6 kg stand between; all are annotated, so that the reverse
    conversion folds them; 5. what mimics the first axis of a joint with two mimics the first joint of the chain; 6. a
    ball joint that was one in URDF is one again, and so is a screw or universal joint that was Drake's.
    Never touches: joints that close a loop, which are joints of SDF in a `<gazebo>` element.
    Diagnostics: `unfolded-joint`; `joint-type-unsupported` for a screw with a pitch of 0 rad/m.
    """

    name: ClassVar[str] = "unfold-joints"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with chains of joints."""
        if not any(joint.type in CHAINS for joint in model.joints):
            return model
        taken = {node.name for node in (*model.links, *model.joints)}
        links: dict[str | None, tuple[Link, ...]] = {}
        first: dict[str, str] = {}
        joints: list[Joint] = []
        for joint in model.joints:
            if (own := fit_for_drake(joint)) is not None and joint.type != "ball":
                joints.append(own)
                continue
            if joint.type not in CHAINS or _was_in_urdf(joint) or _lacks_pitch(joint, keeper):
                joints.append(_restore_dialect_type(joint))
                continue
            between, chain = _unfold(joint, taken, keeper)
            links[joint.child] = between
            joints += chain
            if joint.type in TWO_AXES:
                first[joint.name] = chain[0].name
        every = tuple(one for link in model.links for one in (*links.get(link.name, ()), link))
        joints = [_follow_chain(joint, first) for joint in joints] if first else joints
        return model.copy(links=every, joints=tuple(joints))


def _unfold(joint: Joint, taken: set[str], keeper: UrdfKeeper) -> tuple[tuple[Link, ...], list[Joint]]:
    """The links and joints of a chain, in order from the parent."""
    *above, last = _STEPS[joint.type](joint)
    kept = _account_for(joint, keeper)
    parts_of_first, opaque = split_axes(kept.opaque) if joint.type in TWO_AXES else ((), kept.opaque)
    # z, y and x of a ball's frame is the order of URDF's yaw, pitch and roll.
    links: list[Link] = []
    joints: list[Joint] = []
    parent = joint.parent
    for word, step in zip(CHAINS[joint.type], above, strict=True):
        name = reserve_name(f"{joint.name}_{word}", taken)
        link = reserve_name(f"{name}_link", taken)
        made = Joint.unchecked(
            name=name, type=step.type, parent=parent, child=link, axis=step.axis, source=joint.source
        )
        joints.append(_annotate_part(made.copy(opaque=parts_of_first), joint, keeper))
        links.append(_make_link_between(link, joint, keeper))
        parent, parts_of_first = link, ()
    return tuple(links), [*joints, _make_last_joint(kept, parent, last, opaque, keeper)]


def _annotate_part(made: Joint, joint: Joint, keeper: UrdfKeeper) -> Joint:
    return with_annotation(made, PART, attributes={"joint": joint.name}) if keeper.carriers else made


def _make_link_between(name: str, joint: Joint, keeper: UrdfKeeper) -> Link:
    """A link of the chain, with a token mass that is large enough for libsdformat and MuJoCo."""
    link = Link.unchecked(
        name=name, pose=Pose.unchecked(relative_to=joint.name), inertial=CHAIN_TOKEN, source=joint.source
    )
    return with_annotation(link, PART, attributes={"joint": joint.name}) if keeper.carriers else link


def _make_last_joint(
    joint: Joint, parent: str | None, step: ChainStep, opaque: tuple[Opaque, ...], keeper: UrdfKeeper
) -> Joint:
    """The last joint of a chain, which keeps name, child and place of the original."""
    update: dict[str, object] = {"type": step.type, "parent": parent, "axis": step.axis, "opaque": opaque}
    said = PITCHES if joint.type == "screw" else ("axis2",)  # the second axis of a screw is one that nobody reads
    # The last joint keeps the name: a joint's frame moves with its child in SDF, and so does that
    # of the last joint. Sensors, <physics> and frames that name the joint mean the same as before.
    last = joint.copy(**{**dict.fromkeys(said), **update})
    # Only the type is annotated. Axes, limits, damping and springs are read back from the chain as
    # it stands, so that an edit of them is an edit of the joint.
    return with_annotation(last, CHAIN, attributes={"type": joint.type}) if keeper.carriers else last


def _account_for(joint: Joint, keeper: UrdfKeeper) -> Joint:
    """Report that a joint becomes a chain; returns the joint with what the chain cannot express in carriers."""
    between = len(CHAINS[joint.type])
    message = (
        f"{joint.type} joint {joint.name!r} becomes {_WORDS[joint.type]} in URDF and links of {CHAIN_MASS:g} kg between"
    )
    keeper.sink.report(rules.UNFOLDED_JOINT, message, joint.location.at("@type"), found=joint.type)
    keeper.account(rules.UNFOLDED_JOINT, f"joint {joint.name!r} has the type {joint.type}", joint.location)
    note = partial(keeper.sink.account, Fate.APPROXIMATED, rules.UNFOLDED_JOINT, location=joint.location, weight=0)
    links = f"{plural(between, 'link')} between"
    note(message=f"{links} the joints of {joint.name!r}, of {CHAIN_MASS:g} kg")
    if joint.type == "ball":
        lock = f"where the second of the three joints of {joint.name!r} is at 90 deg, the others turn about one axis"
        note(message=lock)
        return _keep_axis(joint, keeper)
    if joint.type == "screw" and keeper.carriers:  # their number is the multiplier of the mimic; this is its spelling
        written = {name: getattr(joint, name) for name in PITCHES}
        pieces = [text_piece(name, format_value(value)) for name, value in written.items() if value is not None]
        return carry(joint, pieces, "sdf")
    return joint


def _keep_axis(joint: Joint, keeper: UrdfKeeper) -> Joint:
    """The ball joint with its axes in carriers; of these only the damping has an effect."""
    for field in ("axis", "axis2"):
        axis: Axis | None = getattr(joint, field)
        if axis is not None:
            message = f"ball joint {joint.name!r} has an {field}; its damping acts on each of the three joints"
            bare = to_element(Joint.unchecked(name="", type=joint.type).copy(**{field: axis}), "joint", "sdf")
            pieces = [Opaque.unchecked(element=child) for child in bare.children]
            joint = keeper.keep(joint, pieces, rules.UNFOLDED_JOINT, message, axis.location, count_parts(axis))
    return joint


def _follow_chain(joint: Joint, first: dict[str, str]) -> Joint:
    """The joint with a mimic of an axis of a two-axis joint turned into a mimic of a joint of the chain."""
    axis = joint.axis
    mimic = axis.mimic if axis else None
    if axis is None or mimic is None or mimic.joint not in first:
        return joint
    leader = mimic.joint if mimic.axis == "axis2" else first[mimic.joint]
    mimic = mimic.copy(joint=leader, axis=None)
    return joint.copy(axis=axis.copy(mimic=mimic))


def _lacks_pitch(joint: Joint, keeper: UrdfKeeper) -> bool:
    if joint.type != "screw" or metres_per_radian(joint) is not None:
        return False
    message = f"screw joint {joint.name!r} has a thread pitch of 0 rad/m, which moves infinitely far"
    keeper.sink.report(rules.JOINT_TYPE_UNSUPPORTED, message, joint.location, found="0")
    return True


def _was_in_urdf(joint: Joint) -> bool:
    return any(_type_in_urdf(part) for part in joint.opaque)


def _restore_dialect_type(joint: Joint) -> Joint:
    """A ball joint with the type that a dialect of URDF gave it, such as `spherical`."""
    found = next((kind for part in joint.opaque if (kind := _type_in_urdf(part))), None)
    if found is None or joint.type != "ball":
        return joint
    opaque = tuple(part for part in joint.opaque if not _type_in_urdf(part))
    return joint.copy(type=found, opaque=opaque)


def _type_in_urdf(part: Opaque) -> str | None:
    """The type of a ball joint in a carrier of URDF."""
    pieces = unpack(part) if is_carrier(part, "urdf") else ()
    types = (
        piece.attribute[1] for piece in pieces if piece.attribute and piece.attribute[0] == "type" and not piece.at
    )
    return next((kind for kind in types if kind in BALLS), None)
