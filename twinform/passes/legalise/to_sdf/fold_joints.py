"""Folding chains of URDF joints back into the multi-axis SDF joints that they represent, where a chain is intact."""

import math
from collections.abc import Container, Iterator
from typing import ClassVar, NamedTuple, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Axis, Dynamics, Format, Joint, JointType, Limit, Link, Model, Opaque
from twinform.ir.defaults import direction, multiplier, with_range
from twinform.ir.transform import Transform
from twinform.passes.carriers.absorb import CarrierError, absorb
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.carriers import is_carrier, is_ours, unpack
from twinform.passes.carriers.joint_chains import (
    BALL_AXES,
    CHAIN,
    CHAINS,
    PART,
    PITCHES,
    TWO_AXES,
    Parts,
    chain_type,
    is_of_axis,
    join_axes,
    metres_per_radian,
    part_of,
)
from twinform.passes.carriers.token_mass import is_chain_token, is_token
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.joint_notation import restore_reference

_KINDS: dict[str, JointType] = {str(kind): kind for kind in CHAINS}
_TURNS = frozenset({"revolute", "continuous"})
_NO_BODY = ("visuals", "collisions", "sensors", "lights")
_BEYOND_SDF = ("acceleration", "deceleration", "jerk")
_CLOSE = 1e-9
"""How far numbers may be apart that were written from one."""


class StaleChainError(Exception):
    """A chain was edited so that it no longer represents the joint."""


@dataclass(frozen=True, slots=True)
class JointChain:
    """The joints and links of a chain, in order from the parent; `kind` is the type of the joint it represents."""

    kind: JointType
    above: tuple[Joint, ...]
    between: tuple[Link, ...]
    last: Joint


class ChainNeighbors(NamedTuple):
    """Links by name, joints by child, names of joints by parent, and names of joints that are mimicked."""

    links: dict[str, Link]
    above: dict[str | None, Joint]
    below: dict[str | None, list[str]]
    leaders: frozenset[str | None]

    @classmethod
    def of(cls, model: Model) -> "ChainNeighbors":
        """Collect the neighbors of all links of a model, once for all chains."""
        below: dict[str | None, list[str]] = {}
        for joint in model.joints:
            below.setdefault(joint.parent, []).append(joint.name)
        links = {link.name: link for link in model.links}
        mimics = (joint.axis.mimic for joint in model.joints if joint.axis and joint.axis.mimic)
        leaders = frozenset(mimic.joint for mimic in mimics)
        return cls(links, {joint.child: joint for joint in model.joints}, below, leaders)


def find_chain(last: Joint, kind: str, around: ChainNeighbors) -> JointChain:
    """The chain that ends in this joint.

    Raises:
        StaleChainError: it does not stand for a joint of its kind.
    """
    known = _KINDS.get(kind)
    if known is None:
        raise StaleChainError(f"there are no chains for {kind!r}")
    chain = _collect_chain(last, known, around)
    _check_links(chain, around)
    for joint in (*chain.above[1:], last):
        # An offset inside of the chain moves its axes apart: then it is three joints, and no ball.
        if not Transform.from_pose(joint.pose).is_identity:
            raise StaleChainError(f"joint {joint.name!r} is not at the place of the others")
    for joint in chain.above:
        if joint.sensors or not all(is_ours(part) or is_of_axis(part.at) for part in joint.opaque):
            raise StaleChainError(f"joint {joint.name!r} has more than an axis")
        # In SDF a mimic names an axis of a joint. Of a ball or screw it would have none.
        if known not in TWO_AXES and joint.name in around.leaders:
            raise StaleChainError(f"a joint mimics {joint.name!r}")
    _check_limits(chain)
    _CHECKS[known](chain)
    return chain


