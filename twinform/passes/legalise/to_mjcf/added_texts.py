"""Carriers of what edits of SDF or URDF have added to a document of MJCF: plugins, springs of contacts, looks.

Links and joints go by the names of their bodies and joints, which a reader of the file sees too. Most need no text.
"""

from collections.abc import Iterable
from typing import TypeVar

from twinform.ir import (
    Collision,
    Cone,
    Element,
    Heightmap,
    Joint,
    Light,
    Link,
    Material,
    Mesh,
    Node,
    Opaque,
    Plane,
    Polyline,
    Sensor,
    Visual,
    World,
    map_references,
    replace_fields,
    walk,
)
from twinform.ir.frames import MODEL, WORLD
from twinform.ir.scopes import SCOPE
from twinform.passes.carriers.annotations import (
    MADE_NAME,
    annotate_synthesized,
    annotation,
    find_annotation,
    is_synthesized,
)
from twinform.passes.carriers.carriers import is_ours, without_parts
from twinform.passes.carriers.joint_chains import CHAINS
from twinform.passes.carriers.mjcf_texts import (
    LOOP,
    NORMAL,
    PARTS,
    SHAPE_OF,
    TERRAIN,
)
from twinform.passes.carriers.old_names import source_name
from twinform.passes.carriers.partial_nodes import WRITTEN, Left, is_bare, is_rest, remainder
from twinform.passes.legalise.changed_names import fixed_joint_name
from twinform.passes.legalise.to_mjcf.contact_plan import MASKS
from twinform.passes.legalise.to_mjcf.file_models import FileModels
from twinform.passes.legalise.to_mjcf.friction import USUAL_SLIDING, without_friction
from twinform.passes.legalise.to_mjcf.inertials import weight_of
from twinform.passes.legalise.to_mjcf.lights import unread_light
from twinform.passes.legalise.to_mjcf.looks import is_seen
from twinform.passes.legalise.to_mjcf.model_texts import holder_partials, is_of_mjcf
from twinform.passes.legalise.to_mjcf.nested_texts import frames_between, nested_frames
from twinform.passes.legalise.to_mjcf.options import SETTINGS, has_usual_settings
from twinform.passes.legalise.to_mjcf.said_parts import without_elements
from twinform.passes.legalise.to_mjcf.text_list import TextList
from twinform.passes.legalise.to_mjcf.writing_context import KeptSensor, safe_name
from twinform.passes.legalise.to_sdf.joint_types import FLOATING

AnyShape = TypeVar("AnyShape", Visual, Collision)
_WRITTEN_OTHERWISE = (Cone, Heightmap, Plane, Polyline)
"""The shapes that MJCF lacks, turns or moves."""
_MASKS = frozenset(f"contact/{each}" for each in MASKS)
_OF_CONSTRAINTS = frozenset({"ball", "fixed"})
"""The types of joints that constraints are read as."""


