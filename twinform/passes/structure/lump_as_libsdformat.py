"""Lump fixed joints of URDF as libsdformat 12 does: its names and its choice of what moves, without its faults.

Its rules were read in parser_urdf.cc (ReduceFixedJoints and what it calls) and tried on small files.
"""

from collections.abc import Iterable, Mapping
from typing import TypeVar

from twinform.diagnostics import Fate, rules
from twinform.ir import (
    Axis,
    Collision,
    Dynamics,
    Element,
    Format,
    GazeboExtension,
    Joint,
    Limit,
    Link,
    Model,
    Pose,
    Visual,
    count_parts,
)
from twinform.ir.defaults import AXIS, UNLIMITED
from twinform.ir.frames import FrameGraph
from twinform.ir.node import Vector3
from twinform.ir.solids import placed
from twinform.ir.transform import Transform
from twinform.passes.shared.gazebo_tags import is_preserved
from twinform.passes.shared.link_shapes import add_guests, body_of
from twinform.passes.shared.poses import in_radians
from twinform.passes.structure.gazebo_blocks import (
    SHAPE_ELEMENTS,
    Blocks,
    becomes_locked_joint,
    block_content,
    blocks_by_reference,
    is_effective,
    move_element,
    posed_names,
    rename_taken_names,
    shape_elements,
)
from twinform.passes.structure.lumping_plan import LumpingPlan, plan_lumping
from twinform.passes.structure.model_edit import EditContext
from twinform.passes.structure.reference_words import find_mentions
from twinform.passes.structure.tag_shapes import KINDS, shape_name
from twinform.schemas import format_value

Shape = TypeVar("Shape", Visual, Collision)
# The parameters that libsdformat rewrites when it lumps a link (parser_urdf.cc,
# ReduceSDFExtensionPluginFrameReplace).
_BODIES = ("bodyName", "frameName")
_OFFSETS = ("xyzOffset", "rpyOffset")


# Followed are its names, its choice of what moves, and its numbers to 1e-9 on the whole corpus. Not
# followed are its faults: it drops massless links, snaps a pitch near 90 degrees, loses the rest of
# a link, and leaves two sensors of one name in a link. `make report NAME=lumping` lists every
# difference.
def lump_as_libsdformat(model: Model, keep: tuple[str, ...], place: EditContext) -> Model:
    """The model as libsdformat sees it; the same model where nothing changes."""
    there = blocks_by_reference(model.extensions)
    graph = FrameGraph(model)

    def why(joint: Joint, parent: Link, child: Link) -> str | None:
        del parent, child
        return "" if is_preserved(block_content(there, joint.name)) else None

    joints = tuple(sorted(model.joints, key=lambda joint: joint.name))  # urdfdom keeps them by name
    planned = plan_lumping(model.copy(joints=joints), graph, keep, why, place)
    made = _LibsdformatLumping(model, graph, there, planned, place).run() if planned.joints else model
    links = tuple(_name_shapes(link) for link in made.links)
    joints = tuple(_lock_joint(joint) if _is_locked(joint, there) else joint for joint in made.joints)
    if links == made.links and joints == made.joints:
        return made
    return made.copy(links=links, joints=joints)


def _is_locked(joint: Joint, there: Blocks) -> bool:
    return joint.type == "fixed" and becomes_locked_joint(block_content(there, joint.name))


def _lock_joint(joint: Joint) -> Joint:
    """The joint as libsdformat reads a fixed one with `disableFixedJointLumping`: it turns about z, from 0 to 0."""
    limit = Limit(lower=0.0, upper=0.0, effort=UNLIMITED, velocity=UNLIMITED)
    axis = Axis(xyz=AXIS[Format.SDF], limit=limit, dynamics=Dynamics(damping=0.0, friction=0.0))
    return joint.copy(type="revolute", axis=axis)


def _name_shapes(link: Link) -> Link:
    """The link with the names that libsdformat gives its shapes, whether anything was lumped or not."""
    update: dict[str, object] = {}
    for field, kind in KINDS.items():
        shapes: tuple[Visual | Collision, ...] = getattr(link, field)
        named = tuple(
            shape.copy(name=shape_name(link.name, shape.name, kind, number)) for number, shape in enumerate(shapes)
        )
        if named != shapes:
            update[field] = named
    return link.copy(**update) if update else link


