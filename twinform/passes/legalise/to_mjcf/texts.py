"""Carriers in MJCF: what it cannot say, as `<custom><text name="twinform:..." data="..."/></custom>`.

Each link, joint, frame, model or world has one text, which holds the partial node with all that MJCF leaves unsaid:
`twinform:link:arm::hand` is about the link `hand` in the model `arm`. `twinform:document` holds the format and version
of the source, and what stands beside the model or world that is written.

Poses and axes are in the file, so only their frame and notation are in a text. So they stay true after an edit.
"""

from functools import cached_property

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import (
    Axis,
    Collision,
    Document,
    Dynamics,
    Format,
    Frame,
    Geometry,
    Inertial,
    Joint,
    Light,
    Limit,
    Link,
    Mesh,
    Mimic,
    Model,
    Node,
    Opaque,
    Pose,
    Sensor,
    Visual,
    World,
)
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.ir.rewrite import classes_below
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import FROM, annotation, came_from, is_synthesized
from twinform.passes.carriers.carriers import NAMESPACE, to_element, without_ours
from twinform.passes.carriers.joint_chains import CHAINS
from twinform.passes.carriers.mjcf_texts import (
    ATTACHED,
    AXES,
    DOCUMENT,
    LOOK_OF,
    LOOP,
    PARTS,
    PREFIXES,
    SEVERAL,
    SHAPE_OF,
    TURN,
    Tagged,
    bare_xml,
    digest_of,
    look_parts,
    text_element,
    text_name,
    xml_data,
)
from twinform.passes.carriers.partial_nodes import EXISTENCE, PLACE, REST, WRITTEN, Left, is_bare, remainder
from twinform.passes.carriers.said_by_mjcf import said_by_mjcf, said_of_limit
from twinform.passes.legalise.to_mjcf.inertials import weight_of
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext
from twinform.passes.legalise.to_mjcf.written_elements import WrittenElements
from twinform.passes.legalise.to_urdf.express_axes import ExpressAxes
from twinform.passes.legalise.to_urdf.flatten_for_urdf import flat_model
from twinform.passes.legalise.to_urdf.resolve_joint_ends import ResolveJointEnds
from twinform.passes.legalise.to_urdf.to_urdf_pass import UrdfKeeper
from twinform.passes.sdf_versions import sdf_version_read
from twinform.passes.shared.poses import OFFSET, POSE, offset_attributes, pose_attributes
from twinform.schemas import XmlElement, format_value, parse_version, versions_of

_OURS = f"{{{NAMESPACE}}}"
_MARK = f"{_OURS}{REST}"
_GROUPS = frozenset({"axis", "axis2", "limit", "dynamics", "surface"})
"""Elements that only group others: what is in them counts, and not they themselves."""
_ALWAYS_THE_FIRST = frozenset(each for each in versions_of("sdf") if parse_version(each) < (1, 7))
"""The versions of SDF in which the canonical link cannot be named."""
_DIRECTED = frozenset({"revolute", "continuous", "prismatic", "universal", "revolute2", "screw"})
"""The types of joints whose axes MJCF says."""
_WITHOUT_NOTES = frozenset(
    each for each in classes_below(Document) - {Document, World} if "pose" not in each.field_names
)
"""The classes of nodes on which there are never notes, such as those of shapes: they have no pose and no geom."""
Shape = Visual | Collision
Names = dict[tuple[type[Shape], str, str | None], str]
"""The names in MJCF of visuals and collisions, by the scoped name of the link and their own."""


def add_texts(context: MjcfContext) -> None:
    """Add a text to the `custom` section for each part that MJCF leaves unsaid. All other sections are complete."""
    texts = _Texts(context)
    model = texts.flat
    if context.is_of_mjcf:
        texts.add_additions(model)
        return
    texts.add(DOCUMENT, "", texts.document)
    if isinstance(context.holder, World):
        if context.document.worlds:
            texts.add("world", "", context.holder)
    else:
        texts.add("model", "", texts.with_canonical_link(model))
    for kind, parts in (("link", model.links), ("joint", model.joints), ("frame", model.frames)):
        for each in parts:
            texts.add(kind, each.name, texts.in_its_link(each) if isinstance(each, Frame) else each)


def _is_rest(xml: XmlElement) -> bool:
    """Whether a partial element belongs to one that MJCF says."""
    return next(xml.iterchildren(_MARK), None) is not None


