"""Renaming parts of a model with every reference to them, by the scopes in which SDF looks names up."""

from collections.abc import Callable, Mapping
from dataclasses import field
from typing import Any, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import (
    Document,
    Element,
    Format,
    GazeboExtension,
    Model,
    Node,
    Plugin,
    ReferenceKind,
    World,
    map_children,
    map_references,
)
from twinform.ir.frames import MODEL, WORLD
from twinform.ir.record import Sourced
from twinform.ir.rewrite import OPAQUE, bits_of, census_of
from twinform.ir.scopes import nested_models, outer_models
from twinform.lazy import lazy_pattern
from twinform.passes.shared.nodes import map_elements
from twinform.passes.structure.reference_words import kind_of_attribute, kind_of_text

Part = str
"""`link`, `joint`, `frame` or `model`."""
Choose = Callable[[Part, str], str]
"""Gives a part of a kind its new name, by the old one."""
PARTS: tuple[tuple[Part, str], ...] = (
    ("link", "links"), ("joint", "joints"), ("frame", "frames"), ("model", "models"), ("model", "includes"),
)  # fmt: skip
"""The fields of a model with parts that have a name in its scope, by kind."""
RESERVED = frozenset({WORLD, MODEL, "__root__"})
"""Names that SDF reserves."""
LOOKUP_ORDER: dict[ReferenceKind, tuple[Part, ...]] = {
    "link": ("link", "frame", "model", "joint"),
    "joint": ("joint", "frame", "link", "model"),
    "frame": ("link", "frame", "joint", "model"),
    "any": ("link", "frame", "joint", "model"),
}
"""The kinds of parts that a reference may mean, the likeliest first."""
AnyNode = TypeVar("AnyNode", bound=Node)
Holder = TypeVar("Holder", Model, World)
_DEFINES = frozenset({"link", "joint", "frame"})
_MODELS = frozenset({"model", "model_state"})
_SEPARATORS = lazy_pattern(r"([\s,;]+)")
_DEFAULT_SHAPE = ("_collision", "_visual", "_fixed_joint_lump__")
"""What readers of URDF append to the name of a link to name its shapes."""
Changed = TypeVar("Changed", bound=Sourced)


@dataclass(frozen=True, slots=True)
class RenamedScope:
    """The names in a model: `own` has the new ones by kind, `inner` the scopes of nested models by old name."""

    name: str
    own: Mapping[Part, Mapping[str, str]]
    inner: Mapping[str, "RenamedScope"] = field(default_factory=dict[str, "RenamedScope"])

    @property
    def changes(self) -> bool:
        """Whether any name changes."""
        own = any(old != new for names in self.own.values() for old, new in names.items())
        return own or any(scope.changes for scope in self.inner.values())

    def find(self, kind: ReferenceKind, name: str) -> str | None:
        """The new name for a name in this model, also of a part of a nested model; None if it names nothing."""
        first, separator, rest = name.partition("::")
        whole = self._find_own(kind, name)  # before 1.8, or once it is flattened, a name may have colons in it
        if whole is not None or not separator:
            return whole
        if first in self.inner:
            inside = rest if rest == MODEL else self.inner[first].find(kind, rest)
            return None if inside is None else f"{self.own['model'].get(first, first)}::{inside}"
        if first in self.own["model"]:  # an include, of which only the file knows what is in it
            return f"{self.own['model'][first]}::{rest}"
        if first == self.name:  # Gazebo calls things by the model's name too
            inside = self.find(kind, rest)
            return None if inside is None else f"{first}::{inside}"
        return self._find_own("frame", name.removesuffix(f"::{MODEL}"))  # which stands for a model that was flattened

    def follow(self, kind: ReferenceKind, name: str) -> str:
        """The new name for an old one; a name of nothing in this model stays as it is."""
        found = None if name in RESERVED or kind == "material" else self.find(kind, name)
        return name if found is None else found

    def _find_own(self, kind: ReferenceKind, name: str) -> str | None:
        return next((self.own[part][name] for part in LOOKUP_ORDER[kind] if name in self.own[part]), None)


