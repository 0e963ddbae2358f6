"""Annotations on how SDF wrote what MJCF says in another way: other names, the frames and notation of poses, the look.

Poses and axes are in the file, so only their frame and notation are in a note. So they stay true after an edit.
"""

from collections.abc import Callable, Iterable, Mapping
from functools import reduce
from typing import Any

from twinform.ir import (
    Collision,
    Document,
    Format,
    Frame,
    Geometry,
    Heightmap,
    Inertial,
    Joint,
    Light,
    Link,
    Mesh,
    Model,
    Node,
    Opaque,
    Plane,
    Pose,
    Sensor,
    Visual,
    World,
)
from twinform.ir.frames import MODEL, WORLD
from twinform.ir.rewrite import classes_below
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import CONTINUOUS, FROM, annotation
from twinform.passes.carriers.carriers import NAMESPACE, to_element
from twinform.passes.carriers.mjcf_texts import (
    ATTACHED,
    AXES,
    LOOK_OF,
    LOOP,
    NORMAL,
    PARTS,
    PREFIXES,
    SEVERAL,
    SHAPE_OF,
    TERRAIN,
    TURN,
    digest_of,
    look_parts,
    tagged,
)
from twinform.passes.carriers.partial_nodes import PLACE, WRITTEN
from twinform.passes.carriers.said_by_mjcf import said_by_mjcf
from twinform.passes.carriers.sdf_versions import is_version_carrier
from twinform.passes.legalise.to_mjcf.assets import vector_in
from twinform.passes.legalise.to_mjcf.geoms import UP
from twinform.passes.legalise.to_mjcf.inertials import weight_parts
from twinform.passes.legalise.to_mjcf.kept_mjcf import merged
from twinform.passes.legalise.to_mjcf.materials import is_kept_material
from twinform.passes.legalise.to_mjcf.said_parts import without_elements
from twinform.passes.legalise.to_mjcf.what_is_said import WhatIsSaid
from twinform.passes.legalise.to_mjcf.written_file import Shape
from twinform.passes.shared.joint_ends import joint_pose_attributes
from twinform.passes.shared.poses import OFFSET, POSE, offset_attributes, pose_attributes
from twinform.schemas import format_value

_POSED = frozenset(each for each in classes_below(Document) if "pose" in each.field_names)