def _collect_chain(last: Joint, kind: JointType, around: ChainNeighbors) -> JointChain:
    joints: list[Joint] = []
    between: list[Link] = []
    joint = last
    for _ in CHAINS[kind]:
        link, upper = around.links.get(joint.parent or ""), around.above.get(joint.parent)
        if link is None or upper is None or {part_of(link), part_of(upper)} != {last.name}:
            raise StaleChainError(f"the parent of {joint.name!r} is not part of the chain")
        joints.insert(0, upper)
        between.insert(0, link)
        joint = upper
    return JointChain(kind, tuple(joints), tuple(between), last)


def _check_links(chain: JointChain, around: ChainNeighbors) -> None:
    """Check that the links of a chain hold nothing but the chain."""
    inside = {joint.name for joint in (*chain.above, chain.last)}
    for link in chain.between:
        written = link.inertial
        # A link with a mass would lose it, or change the mass matrix of the robot.
        weighs = written is not None and not is_token(written) and not is_chain_token(written)
        if weighs or any(getattr(link, field) for field in _NO_BODY):
            raise StaleChainError(f"link {link.name!r} has a body")
        if any(not is_ours(part) for part in link.opaque):
            raise StaleChainError(f"link {link.name!r} is not empty")
    for name in (name for link in chain.between for name in around.below.get(link.name, ())):
        if name not in inside:
            raise StaleChainError(f"joint {name!r} is attached to one of its links")


def _check_limits(chain: JointChain) -> None:
    for joint in (*chain.above, chain.last):
        limit = joint.axis.limit if joint.axis and joint.axis.limit else Limit.unchecked()
        if any(getattr(limit, field) is not None for field in _BEYOND_SDF):
            raise StaleChainError(f"joint {joint.name!r} has limits that SDF does not have")


def _check_turns(chain: JointChain) -> None:
    for joint in (*chain.above, chain.last):
        if joint.type not in _TURNS:
            raise StaleChainError(f"joint {joint.name!r} does not turn")


def _check_ball(chain: JointChain) -> None:
    _check_turns(chain)
    joints = (*chain.above, chain.last)
    for joint, xyz in zip(joints, BALL_AXES, strict=True):
        axis = joint.axis or Axis.unchecked()
        # A limited axis of the three is a limit that a ball joint cannot have.
        if axis.xyz != xyz or axis.mimic or joint.type != "continuous":
            raise StaleChainError(f"joint {joint.name!r} does not turn freely about {xyz}")
    # A ball joint has one damping for all directions.
    if len({_damping(joint) for joint in joints}) != 1:
        raise StaleChainError("its joints differ in damping")


def _damping(joint: Joint) -> tuple[float | None, float | None]:
    dynamics = joint.axis.dynamics if joint.axis and joint.axis.dynamics else Dynamics.unchecked()
    return dynamics.damping, dynamics.friction


def _check_screw(chain: JointChain) -> None:
    slide, turn = chain.above[0], chain.last
    mimic = slide.axis.mimic if slide.axis else None
    if slide.type != "prismatic" or turn.type not in _TURNS:
        raise StaleChainError("it does not slide and turn")
    if mimic is None or mimic.joint != turn.name or mimic.offset:
        raise StaleChainError(f"joint {slide.name!r} does not follow {turn.name!r}")
    if (slide.axis or Axis.unchecked()).xyz != (turn.axis or Axis.unchecked()).xyz:
        raise StaleChainError("it slides along another axis than it turns about")


_CHECKS = {"universal": _check_turns, "revolute2": _check_turns, "ball": _check_ball, "screw": _check_screw}


def folded(chain: JointChain) -> Joint:
    """The joint that a chain stands for, with the values that the chain has now.

    Raises:
        StaleChainError: what it carries is empty.
    """
    first, last = chain.above[0], chain.last
    if chain.kind in TWO_AXES:
        first, last = _with_reference(first), _with_reference(last)
    own = without_annotation(last, CHAIN).opaque
    opaque = join_axes(first.opaque, own) if chain.kind in TWO_AXES else own
    update: dict[str, object] = {"type": chain.kind, "parent": first.parent, "pose": first.pose, "opaque": opaque}
    joint = last.copy(**update)
    if chain.kind in TWO_AXES:
        return joint.copy(axis=_axis_in_sdf(first), axis2=_axis_in_sdf(last))
    return _fold_ball(joint, last) if chain.kind == "ball" else _fold_screw(joint, chain)


