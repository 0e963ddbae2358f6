"""Lump fixed joints of URDF as libsdformat 12 does: its names, its choice of what follows; without its faults.

Its rules were read in parser_urdf.cc (ReduceFixedJoints and what it calls) and tried on small files.
"""

from collections.abc import Iterable
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
    Visual,
    count_parts,
)
from twinform.ir.defaults import AXIS, UNLIMITED
from twinform.ir.frames import FrameGraph
from twinform.ir.solids import placed
from twinform.ir.transform import Transform
from twinform.passes.structure.combined_bodies import body_of, with_guests
from twinform.passes.structure.gazebo_blocks import (
    OF_SHAPES,
    Blocks,
    blocks,
    content,
    in_host,
    is_set,
    named_apart,
    of_shapes,
    posed_names,
    turns_by_nothing,
)
from twinform.passes.structure.lumping_plan import LumpingPlan, plan
from twinform.passes.structure.mentions import mentions
from twinform.passes.structure.model_edit import EditContext
from twinform.passes.structure.moved_plugins import moved_plugin
from twinform.passes.structure.tagged_shapes import KINDS, shape_name
from twinform.passes.transforms.lumped_links import is_preserved
from twinform.passes.transforms.pose_notation import in_radians

Shape = TypeVar("Shape", Visual, Collision)


# Followed are its names, its choice of what moves, and its numbers to 1e-9 on the whole corpus. Not
# followed are its faults: it drops massless links, snaps a pitch near 90 degrees, loses the rest of
# a link, and leaves two sensors of one name in a link. `make report NAME=lumping` lists every
# difference.
def lump_as_libsdformat(model: Model, keep: tuple[str, ...], place: EditContext) -> Model:
    """The model as libsdformat sees it; the same one where it would change nothing."""
    there = blocks(model.extensions)
    graph = FrameGraph(model)

    def why(joint: Joint, parent: Link, child: Link) -> str | None:
        del parent, child
        return "" if is_preserved(content(there, joint.name)) else None

    joints = tuple(sorted(model.joints, key=lambda joint: joint.name))  # urdfdom keeps them by name
    planned = plan(model.copy(joints=joints), graph, keep, why, place)
    made = _LibsdformatLumping(model, graph, there, planned, place).run() if planned.joints else model
    links = tuple(_named(link) for link in made.links)
    joints = tuple(_turning(joint) if _stays(joint, there) else joint for joint in made.joints)
    if links == made.links and joints == made.joints:
        return made
    return made.copy(links=links, joints=joints)


def _stays(joint: Joint, there: Blocks) -> bool:
    return joint.type == "fixed" and turns_by_nothing(content(there, joint.name))


def _turning(joint: Joint) -> Joint:
    """What libsdformat makes of a fixed joint with `disableFixedJointLumping`: it turns about z, from 0 to 0."""
    limit = Limit(lower=0.0, upper=0.0, effort=UNLIMITED, velocity=UNLIMITED)
    axis = Axis(xyz=AXIS[Format.SDF], limit=limit, dynamics=Dynamics(damping=0.0, friction=0.0))
    return joint.copy(type="revolute", axis=axis)


