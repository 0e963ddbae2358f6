"""Drop visuals, collisions, sensors, plugins and lights from a model, and report references to them that are left."""

from collections.abc import Iterator
from dataclasses import field
from typing import ClassVar, Self, TypeVar

from pydantic import Field, model_validator

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import DROPPED_REFERENCE, NOTHING_MATCHED
from twinform.ir import (
    Collision,
    Document,
    Element,
    GazeboExtension,
    Light,
    Link,
    Model,
    Node,
    Opaque,
    Plugin,
    Sensor,
    Visual,
    map_children,
    node_fields,
    replace_fields,
    walk,
)
from twinform.ir.verify import verify
from twinform.passes.carriers.carriers import is_ours
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name

AnyNode = TypeVar("AnyNode", bound=Node)
_OPTION_OF: dict[type[Node], str] = {
    Visual: "visuals",
    Collision: "collisions",
    Sensor: "sensors",
    Plugin: "plugins",
    Light: "lights",
}
"""The option that selects nodes of a class."""
_OPTIONS = tuple(_OPTION_OF.values())
_FREE_CONTENT = {option.removesuffix("s"): option for option in _OPTIONS}
"""The option that selects elements in the free content of `<gazebo>`."""


@dataclass(frozen=True, slots=True)
class RemovedNames:
    """The names of removed parts, by option; empty for a part without a name."""

    names: dict[str, set[str]] = field(default_factory=dict[str, set[str]])


