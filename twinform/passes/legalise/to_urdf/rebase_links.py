"""Moving each link frame to the frame of its joint, as URDF requires."""

from collections.abc import Iterator, Mapping
from typing import ClassVar, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import NOWHERE, Fate, Location, rules
from twinform.ir import (
    PLAIN,
    Element,
    Joint,
    Light,
    Link,
    Model,
    Node,
    Pose,
    Sensor,
    bits_of,
    census_of,
    count_parts,
)
from twinform.ir.frames import MODEL, WORLD, FrameGraph, Kind
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import REVERSED, annotation, find_annotation, is_synthesized
from twinform.passes.carriers.joint_chains import part_of
from twinform.passes.carriers.old_names import NAME
from twinform.passes.legalise.changed_names import SCOPED_NAME
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.joint_ends import joint_pose_attributes
from twinform.passes.shared.poses import (
    FRAME,
    OFFSET,
    POSE,
    AnyPosed,
    Base,
    ElementPoses,
    Posed,
    Rebasing,
    in_urdf,
    offset_attributes,
    pose_attributes,
)
from twinform.request_options import UrdfVersion

AnyNode = TypeVar("AnyNode", bound=Node)
_MOVED = PLAIN | bits_of(Pose, "relative_to", "degrees", "quat_xyzw", "rotation_format")
"""The census bits of parts whose pose is more than six numbers in the frame of the link."""


