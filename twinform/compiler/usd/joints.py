"""Joints of a stage: their places and limits, and what UsdPhysics, Newton, MuJoCo and PhysX say of their dynamics.

Angles of UsdPhysics are in degrees, and so is what it divides by angles. Attributes of `urdf:` are what a converter
writes for what it found no place for: no engine reads them, so they are carriers here.
"""

import math
from collections.abc import Iterator, Mapping
from itertools import product

from twinform.compiler.usd.stage import Prim, Stage, rotation_of, scaled
from twinform.dataclass import dataclass
from twinform.ir import Axis, Dynamics, Element, Joint, JointType, Limit, Mimic, Opaque, Vector3
from twinform.ir.transform import Transform
from twinform.passes.carriers.carriers import carry

_AXES: Mapping[str, Vector3] = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}
_TYPES: Mapping[str, JointType] = {
    "PhysicsFixedJoint": "fixed",
    "PhysicsRevoluteJoint": "revolute",
    "PhysicsPrismaticJoint": "prismatic",
    "PhysicsSphericalJoint": "ball",
}
_MIMICS = tuple(f"physxMimicJoint:{kind}{axis}" for kind, axis in product(("rot", "trans"), "XYZ"))


@dataclass(frozen=True, slots=True)
class JointSide:
    """One side of a joint: the body that it is on, or None for what stands still, and the joint's frame there."""

    body: str | None
    frame: Transform


@dataclass(frozen=True, slots=True)
class StageJoint:
    """A joint between two sides, from the parent to the child."""

    prim: Prim
    type: JointType
    axis: Vector3
    parent: JointSide
    child: JointSide

    @property
    def is_loop(self) -> bool:
        """Whether the file says that the joint closes a loop."""
        return self.prim.values.get("physics:excludeFromArticulation") is True


def joints_of(stage: Stage) -> Iterator[StageJoint]:
    """Yield the joints that move or hold a body."""
    for prim in stage.prims.values():
        found = _kind(prim)
        if found is None or not prim.on("physics:jointEnabled"):
            continue
        type_, axis = found
        one, other = _side(stage, prim, "0"), _side(stage, prim, "1")
        if other.body is None and one.body is not None:  # the same motion, seen from the other side
            one, other, axis = other, one, scaled(axis, (-1.0, -1.0, -1.0))
        if other.body is not None and one.body != other.body:
            yield StageJoint(prim, type_, axis, one, other)


def _kind(prim: Prim) -> tuple[JointType, Vector3] | None:
    """Return the type and the axis of a joint; None for what is no joint, and for those that SDF has no type for."""
    if prim.type in _TYPES:
        return _TYPES[prim.type], _AXES[prim.token("physics:axis", "X")]
    if prim.type != "PhysicsJoint":
        return None
    free = [name for name in ("transX", "transY", "transZ", "rotX", "rotY", "rotZ") if not _is_locked(prim, name)]
    if free == ["rotX", "rotY", "rotZ"]:
        return "ball", _AXES["X"]
    if len(free) == 3 and not any(f"trans{name[-1]}" in free for name in free if name.startswith("rot")):
        return "planar", _AXES[free[-1][-1]]
    if len(free) > 1:
        return None
    kind: JointType = "fixed" if not free else "revolute" if free[0].startswith("rot") else "prismatic"
    return kind, _AXES[free[0][-1] if free else "X"]


def _is_locked(prim: Prim, name: str) -> bool:
    low, high = (prim.number(f"limit:{name}:physics:{end}") for end in ("low", "high"))
    return low is not None and high is not None and low > high


def _side(stage: Stage, prim: Prim, number: str) -> JointSide:
    holder = stage.prims.get(prim.target(f"physics:body{number}") or "")
    scale = holder.scale if holder else (stage.meters, stage.meters, stage.meters)
    point = scaled(prim.numbers(f"physics:localPos{number}", (0.0, 0.0, 0.0)), scale)
    frame = (holder.place if holder else stage.root).compose(
        Transform(point, rotation_of(prim, f"physics:localRot{number}"))
    )
    body = stage.body_of(holder.path if holder else None)
    return JointSide(body, (stage.prims[body].place.inverse() if body else Transform()).compose(frame))


def joint_of(stage: Stage, one: StageJoint, names: Mapping[str, str]) -> Joint:
    """Make a joint of SDF; `names` are those of the links and joints by their paths.

    Its frame is turned as that of the child link is, as joints of URDF are: USD turns it so that x, y or z is the axis.
    A planar joint is still to be unfolded, and is placed in its parent link, as URDF has it.
    """
    pose = Transform(one.child.frame.translation).to_pose()
    if one.type == "planar":
        place = one.parent.frame.compose(one.child.frame.inverse())
        pose = place.to_pose(names[one.parent.body] if one.parent.body else "world")
    axis = None if one.type in {"fixed", "ball"} else _axis(stage, one, names)
    made = Joint.unchecked(
        name=names[one.prim.path],
        type=one.type,
        parent=names[one.parent.body] if one.parent.body else "world",
        child=names[one.child.body or ""],
        pose=pose,
        axis=axis,
        source=one.prim.source,
    )
    return carry(made, _unread(one.prim, axis), "sdf") if axis else made


