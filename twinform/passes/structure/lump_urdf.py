"""Lumping of fixed joints in URDF: mass and shapes move to the parent link, and the links stay as frames."""

from typing import TypeVar

from twinform.diagnostics import rules
from twinform.ir import Collision, Element, Format, GazeboExtension, Joint, Link, Model, Visual, replace_fields
from twinform.ir.frames import FrameGraph
from twinform.ir.solids import Solid, placed
from twinform.ir.transform import Transform
from twinform.passes.carriers.carriers import is_ours
from twinform.passes.shared.gazebo_tags import is_preserved
from twinform.passes.shared.link_shapes import add_guests, body_of
from twinform.passes.shared.nodes import unique_name
from twinform.passes.shared.poses import in_radians
from twinform.passes.structure.gazebo_blocks import (
    Blocks,
    block_content,
    blocks_by_reference,
    body_settings,
    has_sensor,
    posed_names,
    rename_taken_names,
    shape_elements,
)
from twinform.passes.structure.lumping_plan import LumpingPlan, plan_lumping
from twinform.passes.structure.model_edit import EditContext
from twinform.passes.structure.reference_words import Mentions, find_mentions
from twinform.passes.structure.tag_shapes import KINDS

Shape = TypeVar("Shape", Visual, Collision)


def lump_urdf(model: Model, keep: tuple[str, ...], place: EditContext) -> Model:
    """The model in which only one link of each rigid body has mass; the same model where nothing changes."""
    if not any(joint.type == "fixed" for joint in model.joints):
        return model
    graph, there = FrameGraph(model), blocks_by_reference(model.extensions)
    planned = plan_lumping(model, graph, keep, _UrdfObstacles(there, find_mentions(model)).find_obstacle, place)
    return _UrdfLumping(model, graph, there, planned, place).run() if planned.joints else model


class _UrdfObstacles:
    """Says why a link cannot be lumped; an empty text for a link that is to stay without a report."""

    def __init__(self, there: Blocks, named: Mentions) -> None:
        self.there, self.named = there, named

    def find_obstacle(self, joint: Joint, parent: Link, child: Link) -> str | None:
        if not (child.visuals or child.collisions or _mass(child)) and child.name not in self.named.links:
            return None
        of_joint = block_content(self.there, joint.name)
        if is_preserved(of_joint):
            return ""
        if has_sensor(of_joint):
            return f"there is a sensor on joint {joint.name!r}"
        if joint.name in self.named.joints:
            return f"{self.named.joints[joint.name]} names joint {joint.name!r}"
        if child.name in self.named.links:
            return f"{self.named.links[child.name]} names it" if _mass(child) else ""
        mine, theirs = (
            body_settings(block_content(self.there, child.name)),
            body_settings(block_content(self.there, parent.name)),
        )
        other = next((about for about in {**mine, **theirs} if mine.get(about) != theirs.get(about)), None)
        return f"<gazebo> sets another {other!r} for {parent.name!r}" if other else None


def _mass(link: Link) -> float:
    return (link.inertial.mass or 0.0) if link.inertial else 0.0


class _UrdfLumping:
    """The lumping of one model."""

    def __init__(
        self, model: Model, graph: FrameGraph, there: Blocks, planned: LumpingPlan, place: EditContext
    ) -> None:
        self.model, self.graph, self.there, self.place = model, graph, there, place
        self.planned, self.guests = planned, planned.guests()
        self.links = {link.name: link for link in model.links}
        self.spent: dict[str, set[str]] = {}

    def run(self) -> Model:
        for host, names in self.guests.items():
            self._lump_into_host(host, names)
        made = replace_fields(self.model, links=tuple(self.links[link.name] for link in self.model.links))
        if made is self.model:
            return made
        taken = {host: posed_names(block_content(self.there, host)) for host in self.guests}
        extensions = tuple(
            each for one in self.model.extensions if (each := self._rest_of_extension(one, taken)) is not None
        )
        return made.copy(extensions=extensions)

    def _lump_into_host(self, host: str, names: list[str]) -> None:
        solids: list[Solid] = []
        own = body_of(self.links[host], self.graph, Format.URDF)
        for name in names:
            at = self.graph.pose(name, host)
            guest = self.links[name]
            solid = body_of(guest, self.graph, Format.URDF)
            if solid.mass:
                solids.append(placed(solid, at))
                # The link and its joint stay: URDF has no frames, and a massless link on a fixed
                # joint is what everybody uses for one. Transforms, sensors in <gazebo> and other
                # tools still find the name; removing it would need every reference rewritten with
                # an offset, which most of them cannot express.
                self.links[name] = guest.copy(inertial=None)
            for field in KINDS:
                self._move_shapes(host, name, field, at)
        self.links[host] = add_guests(self.links[host], own, solids, self.place.sink)

    def _move_shapes(self, host: str, name: str, field: str, at: Transform) -> None:
        """Move the visuals or collisions, unless other settings apply to those of the two links."""
        into, guest = self.links[host], self.links[name]
        shapes = getattr(guest, field)
        if not shapes:
            return
        # A tag such as <mu1> is about all shapes of a link: in one link they would get the same
        # tags, and a carrier would be read by nobody else. The mass still moves. SDF has a surface
        # for each shape.
        if self._shape_settings(into, field) != self._shape_settings(guest, field):
            message = f"the {field} of link {name!r} are not moved: <gazebo> sets other values for those of {host!r}"
            self.place.sink.report(rules.SHAPES_NOT_MOVED, message, guest.location, found=name)
            return
        self.spent.setdefault(name, set()).add(field)
        moved = _place_shapes(shapes, getattr(into, field), name, KINDS[field], at)
        self.links[host] = into.copy(**{field: (*getattr(into, field), *moved)})
        self.links[name] = guest.copy(**{field: ()})

    def _shape_settings(self, link: Link, field: str) -> tuple[Element, ...]:
        """Elements that apply to all shapes of a link, of `<gazebo>` and of other tools."""
        tools = tuple(part.element for part in link.opaque if part.element and not is_ours(part))
        return (*shape_elements(block_content(self.there, link.name), field), *(tools if field == "collisions" else ()))

    def _rest_of_extension(
        self, extension: GazeboExtension, taken: dict[str, set[tuple[str, str]]]
    ) -> GazeboExtension | None:
        """The extension of a link that was lumped; None where nothing is left.

        Elements for shapes that moved are removed, since those of the host say the same. Sensors stay; the name of the
        link is put before names that the body has already.
        """
        name = extension.reference or ""
        host = self.planned.hosts.get(name)
        if host is None:
            return extension
        fields = self.spent.get(name, set())
        kept = tuple(
            element for element in extension.content if not any(shape_elements((element,), field) for field in fields)
        )
        kept = rename_taken_names(kept, taken[host], name)
        if kept == extension.content:
            return extension
        return extension.copy(content=kept) if kept or extension.opaque else None


def _place_shapes(
    shapes: tuple[Shape, ...], there: tuple[Shape, ...], link: str, kind: str, at: Transform
) -> list[Shape]:
    """Shapes of a link in the frame of another one, with the names that readers give them in their own link."""
    taken = {shape.name for shape in (*there, *shapes) if shape.name}
    clashing = {shape.name for shape in there if shape.name}
    made: list[Shape] = []
    for shape in shapes:
        name = shape.name
        if not name or name in clashing:
            name = unique_name(f"{link}_{name or kind}", taken)
            taken.add(name)
        written = Transform.from_pose(shape.pose)
        pose = in_radians(at.compose(written))
        made.append(shape.copy(name=name, pose=shape.pose if at.is_identity else pose))
    return made