def _named(link: Link) -> Link:
    """The link with its shapes by the names that libsdformat gives them, whether anything was lumped or not."""
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
    """One run over one model."""

    def __init__(
        self, model: Model, graph: FrameGraph, there: Blocks, planned: LumpingPlan, place: EditContext
    ) -> None:
        self.model, self.graph, self.there, self.planned, self.place = model, graph, there, planned, place
        self.links = {link.name: link for link in model.links}
        self.guests = planned.guests()
        self.mixed: set[tuple[str, str]] = set()
        self.taken: dict[str, set[tuple[str, str]]] = {}

    def run(self) -> Model:
        hosts = {host: self._host(host, names) for host, names in self.guests.items()}
        hosts_of = self.planned.hosts
        made = self.model.copy(
            links=tuple(hosts.get(each.name, each) for each in self.model.links if each.name not in hosts_of),
            joints=tuple(self._joint(each) for each in self.model.joints if not self._goes(each)),
            extensions=tuple(made for each in self.model.extensions if (made := self._extension(each)) is not None),
        )
        self._report_dangling(made)
        return made

    def _goes(self, joint: Joint) -> bool:
        going = self.planned.joints.get(joint.child or "")
        return going is not None and going.name == joint.name

    def _host(self, host: str, names: list[str]) -> Link:
        link = self.links[host]
        own = body_of(link, self.graph, Format.URDF)
        at = {name: self.graph.pose(name, host) for name in names}
        guests = [placed(body_of(self.links[name], self.graph, Format.URDF), at[name]) for name in names]
        link = with_guests(link, own, guests, self.place.sink)
        for field in KINDS:
            self._note_mixed(host, names, field)
            moved = [shape for name in names for shape in _moved(getattr(self.links[name], field), name, at[name])]
            link = link.copy(**{field: (*getattr(link, field), *moved)})
        for name in names:
            self._lose_rest(self.links[name])
        return link

    def _note_mixed(self, host: str, names: list[str], field: str) -> None:
        """Tags about shapes that would be about others too, once these are in one link."""
        with_shapes = [name for name in (host, *names) if getattr(self.links[name], field)]
        for name in names:
            mine = of_shapes(content(self.there, name), field)
            others = [of_shapes(content(self.there, other), field) for other in with_shapes if other != name]
            if mine and (name not in with_shapes or any(other != mine for other in others)):
                self.mixed.add((name, field))

    def _lose_rest(self, link: Link) -> None:
        rest = [part for part in link.opaque if part.element is None or not part.element.name.startswith("{")]
        for part in rest:
            message = f"{part.name} of link {link.name!r} is lost when the link is lumped"
            self._lose(message, link, part.weight)

    def _lose(self, message: str, node: Link | Joint | GazeboExtension, weight: int) -> None:
        self.place.sink.report(rules.LUMPED_AWAY, message, node.location)
        self.place.sink.account(Fate.DROPPED, rules.LUMPED_AWAY, message, node.location, weight)

    def _joint(self, joint: Joint) -> Joint:
        """A joint of a link that goes hangs from the one that it goes into."""
        host = self.planned.hosts.get(joint.parent or "")
        if host is None:
            return joint
        at = self.graph.pose(joint.parent or "", host)
        written = Transform.from_pose(joint.pose)
        pose = in_radians(at.compose(written), host)
        if at.is_identity and joint.pose is not None:
            pose = joint.pose.copy(relative_to=host)
        return joint.copy(parent=host, pose=pose)

    def _extension(self, extension: GazeboExtension) -> GazeboExtension | None:
        name = extension.reference or ""
        if any(joint.name == name for joint in self.planned.joints.values()) and name not in self.links:
            lost = [element for element in extension.content if is_set(element)]
            if lost:
                words = ", ".join(f"<{element.name}>" for element in lost)
                self._lose(f"{words} of joint {name!r} is lost with the joint", extension, count_parts(extension))
            return None
        host = self.planned.hosts.get(name)
        elements = extension.content
        if host is not None:
            at = self.graph.pose(name, host)
            taken = self.taken.setdefault(host, posed_names(content(self.there, host)))
            apart = named_apart(self._unmixed(extension), taken, name)
            elements = tuple(in_host(element, at) for element in apart)
        elements = tuple(self._followed(element) for element in elements)
        if host is None and elements == extension.content:
            return extension
        return extension.copy(reference=host or extension.reference, content=elements)

    def _unmixed(self, extension: GazeboExtension) -> Iterable[Element]:
        """The content without tags that would be about the shapes of other links too."""
        name = extension.reference or ""
        fields = [field for field in OF_SHAPES if (name, field) in self.mixed]
        lost = [element for field in fields for element in of_shapes(extension.content, field)]
        if lost:
            words = ", ".join(f"<{element.name}>" for element in lost)
            host = self.planned.hosts[name]
            message = f"{words} of link {name!r} would apply to all shapes of {host!r}, so it is left out"
            self._lose(message, extension, sum(element.weight for element in lost))
        return [element for element in extension.content if element not in lost]

    def _followed(self, element: Element) -> Element:
        """The element with plugins whose body is another one now."""
        if element.name == "plugin":
            return moved_plugin(element, self.planned.hosts, self.graph)
        children = tuple(self._followed(child) for child in element.children)
        return element.copy(children=children) if children != element.children else element

    def _report_dangling(self, made: Model) -> None:
        """Names of what goes in places that libsdformat leaves as they are."""
        named = mentions(made)
        for name, holder in named.links.items():
            if name in self.planned.hosts:
                message = f"{holder} names link {name!r}, which is a part of {self.planned.hosts[name]!r} now"
                where = self.links[name].location
                self.place.sink.report(rules.LUMPED_AWAY, message, where, found=name)
        for joint in self.planned.joints.values():
            if joint.name in named.joints:
                message = f"{named.joints[joint.name]} names joint {joint.name!r}, which was removed"
                self.place.sink.report(rules.LUMPED_AWAY, message, joint.location, found=joint.name)


def _moved(shapes: tuple[Shape, ...], link: str, at: Transform) -> Iterable[Shape]:
    """Shapes in the frame of the host; one without a name gets that of its link."""
    for shape in shapes:
        pose = shape.pose if at.is_identity else in_radians(at.compose(Transform.from_pose(shape.pose)))
        yield shape.copy(name=shape.name or link, pose=pose)
