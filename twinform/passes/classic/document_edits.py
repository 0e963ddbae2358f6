"""Changes that a migration makes outside of plugins and sensors: models, worlds, materials, hardware, `<gazebo>`."""

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from dataclasses import field

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, Location, rules
from twinform.ir import (
    Axis,
    Document,
    Element,
    Format,
    GazeboExtension,
    Include,
    Joint,
    Mimic,
    Model,
    Plugin,
    Sensor,
    World,
    replace_fields,
    rewrite,
)
from twinform.ir.element import Opaque
from twinform.passes.classic.moving import set_text, text_at
from twinform.passes.classic.tables import hardware_names, unread_parts
from twinform.passes.framework.pass_registry import find_pass, registered_passes
from twinform.passes.joints.transmission import as_parts, location_of, replace_parts, urdf_elements
from twinform.passes.plugins.add_elements import add_sensor, add_world_plugin
from twinform.passes.plugins.catalog_types import Release, SensorKind
from twinform.passes.plugins.sites import PluginSite, sensors_of
from twinform.passes.plugins.world_systems import (
    has_element,
    has_system,
    kind_of_sensor,
    missing_defaults,
    report_needed_systems,
    requirements_of,
    system_plugin,
    systems_needed_by_plugins,
)

_MATERIALS = "materials"
# Fortress, whose ros2_control plugin has names of its own.
_OWN_NAMES = 6
_PLUGIN = "hardware/plugin"
ModelPath = tuple[str, ...]
"""The name of the world, or an empty text, and the names of the models down to the one that is meant."""
ModelChange = Callable[[Model], Model]


@dataclass(slots=True)
class DeferredEdits:
    """Changes to models by their paths, and systems for worlds by their names, which are applied after all plugins."""

    format: Format
    models: dict[ModelPath, list[ModelChange]] = field(default_factory=lambda: defaultdict(list))
    worlds: dict[str, list[Plugin]] = field(default_factory=lambda: defaultdict(list))

    def sensor(self, site: PluginSite, holder: str, sensor: Sensor) -> None:
        """Put a sensor on a link or joint later."""
        self.models[model_path(site)].append(lambda model: _add_sensor(model, holder, sensor, self.format))

    def mimic(self, site: PluginSite, follower: str, mimic: Mimic) -> None:
        """Let a joint mimic another one later."""
        self.models[model_path(site)].append(lambda model: _set_mimic(model, follower, mimic))

    def change(self, site: PluginSite, change: ModelChange) -> None:
        """Change a model in another way later."""
        self.models[model_path(site)].append(change)

    def run(self, document: Document) -> Document:
        """The document with all changes."""
        # Changes wait until all plugins are visited: the walk over plugins rebuilds the models, and
        # a change made in between would be of a model that is no longer part of the document.
        if not self.models and not self.worlds:
            return document
        models = tuple(self._model(model, ("",)) for model in document.models)
        worlds = tuple(self._world(world) for world in document.worlds)
        return document.copy(models=models, worlds=worlds)

    def _world(self, world: World) -> World:
        models = tuple(self._model(model, (world.name,)) for model in world.models)
        world = world.copy(models=models)
        for plugin in self.worlds.get(world.name, ()):
            world = add_world_plugin(world, plugin)
        return world

    def _model(self, model: Model, above: ModelPath) -> Model:
        path = (*above, model.name)
        model = replace_fields(model, models=tuple(self._model(each, path) for each in model.models))
        for change in self.models.get(path, ()):
            model = change(model)
        return model


def model_path(site: PluginSite) -> ModelPath:
    """The path of the model that a site is in."""
    return (site.world.name if site.world else "", *(model.name for model in site.models))


def _add_sensor(model: Model, holder: str, sensor: Sensor, format_: Format) -> Model:
    model = add_sensor(model, holder, sensor, format_)
    joint = next((each for each in model.joints if each.name == holder), None)
    if format_ is Format.SDF or joint is None or joint.type != "fixed" or _is_preserved(model, holder):
        return model
    # libsdformat merges links on fixed joints, and the joint goes with its sensor
    preserve = GazeboExtension(reference=holder, content=(Element(name="preserveFixedJoint", text="true"),))
    return model.copy(extensions=(*model.extensions, preserve))


def _is_preserved(model: Model, joint: str) -> bool:
    names = {"preserveFixedJoint", "disableFixedJointLumping"}
    return any(
        each.reference == joint and any(child.name in names for child in each.content) for each in model.extensions
    )


def _set_mimic(model: Model, follower: str, mimic: Mimic) -> Model:
    def follow(joint: Joint) -> Joint:
        if joint.name != follower:
            return joint
        return joint.copy(axis=(joint.axis or Axis()).copy(mimic=mimic))

    return model.copy(joints=tuple(map(follow, model.joints)))


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
        where = sensor.location if sensor.source or site.model is None else site.model.location
        report_needed_systems(sensor, kind, where, noted, sink)


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


def convert_material_scripts(document: Document, sink: DiagnosticSink) -> Document:
    """The document with colors in place of material scripts, if the pass for that is installed."""
    return find_pass(_MATERIALS)().run(document, sink) if _MATERIALS in registered_passes() else document


def rename_hardware(document: Document, release: Release, sink: DiagnosticSink) -> Document:
    """The document with the hardware of the simulator in `<ros2_control>` under the name for a release."""
    if release.sim <= _OWN_NAMES:
        return document
    return rewrite(document, Model, lambda model: _rename_model_hardware(model, document.format, sink))


def _rename_model_hardware(model: Model, format_: Format, sink: DiagnosticSink) -> Model:
    names, result = hardware_names(), model
    for part, system in list(urdf_elements(model, format_, "ros2_control")):
        old = text_at(system, _PLUGIN)
        if old is None or old not in names:
            continue
        where = location_of(part, model)
        message = f"the hardware of ros2_control {system.get('name')!r} is {names[old]} now, and was {old}"
        sink.report(rules.MIGRATED_PLUGIN, message, where, found=old)
        sink.account(Fate.APPROXIMATED, rules.MIGRATED_PLUGIN, message, where.at("hardware/plugin"))
        changed: Element = set_text(system, _PLUGIN, names[old])
        result = replace_parts(result, (part,), as_parts([changed], format_), after=part)
    return result


def remove_emptied(before: Document, after: Document) -> Document:
    """The document without `<gazebo>` elements that became empty; those that were empty before stay."""
    if before is after:
        return after
    return replace_fields(after, models=tuple(map(_remove_emptied, before.models, after.models)))


def _remove_emptied(before: Model, after: Model) -> Model:
    pairs = zip(before.extensions, after.extensions, strict=True)
    return replace_fields(after, extensions=tuple(new for old, new in pairs if not _is_emptied(old, new)))


def _is_emptied(before: GazeboExtension, after: GazeboExtension) -> bool:
    # A <gazebo> that was empty in the source stays: only what this migration emptied is cleared
    # away.
    return bool(before.content) and not after.content and not after.opaque
