"""World systems: those that a world has, and those that plugins and sensors need."""

from collections.abc import Iterable, Iterator

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import Document, Element, Plugin, Sensor, World
from twinform.passes.plugins.catalog import (
    DEFAULT_SYSTEMS,
    UnknownNameError,
    custom_sensor,
    sensor,
    system,
    systems_of_file,
)
from twinform.passes.plugins.catalog_types import PluginKind, SensorKind
from twinform.passes.plugins.sites import plugins_of

_CUSTOM_TYPE = "custom"
# Water up to a height of zero and air above, in kg/m^3. With one density everywhere, everything
# would float away.
_LAYERS = {"default_density": "1000", "above_depth": "0", "density": "1"}


@dataclass(frozen=True, slots=True)
class WorldRequirements:
    """What a sensor needs in the world."""

    systems: tuple[PluginKind, ...]
    elements: tuple[str, ...]


def kind_of_sensor(node: Sensor, release: str) -> SensorKind | None:
    """The kind of a sensor; None if the release does not simulate it."""
    try:
        found = custom_sensor(custom_type(node)) if node.type == _CUSTOM_TYPE else sensor(node.type or "")
    except UnknownNameError:
        return None
    return found if found is not None and release in found.releases else None


def custom_type(node: Sensor) -> str:
    """The `gz:type` of a sensor, with any prefix."""
    attributes = (part.attribute for part in node.opaque if part.attribute is not None and not part.at)
    return next((value for name, value in attributes if name.startswith("{") and name.endswith("}type")), "")


def requirements_of(kind: SensorKind) -> WorldRequirements:
    """What sensors of a kind need in the world."""
    return WorldRequirements(tuple(system(name) for name in kind.systems), kind.world_elements)


def report_needed_systems(
    node: Sensor, kind: SensorKind, where: Location, noted: set[str], sink: DiagnosticSink
) -> None:
    """Report the systems that a sensor needs in a world that is not known, except those noted; notes them."""
    for needed in requirements_of(kind).systems:
        if needed.name not in noted:
            noted.add(needed.name)
            message = f"sensor {node.name!r} needs {needed.class_name} in the world"
            sink.report(rules.WORLD_SYSTEM_NEEDED, message, where, help=f"the world needs {system_xml(needed)}")


def missing_system_for(kind: PluginKind, world: World | None) -> PluginKind | None:
    """The system that a world lacks for a plugin; None if it needs none, or the world has one that will do."""
    choice = [system(name) for name in kind.needs]
    if not choice or (world is not None and any(has_system(world, each) for each in choice)):
        return None
    return choice[0]


def systems_needed_by_plugins(document: Document, world: World | None, release: str) -> Iterator[PluginKind]:
    """The systems that plugins of a document need and the world does not have."""
    for plugin, _ in plugins_of(document):
        for kind in systems_of_file(plugin.filename or ""):
            needed = missing_system_for(kind, world) if release in kind.releases else None
            if needed is not None:
                yield needed


def has_system(world: World, kind: PluginKind) -> bool:
    """Whether a world has a system, with any spelling of its file."""
    return any(kind in systems_of_file(plugin.filename or "") for plugin in world.plugins)


def missing_defaults(plugins: Iterable[Plugin]) -> tuple[PluginKind, ...]:
    """The default systems of gz-sim that are not among the plugins."""
    # gz-sim adds its default systems only to a world without any plugin: the first explicit plugin
    # switches all of them off, physics included.
    has = {each.name for plugin in plugins for each in systems_of_file(plugin.filename or "")}
    return tuple(system(name) for name in DEFAULT_SYSTEMS if name not in has)


def system_plugin(kind: PluginKind) -> Plugin:
    """The plugin for a system, with the parameters that it should not be without."""
    # Buoyancy without parameters fills the whole world with water, and everything in it floats
    # away.
    content = {"sensors": (Element(name="render_engine", text="ogre2"),), "buoyancy": (_water_and_air(),)}
    return Plugin(name=kind.class_name, filename=kind.file, content=content.get(kind.name, ()))


def _water_and_air() -> Element:
    density, depth, air = (Element(name=name, text=text) for name, text in _LAYERS.items())
    return Element(name="graded_buoyancy", children=(density, Element(name="density_change", children=(depth, air))))


def add_default_systems(world: World, but: PluginKind | None = None) -> World:
    """A world without plugins, with the default systems of gz-sim except `but`; any other world as it is."""
    if world.plugins:
        return world
    kinds = [kind for kind in missing_defaults(()) if kind is not but]
    return world.copy(plugins=tuple(map(system_plugin, kinds)))


def add_systems(world: World, kinds: Iterable[PluginKind]) -> World:
    """The world with the systems that it lacks; the same world if it has all of them."""
    lacks = [kind for kind in dict.fromkeys(kinds) if not has_system(world, kind)]
    if not lacks:
        return world
    world = add_default_systems(world)
    more = [system_plugin(kind) for kind in lacks if not has_system(world, kind)]
    return world.copy(plugins=(*world.plugins, *more))


def system_xml(kind: PluginKind) -> str:
    """The line of XML that adds a system to a world."""
    return f'<plugin filename="{kind.file}" name="{kind.class_name}"/>'


def has_element(world: World, name: str) -> bool:
    """Whether a world has an untyped element of this name."""
    return any(part.element is not None and part.element.name == name and not part.at for part in world.opaque)


def check_sensor_world(sensor: Sensor, kind: SensorKind, world: World, sink: DiagnosticSink) -> None:
    """Report what a sensor needs of its world and does not find."""
    needed = requirements_of(kind)
    for lacking in needed.systems:
        if not has_system(world, lacking):
            message = f"sensor {sensor.name!r} needs {lacking.class_name}, and world {world.name!r} has none"
            sink.report(
                rules.MISSING_WORLD_SYSTEM,
                message,
                sensor.location,
                help=f"add {system_xml(lacking)} to the world",
                related=(world.location,),
            )
    for name in needed.elements:
        if not has_element(world, name):
            message = f"sensor {sensor.name!r} needs <{name}>, and world {world.name!r} has none"
            sink.report(rules.MISSING_WORLD_SYSTEM, message, sensor.location, related=(world.location,))
