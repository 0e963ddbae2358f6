"""All plugins and sensors of a document, in URDF or SDF, with their locations.

In SDF they are nodes of worlds, models, includes, links, joints, sensors and visuals, except those of actors and the
GUI, which are untyped elements. In URDF they are elements in `<gazebo>`. A pass does not need to know the difference.
"""

from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any, TypeVar

from lxml import etree

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.ir import (
    Document,
    Element,
    GazeboExtension,
    Include,
    Joint,
    Link,
    Model,
    Node,
    Opaque,
    Plugin,
    Sensor,
    Visual,
    World,
    replace_fields,
)
from twinform.ir.rewrite import node_fields
from twinform.passes.carriers.carriers import to_element
from twinform.schemas import Context, element_xml, reader, table

AnyNode = TypeVar("AnyNode", bound=Node)
# Where a plugin of Gazebo may stand. The <plugin> in <hardware> of a <ros2_control> is one of
# ros2_control.
_SCOPES = frozenset({"world", "model", "include", "link", "joint", "sensor", "visual", "projector", "actor", "gui"})
_LEAVES = frozenset({"plugins", "sensors"})
"""Fields whose nodes are plugins or sensors."""
_PLUGIN_ATTRIBUTES = frozenset({"name", "filename"})


@dataclass(frozen=True, slots=True)
class PluginSite:
    """Where a plugin or sensor stands: in a `scope` (`model`, `link`, `sensor`, ...) called `holder`.

    `models` are those around it, the innermost last; `link_or_joint` is the name of the link or joint around it.
    """

    scope: str = ""
    holder: str = ""
    world: World | None = None
    models: tuple[Model, ...] = ()
    link_or_joint: str | None = None
    sensor: Sensor | None = None
    included: bool = False
    """Whether it stands in an include, which may name a model or an actor."""

    @property
    def model(self) -> Model | None:
        """The innermost model around it."""
        return self.models[-1] if self.models else None


PluginChange = Callable[[Plugin, PluginSite], Iterable[Plugin]]
SensorChange = Callable[[Sensor, PluginSite], Iterable[Sensor]]


def map_plugins(document: Document, change: PluginChange) -> Document:
    """The document with each plugin replaced by the results of `change`; the same document if nothing changes."""
    return _Walk(plugin=change).node(document, PluginSite())


def map_sensors(document: Document, change: SensorChange) -> Document:
    """The document with each sensor of a link or joint replaced by the results of `change`."""
    return _Walk(sensor=change).node(document, PluginSite())


def plugins_of(document: Document) -> list[tuple[Plugin, PluginSite]]:
    """Every plugin with its site, outer ones first."""
    found: list[tuple[Plugin, PluginSite]] = []

    def see(plugin: Plugin, site: PluginSite) -> Iterable[Plugin]:
        found.append((plugin, site))
        return (plugin,)

    map_plugins(document, see)
    return found


def sensors_of(document: Document) -> list[tuple[Sensor, PluginSite]]:
    """Every sensor of a link or joint, with its site."""
    found: list[tuple[Sensor, PluginSite]] = []

    def see(sensor: Sensor, site: PluginSite) -> Iterable[Sensor]:
        found.append((sensor, site))
        return (sensor,)

    map_sensors(document, see)
    return found