class _LibsdformatLumping:
    """The lumping of one model."""

    def __init__(
        self, model: Model, graph: FrameGraph, there: Blocks, planned: LumpingPlan, place: EditContext
    ) -> None:
        self.model, self.graph, self.there, self.planned, self.place = model, graph, there, planned, place
        self.links = {link.name: link for link in model.links}
        self.guests = planned.guests()
        self.mixed: set[tuple[str, str]] = set()
        self.taken: dict[str, set[tuple[str, str]]] = {}

    def run(self) -> Model:
        hosts = {host: self._lump_into_host(host, names) for host, names in self.guests.items()}
        hosts_of = self.planned.hosts
        made = self.model.copy(
            links=tuple(hosts.get(each.name, each) for each in self.model.links if each.name not in hosts_of),
            joints=tuple(self._move_joint(each) for each in self.model.joints if not self._is_lumped(each)),
            extensions=tuple(
                made for each in self.model.extensions if (made := self._move_extension(each)) is not None
            ),
        )
        self._report_dangling(made)
        return made

    def _is_lumped(self, joint: Joint) -> bool:
        going = self.planned.joints.get(joint.child or "")
        return going is not None and going.name == joint.name

    def _lump_into_host(self, host: str, names: list[str]) -> Link:
        link = self.links[host]
        own = body_of(link, self.graph, Format.URDF)
        at = {name: self.graph.pose(name, host) for name in names}
        guests = [placed(body_of(self.links[name], self.graph, Format.URDF), at[name]) for name in names]
        link = add_guests(link, own, guests, self.place.sink)
        for field in KINDS:
            self._note_mixed_tags(host, names, field)
            moved = [
                shape for name in names for shape in _moved_shapes(getattr(self.links[name], field), name, at[name])
            ]
            link = link.copy(**{field: (*getattr(link, field), *moved)})
        for name in names:
            self._lose_opaque_parts(self.links[name])
        return link

    def _note_mixed_tags(self, host: str, names: list[str], field: str) -> None:
        """Note tags for shapes that would apply to shapes of other links as well, once all are in one link."""
        with_shapes = [name for name in (host, *names) if getattr(self.links[name], field)]
        for name in names:
            mine = shape_elements(block_content(self.there, name), field)
            others = [shape_elements(block_content(self.there, other), field) for other in with_shapes if other != name]
            if mine and (name not in with_shapes or any(other != mine for other in others)):
                self.mixed.add((name, field))

    def _lose_opaque_parts(self, link: Link) -> None:
        rest = [part for part in link.opaque if part.element is None or not part.element.name.startswith("{")]
        for part in rest:
            message = f"{part.name} of link {link.name!r} is lost when the link is lumped"
            self._report_loss(message, link, part.weight)

    def _report_loss(self, message: str, node: Link | Joint | GazeboExtension, weight: int) -> None:
        self.place.sink.report(rules.LUMPED_AWAY, message, node.location)
        self.place.sink.account(Fate.DROPPED, rules.LUMPED_AWAY, message, node.location, weight)

    def _move_joint(self, joint: Joint) -> Joint:
        """The joint, moved from a lumped link to its host."""
        host = self.planned.hosts.get(joint.parent or "")
        if host is None:
            return joint
        at = self.graph.pose(joint.parent or "", host)
        written = Transform.from_pose(joint.pose)
        pose = in_radians(at.compose(written), host)
        if at.is_identity and joint.pose is not None:
            pose = joint.pose.copy(relative_to=host)
        return joint.copy(parent=host, pose=pose)

    def _move_extension(self, extension: GazeboExtension) -> GazeboExtension | None:
        name = extension.reference or ""
        if any(joint.name == name for joint in self.planned.joints.values()) and name not in self.links:
            lost = [element for element in extension.content if is_effective(element)]
            if lost:
                words = ", ".join(f"<{element.name}>" for element in lost)
                self._report_loss(
                    f"{words} of joint {name!r} is lost with the joint", extension, count_parts(extension)
                )
            return None
        host = self.planned.hosts.get(name)
        elements = extension.content
        if host is not None:
            at = self.graph.pose(name, host)
            taken = self.taken.setdefault(host, posed_names(block_content(self.there, host)))
            apart = rename_taken_names(self._remove_mixed_tags(extension), taken, name)
            elements = tuple(move_element(element, at) for element in apart)
        elements = tuple(self._follow_plugins(element) for element in elements)
        if host is None and elements == extension.content:
            return extension
        return extension.copy(reference=host or extension.reference, content=elements)

    def _remove_mixed_tags(self, extension: GazeboExtension) -> Iterable[Element]:
        """The content without tags that would apply to the shapes of other links as well."""
        name = extension.reference or ""
        fields = [field for field in SHAPE_ELEMENTS if (name, field) in self.mixed]
        lost = [element for field in fields for element in shape_elements(extension.content, field)]
        if lost:
            words = ", ".join(f"<{element.name}>" for element in lost)
            host = self.planned.hosts[name]
            message = f"{words} of link {name!r} would apply to all shapes of {host!r}, so it is left out"
            self._report_loss(message, extension, sum(element.weight for element in lost))
        return [element for element in extension.content if element not in lost]

    def _follow_plugins(self, element: Element) -> Element:
        """The element, in which plugins at a lumped link are moved to its host."""
        if element.name == "plugin":
            return _move_plugin(element, self.planned.hosts, self.graph)
        children = tuple(self._follow_plugins(child) for child in element.children)
        return element.copy(children=children) if children != element.children else element

    def _report_dangling(self, made: Model) -> None:
        """Report names of lumped links and joints in places that libsdformat does not change."""
        named = find_mentions(made)
        for name, holder in named.links.items():
            if name in self.planned.hosts:
                message = f"{holder} names link {name!r}, which is a part of {self.planned.hosts[name]!r} now"
                where = self.links[name].location
                self.place.sink.report(rules.LUMPED_AWAY, message, where, found=name)
        for joint in self.planned.joints.values():
            if joint.name in named.joints:
                message = f"{named.joints[joint.name]} names joint {joint.name!r}, which was removed"
                self.place.sink.report(rules.LUMPED_AWAY, message, joint.location, found=joint.name)


