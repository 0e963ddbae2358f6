"""Links without mass on fixed joints of URDF, which are frames in SDF, and frames of SDF that become such links."""

from collections import Counter
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import (
    Collision,
    Element,
    Format,
    Frame,
    Joint,
    Light,
    Link,
    Model,
    Opaque,
    Pose,
    Sensor,
    Visual,
    count_parts,
)
from twinform.ir.frames import MODEL, FrameError, FrameGraph
from twinform.passes.carriers.annotations import (
    EXTENSION,
    SYNTHESIZED,
    annotate_synthesized,
    came_from,
    find_annotation,
    is_synthesized,
    with_annotation,
    without_annotation,
)
from twinform.passes.carriers.carriers import Keeper, carry, is_ours, pack, to_element
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.joint_notation import without_reversals
from twinform.passes.legalise.shape_names import name_all
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.gazebo_tags import FLAGS, flag_tags
from twinform.passes.shared.nodes import reserve_name
from twinform.passes.shared.poses import FRAME, LINK, POSE, pose_attributes

Placed = TypeVar("Placed", Visual, Collision, Sensor, Light)

_FLAGS = ("gravity", "enable_wind", "self_collide", "kinematic")


class FrameLinks(ModelPass):
    """Turn a link without mass on a fixed joint into SDF's `<frame>`, and its joint into another one.

    Changes: 1. the joint becomes a frame attached to its parent, with the joint's origin; 2. the link becomes a frame
    attached to that one, and is annotated as a link of URDF; 3. visuals, collisions, sensors and lights move to the
    nearest link above that stays a link, and are posed in the link's frame as before. Joints below keep the link's name
    as their parent.
    Never touches: links with mass; a link fixed to the world, which has no link above; one whose joint has a sensor,
    which would have no place; one on a joint of SDF in a `<gazebo>` element, which may close a circle; one with two
    parents.
    Diagnostics: none; ledger entries under `frame-link` for what a frame cannot have.
    """

    name: ClassVar[str] = "frame-links"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without massless links on fixed joints."""
        links = {link.name: link for link in model.links}
        stays = came_from(model, Format.SDF)  # where frames are annotated
        above = Counter(joint.child for joint in model.joints)
        moved = {
            joint.child: joint
            for joint in model.joints
            if joint.type == "fixed"
            # A massless root stays a link, although a massive child may be fixed to it: as a frame
            # it would leave another link as the root of every program that asks for it.
            and joint.parent in links
            and joint.child in links
            and above[joint.child] == 1  # another one would connect what the frame is on to itself
            # A force-torque sensor measures what goes through the joint, and often sits in front of
            # a massless frame with the tool behind it.
            and not joint.sensors
            and find_annotation(joint, EXTENSION) is None
            and is_massless(links[joint.child])
            and not (stays and (find_annotation(links[joint.child], FRAME) is None or links[joint.child].inertial))
        }
        if not moved:
            return model
        guests: dict[str, list[Link]] = {}
        anchors: dict[str, str] = {}
        for name in moved:
            guests.setdefault(_find_anchor(name, moved, anchors), []).append(links[name])
        frames = [frame for joint in moved.values() for frame in self._frames(joint, links[joint.child or ""], sink)]
        model = self._keep_physics(model, [(joint, links[joint.child or ""]) for joint in moved.values()], sink)
        model = self._keep_flags(model, [links[name] for name in moved if name], sink)
        made = model.copy(
            links=tuple(
                _host_guests(link, guests.get(link.name, []), sink, carriers=self.carriers)
                for link in model.links
                if link.name not in moved
            ),
            joints=tuple(joint for joint in model.joints if moved.get(joint.child or "") is not joint),
            frames=(*model.frames, *frames),
        )
        if not stays:
            made = made.copy(canonical_link=model.canonical_link or _root(model))
        parents = {
            name: joint.parent or "" for name, joint in moved.items() if find_annotation(links[name or ""], FRAME)
        }
        placed = _attach_frames(made, parents, sink) if parents else made
        return placed.copy(canonical_link=model.canonical_link)

    def _frames(self, joint: Joint, link: Link, sink: DiagnosticSink) -> tuple[Frame, ...]:
        pose = joint.pose.copy(relative_to=None) if joint.pose else None
        if pose == Pose.unchecked():
            pose = None
        annotation = find_annotation(link, FRAME)
        if annotation is not None and is_synthesized(joint):
            return (frame_as_before(joint, link, annotation, pose),)
        # Two frames, so that both names stay, the origin stays as it is written, and joints below
        # keep the link's name as their parent.
        mount = Frame.unchecked(
            name=joint.name, attached_to=joint.parent, pose=pose, opaque=_carriers(joint), source=joint.source
        )
        body = Frame.unchecked(name=link.name, attached_to=joint.name, source=link.source, opaque=_carriers(link))
        if annotation is not None:  # its joint stays, so that in SDF it is a link like those of URDF
            body = without_annotation(body, FRAME)
            message = f"link {link.name!r} was one frame of SDF, and has a joint that was not made for it"
            body = self._keep(body, [Opaque.unchecked(element=annotation)], message, sink)
        if self.carriers:
            body = with_annotation(body, LINK)
        return self._rest_of_joint(mount, joint, sink), self._rest_of_link(body, link, sink)

    def _rest_of_joint(self, frame: Frame, joint: Joint, sink: DiagnosticSink) -> Frame:
        if joint.axis is None:
            return frame
        whole = to_element(joint.copy(opaque=()), "joint", "urdf")
        rest = [
            Opaque.unchecked(element=child)
            for child in whole.children
            if child.name not in {"origin", "parent", "child"}
        ]
        return self._keep(frame, rest, f"the axis of the fixed joint {joint.name!r} has no effect", sink)

    def _keep_physics(self, model: Model, joints: list[tuple[Joint, Link]], sink: DiagnosticSink) -> Model:
        """Carry the physics that `<gazebo>` sets for joints that become frames."""
        kept: list[Opaque] = []
        for joint, link in joints:
            parts = [part.element for part in joint.opaque if part.element and part not in _carriers(joint)]
            if not parts:
                continue
            reference = (("reference", _name_in_urdf(joint, link)),)
            element = Element.unchecked(name="gazebo", attributes=reference, children=tuple(parts))
            message = f"joint {joint.name!r} becomes a frame, which has no <{parts[0].name}>"
            Keeper(sink, self.carriers).account(rules.FRAME_LINK, message, joint.location, element.weight)
            kept.append(Opaque.unchecked(element=element))
        return self._in_front(model, kept)

    def _keep_flags(self, model: Model, links: list[Link], sink: DiagnosticSink) -> Model:
        """Carry the flags that `<gazebo>` sets for links that become frames and have no body."""
        kept: list[Opaque] = []
        for link in links:
            written = {field: getattr(link, field) for field in _FLAGS}
            if all(value is None for value in written.values()):
                continue
            untagged = {field: value for field, value in written.items() if field not in FLAGS}
            bare = to_element(Link.unchecked(name="", spelling=link.spelling, **untagged), "link", "sdf")
            children = (*flag_tags(link), *bare.children)
            element = Element.unchecked(name="gazebo", attributes=(("reference", link.name),), children=children)
            names = ", ".join(field for field, value in written.items() if value is not None)
            message = f"{names} of {link.name!r} have no body to act on"
            Keeper(sink, self.carriers).account(rules.FRAME_LINK, message, link.location, len(children))
            kept.append(Opaque.unchecked(element=element))
        return self._in_front(model, kept)

    def _in_front(self, model: Model, kept: list[Opaque]) -> Model:
        """The model with new carriers before its own, which count less."""
        return model.copy(opaque=(*pack(kept, "urdf"), *model.opaque)) if self.carriers else model

    def _rest_of_link(self, frame: Frame, link: Link, sink: DiagnosticSink) -> Frame:
        if link.inertial is None:
            return frame
        bare = Link.unchecked(name=link.name, inertial=link.inertial)
        rest = [Opaque.unchecked(element=child) for child in to_element(bare, "link", "urdf").children]
        return self._keep(frame, rest, f"the frame {link.name!r} has no inertia", sink)

    def _keep(self, frame: Frame, rest: list[Opaque], message: str, sink: DiagnosticSink) -> Frame:
        for part in rest:
            Keeper(sink, self.carriers).account(rules.FRAME_LINK, message, frame.location, part.weight)
        return carry(frame, rest, "urdf") if self.carriers else frame


def _name_in_urdf(joint: Joint, link: Link) -> str:
    """The name of a joint after a conversion back to URDF; a joint that fixes a frame has no name in SDF."""
    is_made = is_synthesized(joint) and find_annotation(link, FRAME) is not None
    return f"{link.name}_joint" if is_made else joint.name


def _attach_frames(model: Model, parents: dict[str, str], sink: DiagnosticSink) -> Model:
    """The model with frames attached to the parents of their joints, where the annotated holder is elsewhere."""
    graph = FrameGraph(without_reversals(model))  # a frame on a joint moves with its child in SDF
    frames: list[Frame] = []
    for frame in model.frames:
        parent, holder = parents.get(frame.name, ""), frame.attached_to or MODEL
        if parent and holder != parent and not (graph.knows(holder) and _moves_with(graph, holder, parent)):
            message = f"frame {frame.name!r} was attached to {holder!r}, which does not move with {parent!r}"
            sink.report(STALE_CARRIER, message, frame.location, found=holder)
            frame = frame.copy(attached_to=parent)  # noqa: PLW2901 - the same frame, elsewhere
        frames.append(frame)
    return model.copy(frames=tuple(frames))


def _root(model: Model) -> str | None:
    """The root link, which the frame of the model moves with."""
    children = {joint.child for joint in model.joints}
    return next((link.name for link in model.links if link.name not in children), None)


def _moves_with(graph: FrameGraph, holder: str, parent: str) -> bool:
    try:
        return graph.body(holder, kind="frame") == graph.body(parent)
    except FrameError:
        return False


def frame_as_before(joint: Joint, link: Link, annotation: Element, pose: Pose | None) -> Frame:
    """The frame of SDF from which a link and its joint were made, at their present place."""
    holder = annotation.get("attached_to")
    if holder is not None:
        pose = (pose or Pose.unchecked()).copy(relative_to=joint.parent)
    opaque = without_annotation(link, FRAME).opaque
    attached = None if holder == MODEL else holder or joint.parent
    return Frame.unchecked(name=link.name, attached_to=attached, pose=pose, opaque=opaque, source=link.source)


def is_massless(link: Link) -> bool:
    """Whether a link of URDF, where an absent inertial means no mass, has none."""
    return link.inertial is None or (not link.inertial.auto and (link.inertial.mass or 0.0) <= 0.0)


def _find_anchor(name: str, moved: dict[str, Joint], known: dict[str, str]) -> str:
    """The nearest link above that stays a link; `known` caches the answers."""
    way: list[str] = []
    while name in moved and name not in known:
        way.append(name)
        name = moved[name].parent or ""
    anchor = known.get(name, name)
    known.update(dict.fromkeys(way, anchor))
    return anchor


def _carriers(node: Link | Joint) -> tuple[Opaque, ...]:
    """The opaque parts of a node that a frame can hold: elements with a namespace."""
    return tuple(part for part in node.opaque if part.element is not None and part.element.name.startswith("{"))


def _is_native(part: Opaque) -> bool:
    """Whether an opaque part is SDF's own, which moves to the host link."""
    return not is_ours(part) and not (part.element is not None and part.element.name.startswith("{"))