def _as_mjcf_has_it(joint: Joint) -> Joint:
    """A joint without sensors, and without the axis of a ball, which is there for its damping alone."""
    axis = joint.axis.copy(xyz=None) if joint.axis and joint.type == "ball" else joint.axis
    return joint.copy(sensors=(), axis=axis)


def _is_mocap(link: Link) -> bool:
    """Whether a link keeps that only a program moves it."""
    return any(each.name == "body" and each.get("mocap") == "true" for each in kept_elements(link))


def _only_holds(joint: Joint) -> bool:
    """Whether a joint was made for a static model alone, whose bodies have none."""
    return joint.type == "fixed" and joint.parent == WORLD and is_synthesized(joint)


def _axes_note(inertial: Inertial, pose: Pose) -> list[Opaque]:
    """The annotation of the axes of an inertia, which MJCF writes in those of the body where it has products."""
    inertia = inertial.inertia
    if inertia is None or not (inertia.ixy or inertia.ixz or inertia.iyz):
        return []
    turn = Transform.from_pose(pose)
    if turn.is_unturned:
        return []
    rpy = " ".join(map(format_value, turn.rpy()))
    return [annotation(AXES, attributes={"rpy": rpy})]


class _Texts:
    """Makes the texts of one file. All names are scoped names: the models have been flattened."""

    def __init__(self, context: MjcfContext) -> None:
        self.context = context
        holder = context.holder
        self.is_back = isinstance(holder, Model) and came_from(holder, Format.URDF)
        self.around = ""
        self.joint: Joint | None = None
        self.link: Link | None = None
        self.geoms = self._written_geoms()
        self.elements = WrittenElements(context)

    @cached_property
    def flat(self) -> Model:
        """The model, or the world as one, flattened, with joints between links and axes in their frames.

        Annotations say how it was. What these passes account for is nothing that MJCF lacks.
        """
        holder = self.context.holder
        if isinstance(holder, World):
            model = Model.unchecked(
                name=holder.name, models=holder.models, joints=holder.joints, frames=holder.frames, source=holder.source
            )
        else:
            model = holder
        keeper = UrdfKeeper(DiagnosticSink(), carriers=True)
        if model.models:
            model = flat_model(model, keeper)
        for step in (ResolveJointEnds.unchecked(), ExpressAxes.unchecked()):
            model = step.run_model(model, keeper)
        return model

    @cached_property
    def document(self) -> Document:
        """The document with what stands beside the model or world that is written, and with its format and version."""
        document, holder = self.context.document, self.context.holder
        worlds = tuple(each for each in document.worlds if each is not holder)
        models = () if not document.worlds else document.models
        return document.copy(worlds=worlds, models=models)

    def add(self, kind: str, name: str, node: Node) -> None:
        """Add the text of a node, unless MJCF says all of it, and enter what it holds into the ledger."""
        self.around = name if kind == "link" else ""
        self.joint = node if isinstance(node, Joint) else None
        self.link = node if isinstance(node, Link) else None
        left = remainder(node, self.said, self.notes)
        if left is None and isinstance(node, World):  # what is a model has no world around it
            left = World.unchecked(name=node.name)
        if left is not None:
            self._add_text(kind, name, left, node)

    def _add_text(self, kind: str, name: str, left: Node, node: Node) -> None:
        xml = bare_xml(left, kind)
        self._account(xml, f"{kind} {name!r}" if name else f"the {kind}", node)
        if self.context.keeper.carriers:
            self.context.add("custom", text_element(text_name(kind, name), xml_data(xml)))

    def add_additions(self, model: Model) -> None:
        """Add texts for what was added to a document of MJCF while it was SDF: plugins and the like."""
        # What touches what, geoms say; and what hangs between the joints of a body, is made again.
        nothing = {"visuals": (), "collisions": (), "sensors": (), "lights": (), "self_collide": None}
        links = [
            each.copy(
                **nothing,
                inertial=None if weight_of(each).is_nothing else each.inertial,
                kinematic=None if _is_mocap(each) else each.kinematic,
                gravity=None if each.gravity is False else each.gravity,
            )
            for each in model.links
            if each.name not in self.hidden
        ]
        model = model.copy(self_collide=None, static=None)
        joints = [each.copy(child=None) if each.child in self.hidden else each for each in model.joints]
        joints = [_as_mjcf_has_it(each) for each in joints if each.name not in self.closing]
        moving = (each for each in joints if each.type != "fixed")
        for kind, parts in (("model", (model,)), ("link", links), ("joint", moving)):
            for each in parts:
                self.joint = each if isinstance(each, Joint) else None
                left = remainder(without_ours(each), self.said, lambda _: ())
                if left is not None and not is_bare(left):
                    name = next(iter(self._other_names(each)), each.name)
                    self._add_text(kind, name, left.copy(name=name), each)

    def said(self, node: Node) -> frozenset[str] | Left | None:
        """The fields of a node that this file says, and what its writer left of it."""
        if isinstance(node, World):
            return Left(self._without_parts(node), frozenset({EXISTENCE}))
        left = self._left_of(node) if self.context.left else None
        if left is None:
            return self._said(node)
        if isinstance(left, Sensor):
            return Left(node, frozenset({EXISTENCE}))
        if left == node:
            return None
        return Left(left, said_by_mjcf(left) or frozenset())

    def _left_of(self, node: Node) -> Node | None:
        """What the writer of a node has left of it; flattening makes other objects of some nodes."""
        found = self.context.left.get(id(node))
        if found is None and node.source is not None:
            return self._left_by_source.get((type(node), id(node.source)))
        return found[1] if found else None

    @cached_property
    def _left_by_source(self) -> dict[tuple[type[Node], int], Node]:
        return {(type(node), id(node.source)): left for node, left in self.context.left.values() if node.source}

    def _said(self, node: Node) -> frozenset[str] | None:
        match node:
            case Light():
                return frozenset({EXISTENCE})
            case Axis() | Limit() | Dynamics() | Mimic() if self.joint is not None:
                return self._said_of_axis(node, self.joint)
            case Joint():
                return self._said_of_joint(node)
            case Visual() | Collision() | Link() | Frame():
                return said_by_mjcf(node) if self._is_written(node) else None
            case _:
                return said_by_mjcf(node)

    def _said_of_axis(self, node: Axis | Limit | Dynamics | Mimic, joint: Joint) -> frozenset[str] | None:
        """The fields that this file says of an axis, or of a group of values in one."""
        # A loop is held at points, which do not say how it turns there.
        if joint.name in self.closing:
            return None
        if isinstance(node, Limit):
            return said_of_limit(node, joint)
        if isinstance(node, Axis) and joint.type not in _DIRECTED:
            return None if joint.type == "fixed" else frozenset()
        return said_by_mjcf(node)

    def _said_of_joint(self, joint: Joint) -> frozenset[str] | None:
        if joint.name in self.closing:
            return frozenset({EXISTENCE})
        if joint.type == "fixed" and self.is_back:  # where a fixed joint itself is means nothing in URDF
            return frozenset({"name", "parent", "pose"})
        if joint.child in self.hidden:
            return frozenset({"name", "parent", "pose"})
        return said_by_mjcf(joint) if joint.name in self.context.written_joints or _only_holds(joint) else None

    def _is_written(self, node: Shape | Link | Frame) -> bool:
        """Whether there is an element for a node."""
        if isinstance(node, Link):
            return node.name in self.context.written_bodies
        if isinstance(node, Frame):
            return node.name in self.context.names.get("site", ())
        return self._key(node) in self.geoms

    def _without_parts(self, world: World) -> World:
        """What is left of a world, without what is flattened or has texts of its own."""
        lights = tuple(left for each in world.lights if (left := remainder(each, self.said, self.notes)) is not None)
        return world.copy(models=(), joints=(), frames=(), lights=lights)

    def notes(self, node: Node) -> tuple[Opaque, ...]:
        """The annotations on a node about its names in MJCF, and about the frames and notation of its poses."""
        return () if node.__class__ in _WITHOUT_NOTES else self._notes(node)

    def _notes(self, node: Node) -> tuple[Opaque, ...]:
        found = [annotation(WRITTEN, attributes={"as": name}) for name in self._other_names(node)]
        match node:
            case Document():
                found += self._provenance(node)
            case Visual() | Collision():
                found += self._shape_notes(node)
            case Inertial() if node.inertia is not None and node.pose is not None:
                found += _axes_note(node, node.pose)
            case World():
                found.append(annotation(PARTS, attributes={"digest": self._option_digest()}))
            case Light() | Sensor():
                found += self._parts_note(node)
            case Joint() if node.name in self.closing:
                return (*found, annotation(LOOP), *self._pose_notes(node))
            case Joint() if node.type != "fixed":
                found += self._turn(node)
            case Frame():
                found += self._attached(node)
            case Model() if not self.is_back:
                found += self._offset()
            case _:
                pass
        return (*found, *self._pose_notes(node))

    def _pose_notes(self, node: Node) -> list[Opaque]:
        """The annotation of the frame and the notation of a pose."""
        pose: Pose | None = getattr(node, "pose", None)
        attributes = pose_attributes(pose)
        if self.is_back and isinstance(node, Link | Joint):  # in URDF their frames go without saying
            attributes.pop("relative_to", None)
        return [annotation(POSE, attributes=attributes)] if attributes else []

    def with_canonical_link(self, model: Model) -> Model:
        """The model, which names its first link if that is not the first body of the file; no old model can."""
        first = next(iter(self.context.written_bodies), None)
        is_old = sdf_version_read(self._source_version()) in _ALWAYS_THE_FIRST
        if self.is_back or is_old or model.canonical_link or not model.links or first in {None, model.links[0].name}:
            return model
        return model.copy(canonical_link=model.links[0].name)

    def in_its_link(self, frame: Frame) -> Frame:
        """A frame that has no site, such as that of a nested model, posed in the link that it moves with."""
        if frame.name in self.context.names.get("site", ()):
            return frame
        body = self.graph.body(frame.name, kind="frame")
        if not self.graph.knows(body) or body == MODEL:
            return frame
        pose = self.graph.pose(frame.name, body, kind="frame", base="link").to_pose()
        return frame.copy(attached_to=body, pose=pose)

    def _look_note(self, visual: Visual) -> list[Opaque]:
        """The annotation of the elements that say how a visual looks, if they say it in another way than SDF."""
        geom = self.elements.geoms.get(self.geoms.get(self._key(visual), ""))
        if geom is None or visual.material is None or said_by_mjcf(visual.material) is not None:
            return []
        digest = digest_of(look_parts(dict(geom.attributes), self._asset))
        return [annotation(LOOK_OF, attributes={"digest": digest})]

    def _asset(self, tag: str, name: str) -> list[Tagged]:
        """An asset with the elements in it."""
        found = self.elements.asset(tag, name)
        return [] if found is None else [(each.name, dict(each.attributes)) for each in found.walk()]

    def _place_note(self, part: Shape) -> list[Opaque]:
        """The annotation of where a shape without a geom is among those of its link: in URDF only the place tells."""
        link = self.link
        if link is None or self._key(part) in self.geoms:
            return []
        shapes = link.visuals if isinstance(part, Visual) else link.collisions
        place = next((index for index, each in enumerate(shapes) if each.name == part.name), None)
        return [] if place is None else [annotation(PLACE, attributes={"index": str(place)})]

    def _turn(self, joint: Joint) -> list[Opaque]:
        """The annotation of how the frame of a joint is turned in its body, where MJCF only has an axis."""
        if joint.child is None or not self.graph.knows(joint.child):
            return []
        placed = self.graph.pose(joint.name, joint.child, kind="joint", base="link")
        turn = None if placed.is_unturned else " ".join(map(format_value, placed.rpy()))
        # Where a slide is along its axis, and beside it, changes no motion.
        is_slide = joint.type == "prismatic" and any(placed.translation)
        place = " ".join(map(format_value, placed.translation)) if is_slide else None
        return [annotation(TURN, attributes={"rpy": turn, "xyz": place})] if turn or place else []

    def _attached(self, frame: Frame) -> list[Opaque]:
        """The annotation of what a frame is attached to, if that is not the link that its site is in."""
        body = self.graph.body(frame.name, kind="frame")
        if isinstance(self.context.holder, World) and frame.attached_to is None:
            return []
        return [] if frame.attached_to == body else [annotation(ATTACHED, attributes={"to": frame.attached_to or ""})]

    @cached_property
    def graph(self) -> FrameGraph:
        """The frames of the flattened model."""
        return FrameGraph(self.flat)

    @cached_property
    def closing(self) -> frozenset[str]:
        """The joints that close loops."""
        return frozenset(each.name for each in self.context.tree.closing)

    @cached_property
    def hidden(self) -> frozenset[str]:
        """The links between joints of one body, which are no bodies."""
        return frozenset(each.name for each in self.flat.links if each.name not in self.context.written_bodies)

    def _provenance(self, document: Document) -> list[Opaque]:
        """The annotations of the version of SDF that the source had, and of the prefixes in it."""
        version, mixed = self._source_version(), "true" if self.context.mixed else None
        prefixes = [{"prefix": prefix, "uri": uri} for prefix, uri in document.namespaces if uri != NAMESPACE]
        is_alone = bool(self.context.document.worlds) or isinstance(self.context.holder, Model)
        return [
            annotation(FROM, attributes={"format": Format.SDF.value, "version": version, "mixed": mixed}),
            *([] if is_alone else [annotation(SEVERAL)]),
            *(annotation(PREFIXES, attributes=each) for each in prefixes),
        ]

    def _source_version(self) -> str | None:
        return self.context.source_version or self.context.document.version

    def _offset(self) -> list[Opaque]:
        """The annotation of where the model's own frame is in the world, which MJCF has no frame for."""
        placed = self.context.tree.frames.pose(MODEL, WORLD, kind="model", base="world")
        return [] if placed.is_identity else [annotation(OFFSET, attributes=offset_attributes(placed))]

    def _other_names(self, node: Node) -> tuple[str, ...]:
        """The names in MJCF of what stands for a node, where they are not its own name alone."""
        context = self.context
        if isinstance(node, Link):
            names = (context.written_bodies.get(node.name, node.name),)
        elif isinstance(node, Frame):
            names = (context.written_sites.get(node.name, node.name),)
        elif isinstance(node, Joint):
            names = context.written_joints.get(node.name) or (node.name,)
            if node.type == "screw":  # of whose two joints only the one that turns counts for others
                names = (f"{node.name}_{CHAINS[node.type][0]}", *names)
        elif isinstance(node, Visual | Collision):
            names = (self.geoms.get(self._key(node), node.name or ""),)
        else:
            return ()
        return () if names == (node.name,) else names

    def _shape_notes(self, part: Shape) -> list[Opaque]:
        looks = self._look_note(part) if isinstance(part, Visual) else []
        return [*self._shape_note(part), *self._place_note(part), *looks]

    def _shape_note(self, part: Shape) -> list[Opaque]:
        """The annotation of the file that stands for a shape, with the shape, or of the URI that a file had."""
        shape = part.geometry.shape if part.geometry else None
        geom = self.elements.geoms.get(self.geoms.get(self._key(part), ""))
        file = self.elements.file_of(geom) if geom is not None else None
        if shape is None or file is None or getattr(shape, "uri", None) == file:
            return []
        kept = shape.copy(scale=None) if isinstance(shape, Mesh) else shape
        holder = to_element(Geometry.unchecked(shape=kept), "geometry", "sdf")
        note = annotation(SHAPE_OF, attributes={"file": file})
        return [note.copy(element=note.element and note.element.copy(children=holder.children))]

    def _parts_note(self, part: Sensor | Light) -> list[Opaque]:
        """The annotation of the elements that a sensor or light has become."""
        if isinstance(part, Sensor) and self._left_of(part) is None:
            return []
        parts = self.elements.parts_of(part)
        names = "\n".join(f"{each.name} {each.get('name')}" for each in parts)
        digest = digest_of((each.name, dict(each.attributes)) for each in parts)
        return [annotation(PARTS, names, {"digest": digest})]

    def _option_digest(self) -> str:
        options = self.context.sections.get("option", [])
        return digest_of((each.name, dict(each.attributes)) for each in options)

    def _written_geoms(self) -> Names:
        context, found = self.context, Names()
        for name, link in context.tree.links.items():
            for each in (*link.visuals, *link.collisions):
                if id(each) in context.written_geoms:
                    found[type(each), name, each.name] = context.written_geoms[id(each)]
        return found

    def _key(self, shape: Shape) -> tuple[type[Shape], str, str | None]:
        return type(shape), self.around, shape.name

    def _account(self, xml: XmlElement, what: str, node: Node) -> None:
        """Enter what a partial element holds into the ledger; what is of our own namespace is in it already."""
        for child in xml:
            tag = str(child.tag)
            # By its child a joint is known that has no name in MJCF, which says it as well.
            if tag.startswith(_OURS) or (tag == "child" and _is_rest(xml)):
                continue
            if tag in _GROUPS or _is_rest(child):
                self._account(child, what, node)
                continue
            weight = sum(1 + len(each.attrib) for each in child.iter())
            message = f"<{tag}> of {what} has no equivalent in MJCF"
            self.context.account(rules.NOT_IN_MJCF, message, node.location.at(tag), weight)