def scope_of(model: Model, choose: Choose, *, deep: bool = True) -> RenamedScope:
    """The scope of a model whose parts get new names; those in nested models only if `deep`."""
    own: dict[Part, dict[str, str]] = {part: {} for part, _ in PARTS}
    for part, field_name in PARTS:
        for node in getattr(model, field_name):
            if node.name and node.name not in RESERVED:
                own[part].setdefault(node.name, choose(part, node.name))
    inner = {
        nested.name: scope_of(nested, choose if deep else lambda _, name: name, deep=deep) for nested in model.models
    }
    return RenamedScope(model.name, own, inner)


def prefixed_scope(model: Model, prefix: str) -> RenamedScope:
    """The scope of a model whose own parts get a prefix; those in nested models keep their names."""
    return scope_of(model, lambda _, name: prefix + name, deep=False)


def part_names(document: Document) -> set[tuple[Part, str]]:
    """The kinds and names of all parts of all models in a document."""
    models = (model for outer in outer_models(document) for model in nested_models(outer))
    return {(part, node.name) for model in models for part, name in PARTS for node in getattr(model, name) if node.name}


def report_clashes(model: Model, scope: RenamedScope, format_: Format, sink: DiagnosticSink) -> bool:
    """Report parts that would share a name, also in nested models; whether there are any."""
    seen: dict[tuple[str, str], tuple[str, Location]] = {}
    clash = False
    for part, field_name in PARTS:
        kind = part if format_ is Format.URDF else ""  # SDF has one scope for all, URDF one for each kind
        for node in getattr(model, field_name):
            new = scope.own[part].get(node.name or "")
            if new is None:
                continue
            other = seen.setdefault((kind, new), (node.name, node.location))
            if other[1] != node.location or other[0] != node.name:
                message = f"{part} {node.name!r} and {other[0]!r} would both be called {new!r}"
                sink.report(rules.NAME_CLASH, message, node.location, found=new, related=(other[1],))
                clash = True
            elif format_ is Format.SDF and new != node.name and (new in RESERVED or "::" in new):
                message = f"{part} {node.name!r} cannot be called {new!r} in SDF"
                sink.report(rules.NAME_CLASH, message, node.location, found=new)
                clash = True
    inner = [report_clashes(nested, scope.inner[nested.name], format_, sink) for nested in model.models]
    return clash or any(inner)


def rename_model(model: Model, scope: RenamedScope, format_: Format, sink: DiagnosticSink) -> Model:
    """The model with the new names of a scope, in its parts and in references to them."""
    return _Renamer(scope, format_, sink).rename_model(model)


def follow_references(holder: Holder, scope: RenamedScope, format_: Format, sink: DiagnosticSink) -> Holder:
    """The model or world with the new names of a scope in references, but not in its own parts."""
    return _Renamer(scope, format_, sink).follow_in(holder)


def rename_in_world(before: World, after: World, scope: Callable[[Model], RenamedScope], only: str | None) -> World:
    """The world after its models were renamed, in which joints, frames and states follow.

    `before` has the models with their old names; `only` names the model that was renamed if it is the only one.
    """
    inner = {model.name: scope(model) for model in before.models if only in (None, model.name)}
    own: dict[str, dict[str, str]] = {part: {} for part in ("link", "joint", "frame", "model")}
    return follow_references(after, RenamedScope("", own, inner), Format.SDF, DiagnosticSink())


_HAVING = OPAQUE | bits_of(Plugin)
"""What may have names in elements without a type."""