def _moved_shapes(shapes: tuple[Shape, ...], link: str, at: Transform) -> Iterable[Shape]:
    """Shapes in the frame of the host; a shape without a name gets that of its link."""
    for shape in shapes:
        pose = shape.pose if at.is_identity else in_radians(at.compose(Transform.from_pose(shape.pose)))
        yield shape.copy(name=shape.name or link, pose=pose)


def _move_plugin(plugin: Element, hosts: Mapping[str, str], graph: FrameGraph) -> Element:
    """A plugin of Gazebo Classic at the same place of the host, with `xyzOffset` (m) and `rpyOffset` (rad) from there.

    The plugin is moved once, even where both parameters name the link.
    """
    named = next((child.text for child in plugin.children if child.name in _BODIES and child.text in hosts), None)
    if named is None:
        return plugin
    # parser_urdf.cc, ReduceSDFExtensionPluginFrameReplace: libsdformat rewrites these two parameters and
    # their offsets, and no others.
    host = hosts[named]
    offset = Pose(xyz=_read_vector(plugin.find("xyzOffset")), rpy=_read_vector(plugin.find("rpyOffset")))
    at = graph.pose(named, host).compose(Transform.from_pose(offset))
    kept = tuple(
        child.copy(text=host) if child.name in _BODIES and child.text == named else child
        for child in plugin.children
        if child.name not in _OFFSETS
    )
    texts = (" ".join(map(format_value, at.translation)), " ".join(map(format_value, at.rpy())))
    made = tuple(Element(name=name, text=text) for name, text in zip(_OFFSETS, texts, strict=True))
    return plugin.copy(children=(*kept, *made))


def _read_vector(element: Element | None) -> Vector3 | None:
    try:
        x, y, z = map(float, (element.text or "").split()) if element is not None else (0.0, 0.0, 0.0)
    except ValueError:
        return None
    return x, y, z
