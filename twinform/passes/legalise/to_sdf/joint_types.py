"""Conversion of URDF joint types, axes and limits to SDF, and of planar joints to chains."""

from collections.abc import Mapping
from typing import ClassVar, NamedTuple, TypeVar

from twinform.diagnostics import DiagnosticSink, Rule, rules
from twinform.ir import Axis, Element, Format, Joint, Limit, Link, Mimic, Model, Opaque, Pose, count_parts
from twinform.ir.defaults import AXIS, direction, with_range
from twinform.ir.motion import plane_across
from twinform.ir.verify.verify_joints import useless_leader
from twinform.passes.carriers.annotations import (
    SYNTHESIZED,
    annotate_synthesized,
    came_from,
    is_synthesized,
    without_annotation,
)
from twinform.passes.carriers.carriers import NAMESPACE, Keeper, carry, to_element
from twinform.passes.carriers.token_mass import TOKEN
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.free_links import links_in_static_models, needs_no_joint
from twinform.passes.legalise.urdf_pieces import OF_AN_AXIS
from twinform.passes.shared.nodes import reserve_name
from twinform.schemas import format_value

FLOATING = "floating"
"""The annotation on a link of SDF with the floating joint of URDF that leaves it free."""
_BESIDE_AXIS = OF_AN_AXIS - {"axis"}
Made = TypeVar("Made", Link, Joint)