def _axis_in_sdf(joint: Joint) -> Axis:
    """The axis of a URDF joint with the defaults of URDF written out."""
    axis = joint.axis or Axis.unchecked()
    limit = axis.limit
    if limit is not None and joint.type == "continuous":
        limit = limit.copy(lower=None, upper=None)
        limit = None if limit == Limit.unchecked() else limit
    elif limit is not None:
        limit = with_range(limit, Format.URDF)
    return axis.copy(xyz=direction(axis, Format.URDF), limit=limit)


def _with_reference(joint: Joint) -> Joint:
    made = restore_reference(joint)
    if made is None:
        raise StaleChainError(f"joint {joint.name!r} no longer mimics as it did")
    return made


def _fold_ball(joint: Joint, last: Joint) -> Joint:
    """The ball joint with the axis that it carries and the damping of the chain."""
    joint = _unpack_elements(joint.copy(axis=None), ("axis", "axis2"))
    damping, friction = _damping(last)
    axis = joint.axis or Axis.unchecked()
    dynamics = (axis.dynamics or Dynamics.unchecked()).copy(damping=damping, friction=friction)
    if dynamics == (axis.dynamics or Dynamics.unchecked()):
        return joint
    return joint.copy(axis=axis.copy(dynamics=dynamics))


def _fold_screw(joint: Joint, chain: JointChain) -> Joint:
    """The screw joint with the pitch that it carries, or the pitch of the chain if that was edited."""
    axis = chain.above[0].axis
    mimic = axis.mimic if axis else None
    ratio = multiplier(mimic)
    joint = _unpack_elements(joint.copy(axis=_axis_in_sdf(chain.last)), PITCHES)
    written = metres_per_radian(joint)
    # The pitch as it was written, in its own element and unit, unless the ratio of the chain was
    # edited.
    if written is not None and math.isclose(written, ratio, rel_tol=_CLOSE):
        return joint
    return joint.copy(screw_thread_pitch=ratio * math.tau, thread_pitch=None)


def _unpack_elements(joint: Joint, names: tuple[str, ...]) -> Joint:
    """The joint with the elements of these names out of their carriers."""
    opaque: list[Opaque] = []
    pieces: Parts = ()
    for part in joint.opaque:
        if any(name in _element_names(part) for name in names):
            pieces += unpack(part)
        else:
            opaque.append(part)
    try:
        return absorb(joint.copy(opaque=tuple(opaque)), pieces)
    except CarrierError as error:
        raise StaleChainError(str(error)) from error


def _element_names(part: Opaque) -> tuple[str, ...]:
    """The elements in a carrier of SDF that belong into the joint itself."""
    pieces = unpack(part) if is_carrier(part, "sdf") else (part,)
    return tuple(piece.element.name for piece in pieces if piece.element and not piece.at)


AnyPart = TypeVar("AnyPart", Joint, Link)


