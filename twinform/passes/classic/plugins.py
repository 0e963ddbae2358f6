"""Migration of Gazebo Classic plugins, one by one."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Axis, Element, Format, Joint, Mimic, Model, Plugin
from twinform.ir.defaults import multiplier
from twinform.passes.classic.classic_parameters import as_read
from twinform.passes.classic.deferred_edits import DeferredEdits
from twinform.passes.classic.ignition import modern_plugin
from twinform.passes.classic.link_pose import OtherQuantityError, offset_of
from twinform.passes.classic.migrate_sensors import SensorMigration, in_frame
from twinform.passes.classic.moving import DroppedParameter, Moved
from twinform.passes.classic.reporting import MigrationReport, accept, reasons_to_look, scratch
from twinform.passes.classic.systems import made_systems, unused
from twinform.passes.classic.tables import MakeRow, Migration, migration_of
from twinform.passes.classic.topics import RosNames
from twinform.passes.plugins.catalog import systems_of_file
from twinform.passes.plugins.catalog_types import Release
from twinform.passes.plugins.sites import PluginSite, sensor_of
from twinform.passes.plugins.wheels import MEASURES, Measured, NotMeasuredError
from twinform.schemas import format_value


@dataclass(frozen=True, slots=True)
class PluginMigration:
    """Migrates the plugins of a document, other than those that sensors have taken, for one release.

    `control` is what a model needs when it gets a controller manager of ROS 2.
    """

    release: Release
    format: Format
    sink: DiagnosticSink
    edits: DeferredEdits
    keep: bool
    controllers: str | None
    control: Callable[[Model], Model]

    def __call__(self, plugin: Plugin, site: PluginSite) -> Iterable[Plugin]:
        """The plugins that take the place of one."""
        read, report = as_read(plugin), MigrationReport(self.sink, plugin, site)
        migration = migration_of(plugin.filename or "", read.content)
        if migration is None:
            return self._of_no_table(plugin, site, report)
        # Some releases of gz-sim have the plugin under its old name.
        if self.release.name in migration.native:
            return (plugin,)
        if migration.none is not None:
            return self._without(plugin, report, migration.none)
        if migration.mimic:
            return self._mimic(plugin, site, migration, report)
        if migration.make is not None:
            return self._make(plugin, site, migration, report)
        if migration.nothing is not None:
            report.needless(migration.nothing, [])
            return ()
        if migration.sensor is not None:
            where = "a sensor that cannot be read" if site.scope == "sensor" else f"a {site.scope}"
            return self._without(plugin, report, f"it has to be in a sensor of its kind, and is in {where}")
        return self._systems(plugin, site, migration, report)

    def _of_no_table(self, plugin: Plugin, site: PluginSite, report: MigrationReport) -> Iterable[Plugin]:
        modern = modern_plugin(plugin, self.release)
        if modern is not plugin:
            report.renamed(modern)
        elif site.scope != "gui" and not systems_of_file(plugin.filename or "") and _is_called_like_a_library(plugin):
            # It may be the author's own and already ported; whoever deletes it on a guess takes the
            # robot's behavior with it.
            message = f"{report.what} is neither of Gazebo Classic nor of gz-sim; it is kept unchanged"
            self.sink.report(rules.UNKNOWN_PLUGIN, message, report.where, found=plugin.filename)
        elif site.scope == "gui" and _is_called_like_a_library(plugin):
            return self._without(plugin, report, "the GUI of gz-sim has plugins of its own")
        return (modern,)

    def _without(self, plugin: Plugin, report: MigrationReport, reason: str) -> Iterable[Plugin]:
        report.without(reason, keeps=self.keep)
        return (plugin,) if self.keep else ()

    def _systems(
        self, plugin: Plugin, site: PluginSite, migration: Migration, report: MigrationReport
    ) -> Iterable[Plugin]:
        try:
            offset = offset_of(as_read(plugin), migration.body, site.model, self.format) if migration.body else ()
            made, lost = made_systems(plugin, migration, site, self.release.name)
        except (LookupError, OtherQuantityError) as error:
            return self._without(plugin, report, str(error))
        # A system of the world cannot be put into a model file: with a second model it would run
        # twice.
        if any(row.scope == "world" for _, row in made) and site.world is None:
            return self._without(plugin, report, f"{made[0][0].name} has to be in a world, and there is none here")
        report.migrated(" and ".join(each.name or "" for each, _ in made), lost)
        for reason in reasons_to_look(migration, as_read(plugin)):
            report.missing(reason)
        here: list[Plugin] = []
        for each, row in made:
            if row.scope == "world" and site.world is not None:
                self.edits.worlds[site.world.name].append(each)
            elif row.measured and site.model is not None:
                measured, missing = with_measures(each, row.system, site.model, self.format)
                here.append(measured)
                for reason in missing:
                    report.missing(reason)
            else:
                placed = each.copy(content=(*each.content, *offset)) if offset else each
                here.append(self._controlled(placed, site, report) if migration.control else placed)
        return here

    def _controlled(self, plugin: Plugin, site: PluginSite, report: MigrationReport) -> Plugin:
        """A controller manager with its parameters, in a model whose joints are in `<ros2_control>`."""
        self.edits.change(site, self.control)
        if any(child.name == "parameters" for child in plugin.content):
            return plugin
        if self.controllers is not None:
            parameters = Element(name="parameters", text=self.controllers)
            return plugin.copy(content=(*plugin.content, parameters))
        report.missing("it needs <parameters>, the file of its controllers; the option `controllers` writes it")
        return plugin

    def _make(
        self, plugin: Plugin, site: PluginSite, migration: Migration, report: MigrationReport
    ) -> Iterable[Plugin]:
        """A sensor on the link or joint that the plugin names."""
        make = migration.make or MakeRow(type="", on="link", of=())
        holder = _scoped(next((child.text or "" for child in as_read(plugin).content if child.name in make.of), ""))
        if site.model is None or holder not in _names(site.model, make.on):
            return self._without(plugin, report, f"there is no {make.on} {holder!r} to put the sensor on")
        element = Element(name="sensor", attributes=(("name", plugin.name or make.type), ("type", make.type)))
        if make.on == "joint":  # gazebo_ros_ft_sensor.cpp, Load: both plugins measure in the frame of the child
            child = next(joint.child for joint in site.model.joints if joint.name == holder)
            element = in_frame(element, child or "", self.release)
        # What is reported about a sensor that cannot be made in the end must not stay in the
        # report.
        trial = SensorMigration(self.release, scratch(self.sink))
        sensor = sensor_of(trial.move(plugin, migration, element, site))
        if sensor is None:
            return self._without(plugin, report, "a value in it is not of the type that sensors have")
        accept(self.sink, trial.sink)
        self.edits.sensor(site, holder, sensor)
        return ()

    def _mimic(
        self, plugin: Plugin, site: PluginSite, migration: Migration, report: MigrationReport
    ) -> Iterable[Plugin]:
        moved = Moved(Element(name="mimic"))
        moved.apply(plugin.content, {**migration.shared, **migration.moves})
        parameters = {child.name: child.text or "" for child in moved.element.children}
        joints = {joint.name: joint for joint in site.model.joints} if site.model else {}
        follower, leader = parameters.get("mimicJoint", ""), parameters.get("joint", "")
        for name in (follower, leader):
            if name not in joints:
                return self._without(plugin, report, f"there is no joint {name!r}")
        # Of URDF <mimic> can be written for any release; in SDF the element came with 1.11.
        if self.format is Format.SDF and _number_of(self.release.sdf) < (1, 11):
            reason = f"SDF {self.release.sdf}, which gz-sim of {self.release.name} reads, has no <mimic>"
            return self._without(plugin, report, reason)
        mimic = _mimic(leader, parameters)
        if mimic is None:
            return self._without(plugin, report, "its multiplier or offset is not a number")
        written = _written_mimic(joints[follower])
        if written is not None and not _same_mimic(written, mimic):
            return self._without(plugin, report, f"joint {follower!r} mimics {written.joint!r} in another way already")
        lost: list[DroppedParameter] = [*moved.lost, *unused(plugin, moved.moved, RosNames(plugin))]
        report.migrated(f"the <mimic> of joint {follower!r}", lost)
        if written is None:
            self.edits.mimic(site, follower, mimic)
        return ()


def _mimic(leader: str, parameters: dict[str, str]) -> Mimic | None:
    try:
        numbers = {name: float(parameters[name]) for name in ("multiplier", "offset") if name in parameters}
    except ValueError:
        return None
    return Mimic(joint=leader, multiplier=numbers.get("multiplier"), offset=numbers.get("offset"))


def _written_mimic(joint: Joint) -> Mimic | None:
    return (joint.axis or Axis()).mimic


def _same_mimic(one: Mimic, other: Mimic) -> bool:
    def values(mimic: Mimic) -> tuple[str | None, float, float]:
        return mimic.joint, multiplier(mimic), mimic.offset or 0.0

    return values(one) == values(other)


def _names(model: Model, kind: str) -> set[str]:
    return {each.name for each in (model.links if kind == "link" else model.joints)}


def _scoped(name: str) -> str:
    """The last part of a name that names its model too."""
    return name.rpartition("::")[2].strip()


def _number_of(version: str) -> tuple[int, ...]:
    return tuple(map(int, version.split(".")))


def _is_called_like_a_library(plugin: Plugin) -> bool:
    """Whether it is called like a library: what is not may be a name that a program looks up itself."""
    name = plugin.filename or ""
    return name.startswith("lib") or name.endswith((".so", ".dll", ".dylib"))


def with_measures(plugin: Plugin, system: str, model: Model, format_: Format) -> tuple[Plugin, list[str]]:
    """The plugin with the sizes that its system can read off the model, and why the others are missing."""
    written: dict[str, tuple[str, ...]] = {}
    for child in plugin.content:
        option = child.name.replace("_", "-")
        written[option] = (*written.get(option, ()), child.text or "")
    measured = Measured(model, format_, lambda option: written.get(option, ()))
    found: list[Element] = []
    missing: list[str] = []
    for name, measure in MEASURES[system].items():
        if name.replace("_", "-") in written:
            continue
        try:
            found.append(Element(name=name, text=format_value(measure(measured))))
        except NotMeasuredError as error:
            missing.append(f"it needs <{name}>, which cannot be read off the model: {error}")
    return plugin.copy(content=(*plugin.content, *found)), missing