class AddedTexts(TextList):
    """Adds the texts of one document that was read of MJCF."""

    def add(self) -> None:
        """Add texts for what was added to a document of MJCF while it was SDF or URDF: plugins, springs of contacts."""
        model, hidden = self.file.flat, self.file.hidden
        are_bits_usual = self.context.contacts.are_usual  # a file with no others has no masks
        links = [
            self._without_seen(self._as_mjcf_has_link(each, has_masks=not are_bits_usual))
            for each in model.links
            if each.name not in hidden
        ]
        links += [_without_place(each) for each in model.links if each.name in hidden]
        joints = [_without_hidden(each) if each.child in hidden else each for each in model.joints]
        joints = [self._as_mjcf_has_joint(each) for each in joints if not self._is_constraint(each)]
        models = FileModels(self.context)
        for part in holder_partials(self.context, self.file, models):
            self.add_text(*part)
        if isinstance(self.context.holder, World):
            self._add_world(self.context.holder, models)
        for left, frame in (*nested_frames(self.context, self.file), *frames_between(self.file)):
            self.add_text("frame", left.name, map_references(left, self._name_in_file), frame)
        for kind, parts in (("link", links), ("joint", joints)):
            for each in filter(lambda part: models.has_part(part.name), parts):
                self.file.part = each
                self._add_part(kind, each)

    def _add_part(self, kind: str, part: Link | Joint) -> None:
        """Add a text for what the file leaves unsaid of a link or joint, if that is anything."""
        left = remainder(_without_what_file_has(part), self._said_beside, self._notes_beside)
        if left is None or self._is_needless(left, part):
            return
        left = map_references(_with_names_of_sdf(left), self._name_in_file)
        names = [other for other in self.file.other_names(part) if other != WORLD]
        name = names[0] if len(names) == 1 else part.name
        own = name if self._is_named(part) and len(names) <= 1 else _own_name(part.name)
        self.add_text(kind, name, left.copy(name=own), part)

    def _is_named(self, part: Link | Joint) -> bool:
        """Whether a body or joint of the file has the name of a part: none has that of the world's own shapes."""
        if isinstance(part, Joint):
            return bool(self.context.written_joints.get(part.name))
        return self.context.written_bodies.get(part.name) != WORLD

    def _add_world(self, world: World, models: FileModels) -> None:
        """Add a text for what stands in a world itself, such as plugins, and for one that is read as a model."""
        told = without_parts(world.copy(models=(), joints=(), frames=(), gravity=None), is_of_mjcf)
        lights = tuple(left for each in world.lights if (left := unread_light(each)) is not None)
        told, notes = told.copy(lights=lights), ()
        if has_usual_settings(self.context):
            told = without_elements(told, SETTINGS)
        else:
            told, notes = told.copy(gravity=world.gravity), tuple(self.spelling.on_world(world))
        left = remainder(told, self._said_beside, self._notes_beside)
        if left is None and not notes and models.is_world:
            return
        left = left or World.unchecked(name=world.name)
        self.add_text("world", "", left.copy(opaque=(*notes, *left.opaque)), world)

    def _is_named_by_file(self, joint: Joint) -> bool:
        """Whether a fixed joint, which has no name in MJCF, is called as it is when the file is read."""
        body = self._body_of(joint.child)
        # Where several would be called so, a number stands behind it. The link may have another name by now.
        made = find_annotation(joint, MADE_NAME)
        is_made = made is not None and made.text == _own_name(joint.name)
        is_made = is_made and joint.name.startswith(fixed_joint_name(joint.child or ""))
        return is_made or is_synthesized(joint) or _own_name(joint.name) == fixed_joint_name(body or "")

    def _name_in_file(self, kind: str, name: str) -> str:
        """The name that a part goes by in the file, where no scope stands before it."""
        context = self.context
        if name in {WORLD, MODEL}:
            return name
        if kind != "joint" and (body := context.written_bodies.get(name)):
            return _own_name(name) if body == WORLD else body
        if joints := context.written_joints.get(name):
            return joints[-1]
        if site := context.written_sites.get(name):
            return site
        is_model = isinstance(context.holder, World) and any(each.name == name for each in context.holder.models)
        return MODEL if is_model else _own_name(name)

    def _body_of(self, link: str | None) -> str | None:
        """The name of the body of a link, by which a joint without a name of its own is known."""
        return self.context.written_bodies.get(link or "", link)

    def _is_constraint(self, joint: Joint) -> bool:
        """Whether a joint is a constraint in MJCF, and is the joint that such a constraint is read as."""
        is_closing = joint.name in self.file.closing
        return is_closing and joint.type in _OF_CONSTRAINTS and not (joint.axis or joint.sensors)

    def _is_needless(self, left: Node, node: Node) -> bool:
        """Whether what is left of a node says nothing: notes alone that tell of no name, URI, chain or shape."""
        has_more = (isinstance(node, Joint) and _is_of_chain(node)) or _tells_of_names(left) or _has_more_shapes(left)
        return is_bare(self._without_what_names(left, node)) and not has_more

    def _without_what_names(self, left: Node, node: Node) -> Node:
        """What is left of a node, without what a fixed joint is known by if it is read with the name that it has."""
        if (
            isinstance(left, Joint)
            and isinstance(node, Joint)
            and node.type == "fixed"
            and self._is_named_by_file(node)
        ):
            return left.copy(parent=None, child=None, pose=None)
        return left

    def _as_mjcf_has_link(self, link: Link, *, has_masks: bool) -> Link:
        """A link without what geoms and bodies say of it, and what sensors are read with."""
        self.file.part = link

        def left_of(collision: Collision) -> Collision:
            has_geom = self.file.geom_name(collision) is not None
            return _as_mjcf_has_collision(collision, has_masks=has_masks) if has_geom else collision

        lights = (left for each in link.lights if (left := unread_light(each)) is not None)
        # What stands in the world itself is read as no part of the link of its shapes.
        is_of_world = self.context.written_bodies.get(link.name) == WORLD
        return link.copy(
            collisions=tuple(map(left_of, link.collisions)),
            sensors=link.sensors if is_of_world else self._unread_sensors(link.sensors),
            lights=link.lights if is_of_world else tuple(lights),
            inertial=None if weight_of(link).is_nothing else link.inertial,
            kinematic=None if link.name in self.context.mocap else link.kinematic,
        )

    def _as_mjcf_has_joint(self, joint: Joint) -> Joint:
        """A joint without sensors, and without the axis of a ball, which is there for its damping alone."""
        axis = joint.axis.copy(xyz=None) if joint.axis and joint.type == "ball" else joint.axis
        return joint.copy(sensors=self._unread_sensors(joint.sensors), axis=axis)

    def _unread_sensors(self, sensors: Iterable[Sensor]) -> tuple[Sensor, ...]:
        """The sensors of which the file leaves something unsaid."""
        kept = self.context.kept_sensors
        found = (_unread(each, kept.get(id(each.source)), self.what.left_of(each)) for each in sensors)
        return tuple(left for left in found if left is not None)

    def _without_seen(self, link: Link) -> Link:
        """A link whose visuals have no material that the file shows as it is."""
        self.file.part = link
        if self.context.models[1:]:  # flattening gives it to links
            link = link.copy(self_collide=None)

        def unseen(visual: Visual) -> Visual:
            geom = self.file.geom(visual)
            if visual.material is None or geom is None:
                return visual
            asset = self.file.asset_element("material", geom.get("material"))
            bare = without_parts(visual.material, is_ours)
            return visual.copy(material=None) if is_seen(bare, geom, asset) else visual

        return link.copy(visuals=tuple(map(unseen, link.visuals)))

    def _said_beside(self, node: Node) -> frozenset[str] | Left | None:
        """What the file says of a node that was read of MJCF; a material that it does not show is taken whole."""
        if isinstance(node, Material):
            return None
        return self.said(node)

    def _notes_beside(self, node: Node) -> tuple[Opaque, ...]:
        """What tells that a material, sensor or URI is as it was written; its part keeps its name in the file then."""
        if isinstance(node, Visual | Collision):
            look = self.spelling.look(node) if isinstance(node, Visual) and node.material is not None else ()
            notes = (*look, *(self.spelling.on_shape(node) if _is_told(node) else ()))
            geom = self.file.geom_name(node) or ""
            is_unnamed = ("geom", geom) in self.context.unnamed
            if not notes and (is_unnamed or geom in {"", source_name(self._whole(node))}):
                return ()
            self.context.unnamed.discard(("geom", geom))
            return (*(annotation(WRITTEN, attributes={"as": each}) for each in self.file.other_names(node)), *notes)
        if isinstance(node, Joint) and (node.name in self.file.closing or node.type in CHAINS):
            return tuple(self._notes_of_several(node))
        if isinstance(node, Joint):  # its frame, in which sensors on it are posed, is turned as it was written
            return tuple(self.spelling.on_joint(node)) if node.sensors else ()
        if isinstance(node, Sensor) and (read := self.context.kept_sensors.get(id(node.source))) is not None:
            return () if read.name == node.name else (annotation(WRITTEN, attributes={"as": read.name}),)
        if isinstance(node, Light) or (isinstance(node, Sensor) and self.what.left_of(node) is not None):
            parts = self.file.parts_of(node)
            self.context.unnamed.difference_update((each.name, each.get("name") or "") for each in parts)
            return tuple(self.spelling.parts(node))
        return ()

    def _whole(self, shape: Visual | Collision) -> Visual | Collision:
        """The shape of which a part is left, with the note of the name that it had."""
        link = self.file.part
        shapes = (*link.visuals, *link.collisions) if isinstance(link, Link) else ()
        alike = (each for each in shapes if type(each) is type(shape) and each.name == shape.name)
        return next(alike, shape)

    def _notes_of_several(self, joint: Joint) -> Iterable[Opaque]:
        """The names of the joints or constraints that stand for a joint, and that it closes a loop."""
        names = self.file.other_names(joint)
        if joint.name in self.file.closing:
            yield annotation(LOOP)
            self.context.unnamed.difference_update((tag, each) for tag in ("connect", "weld") for each in names)
        yield from (annotation(WRITTEN, attributes={"as": each}) for each in names)


