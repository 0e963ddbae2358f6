"""`<gazebo>` elements become what they mean in SDF."""

from collections import defaultdict
from collections.abc import Callable, Iterable
from typing import Any, ClassVar, TypeVar

from lxml import etree

from twinform.diagnostics import Fate, Location, Notes
from twinform.diagnostics.rules import structure, to_sdf
from twinform.ir import (
    Axis,
    Collision,
    Dynamics,
    Element,
    GazeboExtension,
    Joint,
    Link,
    Material,
    Model,
    Node,
    Opaque,
    Script,
    Surface,
    Visual,
)
from twinform.passes.legalise.carrier import carry, from_xml
from twinform.passes.legalise.model_pass import ModelPass
from twinform.passes.legalise.to_sdf.gazebo_tags import JOINT_TAGS, LINK_TAGS, SCRIPT_URI, Tag, value_text
from twinform.schemas import Context, element_xml, format_value, reader, table

AnyNode = TypeVar("AnyNode", bound=Node)
_Read = tuple[Tag, object]


class FoldGazebo(ModelPass):
    """Fold `<gazebo>` elements into the links, joints and the model that they refer to.

    Changes: 1. tags with a meaning of their own (`mu1`, `material`, `turnGravityOff`, ...) set the field that they
    mean, in every visual or collision of the link where they are about shapes; 2. `<visual>` and `<collision>` put
    their children into every visual or collision of the link; 3. all else is read as SDF at the place of the
    reference: sensors, plugins, lights, joints, poses.
    Never touches: what the link, joint or model says already; the other one stays, with `gazebo-conflict`.
    Diagnostics: `gazebo-conflict`, `gazebo-tag-without-target`, and those of reading SDF.
    """

    name: ClassVar[str] = "fold-gazebo"

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model without extensions."""
        if not model.extensions:
            return model
        links, joints = {link.name for link in model.links}, {joint.name for joint in model.joints}
        groups: dict[str, list[GazeboExtension]] = defaultdict(list)
        for extension in model.extensions:
            groups[extension.reference or ""].append(extension)
        fold = _Fold(model.name, notes)
        changed = model.model_copy(
            update={
                "extensions": (),
                "links": tuple(_each(model.links, groups, fold.link)),
                "joints": tuple(_each(model.joints, groups, lambda joint, found: fold.joint(joint, found, links))),
            }
        )
        lost = [one for name, found in groups.items() if name and name not in links | joints for one in found]
        return fold.lost(fold.model(changed, groups.get("", [])), lost)


def _each(
    nodes: Iterable[Any], groups: dict[str, list[GazeboExtension]], fold: Callable[[Any, list[GazeboExtension]], Any]
) -> Iterable[Any]:
    for node in nodes:
        yield fold(node, groups[node.name]) if node.name in groups else node


class _Fold:
    """One run over one model."""

    def __init__(self, model: str, notes: Notes) -> None:
        self.robot = model
        self.notes = notes

    def link(self, link: Link, extensions: list[GazeboExtension]) -> Link:
        tags, blobs, rest = self._sort(extensions, LINK_TAGS, {"visual", "collision"})
        link = _set_link_fields(link, [read for read in tags if read[0].target == "link"])
        visuals = tuple(_set_visual(visual, tags) for visual in link.visuals)
        collisions = tuple(_set_collision(collision, tags) for collision in link.collisions)
        link = link.model_copy(update={"visuals": visuals, "collisions": collisions})
        for blob in blobs:
            link = self._into_shapes(link, blob)
        return self._merge(link, "link", rest)

    def joint(self, joint: Joint, extensions: list[GazeboExtension], links: set[str]) -> Joint:
        if joint.name in links:  # the link of that name has taken everything but the tags for joints
            extensions = [_only(extension, JOINT_TAGS) for extension in extensions]
        tags, _, rest = self._sort(extensions, JOINT_TAGS, set())
        springs = {tag.field: value for tag, value in tags if tag.target == "dynamics"}
        if springs:
            axis = joint.axis or Axis()
            dynamics = (axis.dynamics or Dynamics()).model_copy(update=springs)
            joint = joint.model_copy(update={"axis": axis.model_copy(update={"dynamics": dynamics})})
        physics = [(tag.field, value) for tag, value in tags if tag.target == "physics"]
        if physics:
            joint = joint.model_copy(update={"opaque": (*joint.opaque, _physics(physics))})
        return self._merge(joint, "joint", rest)

    def model(self, model: Model, extensions: list[GazeboExtension]) -> Model:
        if not extensions:
            return model
        misplaced = {**LINK_TAGS, **JOINT_TAGS}
        rest: list[GazeboExtension] = []
        for extension in extensions:
            for element in extension.content:
                if element.name in misplaced:
                    model = self._misplaced(model, element, extension.location)
            rest.append(_without(extension, misplaced))
        return self._merge(model, "model", rest)

    def lost(self, model: Model, extensions: list[GazeboExtension]) -> Model:
        """What refers to nothing is carried, so that a corrected name finds it again."""
        for extension in extensions:
            element = _gazebo(extension)
            message = f"<gazebo> refers to {extension.reference!r}, which does not exist"
            self.notes.account(Fate.CARRIED, to_sdf.URDF_ONLY, message, extension.location, element.weight)
            model = carry(model, [Opaque(element=element)], "urdf")
        return model

    def _misplaced(self, model: Model, element: Element, where: Location) -> Model:
        message = f"<{element.name}> in a <gazebo> without reference means nothing"
        self.notes.report(to_sdf.GAZEBO_TAG_WITHOUT_TARGET, message, where, found=element.name)
        self.notes.account(Fate.CARRIED, to_sdf.GAZEBO_TAG_WITHOUT_TARGET, message, where, element.weight)
        return carry(model, [Opaque(element=Element(name="gazebo", children=(element,)))], "urdf")

    def _sort(
        self, extensions: list[GazeboExtension], tags: dict[str, Tag], shapes: set[str]
    ) -> tuple[list[_Read], list[tuple[Element, GazeboExtension]], list[GazeboExtension]]:
        """Tags with their values, blobs for shapes, and extensions with all that is left."""
        read: list[_Read] = []
        blobs: list[tuple[Element, GazeboExtension]] = []
        rest: list[GazeboExtension] = []
        for extension in extensions:
            for element in extension.content:
                if element.name in tags and not element.children:
                    read.extend(self._read(element, tags[element.name], extension.location))
                elif element.name in shapes:
                    blobs.append((element, extension))
            plain = {name for name in tags if not any(e.name == name and e.children for e in extension.content)}
            rest.append(_without(extension, plain | shapes))
        return read, blobs, rest

    def _read(self, element: Element, tag: Tag, where: Location) -> Iterable[_Read]:
        text = value_text(element)
        try:
            yield tag, tag.read(text)
        except ValueError:
            message = f"<{element.name}> in <gazebo> is {text!r}; expected a value of its type"
            self.notes.report(structure.INVALID_VALUE, message, where.at(element.name), found=text)

    def _into_shapes(self, link: Link, blob: tuple[Element, GazeboExtension]) -> Link:
        """Each child of a `<visual>` or `<collision>` goes into every shape of its kind, in place of what is there."""
        element, extension = blob
        field, kind = ("visuals", "visual") if element.name == "visual" else ("collisions", "collision")
        extra = self._read_as(kind, kind, [extension.model_copy(update={"content": element.children})])
        changed = tuple(_overlay(shape, extra) for shape in getattr(link, field))
        return link.model_copy(update={field: changed})

    def _merge(self, node: AnyNode, kind: str, extensions: list[GazeboExtension]) -> AnyNode:
        """The node with the SDF in the extensions read into it."""
        content = [extension for extension in extensions if extension.content or extension.opaque]
        if not content:
            return node
        update: dict[str, Any] = {}
        for field, value in self._read_as(kind, str(node.__dict__["name"]), content).items():
            mine = getattr(node, field)
            if isinstance(mine, tuple):
                update[field] = (*mine, *value)
            elif mine is None:
                update[field] = value
            else:
                self._conflict(node, field, content[0].location)
        return node.model_copy(update=update) if update else node

    def _conflict(self, node: Node, field: str, where: Location) -> None:
        message = f"<gazebo> says {field!r} of {getattr(node, 'name', '?')!r} again; the first one stays"
        self.notes.report(to_sdf.GAZEBO_CONFLICT, message, where, found=field)
        self.notes.account(Fate.DROPPED, to_sdf.GAZEBO_CONFLICT, message, where)

    def _read_as(self, kind: str, name: str, extensions: list[GazeboExtension]) -> dict[str, Any]:
        """The fields that the content of extensions sets when it is read as the inside of an SDF element."""
        robot = etree.Element("robot", {"name": self.robot})
        xml = etree.SubElement(robot, "gazebo", {"name": name, **_REQUIRED.get(kind, {})})
        for tag in _REQUIRED_CHILDREN.get(kind, ()):
            etree.SubElement(xml, tag).text = name
        for extension in extensions:
            for element in extension.content:
                for made in element_xml(element, xml).iter():
                    made.sourceline = extension.location.line  # pyright: ignore[reportAttributeAccessIssue] - it can be set
        context = Context(self.notes, self.notes.file, "sdf", table("sdf").newest)
        data = reader("sdf", context.version).read(xml, context, kind)
        fields = set(data) - {"source", "name", "type", "parent", "child"}
        if self.notes.has_errors or not fields:
            return {}
        base: dict[str, Any] = {"name": name, **_REQUIRED.get(kind, {})}
        node = _NODES[kind].model_validate({**base, **{field: data[field] for field in fields}})
        return {field: getattr(node, field) for field in fields}


_REQUIRED = {"joint": {"type": "fixed"}}
_REQUIRED_CHILDREN = {"joint": ("parent", "child")}
_NODES: dict[str, type[Node]] = {"link": Link, "joint": Joint, "model": Model, "visual": Visual, "collision": Collision}


def _without(extension: GazeboExtension, names: Iterable[str]) -> GazeboExtension:
    left = tuple(element for element in extension.content if element.name not in names)
    return extension.model_copy(update={"content": left})


def _only(extension: GazeboExtension, names: Iterable[str]) -> GazeboExtension:
    return extension.model_copy(update={"content": tuple(e for e in extension.content if e.name in names)})


def _gazebo(extension: GazeboExtension) -> Element:
    attributes = (("reference", extension.reference),) if extension.reference is not None else ()
    return Element(name="gazebo", attributes=attributes, children=extension.content)


def _set_link_fields(link: Link, tags: list[_Read]) -> Link:
    update: dict[str, object] = {tag.field: value for tag, value in tags if tag.field != "velocity_decay"}
    decay = [value for tag, value in tags if tag.field == "velocity_decay"]
    if decay:
        text = format_value(decay[0])
        parts = (Element(name="linear", text=text), Element(name="angular", text=text))
        update["opaque"] = (*link.opaque, Opaque(element=Element(name="velocity_decay", children=parts)))
    return link.model_copy(update=update) if update else link


def _set_visual(visual: Visual, tags: list[_Read]) -> Visual:
    names = [str(value) for tag, value in tags if tag.target == "visual" and value]
    if not names:
        return visual
    script = Script(uris=(SCRIPT_URI,), name=names[-1])
    material = (visual.material or Material()).model_copy(update={"script": script})
    return visual.model_copy(update={"material": material})


def _set_collision(collision: Collision, tags: list[_Read]) -> Collision:
    own = {tag.field: value for tag, value in tags if tag.target == "collision"}
    surface = {tag.field: value for tag, value in tags if tag.target == "surface"}
    if surface:
        own["surface"] = (collision.surface or Surface()).model_copy(update=surface)
    return collision.model_copy(update=own) if own else collision


def _overlay(shape: AnyNode, extra: dict[str, Any]) -> AnyNode:
    update = dict(extra)
    if "opaque" in update:
        update["opaque"] = (*shape.opaque, *update["opaque"])
    return shape.model_copy(update=update)


def _physics(values: list[tuple[str, object]]) -> Opaque:
    """The `<physics>` of a joint from paths below it and their values."""
    root = etree.Element("physics")
    for path, value in values:
        holder = root
        for step in path.split("/"):
            found = holder.find(step)
            holder = found if found is not None else etree.SubElement(holder, step)
        holder.text = format_value(value)
    return Opaque(element=from_xml(root))
