"""Every reference to a part follows when the part gets another name."""

import re
from dataclasses import dataclass
from typing import TypeVar

from twinform.diagnostics import Location, Notes
from twinform.diagnostics.rules import edits as rules
from twinform.ir import (
    Axis,
    Collision,
    Element,
    Format,
    Frame,
    GazeboExtension,
    Include,
    Joint,
    Link,
    Model,
    Node,
    Opaque,
    Plugin,
    Pose,
    Sensor,
    Visual,
    rewrite,
)
from twinform.ir.sourced import Sourced
from twinform.passes.legalise.nodes import map_elements
from twinform.passes.structure.reference_words import Kind, kind_of_attribute, kind_of_text
from twinform.passes.structure.scopes import Scope

AnyNode = TypeVar("AnyNode", bound=Node)
Shaped = TypeVar("Shaped", Visual, Collision)
_DEFINES = frozenset({"link", "joint", "frame"})
_MODELS = frozenset({"model", "model_state"})
_SEPARATORS = re.compile(r"([\s,;]+)")
_DEFAULT_SHAPE = ("_collision", "_visual", "_fixed_joint_lump__")
"""What readers of URDF put behind a link's name to call its shapes."""


def renamed_model(model: Model, scope: Scope, format_: Format, notes: Notes) -> Model:
    """The model with the names of the scope, wherever they stand in it."""
    return _Renamer(scope, format_, notes).model(model)


def renamed_contents(model: Model, scope: Scope, format_: Format, notes: Notes) -> Model:
    """The model with the names of the scope in its plugins and untyped parts alone."""
    renamer = _Renamer(scope, format_, notes)
    plugins = tuple(renamer.plugin(plugin) for plugin in model.plugins)
    return _changed(model, {"plugins": plugins, "opaque": renamer.opaque(model.opaque, model.location)})