def _host_guests(link: Link, guests: list[Link], sink: DiagnosticSink, *, carriers: bool) -> Link:
    if not guests:
        return link
    visuals = (*link.visuals, *(_pose_in_frame(visual, guest.name) for guest in guests for visual in guest.visuals))
    collisions = (*link.collisions, *(_pose_in_frame(one, guest.name) for guest in guests for one in guest.collisions))
    plain = tuple(
        _pose_element_in_frame(part, guest.name) for guest in guests for part in guest.opaque if _is_native(part)
    )
    return link.copy(
        visuals=name_all(visuals, f"{link.name}_visual", sink, carriers=carriers),
        collisions=name_all(collisions, f"{link.name}_collision", sink, carriers=carriers),
        sensors=(*link.sensors, *(_pose_in_frame(one, guest.name) for guest in guests for one in guest.sensors)),
        lights=(*link.lights, *(_pose_in_frame(one, guest.name) for guest in guests for one in guest.lights)),
        opaque=(*link.opaque, *plain),
    )


def _pose_in_frame(node: Placed, frame: str) -> Placed:
    """The node posed in a frame of that name, unless its pose names another one already."""
    pose = node.pose or Pose.unchecked()
    if pose.relative_to is not None:
        return node
    return node.copy(pose=pose.copy(relative_to=frame))