class Drop(Pass):
    """Take out what a simulation or a viewer does not need.

    Changes, by patterns for each kind:

    1. `visuals`, `collisions`, `sensors` and `lights` whose name matches; one without a name is matched by `*` alone;
    2. `plugins` whose name or file name matches, wherever they are;
    3. in URDF, such elements in `<gazebo>` too, and a `<gazebo>` element that has nothing left goes with them.

    With `links`, only what is on links with such a name, or about them, goes.
    Never touches: links, joints, inertias, models that an `<include>` names, and what travels in carriers.
    Diagnostics: `dropped-reference` for plugins that name what is gone, `nothing-matched` for a pattern that matches
    nothing, and what `check` would find in the result and did not in the source, such as a contact sensor without its
    collision.
    """

    name = "drop"
    example: ClassVar[str] = 'drop{sensors="*" plugins="*gazebo_ros*"}'

    visuals: tuple[str, ...] = Field(default=(), description=with_such_a_name("Visuals"))
    collisions: tuple[str, ...] = Field(default=(), description=with_such_a_name("Collisions"))
    sensors: tuple[str, ...] = Field(default=(), description=with_such_a_name("Sensors, and the plugins in them,"))
    plugins: tuple[str, ...] = Field(default=(), description=with_such_a_name("Plugins, or those of a file,"))
    lights: tuple[str, ...] = Field(default=(), description=with_such_a_name("Lights of links, models and worlds"))
    links: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only on links"))

    @model_validator(mode="after")
    def _check_any(self) -> Self:
        if not any(getattr(self, option) for option in _OPTIONS):
            raise ValueError(f"nothing to drop; give one of {', '.join(_OPTIONS)}")
        return self

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document without the selected parts."""
        removed = RemovedNames()
        everywhere = "*" in self.links
        made = self._drop_children(document, removed, meant=everywhere)
        made = map_children(made, lambda node: self._drop_below(node, removed, meant=everywhere))
        for option in _OPTIONS:
            patterns = ", ".join(getattr(self, option))
            if patterns and option not in removed.names:
                message = f"none of the {option} is called {patterns}"
                sink.report(NOTHING_MATCHED, message, document.location, found=patterns)
        if made is not document:
            report_dangling(document, made, removed, sink)
        return made

    def _drop_below(self, node: Node, removed: RemovedNames, *, meant: bool) -> Node:
        """The node without selected parts below it; `meant` is whether it is on a link that `links` selects."""
        if isinstance(node, GazeboExtension):
            return self._drop_in_extension(node, removed)
        if isinstance(node, Link):
            meant = matches(node.name, self.links)
        made = map_children(
            self._drop_children(node, removed, meant=meant), lambda child: self._drop_below(child, removed, meant=meant)
        )
        return _remove_empty_extensions(node, made) if isinstance(node, Model) and isinstance(made, Model) else made

    def _drop_children(self, node: AnyNode, removed: RemovedNames, *, meant: bool) -> AnyNode:
        """The node without selected parts directly in it."""
        update: dict[str, object] = {}
        for name in node_fields(type(node)) if meant else ():
            value = getattr(node, name)
            if not value or isinstance(value, Node):
                continue
            kept = tuple(child for child in value if not self._is_dropped(child, removed))
            if len(kept) < len(value):
                update[name] = kept
        if meant and node.opaque:
            opaque = tuple(self._drop_in_opaque(part, removed) for part in node.opaque)
            update |= {"opaque": opaque} if opaque != node.opaque else {}
        return node.copy(**update) if update else node

    def _drop_in_opaque(self, part: Opaque, removed: RemovedNames) -> Opaque:
        """A part that the IR keeps as it is, such as `<gui>`, without selected elements."""
        # What travels in a carrier is a part of the other format, and comes back as it was.
        if part.element is None or is_ours(part):
            return part
        return replace_fields(part, element=self._drop_in_element(part.element, removed))

    def _is_dropped(self, node: Node, removed: RemovedNames) -> bool:
        option = _OPTION_OF.get(type(node))
        if option is None:
            return False
        return self._note_if_named(option, getattr(node, "name", None), getattr(node, "filename", None), removed)

    def _note_if_named(self, option: str, name: str | None, file: str | None, removed: RemovedNames) -> bool:
        """Whether an option selects a name or a file; notes the name if so."""
        patterns = getattr(self, option)
        if not matches(name, patterns) and not (file and matches(file, patterns)):
            return False
        removed.names.setdefault(option, set()).add(name or "")
        return True

    def _drop_in_extension(self, extension: GazeboExtension, removed: RemovedNames) -> GazeboExtension:
        """A `<gazebo>` element of URDF without selected elements."""
        if not matches(extension.reference, self.links):
            return extension
        return replace_fields(extension, content=self._kept_elements(extension.content, removed))

    def _kept_elements(self, elements: tuple[Element, ...], removed: RemovedNames) -> tuple[Element, ...]:
        """The elements that stay, without selected elements in them; parameters of plugins are not looked into."""
        return tuple(
            self._drop_in_element(each, removed) for each in elements if not self._is_element_dropped(each, removed)
        )

    def _drop_in_element(self, element: Element, removed: RemovedNames) -> Element:
        if element.name == "plugin":
            return element
        return replace_fields(element, children=self._kept_elements(element.children, removed))

    def _is_element_dropped(self, element: Element, removed: RemovedNames) -> bool:
        option = _FREE_CONTENT.get(element.name)
        return option is not None and self._note_if_named(option, element.get("name"), element.get("filename"), removed)


def _remove_empty_extensions(before: Model, after: Model) -> Model:
    """The model without the `<gazebo>` elements that became empty."""
    if after.extensions is before.extensions:
        return after
    pairs = zip(before.extensions, after.extensions, strict=True)
    kept = tuple(new for old, new in pairs if new is old or new.content or new.opaque)
    return after.copy(extensions=kept)


def report_dangling(before: Document, after: Document, removed: RemovedNames, sink: DiagnosticSink) -> None:
    """Report plugins that name removed parts, and mistakes that the document did not have before."""
    names = {name for each in removed.names.values() for name in each if name} - set(_remaining_names(after))
    for element, where in _plugin_parameters(after):
        for word in (element.text, *(value for _, value in element.attributes)):
            name = (word or "").strip().rpartition("::")[2]
            if name in names:
                message = f"<{element.name}> of a plugin names {name!r}, which was removed"
                sink.report(DROPPED_REFERENCE, message, where, found=name)
    old, new = DiagnosticSink(sink.file, sink.strict), DiagnosticSink(sink.file, sink.strict)
    verify(before, old)
    verify(after, new)
    # Both documents are verified, so that no list of all kinds of references is needed here.
    known = {(each.rule.name, each.location) for each in old.diagnostics}
    sink.extend_new(each for each in new.diagnostics if (each.rule.name, each.location) not in known)


def _remaining_names(document: Document) -> Iterator[str]:
    """All names in a document."""
    for node in walk(document):
        name = getattr(node, "name", None)
        if isinstance(name, str):
            yield name
        if isinstance(node, GazeboExtension):
            yield from (element.get("name") or "" for each in node.content for element in each.walk())


def _plugin_parameters(document: Document) -> Iterator[tuple[Element, Location]]:
    """Every parameter of every plugin, and its location or that of the plugin."""
    for node in walk(document):
        for plugin, content in _plugins_of(node):
            for each in content:
                for element in each.walk():
                    yield element, element.location if element.source else plugin


def _plugins_of(node: Node) -> Iterator[tuple[Location, tuple[Element, ...]]]:
    if isinstance(node, Plugin):
        yield node.location, node.content
    if isinstance(node, GazeboExtension):
        for each in node.content:
            for element in each.walk():
                if element.name == "plugin":
                    yield (element.location if element.source else node.location), element.children
