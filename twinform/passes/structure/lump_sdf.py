"""Lumping of fixed joints in SDF: links become frames, and their contents move to the link that they are fixed to."""

from collections.abc import Iterable
from typing import TypeVar

from twinform.diagnostics import DiagnosticSink
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
    replace_fields,
)
from twinform.ir.defaults import BODY
from twinform.ir.frames import MODEL, FrameError, FrameGraph
from twinform.ir.solids import placed
from twinform.passes.carriers.carriers import is_ours
from twinform.passes.shared.link_shapes import NoSolidError, add_guests, body_of
from twinform.passes.shared.mesh_solids import Meshes
from twinform.passes.shared.nodes import unique_name
from twinform.passes.shared.poses import link_elements
from twinform.passes.structure.lumping_plan import LumpingPlan, plan_lumping
from twinform.passes.structure.model_edit import EditContext
from twinform.passes.structure.reference_words import Mentions, find_mentions

Posed = TypeVar("Posed", Visual, Collision, Sensor, Light)
_SETTINGS = {name: BODY.get(name) for name in ("gravity", "enable_wind", "self_collide", "kinematic")}
"""The settings of a link for its body, and their defaults."""
_BODY_ELEMENTS = frozenset({"velocity_decay"})


def lump_sdf(
    model: Model, keep: tuple[str, ...], place: EditContext, meshes: Meshes, named: Mentions | None = None
) -> Model:
    """The model, and its nested models, with one link for each rigid body; the same model where nothing changes."""
    named = named or find_mentions(model)
    inner = (lump_sdf(nested, keep, place, meshes, named) for nested in model.models)
    model = replace_fields(model, models=tuple(inner))
    if not any(joint.type == "fixed" for joint in model.joints):
        return model
    graph = FrameGraph(model)
    planned = plan_lumping(model, graph, keep, _SdfObstacles(graph, named, meshes).find_obstacle, place)
    return _lump_model(model, graph, planned, meshes, place.sink) if planned.joints else model


class _SdfObstacles:
    """Says why a link cannot be lumped."""

    def __init__(self, graph: FrameGraph, named: Mentions, meshes: Meshes) -> None:
        self.graph, self.named, self.meshes = graph, named, meshes

    def find_obstacle(self, joint: Joint, parent: Link, child: Link) -> str | None:
        # A force-torque sensor measures what goes through the joint, which would be gone.
        if joint.sensors:
            return f"there is a sensor on joint {joint.name!r}"
        if joint.name in self.named.joints:
            return f"{self.named.joints[joint.name]} names joint {joint.name!r}"
        # A plugin that names a link applies forces to it or reads its speed. A frame is no answer
        # to that, and few plugins have a parameter for an offset.
        if child.name in self.named.links:
            return f"{self.named.links[child.name]} names it"
        other = next(
            (
                name
                for name, usual in _SETTINGS.items()
                if _value_or_default(parent, name, usual) != _value_or_default(child, name, usual)
            ),
            "",
        )
        if other:
            return f"its <{other}> is not that of {parent.name!r}"
        if _body_elements(parent) != _body_elements(child):
            return f"its <velocity_decay> is not that of {parent.name!r}"
        return self._find_untransferable(child) or self._find_missing_mass((parent, child))

    def _find_untransferable(self, child: Link) -> str | None:
        """Why a part of a link cannot move to another link; None if all parts can."""
        known = link_elements("pose") | _BODY_ELEMENTS
        unknown = next((part for part in child.opaque if not is_ours(part) and _element_name(part) not in known), None)
        if unknown is not None:
            return f"{unknown.name} belongs to the link"
        added = child.inertial and any(_element_name(part) == "fluid_added_mass" for part in child.inertial.opaque)
        return "it has <fluid_added_mass>" if added else None

    def _find_missing_mass(self, links: Iterable[Link]) -> str | None:
        try:
            for link in links:
                body_of(link, self.graph, Format.SDF, self.meshes)
        except (NoSolidError, FrameError) as error:
            return str(error)
        return None


def _value_or_default(link: Link, name: str, usual: object) -> object:
    """The value of a field of a link, or the default where it is not written."""
    value = getattr(link, name)
    return usual if value is None else value


def _body_elements(link: Link) -> list[Element]:
    return [part.element for part in link.opaque if part.element and part.element.name in _BODY_ELEMENTS]


def _element_name(part: Opaque) -> str:
    return part.element.name if part.element else part.name


def _lump_model(model: Model, graph: FrameGraph, planned: LumpingPlan, meshes: Meshes, sink: DiagnosticSink) -> Model:
    links = {link.name: link for link in model.links}
    guests = planned.guests()
    gone = {joint.name for joint in planned.joints.values()}
    frames = [frame for name, joint in planned.joints.items() for frame in _frames_for_link(links[name], joint, model)]
    made = model.copy(
        links=tuple(
            _lump_into_link(link, [links[name] for name in guests.get(link.name, [])], graph, meshes, sink)
            for link in model.links
            if link.name not in planned.joints
        ),
        joints=tuple(joint for joint in model.joints if joint.name not in gone),
        frames=(*model.frames, *frames),
    )
    return _keep_canonical_link(made, graph, planned)


