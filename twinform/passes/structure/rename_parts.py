"""Renaming parts of a model, with every reference to them."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeVar

from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import Element, Format, GazeboExtension, Model, Node, Plugin, World, map_children, map_references
from twinform.ir.sourced import Sourced
from twinform.passes.structure.reference_words import kind_of_attribute, kind_of_text
from twinform.passes.structure.scopes import PARTS, Part, RenamedScope
from twinform.passes.transforms.nodes import map_elements

AnyNode = TypeVar("AnyNode", bound=Node)
Holder = TypeVar("Holder", Model, World)
_DEFINES = frozenset({"link", "joint", "frame"})
_MODELS = frozenset({"model", "model_state"})
_SEPARATORS = re.compile(r"([\s,;]+)")
_DEFAULT_SHAPE = ("_collision", "_visual", "_fixed_joint_lump__")
"""What readers of URDF put behind a link's name to call its shapes."""


def renamed_model(model: Model, scope: RenamedScope, format_: Format, sink: DiagnosticSink) -> Model:
    """The model with the names of the scope, wherever they stand in it."""
    return _Renamer(scope, format_, sink).model(model)


def with_followed(holder: Holder, scope: RenamedScope, format_: Format, sink: DiagnosticSink) -> Holder:
    """The model or world with the names of the scope in its references, but not those of its parts."""
    return _Renamer(scope, format_, sink).followed(holder)


@dataclass(frozen=True, slots=True)
class _Renamer:
    """The names in one model."""

    scope: RenamedScope
    format: Format
    sink: DiagnosticSink

    def followed(self, holder: Holder) -> Holder:
        return self.untyped(map_references(holder, self.scope.follow, self.format))

    def model(self, model: Model) -> Model:
        for extension in model.extensions:
            self.report_shared(extension)
        followed = self.followed(model)
        update: dict[str, object] = {
            field: tuple(self.named(part, node) for node in getattr(followed, field)) for part, field in PARTS
        }
        return _changed(followed, update)

    def named(self, part: Part, node: AnyNode) -> AnyNode:
        """A part of the model by its new name; a nested model has a scope of its own."""
        old: Any = getattr(node, "name", None)
        if isinstance(node, Model):
            node = _Renamer(self.scope.inner[old], self.format, self.sink).model(node)
        return _changed(node, {"name": self.scope.own[part].get(old, old)})

    def report_shared(self, extension: GazeboExtension) -> None:
        """A name that a link and a joint share means both, which two new names cannot."""
        name, own = extension.reference, self.scope.own
        if name and name in own["link"] and name in own["joint"] and own["link"][name] != own["joint"][name]:
            message = f"<gazebo> for {name!r}, a link and a joint, follows the link to {own['link'][name]!r}"
            self.sink.report(rules.UNFOLLOWED_NAME, message, extension.location.at("@reference"), found=name)

    def untyped(self, node: AnyNode) -> AnyNode:
        """The node with its opaque parts and plugins, and those of all inside it but nested models."""
        update: dict[str, object] = {}
        if node.opaque:
            update["opaque"] = map_elements(node.opaque, lambda each: self.element(each, "", node.location))
        if isinstance(node, Plugin | GazeboExtension):
            holder = "plugin" if isinstance(node, Plugin) else ""
            update["content"] = tuple(self.element(each, holder, node.location) for each in node.content)
        changed = _changed(node, update)
        return map_children(changed, lambda each: each if isinstance(each, Model) else self.untyped(each))

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

    def state_of_model(self, element: Element, scope: RenamedScope, where: Location) -> Element:
        """What the state of a world has of a model, whose parts have names of their own."""
        new = self.scope.own["model"]
        attributes = tuple(
            (key, new.get(value, value) if key == "name" else value) for key, value in element.attributes
        )
        inside = _Renamer(scope, self.format, self.sink)
        children = tuple(inside.element(child, element.name, where) for child in element.children)
        return _changed(element, {"attributes": attributes, "children": children})

    def attribute(self, element: Element, key: str, value: str, where: Location) -> str:
        kind = kind_of_attribute(element, key)
        if kind is None or (key == "name" and element.name not in _DEFINES and kind == "frame"):
            if key != "name":  # which is a thing's own
                self.report_unfollowed(value, f"{key!r} of <{element.name}>", where)
            return value
        return self.scope.follow(kind, value)

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
        return "".join(self.scope.follow(kind, each) for each in _SEPARATORS.split(text))

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
            message = f"{place} is {value!r}, which is called {new!r} now; check whether this refers to it"
            self.sink.report(rules.UNFOLLOWED_NAME, message, where, found=value)


Changed = TypeVar("Changed", bound=Sourced)


def _changed(node: Changed, update: dict[str, object]) -> Changed:
    """The node with these fields; the same object where they are what they were."""
    different = {name: value for name, value in update.items() if value != getattr(node, name)}
    return node.copy(**different) if different else node


def renamed_in_world(before: World, after: World, scope: Callable[[Model], RenamedScope], only: str | None) -> World:
    """The world after its models were renamed, with its own joints, frames and the like following them.

    `before` has the models by their old names; `only` names the one model that was renamed, if it is one alone.
    """
    inner = {model.name: scope(model) for model in before.models if only in (None, model.name)}
    own: dict[str, dict[str, str]] = {part: {} for part in ("link", "joint", "frame", "model")}
    return with_followed(after, RenamedScope("", own, inner), Format.SDF, DiagnosticSink())