def _is_of_chain(joint: Joint) -> bool:
    """Whether a joint is several in MJCF, or is one of several that a planar joint has become."""
    return (joint.type in CHAINS and joint.type != "ball") or _is_slide_of_planar(joint)


def _is_slide_of_planar(joint: Joint) -> bool:
    return joint.type == "prismatic" and is_synthesized(joint)


def _with_names_of_sdf(left: Node) -> Node:
    """What is left of a part, whose shapes are called as they are read: SDF keeps some names of MJCF for itself."""
    if not isinstance(left, Link):
        return left

    def named(shape: AnyShape) -> AnyShape:
        return shape.copy(name=safe_name(shape.name)) if shape.name else shape

    visuals, collisions = tuple(map(named, left.visuals)), tuple(map(named, left.collisions))
    return replace_fields(left, visuals=visuals, collisions=collisions)


def _without_place(link: Link) -> Link:
    """A link between joints of one body as it is read, without the token that it weighs: it may have flags.

    Without shapes it touches nothing, whatever it says of that.
    """
    return without_parts(link.copy(pose=None, inertial=None, self_collide=None), is_ours)


def _without_hidden(joint: Joint) -> Joint:
    """A joint without the link between it and the next one of a body, if that has the name that it is read with."""
    return joint.copy(child=None) if (joint.child or "").startswith(f"{joint.name}_link") else joint