class _Walk:
    """One walk over a document with a change for plugins or for sensors."""

    def __init__(self, plugin: PluginChange | None = None, sensor: SensorChange | None = None) -> None:
        self._plugin = plugin
        self._sensor = sensor

    def node(self, node: AnyNode, site: PluginSite) -> AnyNode:
        """The node with changes below it. Models may be nested deeply, so there is only one call for each level."""
        site = _enter_node(node, site)
        update: dict[str, Any] = {}
        for field in node_fields(type(node)):
            old = getattr(node, field)
            if not old:
                continue
            if isinstance(old, Node):
                update[field] = self.node(old, site)
            elif field in _LEAVES:
                update[field] = self._leaves(field, old, site)
            else:
                update[field] = tuple([self.node(each, site) for each in old])
        if isinstance(node, GazeboExtension):
            update["content"] = self._elements(node.content, site)
        return replace_fields(node, opaque=self._opaque(node.opaque, site), **update)

    def _leaves(self, field: str, old: Any, site: PluginSite) -> Any:
        if field == "plugins":
            return _flat_map(old, lambda plugin: self._plugins(plugin, site))
        return _flat_map(old, lambda sensor: self._sensors(sensor, site))

    def _plugins(self, plugin: Plugin, site: PluginSite) -> Iterable[Plugin]:
        return self._plugin(plugin, site) if self._plugin else (plugin,)

    def _sensors(self, sensor: Sensor, site: PluginSite) -> Iterable[Sensor]:
        return self._sensor(sensor, site) if self._sensor else (self.node(sensor, site),)

    def _opaque(self, parts: tuple[Opaque, ...], site: PluginSite) -> tuple[Opaque, ...]:
        return _flat_map(parts, lambda part: self._part(part, site))

    def _part(self, part: Opaque, site: PluginSite) -> Iterable[Opaque]:
        element = part.element
        if element is None or element.name.startswith("{"):  # what is in a carrier belongs to another language
            return (part,)
        at = site if not part.at else replace(site, scope=part.at.rsplit("/", 1)[-1], holder="")
        # The line of an opaque part is kept at the part; findings about a plugin in it need one.
        if element.source is None and part.source is not None:
            element = element.copy(source=part.source)
        made = tuple(self._element(element, at))
        if len(made) == 1 and made[0] is element:
            return (part,)
        return tuple(part.copy(element=each) for each in made)

    def _elements(self, elements: tuple[Element, ...], site: PluginSite) -> tuple[Element, ...]:
        return _flat_map(elements, lambda element: self._element(element, site))

    def _element(self, element: Element, site: PluginSite) -> Iterable[Element]:
        if element.name == "plugin" and site.scope in _SCOPES:
            return self._plugin_element(element, site)
        if element.name == "sensor" and self._sensor:
            return self._sensor_element(element, site)
        inside = replace(site, scope=element.name, holder=element.get("name") or "")
        if element.name in {"link", "joint"}:
            inside = replace(inside, link_or_joint=inside.holder)
        # Everything else is walked through: plugins of actors, projectors and the GUI stand in
        # elements that have no class here.
        return (replace_fields(element, children=self._elements(element.children, inside)),)

    def _plugin_element(self, element: Element, site: PluginSite) -> Iterable[Element]:
        if self._plugin is None:
            return (element,)
        plugin = plugin_of(element)
        return [element if each is plugin else plugin_element(each) for each in self._plugin(plugin, site)]

    def _sensor_element(self, element: Element, site: PluginSite) -> Iterable[Element]:
        sensor = sensor_of(element)
        if sensor is None or self._sensor is None:
            return (element,)
        return [element if each is sensor else sensor_element(each) for each in self._sensor(sensor, site)]


Item = TypeVar("Item")


def _flat_map(old: tuple[Item, ...], change: Callable[[Item], Iterable[Item]]) -> tuple[Item, ...]:
    """The results of a function for each item, in one tuple."""
    return tuple([new for each in old for new in change(each)])


def _enter_node(node: Node, site: PluginSite) -> PluginSite:
    """The site of what stands directly in a node."""
    match node:
        case World():
            return PluginSite("world", node.name, node)
        case Model():
            return replace(site, scope="model", holder=node.name, models=(*site.models, node))
        case Include():
            return replace(site, scope="model", holder=node.name or "", included=True)
        case Link():
            return replace(site, scope="link", holder=node.name, link_or_joint=node.name)
        case Joint():
            return replace(site, scope="joint", holder=node.name, link_or_joint=node.name)
        case Sensor():
            return replace(site, scope="sensor", holder=node.name or "", sensor=node)
        case Visual():
            return replace(site, scope="visual", holder=node.name or "")
        case GazeboExtension():
            return _enter_reference(node, site)
        case _:
            return site


def _enter_reference(extension: GazeboExtension, site: PluginSite) -> PluginSite:
    name, model = extension.reference, site.model
    if not name or model is None:
        return site
    # A link and a joint may have one name: then the reference means the link.
    is_joint = all(link.name != name for link in model.links) and any(joint.name == name for joint in model.joints)
    return replace(site, scope="joint" if is_joint else "link", holder=name, link_or_joint=name)


def plugin_of(element: Element) -> Plugin:
    """The plugin in an untyped element."""
    others = tuple(Opaque.unchecked(attribute=each) for each in element.attributes if each[0] not in _PLUGIN_ATTRIBUTES)
    return Plugin.unchecked(
        name=element.get("name"),
        filename=element.get("filename"),
        text=element.text,
        content=element.children,
        opaque=others,
        source=element.source,
    )


def plugin_element(plugin: Plugin) -> Element:
    """A plugin as an untyped element; the elements in it keep their order."""
    written = [
        (name, value) for name, value in (("name", plugin.name), ("filename", plugin.filename)) if value is not None
    ]
    others = [part.attribute for part in plugin.opaque if part.attribute]
    inside = tuple(part.element for part in plugin.opaque if part.element)
    return Element.unchecked(
        name="plugin",
        attributes=(*written, *others),
        text=plugin.text,
        children=(*plugin.content, *inside),
        source=plugin.source,
    )


def sensor_of(element: Element) -> Sensor | None:
    """The sensor in an untyped element; None if it has an error, which the check of the file reports."""
    found = DiagnosticSink(file=element.source.file if element.source else "")
    context = Context(found, found.file, "sdf", table("sdf").newest, declared=False)
    xml = element_xml(element, etree.Element("link", {"name": ""}))
    data: dict[str, Any] = reader("sdf", context.version).read(xml, context, "sensor", Sensor, element.source)
    return None if found.has_errors else Sensor.unchecked(**data)


def sensor_element(sensor: Sensor) -> Element:
    """A sensor as an untyped element."""
    return to_element(sensor, "sensor", "sdf").copy(source=sensor.source)
