"""What worlds of Gazebo Classic need in gz-sim, and what of them it does not read."""

from collections.abc import Iterable, Iterator, Mapping

from twinform.diagnostics import Fate, Location, Notes
from twinform.diagnostics.rules import classic as rules
from twinform.ir import Document, Include, Node, Plugin, Sensor, World, map_children
from twinform.ir.element import Element, Opaque
from twinform.ir.tree import walk
from twinform.passes.classic.tables import unread_parts
from twinform.passes.plugins.catalogue import DEFAULT_SYSTEMS, sensors, system, system_of_class, systems_of_file
from twinform.passes.plugins.editing import add_world_plugin
from twinform.passes.plugins.parts import PluginKind, Release, SensorKind

_RENDER_ENGINE = Element(name="render_engine", text="ogre2")


def ship_models(document: Document, notes: Notes) -> Document:
    """The document with models that came with Gazebo Classic included from Fuel."""
    models = unread_parts()["models"]

    def change(node: Node) -> Node:
        if not isinstance(node, Include) or (node.uri or "").rstrip("/") not in models:
            return map_children(node, change)
        old, new = node.uri or "", models[(node.uri or "").rstrip("/")]
        message = f"{old} came with Gazebo Classic; it is {new} now"
        notes.report(rules.SHIPPED_MODEL, message, node.location, found=old)
        notes.account(Fate.APPROXIMATED, rules.SHIPPED_MODEL, message, node.location.at("uri"))
        return node.model_copy(update={"uri": new})

    return map_children(document, change)


def complete_worlds(before: Document, document: Document, release: Release, notes: Notes) -> Document:
    """The document with the systems that its worlds need: those of sensors, and all defaults once one is written.

    Where the author has chosen systems of gz-sim before, the defaults are left out with a purpose.
    """
    chosen = {world.name for world in before.worlds if any(map(_kind_of, world.plugins))}
    worlds = tuple(_complete(world, world.name in chosen, release, notes) for world in document.worlds)
    return document if worlds == document.worlds else document.model_copy(update={"worlds": worlds})


def report_needs(document: Document, notes: Notes) -> None:
    """Say which systems the world needs that the models of a document without one will stand in."""
    for model in document.models:
        needed = list(dict.fromkeys(name for kind in _kinds(sensors_in(model)) for name in kind.systems))
        if needed:
            classes = ", ".join(system(name).class_name for name in needed)
            message = f"the sensors of model {model.name!r} measure only in a world with {classes}"
            notes.report(rules.NEEDS_WORLD_SYSTEM, message, model.location)


def report_unread(document: Document, notes: Notes) -> None:
    """Say which parts of worlds gz-sim does not read."""
    parts = unread_parts()
    for world in document.worlds:
        for part in world.opaque:
            if part.element is not None and not part.at:
                for element, reason in _unread(part.element, parts["world"], parts["world-inside"]):
                    _say_unread(world, part, element, reason, notes)


def sensors_in(node: Node) -> list[Sensor]:
    """Every sensor in a node; those in `<gazebo>` elements too."""
    typed = [each for each in walk(node) if isinstance(each, Sensor)]
    elements = (element for each in walk(node) for element in getattr(each, "content", ()) if element.name == "sensor")
    return typed + [Sensor(name=each.get("name"), type=each.get("type")) for each in elements]


def _complete(world: World, chosen: bool, release: Release, notes: Notes) -> World:
    there = {kind.name for plugin in world.plugins if (kind := _kind_of(plugin))}
    kinds = _kinds(sensors_in(world))
    wanted = list(dict.fromkeys(name for kind in kinds for name in kind.systems))
    if not chosen and (there or wanted):
        wanted = [*DEFAULT_SYSTEMS, *wanted]
    missing = [name for name in wanted if name not in there and release.name in system(name).releases]
    for name in missing:
        world = add_world_plugin(world, _system_plugin(name))
    if missing:
        listed = ", ".join(system(name).class_name for name in missing)
        message = f"world {world.name!r} got the systems that it needs: {listed}"
        notes.report(rules.ADDED_WORLD_SYSTEM, message, world.location)
    _report_elements(world, kinds, notes)
    return world


def _report_elements(world: World, kinds: Iterable[SensorKind], notes: Notes) -> None:
    written = {part.element.name for part in world.opaque if part.element}
    for name in sorted({name for kind in kinds for name in kind.world_elements} - written):
        message = f"world {world.name!r} has no <{name}>, without which a sensor in it measures nothing"
        notes.report(rules.INCOMPLETE_MIGRATION, message, world.location, expected=f"<{name}>")


def _kinds(found: Iterable[Sensor]) -> list[SensorKind]:
    return list(dict.fromkeys(kind for sensor in found if (kind := sensors().get(sensor.type or ""))))


def _kind_of(plugin: Plugin) -> PluginKind | None:
    kinds = systems_of_file(plugin.filename or "")
    return system_of_class(plugin.name or "") if len(kinds) != 1 else kinds[0]


def _system_plugin(name: str) -> Plugin:
    kind = system(name)
    content = (_RENDER_ENGINE,) if name == "sensors" else ()
    return Plugin(name=kind.class_name, filename=kind.file, content=content)


def _unread(element: Element, whole: Mapping[str, str], inside: Mapping[str, str]) -> Iterator[tuple[Element, str]]:
    if element.name in whole:
        yield element, whole[element.name]
    stack = [(element, element.name)]
    while stack:
        here, path = stack.pop()
        if path in inside:
            yield here, inside[path]
            continue
        stack += [(child, f"{path}/{child.name}") for child in reversed(here.children)]


def _say_unread(world: World, part: Opaque, element: Element, reason: str, notes: Notes) -> None:
    where: Location = element.location if element.source else part.location if part.source else world.location
    message = f"<{element.name}> of world {world.name!r} is not read by gz-sim: {reason}"
    notes.report(rules.UNREAD_WORLD_PART, message, where, found=element.name)
