"""Links without mass that are fixed to another become frames."""

from typing import ClassVar, TypeVar

from twinform.diagnostics import Fate, Notes
from twinform.diagnostics.rules import to_sdf
from twinform.ir import Collision, Element, Frame, Joint, Light, Link, Model, Opaque, Pose, Sensor, Visual
from twinform.passes.legalise.carrier import carry, is_ours, to_element
from twinform.passes.legalise.model_pass import ModelPass
from twinform.passes.legalise.to_sdf.name_shapes import name_all

Placed = TypeVar("Placed", Visual, Collision, Sensor, Light)


class FrameLinks(ModelPass):
    """Turn a link without mass on a fixed joint into SDF's `<frame>`, and its joint into another one.

    Changes: 1. the joint becomes a frame attached to its parent, with the joint's origin; 2. the link becomes a frame
    attached to that one; 3. visuals, collisions, sensors and lights move to the nearest link above that stays a link,
    and are posed in the link's frame as before. Joints below keep the link's name as their parent.
    Never touches: links with mass; a link fixed to the world, which has no link above; one whose joint has a sensor,
    which would have no place.
    Diagnostics: none; ledger entries under `frame-link` for what a frame cannot have.
    """

    name: ClassVar[str] = "frame-links"
    carriers: bool = True

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model without massless links on fixed joints."""
        links = {link.name: link for link in model.links}
        moved = {
            joint.child: joint
            for joint in model.joints
            if joint.type == "fixed"
            and joint.parent in links
            and joint.child in links
            and is_massless(links[joint.child])
            and not joint.sensors
        }
        if not moved:
            return model
        guests: dict[str, list[Link]] = {}
        for name in moved:
            guests.setdefault(_anchor(name, moved), []).append(links[name])
        frames = [frame for joint in moved.values() for frame in self._frames(joint, links[joint.child or ""], notes)]
        model = self._keep_physics(model, list(moved.values()), notes)
        return model.model_copy(
            update={
                "links": tuple(
                    _host(link, guests.get(link.name, []), notes) for link in model.links if link.name not in moved
                ),
                "joints": tuple(joint for joint in model.joints if moved.get(joint.child or "") is not joint),
                "frames": (*model.frames, *frames),
            }
        )

    def _frames(self, joint: Joint, link: Link, notes: Notes) -> tuple[Frame, Frame]:
        pose = joint.pose.model_copy(update={"relative_to": None}) if joint.pose else None
        if pose == Pose():
            pose = None
        mount = Frame(
            name=joint.name, attached_to=joint.parent, pose=pose, opaque=_carriers(joint), source=joint.source
        )
        body = Frame(name=link.name, attached_to=joint.name, source=link.source, opaque=_carriers(link))
        return self._rest_of_joint(mount, joint, notes), self._rest_of_link(body, link, notes)

    def _rest_of_joint(self, frame: Frame, joint: Joint, notes: Notes) -> Frame:
        if joint.axis is None:
            return frame
        whole = to_element(joint.model_copy(update={"opaque": ()}), "joint", "urdf")
        rest = [Opaque(element=child) for child in whole.children if child.name not in {"origin", "parent", "child"}]
        return self._keep(frame, rest, f"the axis of the fixed joint {joint.name!r} has no use", notes)

    def _keep_physics(self, model: Model, joints: list[Joint], notes: Notes) -> Model:
        """What `<gazebo>` says of the physics of a joint that becomes a frame: it is carried in such an element."""
        kept: list[Opaque] = []
        for joint in joints:
            parts = [part.element for part in joint.opaque if part.element and part not in _carriers(joint)]
            if not parts:
                continue
            element = Element(name="gazebo", attributes=(("reference", joint.name),), children=tuple(parts))
            message = f"joint {joint.name!r} becomes a frame, which has no <{parts[0].name}>"
            fate = Fate.CARRIED if self.carriers else Fate.DROPPED
            notes.account(fate, to_sdf.FRAME_LINK, message, joint.location, element.weight)
            kept.append(Opaque(element=element))
        return carry(model, kept, "urdf") if self.carriers else model

    def _rest_of_link(self, frame: Frame, link: Link, notes: Notes) -> Frame:
        flags = [
            field
            for field in ("gravity", "enable_wind", "self_collide", "kinematic")
            if getattr(link, field) is not None
        ]
        if flags:
            message = f"{', '.join(flags)} of {link.name!r} have no body to act on"
            notes.account(Fate.DROPPED, to_sdf.FRAME_LINK, message, link.location, len(flags))
        if link.inertial is None:
            return frame
        bare = Link(name=link.name, inertial=link.inertial)
        rest = [Opaque(element=child) for child in to_element(bare, "link", "urdf").children]
        return self._keep(frame, rest, f"the frame {link.name!r} has no inertia", notes)

    def _keep(self, frame: Frame, rest: list[Opaque], message: str, notes: Notes) -> Frame:
        for part in rest:
            notes.account(
                Fate.CARRIED if self.carriers else Fate.DROPPED, to_sdf.FRAME_LINK, message, frame.location, part.weight
            )
        return carry(frame, rest, "urdf") if self.carriers else frame


def is_massless(link: Link) -> bool:
    """Whether a link of URDF, where an absent inertial means no mass, has none."""
    return link.inertial is None or (not link.inertial.auto and (link.inertial.mass or 0.0) <= 0.0)


def _anchor(name: str, moved: dict[str, Joint]) -> str:
    """The nearest link above that stays a link."""
    while name in moved:
        name = moved[name].parent or ""
    return name


def _carriers(node: Link | Joint) -> tuple[Opaque, ...]:
    """What a frame can hold of a node's opaque parts: those that only our own reader understands."""
    return tuple(part for part in node.opaque if part.element is not None and part.element.name.startswith("{"))


def _is_native(part: Opaque) -> bool:
    """Whether it is SDF's own: carriers stay with the frame, and marks say something of the link that is gone."""
    return not is_ours(part) and not (part.element is not None and part.element.name.startswith("{"))


def _host(link: Link, guests: list[Link], notes: Notes) -> Link:
    if not guests:
        return link
    visuals = (*link.visuals, *(_placed(visual, guest.name) for guest in guests for visual in guest.visuals))
    collisions = (*link.collisions, *(_placed(one, guest.name) for guest in guests for one in guest.collisions))
    plain = tuple(_placed_element(part, guest.name) for guest in guests for part in guest.opaque if _is_native(part))
    return link.model_copy(
        update={
            "visuals": name_all(visuals, f"{link.name}_visual", notes),
            "collisions": name_all(collisions, f"{link.name}_collision", notes),
            "sensors": (*link.sensors, *(_placed(one, guest.name) for guest in guests for one in guest.sensors)),
            "lights": (*link.lights, *(_placed(one, guest.name) for guest in guests for one in guest.lights)),
            "opaque": (*link.opaque, *plain),
        }
    )


def _placed(node: Placed, frame: str) -> Placed:
    """The node posed in a frame of that name, unless its pose names another one already."""
    pose = node.pose or Pose()
    if pose.relative_to is not None:
        return node
    return node.model_copy(update={"pose": pose.model_copy(update={"relative_to": frame})})


def _placed_element(part: Opaque, frame: str) -> Opaque:
    """The same for an element without a typed form, such as a projector."""
    element = part.element
    if element is None:
        return part
    pose = element.find("pose")
    if pose is None or pose.get("relative_to") is not None:
        return part
    placed = pose.model_copy(update={"attributes": (*pose.attributes, ("relative_to", frame))})
    children = tuple(placed if child is pose else child for child in element.children)
    return part.model_copy(update={"element": element.model_copy(update={"children": children})})