@dataclass(frozen=True, slots=True)
class _Renamer:
    """Renames in one model."""

    scope: RenamedScope
    format: Format
    sink: DiagnosticSink

    def follow_in(self, holder: Holder) -> Holder:
        return self.follow_in_untyped(map_references(holder, self.scope.follow, self.format))

    def rename_model(self, model: Model) -> Model:
        for extension in model.extensions:
            self.report_shared(extension)
        followed = self.follow_in(model)
        update: dict[str, object] = {
            field: tuple(self.rename_part(part, node) for node in getattr(followed, field)) for part, field in PARTS
        }
        return _copy_if_changed(followed, update)

    def rename_part(self, part: Part, node: AnyNode) -> AnyNode:
        """A part of the model with its new name; a nested model has a scope of its own."""
        old: Any = getattr(node, "name", None)
        if isinstance(node, Model):
            node = _Renamer(self.scope.inner[old], self.format, self.sink).rename_model(node)
        return _copy_if_changed(node, {"name": self.scope.own[part].get(old, old)})

    def report_shared(self, extension: GazeboExtension) -> None:
        """Report a `<gazebo>` element for a link and a joint of one name, if these get two different names."""
        name, own = extension.reference, self.scope.own
        if name and name in own["link"] and name in own["joint"] and own["link"][name] != own["joint"][name]:
            message = f"<gazebo> for {name!r}, a link and a joint, follows the link to {own['link'][name]!r}"
            self.sink.report(rules.UNFOLLOWED_NAME, message, extension.location.at("@reference"), found=name)

    def follow_in_untyped(self, node: AnyNode) -> AnyNode:
        """The node with new names in opaque parts and plugins, its own and those below, except in nested models."""
        if not census_of(node) & _HAVING:
            return node
        update: dict[str, object] = {}
        if node.opaque:
            update["opaque"] = map_elements(node.opaque, lambda each: self.follow_in_element(each, "", node))
        if isinstance(node, Plugin | GazeboExtension):
            around = "plugin" if isinstance(node, Plugin) else ""
            update["content"] = tuple([self.follow_in_element(each, around, node) for each in node.content])
        changed = _copy_if_changed(node, update)
        return map_children(changed, lambda each: each if isinstance(each, Model) else self.follow_in_untyped(each))

    def follow_in_element(self, element: Element, around: str, placed: Sourced) -> Element:
        """The element with new names; `around` is the name of the element around it, and `placed` what has a place."""
        if element.source:
            placed = element
        inner = self.scope.inner.get(element.get("name") or "") if element.name in _MODELS else None
        if inner is not None:
            return self.follow_in_state(element, inner, placed)
        attributes = tuple(
            [(key, self.follow_attribute(element, key, value, placed)) for key, value in element.attributes]
        )
        update: dict[str, object] = {
            "attributes": attributes,
            "text": self.follow_text(element, around, placed),
            "children": tuple([self.follow_in_element(child, element.name, placed) for child in element.children]),
        }
        return _copy_if_changed(element, update)

    def follow_in_state(self, element: Element, scope: RenamedScope, placed: Sourced) -> Element:
        """The state of a model in a world, in which the names of the model are looked up."""
        new = self.scope.own["model"]
        attributes = tuple(
            (key, new.get(value, value) if key == "name" else value) for key, value in element.attributes
        )
        inside = _Renamer(scope, self.format, self.sink)
        children = tuple(inside.follow_in_element(child, element.name, placed) for child in element.children)
        return _copy_if_changed(element, {"attributes": attributes, "children": children})

    def follow_attribute(self, element: Element, key: str, value: str, placed: Sourced) -> str:
        kind = kind_of_attribute(element, key)
        if kind is None or (key == "name" and element.name not in _DEFINES and kind == "frame"):
            if key != "name":  # which is a thing's own
                self.report_unfollowed(value, f"{key!r} of <{element.name}>", placed)
            return value
        return self.scope.follow(kind, value)

    def follow_text(self, element: Element, around: str, placed: Sourced) -> str | None:
        text = element.text
        if not text:
            return text
        if element.name == "collision":
            return self.follow_collision(text)
        kind = kind_of_text(element, around)
        if kind is None:
            self.report_unfollowed(text, f"the text of <{element.name}>", placed)
            return text
        whole = self.scope.find(kind, text)
        if whole is not None:
            return whole
        return "".join(self.scope.follow(kind, each) for each in _SEPARATORS.split(text))

    def follow_collision(self, text: str) -> str:
        """The name of a collision, which may begin with the name of its link."""
        scoped, separator, last = text.rpartition("::")
        if separator:
            return f"{self.scope.follow('link', scoped)}::{last}"
        for old, new in self.scope.own["link"].items():
            if text.startswith(old) and text[len(old) :].startswith(_DEFAULT_SHAPE):
                return new + text[len(old) :]
        return text

    def report_unfollowed(self, value: str, place: str, placed: Sourced) -> None:
        new = self.scope.find("any", value)
        if new is not None and new != value:
            message = f"{place} is {value!r}, which is called {new!r} now; check whether this refers to it"
            self.sink.report(rules.UNFOLLOWED_NAME, message, placed.location, found=value)


def _copy_if_changed(node: Changed, update: dict[str, object]) -> Changed:
    """The node with these fields; the same object where nothing differs."""
    different = {name: value for name, value in update.items() if value != getattr(node, name)}
    return node.copy(**different) if different else node