def _pose_element_in_frame(part: Opaque, frame: str) -> Opaque:
    """Say in the pose of an untyped element, such as a projector, which frame it is relative to."""
    element = part.element
    if element is None:
        return part
    pose = element.find("pose")
    if pose is None or pose.get("relative_to") is not None:
        return part
    placed = pose.copy(attributes=(*pose.attributes, ("relative_to", frame)))
    return part.copy(element=element.exchange(pose, placed))


class TurnFramesIntoLinks(ToUrdfPass):
    """Make every frame a link without mass, fixed to the link that the frame moves with.

    Changes: 1. the link has the frame's name, the joint that name and `_joint`; 2. a model without any link gets one,
    called like the model, because URDF needs a root.
    Diagnostics: in the ledger `frame-made-link`, but not for a frame that `place-free-links` writes as one again.
    """

    name: ClassVar[str] = "turn-frames-into-links"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model without frames."""
        if model.links and not model.frames:
            return model
        taken = {node.name for node in (*model.links, *model.joints, *model.frames)}
        if not model.links:
            model = model.copy(links=(annotate_synthesized(Link.unchecked(name=reserve_name(model.name, taken))),))
        graph = FrameGraph(model)
        links, joints = list(model.links), list(model.joints)
        floating = {joint.name for joint in model.joints if joint.type == "floating"} if keeper.carriers else set[str]()
        for frame in model.frames:
            joint = reserve_name(f"{frame.name}_joint", taken)
            body = graph.body(frame.name, kind="frame")
            links.append(_make_link(frame, body, keeper))
            # a synthesized one stands for a nested model, and PlaceFreeLinks writes that of a floating joint as a frame
            if not is_synthesized(frame) and frame.name not in floating:
                message = f"frame {frame.name!r} becomes a link without mass"
                keeper.account(rules.FRAME_MADE_LINK, message, frame.location, count_parts(frame))
            made = Joint.unchecked(name=joint, type="fixed", parent=body, child=frame.name, source=frame.source)
            joints.append(annotate_synthesized(made))
        return model.copy(links=tuple(links), joints=tuple(joints), frames=())


def _make_link(frame: Frame, body: str, keeper: UrdfKeeper) -> Link:
    pose = frame.pose or Pose.unchecked()
    if not pose.relative_to:
        pose = pose.copy(relative_to=frame.attached_to or MODEL)
    link = Link.unchecked(name=frame.name, pose=pose, source=frame.source, opaque=frame.opaque)
    if is_synthesized(frame):
        return keeper.annotate(
            without_annotation(link, SYNTHESIZED), FRAME, attributes={"attached_to": None}, always=True
        )
    holder = frame.attached_to or MODEL
    link = keeper.annotate(link, FRAME, attributes={"attached_to": None if holder == body else holder}, always=True)
    return keeper.annotate(link, POSE, attributes=pose_attributes(frame.pose)) if pose_attributes(frame.pose) else link