class UrdfJoints(ModelPass):
    """Convert the types, default axes and default limits of URDF to SDF.

    Changes: 1. a `fixed` joint loses its axis, limits and the like, which are carried; 2. a `continuous` joint is
    `revolute` without limits, as no engine of Gazebo knows the other, and loses lower and upper, which URDF ignores; 3.
    a joint that moves gets its axis written, 1 0 0 where URDF leaves it out; 4. a revolute or prismatic joint gets its
    limits written, 0 where URDF leaves them out; 5. a `floating` joint goes, and so does one synthesized to fix a
    static model, or one in the model, to the world; its child link is posed where it was; 6. limits of acceleration and
    jerk, which SDF lacks, are carried; 7. a `planar` joint becomes two sliding joints and a turning one, with two links
    without mass between them, all of them annotated so that they become one again; 8. a `mimic` of what has no axis,
    which libsdformat refuses, is carried.
    Never touches: names, origins, parents, children.
    Diagnostics: `joint-chain`; ledger entries under `urdf-only` and `no-joint`.
    """

    name: ClassVar[str] = "urdf-joints"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with joints of SDF."""
        held = links_in_static_models(model)
        free = {joint.child: joint for joint in model.joints if needs_no_joint(joint, held)}
        # urdfdom takes a <mimic> of a fixed joint, of the joint itself or of none; libsdformat
        # refuses the whole file since version 14. The joint is free then, as it is for other
        # readers of the URDF.
        mimicking = self._without_useless_mimics(model, sink) if any(map(_mimic_of, model.joints)) else model.joints
        joints = tuple(self._joint(joint, sink) for joint in mimicking if not needs_no_joint(joint, held))
        links = model.links
        if free:
            links = tuple(
                self._free(link, free[link.name], sink, held) if link.name in free else link for link in links
            )
        model = model.copy(joints=joints, links=links)
        return self._unfold(model, sink) if any(joint.type == "planar" for joint in joints) else model

    def _without_useless_mimics(self, model: Model, sink: DiagnosticSink) -> tuple[Joint, ...]:
        """The joints without mimics that libsdformat refuses since SDF 1.11; those that came from SDF stay."""
        if came_from(model, Format.SDF):
            return model.joints
        known = {joint.name: joint for joint in model.joints}
        return tuple(self._without_useless_mimic(joint, known, sink) for joint in model.joints)

    def _without_useless_mimic(self, joint: Joint, known: Mapping[str, Joint], sink: DiagnosticSink) -> Joint:
        mimic = _mimic_of(joint)
        if joint.axis is None or mimic is None or not useless_leader(joint, mimic, known):
            return joint
        pieces = to_element(joint, "joint", "urdf").find_all("mimic")
        axis = joint.axis.copy(mimic=None)
        bare = joint.copy(axis=None if axis == Axis.unchecked() else axis)
        message = f"joint {joint.name!r} cannot mimic {mimic.joint!r} in SDF"
        return self._keep(bare, [Opaque.unchecked(element=each) for each in pieces], message, sink)

    def _unfold(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with each planar joint replaced by a chain."""
        taken = {node.name for node in (*model.links, *model.joints, *model.frames)}
        links: dict[str | None, tuple[Link, ...]] = {}
        joints: list[Joint] = []
        for joint in model.joints:
            if joint.type != "planar":
                joints.append(joint)
                continue
            # no pass synthesizes a planar joint, so whoever made it one has changed what was synthesized
            planar = without_annotation(joint, SYNTHESIZED)
            chain = planar_chain(planar, planar_names(joint.name, taken))
            links[joint.child] = tuple(self._mark_synthesized(link) for link in chain.links)
            slide, shift, turn = chain.joints
            joints += [
                self._mark_synthesized(slide),
                self._mark_synthesized(shift),
                self._was_planar(turn, joint, sink),
            ]
        every = tuple(one for link in model.links for one in (*links.get(link.name, ()), link))
        return model.copy(links=every, joints=tuple(joints))

    def _mark_synthesized(self, node: Made) -> Made:
        return annotate_synthesized(node) if self.carriers else node

    def _was_planar(self, turn: Joint, joint: Joint, sink: DiagnosticSink) -> Joint:
        message = f"planar joint {joint.name!r} is two sliding joints and a turning one in SDF, with links without mass"
        sink.report(rules.JOINT_CHAIN, message, joint.location.at("@type"), found="planar")
        rest = [child for child in to_element(joint, "joint", "urdf").children if child.name in _BESIDE_AXIS]
        pieces = [Opaque.unchecked(attribute=("type", "planar")), *(Opaque.unchecked(element=child) for child in rest)]
        return self._keep(turn, pieces, f"planar joint {joint.name!r} is a chain of joints", sink, rules.JOINT_CHAIN)

    def _free(self, link: Link, joint: Joint, sink: DiagnosticSink, held: frozenset[str]) -> Link:
        freed = link.copy(pose=joint.pose)
        # The joints that are made for a static model are fixed: an edit has let this one go.
        is_let_go = joint.type == "floating" and link.name in held
        if is_synthesized(joint) and not is_let_go:
            return freed
        message = f"joint {joint.name!r} leaves link {link.name!r} free, which needs no joint in SDF"
        element = to_element(joint.copy(pose=None), "joint", "urdf")
        Keeper(sink, self.carriers).account(rules.NO_JOINT, message, joint.location, count_parts(joint))
        if not self.carriers:
            return freed
        rest = tuple(child for child in element.children if child.name not in {"parent", "child"})
        attributes = (("joint", joint.name), ("parent", joint.parent or ""))
        annotation = Element.unchecked(name=f"{{{NAMESPACE}}}{FLOATING}", attributes=attributes, children=rest)
        return freed.copy(opaque=(*freed.opaque, Opaque.unchecked(element=annotation)))

    def _joint(self, joint: Joint, sink: DiagnosticSink) -> Joint:
        match joint.type:
            case "fixed":
                return self._without_axis(joint, sink)
            case "revolute" | "prismatic" | "continuous":
                return self._moving(joint, sink)
            case "ball":
                return self._ball(joint, sink)
            case "planar" | "universal" | "revolute2" | "screw" | "gearbox":
                return joint  # SDF's own, from a <gazebo> element
            case _:
                message = f"joint {joint.name!r} is {joint.type!r}, which SDF has no joint for"
                sink.report(rules.JOINT_TYPE_UNSUPPORTED, message, joint.location.at("@type"), found=joint.type)
                return joint

    def _ball(self, joint: Joint, sink: DiagnosticSink) -> Joint:
        """The ball joint with its axis, whose damping counts, but without a zero direction, which SDF forbids."""
        if joint.axis is not None and joint.axis.xyz is not None and not any(joint.axis.xyz):
            written = " ".join(format_value(each) for each in joint.axis.xyz)
            joint = joint.copy(axis=joint.axis.copy(xyz=None))
            pieces = [Opaque.unchecked(at="axis", attribute=("xyz", written))]
            joint = self._keep(joint, pieces, f"the axis of joint {joint.name!r} has no direction", sink)
        limit = joint.axis.limit if joint.axis else None
        if joint.axis is None or limit is None:
            return joint
        limit, rest = _without(limit, _HIGHER)
        joint = joint.copy(axis=joint.axis.copy(limit=limit))
        return self._keep(joint, rest, f"SDF has no equivalent of these limits of joint {joint.name!r}", sink)

    def _without_axis(self, joint: Joint, sink: DiagnosticSink) -> Joint:
        if joint.axis is None:
            return joint
        # Carriers and the like, which most joints have more of, are not written for that.
        opaque = tuple([part for part in joint.opaque if _first_step(part) in OF_AN_AXIS])
        alone = Joint.unchecked(name=joint.name, type=joint.type, axis=joint.axis, opaque=opaque)
        rest = [child for child in to_element(alone, "joint", "urdf").children if child.name in OF_AN_AXIS]
        kept = joint.copy(axis=None)
        message = f"the {joint.type} joint {joint.name!r} has no axis"
        return self._keep(kept, [Opaque.unchecked(element=child) for child in rest], message, sink)

    def _moving(self, joint: Joint, sink: DiagnosticSink) -> Joint:
        axis = joint.axis or Axis.unchecked()
        limit, rest = _limit(joint, axis.limit)
        update: dict[str, object] = {}
        if limit is not axis.limit:
            update["limit"] = limit
        if axis.xyz is None:
            # The default axis is x in URDF and z in SDF.
            update["xyz"] = AXIS[Format.URDF]
        if joint.type == "continuous":
            # DART makes a `continuous` joint a fixed one. SDF's revolute joint without limits is
            # the same joint.
            joint = joint.copy(type="revolute")
        if not update:
            return joint
        joint = joint.copy(axis=axis.copy(**update))
        return self._keep(joint, rest, f"SDF has no equivalent of these limits of joint {joint.name!r}", sink)

    def _keep(
        self, joint: Joint, rest: list[Opaque], message: str, sink: DiagnosticSink, rule: Rule = rules.URDF_ONLY
    ) -> Joint:
        for part in rest:
            Keeper(sink, self.carriers).account(rule, f"{message}: {part.name}", joint.location, part.weight)
        return carry(joint, rest, "urdf") if self.carriers else joint