class RebaseLinks(ToUrdfPass):
    """Move every link's frame onto the joint that carries it; nothing in the robot moves.

    Changes: 1. a joint's pose is relative to its parent link, a link's to its joint, with no offset: in a model that
    came from URDF a fixed joint moves to its link; 2. the poses in a link, of sensors and lights too, are relative to
    the moved frame, in radians where URDF writes them, but in a model that came from URDF those of sensors and lights
    go on naming links; 3. the root link is the model's frame: the model's pose is the root's, or none where the root is
    `world`. Numbers stay as they are where nothing moves. Annotations record where the frames of links, fixed joints
    and model were, and in which frames poses were written.
    Diagnostics: in the ledger `moved-frame` for every pose that is written in another way than it was.
    """

    name: ClassVar[str] = "rebase-links"
    urdf_version: UrdfVersion = "1.0"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with each link in the frame of its joint."""
        graph = FrameGraph(model)
        carried_by = {joint.child or "": joint for joint in model.joints}
        bases: dict[str, Base] = {WORLD: (WORLD, "world")}
        bases |= {link.name: keeper.frame_of(link.name, carried_by.get(link.name)) for link in model.links}
        framed = frozenset(joint.child or "" for joint in model.joints if _is_of_frame(joint))
        named = _unmoved_links(model, graph, bases) if keeper.back else frozenset[str]()
        links = tuple(
            _Rebase(graph, link.name, bases[link.name], keeper, self.urdf_version, framed=framed, named=named).link(
                link, carried_by.get(link.name)
            )
            for link in model.links
        )
        joints = tuple(_place_joint(joint, graph, bases, keeper, self.urdf_version) for joint in model.joints)
        roots = [link.name for link in model.links if link.name not in carried_by]
        model = model.copy(links=links, joints=joints)
        return _place_model(model, graph, roots, keeper)


@dataclass(frozen=True, slots=True)
class _Rebase:
    """Moves the poses in one link or joint into the frame `base`."""

    graph: FrameGraph
    name: str
    base: Base
    keeper: UrdfKeeper
    urdf_version: UrdfVersion
    kind: Kind = "link"
    framed: frozenset[str] = frozenset()
    """Links that are frames in SDF, which have ledger entries of their own."""
    named: frozenset[str] = frozenset()
    """Links that the poses of sensors and lights may go on naming, as in `<gazebo>`."""

    @property
    def poses(self) -> Rebasing:
        elements = ElementPoses(self.graph, self.name, self.base, self._annotate_element, self.kind, stays=self.named)
        return Rebasing(self.graph, self.name, self.kind, self.base, elements, self._write, self._stays)

    def _stays(self, holder: Posed) -> bool:
        """Whether the pose of a part can be written unchanged, in URDF or in an extension."""
        named = holder.pose.relative_to if holder.pose and isinstance(holder, Sensor | Light) else None
        return _is_plain(holder) or named in self.named

    def link(self, link: Link, joint: Joint | None) -> Link:
        """The link with its parts in the frame that it has in URDF; `joint` is the one that carries it."""
        offset = self.graph.pose(link.name, self.base[0], base=self.base[1])
        if not offset.is_identity or link.opaque or any(map(_may_move, _parts(link))):
            link = self.poses.link(link)
        return self._own_pose(link, joint, offset)

    def _own_pose(self, link: Link, joint: Joint | None, offset: Transform) -> Link:
        written, made = link.pose, Pose.unchecked(relative_to=joint.name) if joint else None
        moved = link.copy(pose=made)
        if is_synthesized(link) or part_of(link) is not None:
            return moved
        if not offset.is_identity:
            # An offset and no poses: the reverse conversion applies it to all that is in the link
            # by then, also to what was added by hand or by a pass.
            moved = self.keeper.annotate(moved, OFFSET, attributes=offset_attributes(offset), always=True)
        if find_annotation(link, FRAME) is None:
            moved = self._annotate_pose(moved, written)
        if written is not None and written != made and _is_written(written, link) and link.name not in self.framed:
            message = f"link {link.name!r} is the root, whose frame is that of the robot"
            if joint is not None:
                message = f"the frame of link {link.name!r} is that of its joint {joint.name!r}"
            _account_for_pose(self.keeper, message, written, written.location)
        return moved

    def _write(self, holder: AnyPosed, tag: str, transform: Transform) -> AnyPosed:
        written = holder.pose
        made = transform.to_pose() if tag in {"sensor", "light"} else in_urdf(transform, None, self.urdf_version)
        moved = holder.copy(pose=made)
        if written is None or made == written:
            return moved
        name = getattr(holder, "name", None)
        message = (
            f"the pose of the {tag} {name!r} is written differently in URDF" if name else f"the pose of the {tag} moved"
        )
        message = f"{message} ({self.kind} {self.name!r})"
        _account_for_pose(self.keeper, message, written, written.location)
        return self._annotate_pose(moved, written, notation=made)

    def _annotate_pose(self, node: AnyNode, written: Pose | None, *, notation: Pose | None = None) -> AnyNode:
        attributes = pose_attributes(written)
        if attributes.get("relative_to") == _scope_of(node):
            del attributes["relative_to"]
        if notation is not None and notation.degrees == (written and written.degrees):
            attributes = {name: text for name, text in attributes.items() if name != "degrees"}
        return self.keeper.annotate(node, POSE, attributes=attributes) if attributes else node

    def _annotate_element(self, message: str, written: Pose) -> tuple[Element, ...]:
        _account_for_pose(self.keeper, message, written, NOWHERE)
        attributes = pose_attributes(written)
        made = annotation(POSE, attributes=attributes).element if attributes else None
        return (made,) if made and self.keeper.carriers and not self.keeper.back else ()


def _account_for_pose(keeper: UrdfKeeper, message: str, written: Pose, where: Location) -> None:
    """Enter a moved pose into the ledger, and as dropped what it holds besides numbers."""
    rest = sum(part.weight for part in written.opaque)
    keeper.account(rules.MOVED_FRAME, message, where, count_parts(written) - rest)
    for part in written.opaque:
        lost = f"no reader uses {part.name} in a <pose>, and URDF has six numbers there"
        keeper.sink.account(Fate.DROPPED, rules.SDF_ONLY, lost, part.location_in(written), part.weight)


def _parts(link: Link) -> Iterator[Posed]:
    if link.inertial:
        yield link.inertial
    for parts in (link.visuals, link.collisions, link.sensors, link.lights):
        yield from parts


def _may_move(part: Posed) -> bool:
    """Whether the pose of a part is more than six numbers."""
    return census_of(part) & _MOVED != 0 or (part.pose is not None and bool(part.pose.opaque))


def _unmoved_links(model: Model, graph: FrameGraph, bases: dict[str, Base]) -> frozenset[str]:
    """The links whose frames and names stay the same in URDF."""
    return frozenset(
        link.name
        for link in model.links
        if find_annotation(link, NAME) is None
        and graph.pose(link.name, bases[link.name][0], base=bases[link.name][1]).is_identity
    )


def _scope_of(node: Node) -> str:
    """The frame of the nested model that a link was in, the default frame of its pose."""
    found = find_annotation(node, SCOPED_NAME)
    return (found.text or "").rpartition("::")[0].replace("::", "__") if found else ""


def _is_of_frame(joint: Joint) -> bool:
    """Whether a joint was synthesized to fix a frame that became a link."""
    return joint.type == "fixed" and joint.parent != WORLD and is_synthesized(joint)


def _is_written(pose: Pose, holder: Link | Joint) -> bool:
    """Whether a pose was read from the file, not made by a pass."""
    return pose.source is not None or holder.source is None


def _is_plain(holder: Posed) -> bool:
    """Whether URDF can write the pose of a part unchanged."""
    pose = holder.pose
    return pose is None or not (
        pose.relative_to or pose.degrees or pose.quat_xyzw or pose.rotation_format or pose.opaque
    )


def _place_joint(
    joint: Joint, graph: FrameGraph, bases: Mapping[str, Base], keeper: UrdfKeeper, version: UrdfVersion
) -> Joint:
    written = joint.pose
    (name, kind), (parent, held) = bases.get(joint.child or "", (joint.name, "joint")), bases[joint.parent or WORLD]
    made = in_urdf(graph.pose(name, parent, kind=kind, base=held), joint.parent, version)
    rebase = _Rebase(graph, joint.name, (name, kind), keeper, version, "joint")
    placed = rebase.poses.joint(joint).copy(pose=made)
    offset = graph.pose(joint.name, name, kind="joint", base=kind)
    if not offset.is_identity:
        placed = keeper.annotate(placed, OFFSET, attributes=offset_attributes(offset), always=True)
    if written is None or is_synthesized(joint):
        return placed
    if written != made and _is_written(written, joint):
        message = f"the pose of joint {joint.name!r} is relative to its parent link"
        _account_for_pose(keeper, message, written, written.location)
    attributes = {} if find_annotation(joint, REVERSED) else joint_pose_attributes(joint)
    return keeper.annotate(placed, POSE, attributes=attributes) if attributes else placed


def _place_model(model: Model, graph: FrameGraph, roots: list[str], keeper: UrdfKeeper) -> Model:
    """The model with the pose of its root link, whose frame is that of the robot."""
    written, root = model.pose, roots[0] if roots else WORLD
    made = None
    if roots:
        placed = graph.pose(root, WORLD, base="world")
        made = None if placed.is_identity and placed.notation is None else placed.to_pose()
    moved = model.copy(pose=made)
    offset = graph.pose(MODEL, root, kind="model", base="link" if roots else "world")
    if not offset.is_identity:
        moved = keeper.annotate(moved, OFFSET, attributes=offset_attributes(offset))
    if written is None or written == made:
        return moved
    message = f"the pose of model {model.name!r} is that of its root link {root!r}"
    _account_for_pose(keeper, message, written, written.location)
    attributes = pose_attributes(written)
    return keeper.annotate(moved, POSE, attributes=attributes) if attributes else moved
