"""Lumping of fixed joints in URDF: mass and shapes move to the parent link, and the links stay as frames."""

from typing import TypeVar

from twinform.diagnostics import rules
from twinform.ir import Collision, Element, Format, GazeboExtension, Joint, Link, Model, Visual, replace_fields
from twinform.ir.frames import FrameGraph
from twinform.ir.solids import Solid, placed
from twinform.ir.transform import Transform
from twinform.passes.carriers.carriers import is_ours
from twinform.passes.structure.combined_bodies import body_of, with_guests
from twinform.passes.structure.gazebo_blocks import (
    Blocks,
    blocks,
    content,
    measures,
    named_apart,
    of_body,
    of_shapes,
    posed_names,
)
from twinform.passes.structure.lumping_plan import LumpingPlan, plan
from twinform.passes.structure.mentions import Mentions, mentions
from twinform.passes.structure.model_edit import EditContext
from twinform.passes.transforms.lumped_links import is_preserved
from twinform.passes.transforms.nodes import unique_name
from twinform.passes.transforms.pose_notation import in_radians

Shape = TypeVar("Shape", Visual, Collision)
_KINDS = {"visuals": "visual", "collisions": "collision"}


def lump_urdf(model: Model, keep: tuple[str, ...], place: EditContext) -> Model:
    """The model in which only one link of each rigid body has mass; the same one where nothing changes."""
    if not any(joint.type == "fixed" for joint in model.joints):
        return model
    graph, there = FrameGraph(model), blocks(model.extensions)
    planned = plan(model, graph, keep, _UrdfObstacles(there, mentions(model)).why, place)
    return _UrdfLumping(model, graph, there, planned, place).run() if planned.joints else model


class _UrdfObstacles:
    """Why a link cannot be lumped; an empty text for one that has nothing to give, or is to stay."""

    def __init__(self, there: Blocks, named: Mentions) -> None:
        self.there, self.named = there, named

    def why(self, joint: Joint, parent: Link, child: Link) -> str | None:
        if not (child.visuals or child.collisions or _mass(child)) and child.name not in self.named.links:
            return None
        of_joint = content(self.there, joint.name)
        if is_preserved(of_joint):
            return ""
        if measures(of_joint):
            return f"there is a sensor on joint {joint.name!r}"
        if joint.name in self.named.joints:
            return f"{self.named.joints[joint.name]} names joint {joint.name!r}"
        if child.name in self.named.links:
            return f"{self.named.links[child.name]} names it" if _mass(child) else ""
        mine, theirs = of_body(content(self.there, child.name)), of_body(content(self.there, parent.name))
        other = next((about for about in {**mine, **theirs} if mine.get(about) != theirs.get(about)), None)
        return f"<gazebo> sets another {other!r} for {parent.name!r}" if other else None


def _mass(link: Link) -> float:
    return (link.inertial.mass or 0.0) if link.inertial else 0.0


class _UrdfLumping:
    """One run over one model."""

    def __init__(
        self, model: Model, graph: FrameGraph, there: Blocks, planned: LumpingPlan, place: EditContext
    ) -> None:
        self.model, self.graph, self.there, self.place = model, graph, there, place
        self.planned, self.guests = planned, planned.guests()
        self.links = {link.name: link for link in model.links}
        self.spent: dict[str, set[str]] = {}

    def run(self) -> Model:
        for host, names in self.guests.items():
            self._host(host, names)
        made = replace_fields(self.model, links=tuple(self.links[link.name] for link in self.model.links))
        if made is self.model:
            return made
        taken = {host: posed_names(content(self.there, host)) for host in self.guests}
        extensions = tuple(
            each for one in self.model.extensions if (each := self._rest_of_extension(one, taken)) is not None
        )
        return made.copy(extensions=extensions)

    def _host(self, host: str, names: list[str]) -> None:
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
            for field in _KINDS:
                self._shapes(host, name, field, at)
        self.links[host] = with_guests(self.links[host], own, solids, self.place.sink)

    def _shapes(self, host: str, name: str, field: str, at: Transform) -> None:
        """Move the shapes of a kind, unless `<gazebo>` or another tool sets other things for the two links' shapes."""
        into, guest = self.links[host], self.links[name]
        shapes = getattr(guest, field)
        if not shapes:
            return
        # A tag such as <mu1> is about all shapes of a link: in one link they would get the same
        # tags, and a carrier would be read by nobody else. The mass still moves. SDF has a surface
        # for each shape.
        if self._about(into, field) != self._about(guest, field):
            message = f"the {field} of link {name!r} are not moved: <gazebo> sets other values for those of {host!r}"
            self.place.sink.report(rules.SHAPES_NOT_MOVED, message, guest.location, found=name)
            return
        self.spent.setdefault(name, set()).add(field)
        moved = placed_shapes(shapes, getattr(into, field), name, _KINDS[field], at)
        self.links[host] = into.copy(**{field: (*getattr(into, field), *moved)})
        self.links[name] = guest.copy(**{field: ()})

    def _about(self, link: Link, field: str) -> tuple[Element, ...]:
        tools = tuple(part.element for part in link.opaque if part.element and not is_ours(part))
        return (*of_shapes(content(self.there, link.name), field), *(tools if field == "collisions" else ()))

    def _rest_of_extension(
        self, extension: GazeboExtension, taken: dict[str, set[tuple[str, str]]]
    ) -> GazeboExtension | None:
        """The extension of a link that gave what it had.

        What the new link of its shapes has in the same form goes. Sensors keep their place; where another one of the
        body is called so, the link's name comes before theirs.
        """
        name = extension.reference or ""
        host = self.planned.hosts.get(name)
        if host is None:
            return extension
        fields = self.spent.get(name, set())
        kept = tuple(
            element for element in extension.content if not any(of_shapes((element,), field) for field in fields)
        )
        kept = named_apart(kept, taken[host], name)
        if kept == extension.content:
            return extension
        return extension.copy(content=kept) if kept or extension.opaque else None


def placed_shapes(
    shapes: tuple[Shape, ...], there: tuple[Shape, ...], link: str, kind: str, at: Transform
) -> list[Shape]:
    """Shapes of a link in the frame of another one, by the names that readers call them by in their own link."""
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