@dataclass(frozen=True, slots=True)
class _Renamer:
    """The references of one model. In URDF a link's pose names its joint, and a joint's pose a link."""

    scope: Scope
    format: Format
    notes: Notes

    def model(self, model: Model) -> Model:
        follow = self.scope.follow
        update: dict[str, object] = {
            "canonical_link": follow("link", model.canonical_link),
            "placement_frame": follow("any", model.placement_frame),
            "links": tuple(map(self.link, model.links)),
            "joints": tuple(map(self.joint, model.joints)),
            "frames": tuple(map(self.frame, model.frames)),
            "models": tuple(map(self.nested, model.models)),
            "includes": tuple(map(self.include, model.includes)),
            "plugins": tuple(self.plugin(plugin) for plugin in model.plugins),
            "extensions": tuple(map(self.extension, model.extensions)),
            "opaque": self.opaque(model.opaque, model.location),
        }
        return _changed(model, update)

    def link(self, link: Link) -> Link:
        pose = self.pose(link.pose, "joint")
        inside = self.inside(link.model_copy(update={"pose": None}))
        return _changed(inside, {"name": self.scope.own["link"].get(link.name, link.name), "pose": pose})

    def joint(self, joint: Joint) -> Joint:
        follow = self.scope.follow
        pose = self.pose(joint.pose, "link")
        update: dict[str, object] = {
            "name": self.scope.own["joint"].get(joint.name, joint.name),
            "parent": follow("link", joint.parent),
            "child": follow("link", joint.child),
            "gearbox_reference_body": follow("link", joint.gearbox_reference_body),
            "axis": self.axis(joint.axis),
            "axis2": self.axis(joint.axis2),
            "pose": pose,
        }
        return _changed(self.inside(joint.model_copy(update={"pose": None})), update)

    def frame(self, frame: Frame) -> Frame:
        name = self.scope.own["frame"].get(frame.name, frame.name)
        attached = self.scope.follow("any", frame.attached_to)
        return _changed(self.inside(frame), {"name": name, "attached_to": attached})

    def nested(self, model: Model) -> Model:
        """A nested model has a scope of its own; only its pose and its name belong to this one."""
        inner = _Renamer(self.scope.inner[model.name], self.format, self.notes).model(model)
        name = self.scope.own["model"].get(model.name, model.name)
        return _changed(inner, {"name": name, "pose": self.pose(model.pose, "any")})

    def include(self, include: Include) -> Include:
        name = self.scope.own["model"].get(include.name, include.name) if include.name else None
        plugins = tuple(self.plugin(plugin) for plugin in include.plugins)
        return _changed(include, {"name": name, "pose": self.pose(include.pose, "any"), "plugins": plugins})

    def axis(self, axis: Axis | None) -> Axis | None:
        if axis is None:
            return None
        update: dict[str, object] = {"expressed_in": self.scope.follow("any", axis.expressed_in)}
        if axis.mimic is not None:
            update["mimic"] = _changed(axis.mimic, {"joint": self.scope.follow("joint", axis.mimic.joint)})
        return _changed(axis, {**update, "opaque": self.opaque(axis.opaque, axis.location)})

    def pose(self, pose: Pose | None, kind: Kind) -> Pose | None:
        if pose is None or not pose.relative_to:
            return pose
        return _changed(pose, {"relative_to": self.scope.follow(kind, pose.relative_to)})

    def extension(self, extension: GazeboExtension) -> GazeboExtension:
        reference = self.reference(extension)
        content = tuple(self.element(each, "", extension.location) for each in extension.content)
        return _changed(extension, {"reference": reference, "content": content})

    def reference(self, extension: GazeboExtension) -> str | None:
        """A name that a link and a joint share means both, which two new names cannot."""
        name, own = extension.reference, self.scope.own
        if name and name in own["link"] and name in own["joint"] and own["link"][name] != own["joint"][name]:
            message = f"<gazebo> for {name!r}, a link and a joint, follows the link to {own['link'][name]!r}"
            self.notes.report(rules.UNFOLLOWED_NAME, message, extension.location.at("@reference"), found=name)
        return self.scope.follow("link", name)

    def plugin(self, plugin: Plugin) -> Plugin:
        content = tuple(self.element(each, "plugin", plugin.location) for each in plugin.content)
        return _changed(plugin, {"content": content})

    def sensor(self, sensor: Sensor) -> Sensor:
        update: dict[str, object] = {
            "frame_id": self.scope.follow("frame", sensor.frame_id),
            "plugins": tuple(self.plugin(plugin) for plugin in sensor.plugins),
            "opaque": self.opaque(sensor.opaque, sensor.location),
        }
        return _changed(sensor, update)

    def inside(self, node: AnyNode) -> AnyNode:
        """A node with what is in it, except for its own name and what else its kind has."""
        node = rewrite(node, Pose, lambda pose: self.pose(pose, "any") or pose)
        update: dict[str, object] = {"opaque": self.opaque(node.opaque, node.location)}
        if isinstance(node, Link | Joint):
            update["sensors"] = tuple(map(self.sensor, node.sensors))
        if isinstance(node, Link):
            update["visuals"] = tuple(map(self.shape, node.visuals))
            update["collisions"] = tuple(map(self.shape, node.collisions))
        return _changed(node, update)

    def shape(self, shape: Shaped) -> Shaped:
        update: dict[str, object] = {"opaque": self.opaque(shape.opaque, shape.location)}
        if isinstance(shape, Visual):
            update["plugins"] = tuple(self.plugin(plugin) for plugin in shape.plugins)
        return _changed(shape, update)

    def opaque(self, parts: tuple[Opaque, ...], where: Location) -> tuple[Opaque, ...]:
        if not parts:
            return parts
        return map_elements(parts, lambda element: self.element(element, "", where))

    def element(self, element: Element, holder: str, where: Location) -> Element:
        """An element without a typed form; `holder` is the name of the one around it."""
        where = element.location if element.source else where
        inner = self.scope.inner.get(element.get("name") or "") if element.name in _MODELS else None
        if inner is not None:
            return self.state_of_model(element, inner, where)
        attributes = tuple((key, self.attribute(element, key, value, where)) for key, value in element.attributes)
        update: dict[str, object] = {
            "attributes": attributes,
            "text": self.text(element, holder, where),
            "children": tuple(self.element(child, element.name, where) for child in element.children),
        }
        return _changed(element, update)

    def state_of_model(self, element: Element, scope: Scope, where: Location) -> Element:
        """What the state of a world says of a model, whose parts have names of their own."""
        new = self.scope.own["model"]
        attributes = tuple(
            (key, new.get(value, value) if key == "name" else value) for key, value in element.attributes
        )
        inside = _Renamer(scope, self.format, self.notes)
        children = tuple(inside.element(child, element.name, where) for child in element.children)
        return _changed(element, {"attributes": attributes, "children": children})

    def attribute(self, element: Element, key: str, value: str, where: Location) -> str:
        kind = kind_of_attribute(element, key)
        if kind is None or (key == "name" and element.name not in _DEFINES and kind == "frame"):
            if key != "name":  # which is a thing's own
                self.report_unfollowed(value, f"{key!r} of <{element.name}>", where)
            return value
        return self.scope.follow(kind, value) or value

    def text(self, element: Element, holder: str, where: Location) -> str | None:
        text = element.text
        if not text:
            return text
        if element.name == "collision":
            return self.collision(text)
        kind = kind_of_text(element, holder)
        if kind is None:
            self.report_unfollowed(text, f"the text of <{element.name}>", where)
            return text
        whole = self.scope.find(kind, text)
        if whole is not None:
            return whole
        return "".join(self.scope.follow(kind, each) or each for each in _SEPARATORS.split(text))

    def collision(self, text: str) -> str:
        """The name of a collision, which may begin with that of its link."""
        scoped, separator, last = text.rpartition("::")
        if separator:
            return f"{self.scope.follow('link', scoped)}::{last}"
        for old, new in self.scope.own["link"].items():
            if text.startswith(old) and text[len(old) :].startswith(_DEFAULT_SHAPE):
                return new + text[len(old) :]
        return text

    def report_unfollowed(self, value: str, place: str, where: Location) -> None:
        new = self.scope.find("any", value)
        if new is not None and new != value:
            message = f"{place} is {value!r}, which is called {new!r} now; nobody knows whether it means that"
            self.notes.report(rules.UNFOLLOWED_NAME, message, where, found=value)


Changed = TypeVar("Changed", bound=Sourced)


def _changed(node: Changed, update: dict[str, object]) -> Changed:
    """The node with these fields; the same object where they are what they were."""
    values = node.__dict__
    different = {name: value for name, value in update.items() if value != values[name]}
    return node.model_copy(update=different) if different else node
