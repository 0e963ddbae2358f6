"""Check plugins and sensors against the catalog of a Gazebo release."""

from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, did_you_mean, rules
from twinform.ir import Document, Plugin, Sensor, World
from twinform.passes.framework.pass_base import Pass
from twinform.passes.plugins.catalog import (
    classic_plugins,
    classic_plugins_of_file,
    is_ignition_name,
    modern_file,
    releases,
    suggestion,
    system,
    system_of_class,
    systems,
    systems_of_file,
)
from twinform.passes.plugins.catalog_types import PluginKind
from twinform.passes.plugins.parameters import ModelNames, ParameterContext, check_parameters, find_class
from twinform.passes.plugins.release_names import ReleaseName
from twinform.passes.plugins.sites import PluginSite, plugins_of, sensors_of
from twinform.passes.plugins.world_systems import (
    check_sensor_world,
    kind_of_sensor,
    missing_defaults,
    missing_system_for,
    report_needed_systems,
    system_xml,
)

_NATIVE_IGNITION = "fortress"
"""The last release in which the names of Ignition are the ones in use."""


class CheckPlugins(Pass):
    """Hold plugins and sensors against what a release of Gazebo knows.

    Changes nothing. Finds:

    1. parameters that a system does not read, with the nearest one, that lack, stand twice or have values of another
       type, and joints and links that the model does not have;
    2. a class that is not in the file, names of Ignition, systems and sensors that the release does not have;
    3. systems that stand in what they are not for;
    4. sensors in a world without the system that they need, and what a model needs in any world;
    5. worlds with plugins but without the systems that gz-sim adds to worlds that have none.

    Never looks at: plugins of the GUI and of files that are not of Gazebo.
    Diagnostics: `unknown-plugin-parameter`, `plugin-parameter-value`, `plugin-parameter-count`, `plugin-reference`,
    `wrong-plugin-class`, `ignition-plugin-name`, `wrong-plugin-scope`, `plugin-not-in-release`, `unsupported-sensor`,
    `missing-world-system`, `world-system-needed`, `default-systems-off`.
    """

    name: ClassVar[str] = "check-plugins"
    example: ClassVar[str] = "check-plugins{release=harmonic}"

    release: ReleaseName = Field(default="harmonic", description="The release of Gazebo that the model is for.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The same document."""
        names = ModelNames()
        for plugin, site in plugins_of(document):
            if site.scope != "gui":
                # Over 461 files of the corpus with plugins, this finds 48 parameters that nobody
                # reads, most of them in gz-sim's multicopter worlds and in PX4's models, which have
                # them from Gazebo Classic. No false alarm was left.
                _check_plugin(plugin, site, self.release, names, sink)
        for world in document.worlds:
            _check_defaults(world, sink)
        noted: set[str] = set()
        for sensor, site in sensors_of(document):
            _check_sensor(sensor, site, self.release, noted, sink)
        return document


def _check_plugin(plugin: Plugin, site: PluginSite, release: str, names: ModelNames, sink: DiagnosticSink) -> None:
    kinds = systems_of_file(plugin.filename or "")
    # A file that is in no table is somebody's own plugin and is left alone, unless its name or
    # class shows that a system of Gazebo was meant.
    if not kinds:
        _check_unknown_file(plugin, sink)
        return
    kind = find_class(plugin, kinds, sink)
    if release != _NATIVE_IGNITION and is_ignition_name(f"{plugin.filename} {plugin.name}"):
        found = kind or kinds[0]
        message = f"plugin {plugin.name!r} has a name from before Ignition became Gazebo"
        sink.report(rules.IGNITION_PLUGIN_NAME, message, plugin.location, help=f"write {system_xml(found)}")
    if kind is None:
        return
    if release not in kind.releases:
        have = ", ".join(each for each in releases() if each in kind.releases) or "none yet"
        message = f"{kind.class_name} is not in {release}; releases that have it: {have}"
        sink.report(rules.PLUGIN_NOT_IN_RELEASE, message, plugin.location, found=plugin.filename)
        return
    # What an <include> brings is not known here: it may be an actor.
    if site.scope not in kind.scopes and not (site.included and "actor" in kind.scopes):
        scopes = " or ".join(f"<{scope}>" for scope in kind.scopes)
        message = f"{kind.class_name} is in <{site.scope}> and has to be in {scopes}"
        sink.report(rules.WRONG_PLUGIN_SCOPE, message, plugin.location, found=site.scope, expected=scopes)
    _check_needs(plugin, kind, site, sink)
    # A world system names joints and links of models anywhere in the world, with scopes; only those
    # of a model plugin can be looked up.
    model = site.model if "world" not in kind.scopes else None
    check_parameters(plugin, ParameterContext(kind, release, model, names, sink))


def _check_needs(plugin: Plugin, kind: PluginKind, site: PluginSite, sink: DiagnosticSink) -> None:
    """Report if the world has none of the systems that this one needs."""
    needed = missing_system_for(kind, site.world)
    if needed is None:
        return
    listed = " or ".join(system(name).class_name for name in kind.needs)
    help_ = f"add {system_xml(needed)} to the world"
    if site.world is None:
        message = f"{kind.class_name} needs {listed} in the world"
        sink.report(rules.WORLD_SYSTEM_NEEDED, message, plugin.location, help=help_)
    else:
        message = f"{kind.class_name} needs {listed}, and world {site.world.name!r} has none"
        sink.report(rules.MISSING_WORLD_SYSTEM, message, plugin.location, help=help_, related=(site.world.location,))


def _check_unknown_file(plugin: Plugin, sink: DiagnosticSink) -> None:
    """Check a file that belongs to no system: it may be a plugin of the user, or a mistake."""
    file = plugin.filename or ""
    kind = system_of_class(plugin.name or "")
    if kind is not None:
        message = f"{kind.class_name} is in {kind.file}, not in {file}"
        sink.report(rules.WRONG_PLUGIN_CLASS, message, plugin.location, found=file, expected=kind.file)
    elif is_classic(file):
        known = [kind.file for family in ("noetic", "ros2") for kind in classic_plugins(family).values()]
        hint = None if classic_plugins_of_file(file) else did_you_mean(file, known)
        message = f"no plugin is known by the file {file}" if hint else f"{file} is a plugin of Gazebo Classic"
        sink.report(rules.PLUGIN_NOT_IN_RELEASE, message, plugin.location, found=file, help=hint)
    elif modern_file(file).startswith("gz-sim-"):
        message = f"gz-sim has no {file}"
        help_ = suggestion(modern_file(file), [each.file for each in systems().values()])
        sink.report(rules.PLUGIN_NOT_IN_RELEASE, message, plugin.location, found=file, help=help_)


def is_classic(file: str) -> bool:
    """Whether a file is known as a plugin of Gazebo Classic."""
    return modern_file(file).startswith(("gazebo_ros_", "gazebo_ros2_")) or bool(classic_plugins_of_file(file))


def _check_defaults(world: World, sink: DiagnosticSink) -> None:
    # A plugin of Gazebo Classic is not loaded, so it does not switch off the default systems,
    # either in gz-sim or in what is reported here.
    ours = [plugin for plugin in world.plugins if not is_classic(plugin.filename or "")]
    missing = missing_defaults(ours) if ours else ()
    if missing:
        listed = ", ".join(kind.class_name.rsplit("::", 1)[-1] for kind in missing)
        message = f"the plugins of world {world.name!r} switch off the default systems, and it has no {listed}"
        help_ = f"add {' '.join(map(system_xml, missing))}"
        sink.report(rules.DEFAULT_SYSTEMS_OFF, message, ours[0].location, help=help_)


def _check_sensor(sensor: Sensor, site: PluginSite, release: str, noted: set[str], sink: DiagnosticSink) -> None:
    kind = kind_of_sensor(sensor, release)
    if kind is None:
        if sensor.type not in {None, "custom"}:
            message = f"sensor {sensor.name!r} is a {sensor.type}, which {release} does not simulate"
            sink.report(rules.UNSUPPORTED_SENSOR, message, sensor.location, found=sensor.type)
        return
    if site.world is not None:
        check_sensor_world(sensor, kind, site.world, sink)
        return
    report_needed_systems(sensor, kind, sensor.location, noted, sink)
