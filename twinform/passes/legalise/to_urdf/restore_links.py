"""Reverse conversion of links and joints: restoring how the URDF source wrote them."""

from collections.abc import Container, Iterator, Mapping
from typing import ClassVar, TypeVar

from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Collision, Element, Frame, Joint, Light, Link, Model, Opaque, Pose, Sensor, Visual
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph
from twinform.passes.carriers.annotations import EXTENSION, find_annotation, without_annotation
from twinform.passes.carriers.carriers import NAMESPACE, carry, is_carrier, unpack
from twinform.passes.legalise.to_sdf.joint_types import FLOATING
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.poses import FRAME, LINK

Placed = TypeVar("Placed", Visual, Collision, Sensor, Light)

_HELD = ("visuals", "collisions", "sensors", "lights")


class RestoreLinks(ToUrdfPass):
    """Make links and joints again of what was a massless link on a fixed joint, or on a floating one.

    Changes: 1. a frame that is annotated as a link is one, and the frame that it is attached to its joint; 2. what the
    link below holds in this frame is the link's, and a joint that
    holds it holds the link below; 3. a link that an annotation calls free hangs from its joint again.
    Never touches: a frame that is not attached to its joint any more; it is made a link like others.
    Diagnostics: `stale-carrier` for these, and for a floating joint that fits the file no more.
    """

    name: ClassVar[str] = "restore-links"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with links and joints in the place of frames."""
        if any(find_annotation(frame, LINK) is not None for frame in model.frames):
            model = _with_links(model, keeper)
        return with_floating_joints(model, keeper)


def _with_links(model: Model, keeper: UrdfKeeper) -> Model:
    pairs = dict(_link_frames(model, keeper))
    graph = FrameGraph(model)
    mounts = {mount.name for mount in pairs.values()}
    held_by = {name: graph.body(name, kind="frame") for name in pairs}
    links = [_without_held(link, {name for name in pairs if held_by[name] == link.name}) for link in model.links]
    joints: list[Joint] = []
    for name, mount in pairs.items():
        frame = next(each for each in model.frames if each.name == name)
        holder = _parent_of(mount, pairs, graph)
        pose = (mount.pose or Pose.unchecked()).copy(
            relative_to=(mount.pose and mount.pose.relative_to) or mount.attached_to or MODEL
        )
        joints.append(
            Joint.unchecked(
                name=mount.name, type="fixed", parent=holder, child=name, pose=pose, opaque=mount.opaque,
                source=mount.source,
            )
        )  # fmt: skip
        own = (frame.pose or Pose.unchecked()).copy(relative_to=mount.name)
        bare = Link.unchecked(name=name, pose=own, opaque=without_annotation(frame, LINK).opaque)
        holders = [link for link in model.links if link.name == held_by[name]]
        if not _will_be_a_frame(frame):  # which goes without saying in a URDF that was one before
            bare = keeper.annotate(bare, FRAME)
        links.append(_with_held(bare.copy(source=frame.source), holders))
    frames = tuple(
        without_annotation(frame, LINK)
        for frame in model.frames
        if frame.name not in pairs and frame.name not in mounts
    )
    joints += [_hold_a_link(joint, held_by) for joint in model.joints]  # after those that hold what was a frame
    return model.copy(links=tuple(links), joints=tuple(joints), frames=frames)


def _hold_a_link(joint: Joint, held_by: dict[str, str]) -> Joint:
    """A joint whose child was a frame, now with the link that the frame moves with as its child."""
    body = held_by.get(joint.child or "")
    # Where an edit closes a circle over such a frame, its own fixed joint comes first, and the
    # joint of the edit is the one that is cut and carried. The other way round, the result could
    # not be read again.
    if body in {None, joint.parent, MODEL, WORLD} or find_annotation(joint, EXTENSION) is not None:
        return joint  # what URDF has elsewhere is no joint of the tree
    pose = joint.pose or Pose.unchecked()
    pose = pose if pose.relative_to else pose.copy(relative_to=joint.child)
    return joint.copy(child=body, pose=pose)


def _link_frames(model: Model, keeper: UrdfKeeper) -> Iterator[tuple[str, Frame]]:
    """The names of frames that were links in URDF, with the frames that were their joints."""
    frames = {frame.name: frame for frame in model.frames}
    taken: set[str] = set()
    for frame in model.frames:
        if find_annotation(frame, LINK) is None:
            continue
        mount = frames.get(frame.attached_to or "")
        if (
            mount is None
            or mount.name in taken
            or find_annotation(mount, LINK) is not None
            or (frame.pose and frame.pose.relative_to not in {None, mount.name})
        ):
            message = f"frame {frame.name!r} was a link on a fixed joint, and is not attached to that joint any more"
            keeper.sink.report(STALE_CARRIER, message, frame.location, found=frame.name)
            continue
        taken.add(mount.name)
        yield frame.name, mount


def _parent_of(mount: Frame, pairs: dict[str, Frame], graph: FrameGraph) -> str:
    """The parent link of the fixed joint that a frame becomes."""
    name = mount.attached_to or MODEL
    joints = {joint.name: link for link, joint in pairs.items()}
    if name in pairs:
        return name
    return joints.get(name) or graph.body(name, kind="link")


def _will_be_a_frame(frame: Frame) -> bool:
    """Whether a carrier of a frame has the annotation by which a link becomes a frame of SDF."""
    carried = (piece.element for part in frame.opaque if is_carrier(part, "urdf") for piece in unpack(part))
    return any(each.name == f"{{{NAMESPACE}}}{FRAME}" for each in carried if each is not None)


def _is_in(node: Placed, names: Container[str]) -> bool:
    return node.pose is not None and (node.pose.relative_to or "") in names


def _without_held(link: Link, frames: set[str]) -> Link:
    """The link without the parts that are posed in one of the frames."""
    if not frames:
        return link
    update: dict[str, object] = {
        field: tuple(each for each in getattr(link, field) if not _is_in(each, frames)) for field in _HELD
    }
    update["opaque"] = tuple(part for part in link.opaque if _frame_of(part) not in frames)
    return link.copy(**update)


def _with_held(link: Link, holders: list[Link]) -> Link:
    """The link with the parts that other links hold in its frame."""
    own = {link.name}
    update: dict[str, object] = {}
    for field in _HELD:
        held = [each for other in holders for each in getattr(other, field) if _is_in(each, own)]
        update[field] = tuple(_pose_in_own_frame(each) for each in held)
    parts = [part for other in holders for part in other.opaque if _frame_of(part) == link.name]
    update["opaque"] = (*link.opaque, *map(_pose_part_in_own_frame, parts))
    return link.copy(**update)


def _pose_in_own_frame(node: Placed) -> Placed:
    pose = node.pose.copy(relative_to=None) if node.pose else None
    return node.copy(pose=None if pose == Pose.unchecked() else pose)


def _frame_of(part: Opaque) -> str | None:
    """The frame in which an untyped element, such as a projector, is posed."""
    pose = part.element.find("pose") if part.element else None
    return pose.get("relative_to") if pose else None


def _pose_part_in_own_frame(part: Opaque) -> Opaque:
    element = part.element
    pose = element.find("pose") if element else None
    if element is None or pose is None:
        return part
    bare = pose.copy(attributes=tuple(pair for pair in pose.attributes if pair[0] != "relative_to"))
    return part.copy(element=element.exchange(pose, bare))


def with_floating_joints(model: Model, keeper: UrdfKeeper) -> Model:
    """The model with its annotated floating joints restored, or reported where they no longer fit."""
    if not _has_annotations(model):
        return model
    joints = list(model.joints)
    for link, annotation, fits in _annotated_links(model):
        name, parent = annotation.get("joint") or "", annotation.get("parent") or ""
        if not fits:
            message = f"link {link.name!r} hung from {parent!r} by the floating joint {name!r}, and no longer can"
            keeper.sink.report(STALE_CARRIER, message, link.location, found=name)
            continue
        joint = Joint.unchecked(
            name=name, type="floating", parent=parent, child=link.name, pose=Pose.unchecked(relative_to=link.name)
        )
        rest = [Opaque.unchecked(element=child) for child in annotation.children]
        joints.append(carry(joint.copy(source=link.source), rest, "urdf"))
    links = tuple(without_annotation(link, FLOATING) for link in model.links)
    return model.copy(links=links, joints=tuple(joints))


def without_loose_floating(model: Model) -> Model:
    """The model without annotations of floating joints that no longer fit."""
    if not _has_annotations(model):
        return model
    loose = {link.name for link, _, fits in _annotated_links(model) if not fits}
    links = (without_annotation(link, FLOATING) if link.name in loose else link for link in model.links)
    return model.copy(links=tuple(links))


def _has_annotations(model: Model) -> bool:
    return any(find_annotation(link, FLOATING) is not None for link in model.links)


def _annotated_links(model: Model) -> Iterator[tuple[Link, Element, bool]]:
    """Each annotated link, its annotation, and whether its floating joint can be restored."""
    graph = FrameGraph(model)
    # A joint that URDF has elsewhere holds no link there: a free one may be at an end of it.
    own = (joint for joint in model.joints if find_annotation(joint, EXTENSION) is None)
    holders = {joint.child: joint.parent or WORLD for joint in own if joint.child}
    names = {joint.name for joint in model.joints}
    for link in model.links:
        annotation = find_annotation(link, FLOATING)
        if annotation is None:
            continue
        name, parent = annotation.get("joint"), annotation.get("parent")
        fits = bool(name) and name not in names and link.name not in holders
        # A joint that an edit added may have put the old parent below the link: the floating joint
        # would close a circle.
        fits = fits and parent is not None and not _hangs_below(link.name, parent, holders, graph)
        if fits and name and parent:
            names.add(name)
            holders[link.name] = parent
        yield link, annotation, fits


def _hangs_below(link: str, name: str, holders: Mapping[str, str], graph: FrameGraph) -> bool:
    """Whether a frame or link hangs from a link, or does not exist."""
    seen: set[str] = set()
    while name != WORLD:
        try:
            name = graph.body(name, kind="link")
        except FrameError:
            return True
        if name == link:
            return True
        if name in seen or name not in holders:
            return False
        seen.add(name)
        name = holders[name]
    return False