class FoldJoints(ModelPass):
    """Put ball, universal, revolute2 and screw joints of SDF, which are chains in URDF, together again.

    Changes: 1. the last joint of a chain has its type, parent and place again, and the axes as the chain has them now;
    2. the other joints and the links between go; 3. what mimics the first joint of two mimics `axis` of the one, what
    mimics the last `axis2`.
    Never touches: chains that were edited so that they are not such a joint any more, or of which another joint mimics
    a part that the one joint has no axis for; their annotations go, and
    so does the mimic of a slide that has nothing to follow any more.
    Diagnostics: `stale-carrier`, also for parts whose own names get lost.
    """

    name: ClassVar[str] = "fold-joints"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without chains."""
        annotations = [node for node in (*model.joints, *model.links) if _is_annotated(node)]
        if not annotations:
            return model
        made: dict[str, Joint] = {}
        first: dict[str, str] = {}
        gone: set[str] = set()
        for chain, joint in _fold_chains(model, sink):
            made[joint.name] = joint
            gone |= {part.name for part in (*chain.above, *chain.between)}
            if joint.type in TWO_AXES:
                first[chain.above[0].name] = chain.last.name
        names = {joint.name for joint in model.joints}
        joints = (
            made.get(joint.name) or _without_marks(_without_lost_mimic(joint, names))
            for joint in model.joints
            if joint.name not in gone
        )
        links = (_without_marks(link) for link in model.links if link.name not in gone)
        second = frozenset(first.values())
        followed = tuple(_follow_axes(joint, first, second) for joint in joints)
        return model.copy(joints=followed, links=tuple(links))


def _fold_chains(model: Model, sink: DiagnosticSink) -> Iterator[tuple[JointChain, Joint]]:
    """The intact chains with the joints that they fold into; edited chains are reported."""
    around = ChainNeighbors.of(model)
    for joint in model.joints:
        kind = chain_type(joint)
        if kind is None:
            continue
        try:
            chain = find_chain(joint, kind, around)
            made = folded(chain)
        except StaleChainError as error:
            message = f"joint {joint.name!r} was {kind}, and the chain that it became has changed: {error}"
            sink.report(rules.STALE_CARRIER, message, joint.location, found=joint.name)
        else:
            _report_names(chain, sink)
            yield chain, made


def _report_names(chain: JointChain, sink: DiagnosticSink) -> None:
    """Report the parts of a chain that were renamed by hand, whose names get lost."""
    for part in (*chain.above, *chain.between):
        # A name that somebody gave to a part is one that controllers and plugins of the URDF may
        # know, and the one joint has no place for it.
        if not part.name.startswith(chain.last.name):
            message = f"{part.name!r} is a part of the {chain.kind} joint {chain.last.name!r}, and has no name in SDF"
            sink.report(rules.STALE_CARRIER, message, part.location, found=part.name)


def _is_annotated(node: Joint | Link) -> bool:
    return find_annotation(node, CHAIN) is not None or find_annotation(node, PART) is not None


def _without_marks(node: AnyPart) -> AnyPart:
    """A part of a chain that is not folded, without its annotations."""
    return without_annotation(node, CHAIN, PART)


def _without_lost_mimic(joint: Joint, names: Container[str]) -> Joint:
    """The slide of a screw without its synthesized mimic, if the joint that it mimics is gone."""
    mimic = joint.axis.mimic if joint.axis and part_of(joint) else None
    if joint.axis is None or mimic is None or (mimic.joint or "") in names:
        return joint
    return joint.copy(axis=joint.axis.copy(mimic=None))


def _follow_axes(joint: Joint, first: dict[str, str], second: frozenset[str]) -> Joint:
    update = {field: _follow_axis(getattr(joint, field), first, second) for field in ("axis", "axis2")}
    changed = {field: axis for field, axis in update.items() if axis is not getattr(joint, field)}
    return joint.copy(**changed) if changed else joint


def _follow_axis(axis: Axis | None, first: dict[str, str], second: frozenset[str]) -> Axis | None:
    """The axis with a mimic of a chain joint turned into a mimic of an axis of the folded joint."""
    mimic = axis.mimic if axis else None
    if axis is None or mimic is None:
        return axis
    if mimic.joint in first:
        mimic = mimic.copy(joint=first[mimic.joint])
    elif mimic.joint in second:
        mimic = mimic.copy(axis="axis2")
    return axis if mimic is axis.mimic else axis.copy(mimic=mimic)