def _axis(stage: Stage, one: StageJoint, names: Mapping[str, str]) -> Axis:
    unit = _Units(stage, turns=one.type == "revolute")
    prim, source = one.prim, one.prim.source
    return Axis.unchecked(
        xyz=one.child.frame.rotate(one.axis),
        limit=_limit(one, unit),
        dynamics=_dynamics(prim, unit),
        mimic=_mimic(prim, unit, names),
        source=source,
    )


@dataclass(frozen=True, slots=True)
class _Units:
    """The units of a joint that turns or slides: what a number of USD is in SI."""

    stage: Stage
    turns: bool

    @property
    def drive(self) -> str:
        return "angular" if self.turns else "linear"

    @property
    def position(self) -> float:
        return math.pi / 180 if self.turns else self.stage.meters

    @property
    def force(self) -> float:
        return self.stage.kilograms * self.stage.meters ** (2 if self.turns else 1)

    @property
    def gain(self) -> float:
        """That of a force for each unit of position or speed."""
        return self.force / self.position


def _times(value: float | None, unit: float) -> float | None:
    return None if value is None else value * unit


def _limit(one: StageJoint, unit: _Units) -> Limit:
    prim, along = one.prim, "XYZ"[max(range(3), key=lambda at: abs(one.axis[at]))]
    freedom = f"limit:{'rot' if unit.turns else 'trans'}{along}:physics"
    ends = (
        prim.first(f"physics:{name}Limit", f"{freedom}:{short}")
        for name, short in (("lower", "low"), ("upper", "high"))
    )
    lower, upper = (None if end is None or math.isinf(end) else end * unit.position for end in ends)
    effort = _times(prim.first(f"drive:{unit.drive}:physics:maxForce", "mjc:actuatorfrcrange:max"), unit.force)
    velocity = _times(prim.first("newton:velocityLimit", "physxJoint:maxJointVelocity"), unit.position)
    return Limit.unchecked(lower=lower, upper=upper, effort=effort, velocity=velocity, source=prim.source)


def _dynamics(prim: Prim, unit: _Units) -> Dynamics:
    damping = _times(prim.number("newton:damping"), unit.gain)
    stiffness = prim.first(f"drive:{unit.drive}:physics:stiffness")
    if damping is None:
        damping = _times(prim.number("mjc:damping"), unit.force)
    if damping is None and not stiffness:  # else it is the gain of a controller of positions
        damping = _times(prim.number(f"drive:{unit.drive}:physics:damping"), unit.gain)
    friction = prim.first("newton:friction", "mjc:frictionloss", "physxJoint:jointFriction")
    return Dynamics.unchecked(damping=damping, friction=_times(friction, unit.force), source=prim.source)


def _mimic(prim: Prim, unit: _Units, names: Mapping[str, str]) -> Mimic | None:
    leader = names.get(prim.target("newton:mimicJoint") or "")
    if leader and prim.on("newton:mimicEnabled"):
        offset, multiplier = prim.first("newton:mimicCoef0"), prim.first("newton:mimicCoef1")
        return _follow(leader, 1.0 if multiplier is None else multiplier, (offset or 0.0) * unit.position, prim)
    for instance in _MIMICS:
        leader = names.get(prim.target(f"{instance}:referenceJoint") or "")
        if leader:  # the sum of the position, the gearing times that of the leader, and the offset is zero
            gearing, offset = prim.first(f"{instance}:gearing"), prim.first(f"{instance}:offset")
            return _follow(leader, -(1.0 if gearing is None else gearing), -(offset or 0.0) * unit.position, prim)
    return None


def _follow(leader: str, multiplier: float, offset: float, prim: Prim) -> Mimic:
    return Mimic.unchecked(joint=leader, axis="axis", multiplier=multiplier, offset=offset, source=prim.source)


def _unread(prim: Prim, axis: Axis) -> Iterator[Opaque]:
    """Yield what only attributes of `urdf:` say of an axis."""
    parts = {"limit": axis.limit, "dynamics": axis.dynamics}
    for part, name in (("limit", "effort"), ("limit", "velocity"), ("dynamics", "damping"), ("dynamics", "friction")):
        value = prim.number(f"urdf:{part}:{name}")
        if value is not None and getattr(parts[part], name) is None:
            yield Opaque.unchecked(at=f"axis/{part}", element=Element.unchecked(name=name, text=repr(value)))
