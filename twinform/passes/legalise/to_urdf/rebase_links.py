"""In URDF the frame of a link is the frame of its joint."""

from dataclasses import dataclass
from functools import partial
from typing import ClassVar, TypeVar

from twinform.diagnostics import NOWHERE
from twinform.diagnostics.rules import to_urdf as rules
from twinform.ir import (
    Collision,
    Element,
    Inertial,
    Joint,
    Light,
    Link,
    Model,
    Node,
    Opaque,
    Pose,
    Sensor,
    Visual,
    count_parts,
)
from twinform.ir.frames import WORLD, FrameGraph, Kind
from twinform.passes.legalise.element_poses import ElementPoses
from twinform.passes.legalise.marks import made_fields, mark_made
from twinform.passes.legalise.nodes import pose_piece
from twinform.passes.legalise.notation import in_radians
from twinform.passes.legalise.to_urdf.base import ToUrdfPass
from twinform.passes.legalise.to_urdf.keeper import Keeper

AnyNode = TypeVar("AnyNode", bound=Node)
AnyPosed = TypeVar("AnyPosed", Inertial, Visual, Collision, Sensor, Light)

_Base = tuple[str, Kind]


class RebaseLinks(ToUrdfPass):
    """Move every link's frame onto the joint that carries it; nothing in the robot moves.

    Changes: 1. a joint's pose is relative to its parent link, a link's to its joint, with no offset; 2. the poses in a
    link, of sensors and lights too, are relative to the moved frame, in radians where URDF writes them; 3. the root
    link is the model's frame: the model's pose is the root's, or none where the root is `world`. Numbers stay as they
    are where nothing moves.
    Diagnostics: in the ledger `moved-frame` for every pose that is written in another way than it was.
    """

    name: ClassVar[str] = "rebase-links"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model with each link in the frame of its joint."""
        graph = FrameGraph(model)
        carried_by = {joint.child or "": joint.name for joint in model.joints}
        bases: dict[str, _Base] = {WORLD: (WORLD, "world")}
        for link in model.links:
            joint = carried_by.get(link.name)
            bases[link.name] = (link.name, "link") if joint is None else (joint, "joint")
        links = tuple(_Rebase(graph, link.name, bases[link.name], keeper).link(link) for link in model.links)
        joints = tuple(_place_joint(joint, graph, bases[joint.parent or WORLD], keeper) for joint in model.joints)
        roots = [link.name for link in model.links if link.name not in carried_by]
        model = model.model_copy(update={"links": links, "joints": joints})
        return _place_model(model, graph, roots, keeper)


@dataclass(frozen=True, slots=True)
class _Rebase:
    """One link or joint and the frame that the poses in it are to be in."""

    graph: FrameGraph
    name: str
    base: _Base
    keeper: Keeper
    kind: Kind = "link"

    def link(self, link: Link) -> Link:
        """The link and all in it in the frame of its joint."""
        offset = self.graph.pose(link.name, self.base[0], base=self.base[1])
        still = offset.is_identity
        elements = ElementPoses(self.graph, self.name, self.base, partial(_keep_element_pose, self.keeper))
        update: dict[str, object] = {
            "inertial": link.inertial and self._move(link.inertial, "inertial", still=still),
            "visuals": tuple(self._move(visual, "visual", still=still) for visual in link.visuals),
            "collisions": tuple(self._move(collision, "collision", still=still) for collision in link.collisions),
            "sensors": tuple(elements.sensor(self._move(one, "sensor", still=still), one.pose) for one in link.sensors),
            "lights": tuple(self._move(light, "light", still=still) for light in link.lights),
            "opaque": elements.parts(link.opaque, still=still),
        }
        return self._own_pose(link.model_copy(update=update))

    def joint(self, joint: Joint) -> Joint:
        """The joint with its sensors in its own frame."""
        elements = ElementPoses(self.graph, self.name, self.base, partial(_keep_element_pose, self.keeper), "joint")
        moved = tuple(elements.sensor(self._move(one, "sensor", still=True), one.pose) for one in joint.sensors)
        return joint.model_copy(update={"sensors": moved}) if moved else joint

    def _own_pose(self, link: Link) -> Link:
        name, kind = self.base
        written, made = link.pose, Pose(relative_to=name) if kind == "joint" else None
        moved = link.model_copy(update={"pose": made})
        if written == made or {".", "pose"} & {*made_fields(link)}:
            return moved
        if written is None:
            return mark_made(moved, "pose")
        message = f"the frame of link {link.name!r} is that of its joint {name!r}"
        if kind != "joint":
            message = f"link {link.name!r} is the root, whose frame is that of the robot"
        return self._keep(moved, written, message)

    def _move(self, holder: AnyPosed, tag: str, *, still: bool) -> AnyPosed:
        written = holder.pose
        if still and (written is None or _is_plain(written)):
            return holder
        transform = self.graph.resolve(written, self.name, self.base[0], kind=self.kind, base=self.base[1])
        made = transform.to_pose() if tag in {"sensor", "light"} else in_radians(transform)
        if written is None or "pose" in made_fields(holder):
            return mark_made(holder.model_copy(update={"pose": made}), "pose")
        moved = holder.model_copy(update={"pose": made})
        name = getattr(holder, "name", None)
        message = (
            f"the pose of the {tag} {name!r} is written in another way" if name else f"the pose of the {tag} moved"
        )
        return moved if made == written else self._keep(moved, written, f"{message} ({self.kind} {self.name!r})")

    def _keep(self, node: AnyNode, written: Pose, message: str) -> AnyNode:
        where, weight = written.location, count_parts(written)
        return self.keeper.keep(node, [pose_piece(written)], rules.MOVED_FRAME, message, where, weight)


def _is_plain(pose: Pose) -> bool:
    """Whether URDF can write it as it is."""
    return not (pose.relative_to or pose.degrees or pose.quat_xyzw or pose.rotation_format or pose.opaque)


def _keep_element_pose(keeper: Keeper, message: str, pose: Element) -> tuple[Element, ...]:
    kept = keeper.keep(Node(), [Opaque(element=pose)], rules.MOVED_FRAME, message, NOWHERE)
    return tuple(part.element for part in kept.opaque if part.element)


def _place_joint(joint: Joint, graph: FrameGraph, base: _Base, keeper: Keeper) -> Joint:
    written = joint.pose
    made = in_radians(graph.pose(joint.name, base[0], kind="joint", base=base[1]), joint.parent)
    placed = _Rebase(graph, joint.name, (joint.name, "joint"), keeper, "joint").joint(joint)
    placed = placed.model_copy(update={"pose": made})
    if written == made or "." in made_fields(joint):
        return placed
    if written is None:
        return mark_made(placed, "pose") if made != Pose(relative_to=joint.parent) else placed
    message = f"the pose of joint {joint.name!r} is relative to its parent link"
    weight = count_parts(written)
    return keeper.keep(placed, [pose_piece(written)], rules.MOVED_FRAME, message, written.location, weight)


def _place_model(model: Model, graph: FrameGraph, roots: list[str], keeper: Keeper) -> Model:
    """The pose of the root, which is the robot's frame."""
    written = model.pose
    if roots:
        placed = graph.pose(roots[0], WORLD)
        made = None if placed.is_identity and placed.notation is None else placed.to_pose()
    else:
        made = None
    moved = model.model_copy(update={"pose": made})
    if written == made:
        return moved
    if written is None:
        return mark_made(moved, "pose")
    message = f"the pose of model {model.name!r} is that of its root link {(roots or [WORLD])[0]!r}"
    weight = count_parts(written)
    return keeper.keep(moved, [pose_piece(written)], rules.MOVED_FRAME, message, written.location, weight)
