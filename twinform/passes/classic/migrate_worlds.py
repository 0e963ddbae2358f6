"""Migration of worlds: the systems that gz-sim needs, and the parts that it does not read."""

from collections.abc import Iterator, Mapping

from twinform.diagnostics import DiagnosticSink, Fate, Location, rules
from twinform.ir import Document, Format, Include, World, rewrite
from twinform.ir.element import Element, Opaque
from twinform.passes.classic.tables import unread_parts
from twinform.passes.plugins.add_elements import add_world_plugin
from twinform.passes.plugins.catalog_types import Release, SensorKind
from twinform.passes.plugins.sites import sensors_of
from twinform.passes.plugins.world_systems import (
    has_element,
    has_system,
    kind_of_sensor,
    missing_defaults,
    requirements_of,
    system_plugin,
    system_xml,
    systems_needed_by_plugins,
)


def include_from_fuel(document: Document, sink: DiagnosticSink) -> Document:
    """The document that includes models from Fuel if they came with Gazebo Classic."""
    models = unread_parts()["models"]

    def change(include: Include) -> Include:
        old = include.uri or ""
        # Gazebo Classic had `model://sun` and `model://ground_plane` on every machine; gz-sim has
        # them on Fuel.
        new = models.get(old.rstrip("/"))
        if new is None:
            return include
        message = f"{old} came with Gazebo Classic; it is {new} now"
        sink.report(rules.SHIPPED_MODEL, message, include.location, found=old)
        sink.account(Fate.APPROXIMATED, rules.SHIPPED_MODEL, message, include.location)
        return include.copy(uri=new)

    return rewrite(document, Include, change)


def complete_worlds(document: Document, release: Release, sink: DiagnosticSink) -> Document:
    """The document with the systems that its worlds need, and all default systems once any is written."""
    worlds = tuple(_complete_world(world, release, sink) for world in document.worlds)
    return document if worlds == document.worlds else document.copy(worlds=worlds)


def report_needs(document: Document, release: Release, sink: DiagnosticSink) -> None:
    """Report the systems that models of a document without a world need in the world."""
    sensors, noted = sensors_of(document), set[str]()
    for sensor, site in sensors:
        kind = kind_of_sensor(sensor, release.name)
        if kind is None or site.world is not None:
            continue
        for needed in requirements_of(kind).systems:
            if needed.name not in noted:
                noted.add(needed.name)
                where = sensor.location if sensor.source or site.model is None else site.model.location
                message = f"sensor {sensor.name!r} needs {needed.class_name} in the world"
                help_ = f"the world needs {system_xml(needed)}"
                sink.report(rules.WORLD_SYSTEM_NEEDED, message, where, help=help_)


def report_unread(document: Document, sink: DiagnosticSink) -> None:
    """Report parts of worlds that gz-sim does not read."""
    parts = unread_parts()
    for world in document.worlds:
        for part in world.opaque:
            if part.element is not None and not part.at:
                for element, reason in _unread_elements(part.element, parts["world"], parts["world-inside"]):
                    _report_unread_part(world, part, element, reason, sink)


def _complete_world(world: World, release: Release, sink: DiagnosticSink) -> World:
    kinds = _sensor_kinds(world, release)
    needed = [kind for each in kinds for kind in requirements_of(each).systems]
    needed += systems_needed_by_plugins(Document(format=Format.SDF, worlds=(world,)), world, release.name)
    # A world without any plugin gets the default systems from gz-sim itself; as soon as one is
    # written here, all of them have to be.
    defaults = missing_defaults(world.plugins) if world.plugins or needed else ()
    missing = [kind for kind in dict.fromkeys((*defaults, *needed)) if not has_system(world, kind)]
    for kind in missing:
        world = add_world_plugin(world, system_plugin(kind))
    if missing:
        listed = ", ".join(kind.class_name for kind in missing)
        message = f"world {world.name!r} got the systems that it needs: {listed}"
        sink.report(rules.ADDED_WORLD_SYSTEM, message, world.location)
    for name in sorted(
        {name for kind in kinds for name in requirements_of(kind).elements if not has_element(world, name)}
    ):
        message = f"world {world.name!r} has no <{name}>, without which a sensor in it measures nothing"
        sink.report(rules.INCOMPLETE_MIGRATION, message, world.location, expected=f"<{name}>")
    return world


def _sensor_kinds(world: World, release: Release) -> list[SensorKind]:
    """The kinds of sensors in a world, also in nested models."""
    document = Document(format=Format.SDF, worlds=(world,))
    found = (kind_of_sensor(sensor, release.name) for sensor, _ in sensors_of(document))
    return list(dict.fromkeys(kind for kind in found if kind is not None))


def _unread_elements(
    element: Element, whole: Mapping[str, str], inside: Mapping[str, str]
) -> Iterator[tuple[Element, str]]:
    if element.name in whole:
        yield element, whole[element.name]
    # A stack, not recursion: opaque elements may be nested as deeply as the limits of the reader
    # allow.
    stack = [(element, element.name)]
    while stack:
        here, path = stack.pop()
        if path in inside:
            yield here, inside[path]
            continue
        stack += [(child, f"{path}/{child.name}") for child in reversed(here.children)]


def _report_unread_part(world: World, part: Opaque, element: Element, reason: str, sink: DiagnosticSink) -> None:
    where: Location = element.location if element.source else part.location if part.source else world.location
    message = f"<{element.name}> of world {world.name!r} is not read by gz-sim: {reason}"
    sink.report(rules.UNREAD_WORLD_PART, message, where, found=element.name)