class SpellingNotes:
    """Makes the annotations on the nodes of a flattened model that one file leaves necessary."""

    def __init__(self, said: WhatIsSaid) -> None:
        self.said, self.file, self.context = said, said.file, said.file.context
        self._by_class: Mapping[type[Node], Callable[[Any], Iterable[Opaque]]] = {
            **dict.fromkeys(_POSED, lambda _: ()),
            Document: self._provenance,
            Visual: self._on_visual,
            Collision: self.on_shape,
            Inertial: self._on_inertial,
            World: self.on_world,
            Light: self.parts,
            Sensor: lambda sensor: () if said.left_of(sensor) is None else self.parts(sensor),
            Joint: self.on_joint,
            Frame: self._attached,
            Model: self._offset,
        }

    def on(self, node: Node) -> tuple[Opaque, ...]:
        """The annotations on a node about its names in MJCF, and about the frames and notation of its poses."""
        of_class = self._by_class.get(node.__class__)
        if of_class is None:
            return ()
        written = [annotation(WRITTEN, attributes={"as": each}) for each in self.file.other_names(node)]
        return (*written, *of_class(node), *self._pose(node))

    def _pose(self, node: Node) -> Iterable[Opaque]:
        """The frame and the notation of a pose."""
        pose: Pose | None = getattr(node, "pose", None)
        attributes = joint_pose_attributes(node) if isinstance(node, Joint) else pose_attributes(pose)
        if not attributes:
            return ()
        if self.file.is_back and isinstance(node, Link | Joint):  # in URDF their frames go without saying
            attributes.pop("relative_to", None)
        return [annotation(POSE, attributes=attributes)] if attributes else ()

    def _provenance(self, document: Document) -> Iterable[Opaque]:
        """The version of SDF that the source had, and the prefixes in it."""
        context = self.context
        version, mixed = context.version_read, "true" if context.mixed else None
        yield annotation(FROM, attributes={"format": Format.SDF.value, "version": version, "mixed": mixed})
        if not (context.document.worlds or isinstance(context.holder, Model)):
            yield annotation(SEVERAL)
        for prefix, uri in document.namespaces:
            if uri != NAMESPACE:
                yield annotation(PREFIXES, attributes={"prefix": prefix, "uri": uri})

    def on_world(self, _world: World) -> Iterable[Opaque]:
        """The digest of the options of the file, which say the settings of the world."""
        options = self.context.sections.get("option", ())
        written = [reduce(merged, options)] if options else []  # what is kept of them stands in the same element
        yield annotation(PARTS, attributes={"digest": digest_of(tagged(written))})

    def _offset(self, _model: Model) -> Iterable[Opaque]:
        """Where the model's own frame is in the world, which MJCF has no frame for."""
        if not self.file.is_back:
            placed = self.context.tree.frames.pose(MODEL, WORLD, kind="model", base="world")
            if not placed.is_identity:
                yield annotation(OFFSET, attributes=offset_attributes(placed))

    def on_joint(self, joint: Joint) -> Iterable[Opaque]:
        """How the frame of a joint is turned in its body, where MJCF only has an axis; that constraints stand for it.

        MJCF has one word for `continuous` and for `revolute` without a range.
        """
        if joint.name in self.file.closing:
            is_held = joint.name in self.context.written_joints
            return [annotation(LOOP, attributes={"held": None if is_held else "false"})]
        if joint.type in {"fixed", "gearbox"} or joint.child is None or not self.file.graph.knows(joint.child):
            return ()
        if not self.context.written_joints.get(joint.name):  # as those of a static model
            return ()
        placed = self.file.graph.pose(joint.name, joint.child, kind="joint", base="link")
        turn = None if placed.is_unturned else _numbers(placed.rpy())
        # Where a slide is along its axis, and beside it, changes no motion.
        is_slide = joint.type == "prismatic" and any(placed.translation)
        place = _numbers(placed.translation) if is_slide else None
        notes = [annotation(TURN, attributes={"rpy": turn, "xyz": place})] if turn or place else []
        return [*notes, annotation(CONTINUOUS)] if joint.type == "continuous" else notes

    def _on_inertial(self, inertial: Inertial) -> Iterable[Opaque]:
        """The axes of an inertia; where it was computed, what it and the geoms that it was computed of are."""
        link = self.file.part
        if not isinstance(link, Link) or not any(map(is_version_carrier, inertial.opaque)):
            return _axes(inertial)
        geoms = [geom for each in link.collisions if (geom := self.file.geom(each)) is not None]
        digest = digest_of([weight_parts(inertial), *tagged(geoms)])
        names = "\n".join(each.get("name") or "" for each in geoms)
        return (*_axes(inertial), annotation(PARTS, names, {"digest": digest}))

    def _attached(self, frame: Frame) -> Iterable[Opaque]:
        """What a frame is attached to, if that is not the link that its site is in."""
        body = self.file.graph.body(frame.name, kind="frame")
        is_usual = isinstance(self.context.holder, World) and not frame.attached_to
        if is_usual or (frame.attached_to == body and body != WORLD):
            return ()
        return [annotation(ATTACHED, attributes={"to": frame.attached_to or ""})]

    def _on_visual(self, visual: Visual) -> Iterable[Opaque]:
        """As on a shape, and the elements that say how it looks, if they say it in another way than SDF."""
        yield from self.on_shape(visual)
        geom = self.file.geom(visual)
        is_of_file = visual.material is None and geom is not None and geom.get("rgba") is not None  # that of its mesh
        if is_of_file or (visual.material is not None and said_by_mjcf(visual.material) is None):
            yield from self.look(visual)

    def look(self, visual: Visual) -> Iterable[Opaque]:
        """The digest of the elements that say how a visual looks, if it has a geom, and whether it kept its names."""
        geom = self.file.geom(visual)
        if geom is not None:
            digest = digest_of(look_parts(dict(geom.attributes), self.file.asset))
            is_kept = is_kept_material(self.context, geom.get("material"))
            yield annotation(LOOK_OF, attributes={"digest": digest, "kept": "true" if is_kept else None})

    def on_shape(self, part: Shape) -> Iterable[Opaque]:
        """The file that stands for a shape, or where it faces; the place in its link of one without a geom.

        In URDF only the place tells which it is.
        """
        geom = self.file.geom(part)
        if geom is None:
            link = self.file.part
            if isinstance(link, Link) and self.file.geom_name(part) is None:
                shapes = link.visuals if isinstance(part, Visual) else link.collisions
                place = next((index for index, each in enumerate(shapes) if each.name == part.name), None)
                if place is not None:
                    yield annotation(PLACE, attributes={"index": str(place)})
            return
        shape, file = part.geometry.shape if part.geometry else None, self.file.file_of(geom)
        if shape is not None and file is not None and getattr(shape, "uri", None) != file:
            kept = shape.copy(scale=None) if isinstance(shape, Mesh) else without_elements(shape, {"size", "pos"})
            holder = to_element(Geometry.unchecked(shape=kept), "geometry", "sdf")
            note = annotation(SHAPE_OF, attributes={"file": file})
            yield note.copy(element=note.element and note.element.copy(children=holder.children))
        if isinstance(shape, Plane) and shape.normal not in {None, UP}:
            yield annotation(NORMAL, attributes={"xyz": _numbers(shape.normal or UP)})
        if isinstance(shape, Heightmap) and any(position := vector_in(shape, "pos", (0.0, 0.0, 0.0))):
            yield annotation(TERRAIN, attributes={"xyz": _numbers(position)})

    def parts(self, part: Sensor | Light) -> Iterable[Opaque]:
        """The elements that a sensor or light has become."""
        parts = self.file.parts_of(part)
        names = "\n".join(f"{each.name} {each.get('name')}" for each in parts)
        yield annotation(PARTS, names, {"digest": digest_of(tagged(parts))})


def _axes(inertial: Inertial) -> Iterable[Opaque]:
    """The axes of an inertia, which MJCF writes in those of the body where it has products."""
    inertia = inertial.inertia
    if inertia is None or inertial.pose is None or not (inertia.ixy or inertia.ixz or inertia.iyz):
        return ()
    turn = Transform.from_pose(inertial.pose)
    return () if turn.is_unturned else [annotation(AXES, attributes={"rpy": _numbers(turn.rpy())})]


def _numbers(values: Iterable[float]) -> str:
    return " ".join(map(format_value, values))