def _is_told(shape: Visual | Collision) -> bool:
    """Whether a shape may be a mesh in MJCF, name its file by a scheme, or be in a place of its own in its pose."""
    found = shape.geometry.shape if shape.geometry else None
    return isinstance(found, _WRITTEN_OTHERWISE) or (isinstance(found, Mesh) and "://" in (found.uri or ""))


def _has_more_shapes(left: Node) -> bool:
    """Whether what is left of a node has shapes for which there is no geom, if only empty ones."""
    return any(isinstance(each, Visual | Collision) and not is_rest(each) for each in walk(left))


def _tells_of_names(left: Node) -> bool:
    """Whether what is left of a node has a note of a file, plane, shape or sensor that is named otherwise than in MJCF.

    Of a sensor that is read as another one, or as none, its name and its type say something, and of a link that floats
    the joint by which it did so in URDF.
    """
    return any(
        any(find_annotation(each, note) is not None for note in (SHAPE_OF, NORMAL, TERRAIN))
        or (isinstance(each, Link) and find_annotation(each, FLOATING) is not None)
        or (isinstance(each, Visual | Collision | Sensor) and find_annotation(each, WRITTEN) is not None)
        or (isinstance(each, Sensor) and (find_annotation(each, PARTS) is not None or not is_rest(each)))
        for each in walk(left)
    )


def _own_name(name: str) -> str:
    """The name of a part in its model."""
    return name.rpartition(SCOPE)[2]


def _without_what_file_has(part: Link | Joint) -> Link | Joint:
    """A part without what only MJCF says of it; a light comes back as a whole, and keeps that."""
    bare = without_parts(part, is_of_mjcf)
    if isinstance(part, Joint) and _is_slide_of_planar(part):
        return annotate_synthesized(bare)
    return bare.copy(lights=part.lights) if isinstance(part, Link) and part.lights else bare


def _as_mjcf_has_collision(collision: Collision, *, has_masks: bool) -> Collision:
    """A collision without friction but for a second coefficient, or masks if the bits of its geom have them."""
    surface = collision.surface
    if surface is None:
        return collision
    surface = without_friction(without_elements(surface, _MASKS) if has_masks else surface)
    one, other = (USUAL_SLIDING if each is None else each for each in (surface.mu, surface.mu2))
    # A geom is read with one coefficient for both, so that the usual second one has to be told of as well.
    return collision.copy(surface=surface.copy(mu2=None if one == other else other))


def _unread(sensor: Sensor, read: KeptSensor | None, written: Node | None) -> Sensor | None:
    """What a file of MJCF leaves unsaid of a sensor, without a type where readings stand for it; None for nothing.

    `read` is how it is read of the readings that it keeps, and `written` is there if the file has it as a camera.
    """
    opaque = tuple(part for part in sensor.opaque if not (is_of_mjcf(part) or _is_read(part.element, read)))
    bare = sensor.copy(type=None, pose=None, opaque=opaque)
    is_read = read.name == sensor.name if read is not None else sensor.type == "camera" and written is not None
    if is_read and bare == Sensor.unchecked(name=sensor.name):
        return None
    return sensor if read is None else bare


def _is_read(element: Element | None, read: KeptSensor | None) -> bool:
    """Whether parameters of a sensor are those that sensors of MJCF are read with."""
    if element is None:
        return False
    if read is not None:
        return element.name in _PARAMETERS and (element.name != "contact" or read.has_same_contacts)
    return element.name == "camera" and {each.name for each in element.walk()} <= _OF_CAMERAS


_PARAMETERS = frozenset({"contact", "lidar", "force_torque"})
_OF_CAMERAS = frozenset({"camera", "horizontal_fov", "image", "width", "height"})