def _frames_for_link(link: Link, joint: Joint, model: Model) -> tuple[Frame, Frame]:
    """Frames with the names of a joint and its child: whatever names these stays valid."""
    child = next((each.child for each in model.joints if each.name == joint.name), None) or link.name
    mount = Frame(
        name=joint.name,
        attached_to=joint.parent,
        pose=_relative_to(joint.pose, child),
        source=joint.source,
        opaque=_our_parts(joint),
    )
    body = Frame(
        name=link.name,
        attached_to=joint.parent,
        pose=_relative_to(link.pose, MODEL),
        source=link.source,
        opaque=_our_parts(link),
    )
    return mount, body


def _our_parts(node: Joint | Link) -> tuple[Opaque, ...]:
    return tuple(part for part in node.opaque if is_ours(part) and part.element is not None)


def _relative_to(pose: Pose | None, base: str) -> Pose:
    """The pose with its frame written out, since another one is the default for a frame."""
    pose = pose or Pose()
    return pose if pose.relative_to else pose.copy(relative_to=base)


def _lump_into_link(link: Link, guests: list[Link], graph: FrameGraph, meshes: Meshes, sink: DiagnosticSink) -> Link:
    if not guests:
        return link
    solids = [placed(body_of(guest, graph, Format.SDF, meshes), graph.pose(guest.name, link.name)) for guest in guests]
    heavy = add_guests(link, body_of(link, graph, Format.SDF, meshes), solids, sink)
    into = heavy
    for guest in guests:
        collisions = _moved_parts(guest, guest.collisions, into.collisions)
        sensors = tuple(_follow_collisions(each, guest, collisions) for each in guest.sensors)
        moved = tuple(
            _pose_element_in_frame(part, guest.name)
            for part in guest.opaque
            if _element_name(part) in link_elements("pose")
        )
        into = into.copy(
            visuals=(*into.visuals, *_moved_parts(guest, guest.visuals, into.visuals)),
            collisions=(*into.collisions, *collisions),
            sensors=(*into.sensors, *_moved_parts(guest, sensors, into.sensors)),
            lights=(*into.lights, *_moved_parts(guest, guest.lights, into.lights)),
            opaque=(*into.opaque, *moved),
        )
    return into


def _moved_parts(guest: Link, parts: tuple[Posed, ...], there: tuple[Posed, ...]) -> list[Posed]:
    """Parts posed in the frame of their old link, whose name is put before names that are taken."""
    taken = {part.name for part in there}
    made: list[Posed] = []
    for part in parts:
        name = part.name
        if name in taken:
            name = unique_name(f"{guest.name}_{name}", taken | {each.name for each in parts})
        taken.add(name)
        placed_part = part.copy(pose=_relative_to(part.pose, guest.name))
        made.append(placed_part if name == part.name else placed_part.copy(name=name))
    return made


def _follow_collisions(sensor: Sensor, guest: Link, collisions: list[Collision]) -> Sensor:
    """A contact sensor of a lumped link, with the new names of the collisions of this link."""
    pairs = zip(guest.collisions, collisions, strict=True)
    renamed = {old.name: new.name for old, new in pairs if old.name and new.name and old.name != new.name}
    if not renamed or sensor.type != "contact":
        return sensor
    parts = tuple(
        part if part.element is None else part.copy(element=_rename_collisions(part.element, renamed))
        for part in sensor.opaque
    )
    return sensor.copy(opaque=parts)


def _rename_collisions(element: Element, names: dict[str, str]) -> Element:
    text = names.get(element.text or "", element.text) if element.name == "collision" else element.text
    children = tuple(_rename_collisions(child, names) for child in element.children)
    return element.copy(text=text, children=children)


def _pose_element_in_frame(part: Opaque, frame: str) -> Opaque:
    element = part.element
    if element is None:
        return part
    pose = element.find("pose")
    if pose is None:
        made = Element(name="pose", attributes=(("relative_to", frame),))
        return part.copy(element=element.copy(children=(made, *element.children)))
    if pose.get("relative_to"):
        return part
    made = pose.copy(attributes=(*pose.attributes, ("relative_to", frame)))
    return part.copy(element=element.exchange(pose, made))


def _keep_canonical_link(model: Model, graph: FrameGraph, planned: LumpingPlan) -> Model:
    """The model with a canonical link that makes the frame of the model move with the same body as before."""
    before = graph.body(MODEL, kind="model")
    body = planned.hosts.get(before, before)
    # The model's own frame must not start to move with another body.
    if model.canonical_link is None and FrameGraph(model).body(MODEL, kind="model") == body:
        return model
    if model.canonical_link is not None and model.canonical_link not in planned.hosts:
        return model
    return model.copy(canonical_link=body)