_HIGHER = ("acceleration", "deceleration", "jerk")


def _limit(joint: Joint, limit: Limit | None) -> tuple[Limit | None, list[Opaque]]:
    """The limit in SDF, and the attributes of the URDF limit that SDF lacks."""
    if limit is None:
        return None, []
    unsaid = (*_HIGHER, "lower", "upper") if joint.type == "continuous" else _HIGHER
    limit, rest = _without(limit, unsaid)
    return limit if joint.type == "continuous" else with_range(limit, Format.URDF), rest


def _mimic_of(joint: Joint) -> Mimic | None:
    return joint.axis.mimic if joint.axis else None


def _without(limit: Limit, names: tuple[str, ...]) -> tuple[Limit, list[Opaque]]:
    """The limit without the named fields, and these as attributes of URDF."""
    written = [(name, getattr(limit, name)) for name in names if getattr(limit, name) is not None]
    rest = [Opaque.unchecked(at="limit", attribute=(name, format_value(value))) for name, value in written]
    return (limit.copy(**{name: None for name, _ in written}) if written else limit), rest


Names = tuple[str, str, str, str]
"""The names of the first sliding joint and its link, and of the second ones."""


class PlanarChain(NamedTuple):
    """Two sliding joints with the links that they move, and the turning joint, which keeps name and child."""

    links: tuple[Link, Link]
    joints: tuple[Joint, Joint, Joint]


def planar_names(joint: str, taken: set[str]) -> Names:
    """The names in the chain of a planar joint, made unique and added to the taken ones."""
    return (
        reserve_name(f"{joint}_x", taken),
        reserve_name(f"{joint}_x_link", taken),
        reserve_name(f"{joint}_y", taken),
        reserve_name(f"{joint}_y_link", taken),
    )


def planar_chain(joint: Joint, names: Names) -> PlanarChain:
    """The chain of a planar joint of URDF.

    All axes are in the frame of the joint, whose x and y span the plane if its normal is z. The links between have a
    token mass, so that engines can move them and the robot keeps its mass.
    """
    normal = direction(joint.axis, Format.URDF)
    along, across = plane_across(normal)
    first, first_link, second, second_link = names
    source = joint.source
    slide = Joint.unchecked(
        name=first,
        type="prismatic",
        parent=joint.parent,
        child=first_link,
        pose=joint.pose,
        axis=Axis.unchecked(xyz=along),
        source=source,
    )
    shift = Joint.unchecked(
        name=second,
        type="prismatic",
        parent=first_link,
        child=second_link,
        pose=Pose.unchecked(relative_to=first_link),
        axis=Axis.unchecked(xyz=across),
        source=source,
    )
    turn = joint.copy(
        type="revolute",
        parent=second_link,
        pose=Pose.unchecked(relative_to=second_link),
        axis=Axis.unchecked(xyz=normal),
    )
    links = (
        # Any mass worth the name would change the mass matrix of the robot.
        Link.unchecked(name=first_link, pose=Pose.unchecked(relative_to=first), inertial=TOKEN, source=source),
        Link.unchecked(name=second_link, pose=Pose.unchecked(relative_to=second), inertial=TOKEN, source=source),
    )
    return PlanarChain(links, (slide, shift, turn))


def _first_step(part: Opaque) -> str:
    """The element of a joint that an opaque part is in, or is itself."""
    return part.at.partition("/")[0] or (part.element.name if part.element else "")
