"""Drop visuals, collisions, sensors, plugins and lights from a model."""

from typing import ClassVar, Self, TypeVar

from pydantic import Field, model_validator

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import NOTHING_MATCHED
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
)
from twinform.passes.carriers.carriers import is_ours
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name
from twinform.passes.structure.dangling import RemovedNames, report_dangling

AnyNode = TypeVar("AnyNode", bound=Node)

_KINDS: dict[type[Node], str] = {
    Visual: "visuals",
    Collision: "collisions",
    Sensor: "sensors",
    Plugin: "plugins",
    Light: "lights",
}
"""The option that selects the nodes of a class that go."""
_OPTIONS = tuple(_KINDS.values())
_FREE_CONTENT = {option.removesuffix("s"): option for option in _OPTIONS}
"""The same for elements in the free content of `<gazebo>`."""


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
        """The document without what is to go."""
        removed = RemovedNames()
        everywhere = "*" in self.links
        made = self._thinned(document, removed, meant=everywhere)
        made = map_children(made, lambda node: self._node(node, removed, meant=everywhere))
        for option in _OPTIONS:
            patterns = ", ".join(getattr(self, option))
            if patterns and option not in removed.names:
                message = f"none of the {option} is called {patterns}"
                sink.report(NOTHING_MATCHED, message, document.location, found=patterns)
        if made is not document:
            report_dangling(document, made, removed, sink)
        return made

    def _node(self, node: Node, removed: RemovedNames, *, meant: bool) -> Node:
        """The node without what is to go below it; `meant` is whether it is on a link that is meant."""
        if isinstance(node, GazeboExtension):
            return self._extension(node, removed)
        if isinstance(node, Link):
            meant = matches(node.name, self.links)
        made = map_children(
            self._thinned(node, removed, meant=meant), lambda child: self._node(child, removed, meant=meant)
        )
        return _without_empty(node, made) if isinstance(node, Model) and isinstance(made, Model) else made

    def _thinned(self, node: AnyNode, removed: RemovedNames, *, meant: bool) -> AnyNode:
        """The node without what is to go directly in it."""
        update: dict[str, object] = {}
        for name in node_fields(type(node)) if meant else ():
            value = getattr(node, name)
            if not value or isinstance(value, Node):
                continue
            kept = tuple(child for child in value if not self._is_dropped(child, removed))
            if len(kept) < len(value):
                update[name] = kept
        if meant and node.opaque:
            opaque = tuple(self._in_opaque(part, removed) for part in node.opaque)
            update |= {"opaque": opaque} if opaque != node.opaque else {}
        return node.copy(**update) if update else node

    def _in_opaque(self, part: Opaque, removed: RemovedNames) -> Opaque:
        """A part that the IR keeps as it is, such as `<gui>`, without what is to go in it."""
        # What travels in a carrier is a part of the other format, and comes back as it was.
        if part.element is None or is_ours(part):
            return part
        return replace_fields(part, element=self._inside(part.element, removed))

    def _is_dropped(self, node: Node, removed: RemovedNames) -> bool:
        option = _KINDS.get(type(node))
        if option is None:
            return False
        return self._is_named(option, getattr(node, "name", None), getattr(node, "filename", None), removed)

    def _is_named(self, option: str, name: str | None, file: str | None, removed: RemovedNames) -> bool:
        patterns = getattr(self, option)
        if not matches(name, patterns) and not (file and matches(file, patterns)):
            return False
        removed.names.setdefault(option, set()).add(name or "")
        return True

    def _extension(self, extension: GazeboExtension, removed: RemovedNames) -> GazeboExtension:
        """A `<gazebo>` element of URDF without what is to go in it."""
        if not matches(extension.reference, self.links):
            return extension
        return replace_fields(extension, content=self._kept_elements(extension.content, removed))

    def _kept_elements(self, elements: tuple[Element, ...], removed: RemovedNames) -> tuple[Element, ...]:
        """The elements that stay, without what is to go in them; the parameters of plugins are theirs alone."""
        return tuple(self._inside(each, removed) for each in elements if not self._element_goes(each, removed))

    def _inside(self, element: Element, removed: RemovedNames) -> Element:
        if element.name == "plugin":
            return element
        return replace_fields(element, children=self._kept_elements(element.children, removed))

    def _element_goes(self, element: Element, removed: RemovedNames) -> bool:
        option = _FREE_CONTENT.get(element.name)
        return option is not None and self._is_named(option, element.get("name"), element.get("filename"), removed)


def _without_empty(before: Model, after: Model) -> Model:
    """The model without the `<gazebo>` elements that have nothing left."""
    if after.extensions is before.extensions:
        return after
    pairs = zip(before.extensions, after.extensions, strict=True)
    kept = tuple(new for old, new in pairs if new is old or new.content or new.opaque)
    return after.copy(extensions=kept)
