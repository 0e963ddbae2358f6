"""Migration of Gazebo Classic plugins, one by one, and of plugins with the names of Ignition."""

from collections.abc import Callable, Iterable, Iterator

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Axis, Element, Format, Joint, Mimic, Model, Plugin
from twinform.ir.defaults import multiplier
from twinform.ir.frames import MODEL, FrameError, FrameGraph
from twinform.ir.transform import Transform
from twinform.lazy import lazy_pattern
from twinform.passes.classic.document_edits import DeferredEdits
from twinform.passes.classic.migrate_sensors import SensorMigration, set_frame
from twinform.passes.classic.moving import (
    DroppedParameter,
    MigrationReport,
    Moved,
    accept_trial,
    needed_checks,
    trial_sink,
)
from twinform.passes.classic.systems import RosNames, make_systems, unused_parameters, without_unread_parameters
from twinform.passes.classic.tables import MakeRow, Migration, migration_of
from twinform.passes.plugins.catalog import is_ignition_name, modern_class, modern_file, systems_of_file
from twinform.passes.plugins.catalog_types import Release
from twinform.passes.plugins.sites import PluginSite, sensor_of
from twinform.passes.plugins.wheels import MEASURES, Measured, NotMeasuredError, base_link
from twinform.schemas import format_value, parse_version

# Fortress, in which the names of Ignition are the ones in use.
_NATIVE = 6
_ELEMENTS = {"ignition-gui": "gz-gui", "ignition_frame_id": "gz_frame_id"}
# Only where the word names a library or a message. `ignition` alone may be a topic or a model of
# the author.
_WORDS = lazy_pattern(r"\bignition(?=\.msgs\.|-physics-|-rendering-|-gui\b)")
_CLASSES = lazy_pattern(r"\bignition::(?:gazebo|sim)::")
# Frames that gazebo_ros_p3d takes for the world; any other is a link that the pose is relative to.
_WORLDS = frozenset({"", "world", "/world", "map", "/map"})
_FRAMES = ("frameName", "frame_name")


@dataclass(frozen=True, slots=True)
class PluginMigration:
    """Migrates the plugins of a document for one release, except those that belong to sensors.

    `control` prepares a model for a controller manager of ROS 2.
    """

    release: Release
    format: Format
    sink: DiagnosticSink
    edits: DeferredEdits
    keep: bool
    controllers: str | None
    control: Callable[[Model], Model]

    def __call__(self, plugin: Plugin, site: PluginSite) -> Iterable[Plugin]:
        """The plugins that replace one."""
        read, report = without_unread_parameters(plugin), MigrationReport(self.sink, plugin, site)
        migration = migration_of(plugin.filename or "", read.content)
        if migration is None:
            return self._migrate_unknown(plugin, site, report)
        # Some releases of gz-sim have the plugin under its old name.
        if self.release.name in migration.native:
            return (plugin,)
        if migration.none is not None:
            return self._drop_or_keep(plugin, report, migration.none)
        if migration.mimic:
            return self._make_mimic(plugin, site, migration, report)
        if migration.make is not None:
            return self._make_sensor(plugin, site, migration, report)
        if migration.nothing is not None:
            report.needless(migration.nothing, [])
            return ()
        if migration.sensor is not None:
            where = "a sensor that cannot be read" if site.scope == "sensor" else f"a {site.scope}"
            return self._drop_or_keep(plugin, report, f"it has to be in a sensor of its kind, and is in {where}")
        return self._replace_by_systems(plugin, site, migration, report)

    def _migrate_unknown(self, plugin: Plugin, site: PluginSite, report: MigrationReport) -> Iterable[Plugin]:
        modern = rename_ignition_plugin(plugin, self.release)
        if modern is not plugin:
            report.renamed(modern)
        elif site.scope != "gui" and not systems_of_file(plugin.filename or "") and _is_library(plugin):
            # It may be the author's own and already ported; whoever deletes it on a guess takes the
            # robot's behavior with it.
            message = f"{report.what} is neither of Gazebo Classic nor of gz-sim; it is kept unchanged"
            self.sink.report(rules.UNKNOWN_PLUGIN, message, report.where, found=plugin.filename)
        elif site.scope == "gui" and _is_library(plugin):
            return self._drop_or_keep(plugin, report, "the GUI of gz-sim has plugins of its own")
        return (modern,)

    def _drop_or_keep(self, plugin: Plugin, report: MigrationReport, reason: str) -> Iterable[Plugin]:
        report.without(reason, keeps=self.keep)
        return (plugin,) if self.keep else ()

    def _replace_by_systems(
        self, plugin: Plugin, site: PluginSite, migration: Migration, report: MigrationReport
    ) -> Iterable[Plugin]:
        try:
            offset = (
                pose_offset(without_unread_parameters(plugin), migration.body, site.model, self.format)
                if migration.body
                else ()
            )
            made, lost = make_systems(plugin, migration, site, self.release.name)
        except (LookupError, OtherQuantityError) as error:
            return self._drop_or_keep(plugin, report, str(error))
        # A system of the world cannot be put into a model file: with a second model it would run
        # twice.
        if any(row.scope == "world" for _, row in made) and site.world is None:
            return self._drop_or_keep(plugin, report, f"{made[0][0].name} has to be in a world, and there is none here")
        report.migrated(" and ".join(each.name or "" for each, _ in made), lost)
        for reason in needed_checks(migration, without_unread_parameters(plugin)):
            report.missing(reason)
        here: list[Plugin] = []
        for each, row in made:
            if row.scope == "world" and site.world is not None:
                self.edits.worlds[site.world.name].append(each)
            elif row.measured and site.model is not None:
                measured, missing = add_measures(each, row.system, site.model, self.format)
                here.append(measured)
                for reason in missing:
                    report.missing(reason)
            else:
                placed = each.copy(content=(*each.content, *offset)) if offset else each
                here.append(self._set_controllers(placed, site, report) if migration.control else placed)
        return here

    def _set_controllers(self, plugin: Plugin, site: PluginSite, report: MigrationReport) -> Plugin:
        """A controller manager with its parameters, in a model whose joints are in `<ros2_control>`."""
        self.edits.change(site, self.control)
        if any(child.name == "parameters" for child in plugin.content):
            return plugin
        if self.controllers is not None:
            parameters = Element(name="parameters", text=self.controllers)
            return plugin.copy(content=(*plugin.content, parameters))
        report.missing("it needs <parameters>, the file of its controllers; the option `controllers` writes it")
        return plugin

    def _make_sensor(
        self, plugin: Plugin, site: PluginSite, migration: Migration, report: MigrationReport
    ) -> Iterable[Plugin]:
        """Make a sensor on the link or joint that the plugin names."""
        make = migration.make or MakeRow(type="", on="link", of=())
        holder = _unscoped_name(
            next((child.text or "" for child in without_unread_parameters(plugin).content if child.name in make.of), "")
        )
        if site.model is None or holder not in _part_names(site.model, make.on):
            return self._drop_or_keep(plugin, report, f"there is no {make.on} {holder!r} to put the sensor on")
        element = Element(name="sensor", attributes=(("name", plugin.name or make.type), ("type", make.type)))
        if make.on == "joint":  # gazebo_ros_ft_sensor.cpp, Load: both plugins measure in the frame of the child
            child = next(joint.child for joint in site.model.joints if joint.name == holder)
            element = set_frame(element, child or "", self.release)
        # What is reported about a sensor that cannot be made in the end must not stay in the
        # report.
        trial = SensorMigration(self.release, trial_sink(self.sink))
        sensor = sensor_of(trial.apply_plugin(plugin, migration, element, site))
        if sensor is None:
            return self._drop_or_keep(plugin, report, "a value in it is not of the type that sensors have")
        accept_trial(self.sink, trial.sink)
        self.edits.sensor(site, holder, sensor)
        return ()

    def _make_mimic(
        self, plugin: Plugin, site: PluginSite, migration: Migration, report: MigrationReport
    ) -> Iterable[Plugin]:
        moved = Moved(Element(name="mimic"))
        moved.apply(plugin.content, {**migration.shared, **migration.moves})
        parameters = {child.name: child.text or "" for child in moved.element.children}
        joints = {joint.name: joint for joint in site.model.joints} if site.model else {}
        follower, leader = parameters.get("mimicJoint", ""), parameters.get("joint", "")
        for name in (follower, leader):
            if name not in joints:
                return self._drop_or_keep(plugin, report, f"there is no joint {name!r}")
        # Of URDF <mimic> can be written for any release; in SDF the element came with 1.11.
        if self.format is Format.SDF and parse_version(self.release.sdf) < (1, 11):
            reason = f"SDF {self.release.sdf}, which gz-sim of {self.release.name} reads, has no <mimic>"
            return self._drop_or_keep(plugin, report, reason)
        mimic = _make_mimic(leader, parameters)
        if mimic is None:
            return self._drop_or_keep(plugin, report, "its multiplier or offset is not a number")
        written = _mimic_of(joints[follower])
        if written is not None and not _same_mimic(written, mimic):
            return self._drop_or_keep(
                plugin, report, f"joint {follower!r} mimics {written.joint!r} in another way already"
            )
        lost: list[DroppedParameter] = [*moved.lost, *unused_parameters(plugin, moved.moved, RosNames(plugin))]
        report.migrated(f"the <mimic> of joint {follower!r}", lost)
        if written is None:
            self.edits.mimic(site, follower, mimic)
        return ()


def _make_mimic(leader: str, parameters: dict[str, str]) -> Mimic | None:
    try:
        numbers = {name: float(parameters[name]) for name in ("multiplier", "offset") if name in parameters}
    except ValueError:
        return None
    return Mimic(joint=leader, multiplier=numbers.get("multiplier"), offset=numbers.get("offset"))


def _mimic_of(joint: Joint) -> Mimic | None:
    return (joint.axis or Axis()).mimic


def _same_mimic(one: Mimic, other: Mimic) -> bool:
    def values(mimic: Mimic) -> tuple[str | None, float, float]:
        return mimic.joint, multiplier(mimic), mimic.offset or 0.0

    return values(one) == values(other)


def _part_names(model: Model, kind: str) -> set[str]:
    return {each.name for each in (model.links if kind == "link" else model.joints)}


def _unscoped_name(name: str) -> str:
    """The last part of a scoped name."""
    return name.rpartition("::")[2].strip()


def _is_library(plugin: Plugin) -> bool:
    """Whether the file is named like a library; other names may be looked up by some program."""
    name = plugin.filename or ""
    return name.startswith("lib") or name.endswith((".so", ".dll", ".dylib"))


def add_measures(plugin: Plugin, system: str, model: Model, format_: Format) -> tuple[Plugin, list[str]]:
    """The plugin with sizes for its system that can be measured on the model, and why others are missing."""
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


def rename_ignition_plugin(plugin: Plugin, release: Release) -> Plugin:
    """The plugin with current names; the same plugin if it has them, or if the release uses the old ones."""
    if release.sim <= _NATIVE:
        return plugin
    filename, name = plugin.filename or "", plugin.name
    changed = Plugin(
        filename=modern_file(filename) if is_ignition_name(filename) else plugin.filename,
        name=modern_class(name) if name and is_ignition_name(name) else name,
        text=plugin.text,
        content=tuple(map(_rename_in_element, plugin.content)),
        opaque=plugin.opaque,
        source=plugin.source,
    )
    return plugin if changed == plugin else changed


def _rename_in_element(element: Element) -> Element:
    text = _rename_in_text(element.text) if element.text else element.text
    attributes = tuple((name, _rename_in_text(value)) for name, value in element.attributes)
    children = tuple(map(_rename_in_element, element.children))
    update = {"name": _ELEMENTS.get(element.name, element.name), "text": text, "attributes": attributes}
    changed = element.copy(**{**update, "children": children})
    return element if changed == element else changed


def _rename_in_text(text: str) -> str:
    return _CLASSES.sub("gz::sim::", _WORDS.sub("gz", text))


class OtherQuantityError(Exception):
    """The pose of the model in the world is not what the plugin reported; the message has the reason."""


def pose_offset(plugin: Plugin, bodies: tuple[str, ...], model: Model | None, format_: Format) -> tuple[Element, ...]:
    """The offset of the link whose pose a plugin (gazebo_ros_p3d) reports from the model; empty if there is none.

    Raises:
        OtherQuantityError: there is no such link, it moves on its own, or the pose was relative to another link.
    """
    body = next((child.text or "" for child in plugin.content if child.name in bodies), "").rpartition("::")[2].strip()
    frame = next((child.text or "" for child in plugin.content if child.name in _FRAMES), "").strip()
    # gazebo_ros_p3d reports a link, OdometryPublisher a model. A link fixed to the base gets its
    # offset from the model's frame; any other pose would be a different quantity under the same
    # topic, and is refused.
    if frame not in _WORLDS:
        raise OtherQuantityError(f"the pose was relative to link {frame!r}, and OdometryPublisher knows the world only")
    if model is None or body not in {link.name for link in model.links}:
        raise OtherQuantityError(f"there is no link {body!r} to report the pose of")
    if body not in _links_fixed_to(model, base_link(model, format_) or ""):
        reason = f"it reported the pose of link {body!r}, which moves on its own; OdometryPublisher has the model's"
        raise OtherQuantityError(reason)
    try:
        place = FrameGraph(model).pose(body, MODEL, kind="link", base="model")
    except FrameError as error:
        raise OtherQuantityError(error.message) from error
    return tuple(_offset_elements(place))


def _offset_elements(place: Transform) -> Iterator[Element]:
    pose = Transform(place.translation, place.rotation).to_pose()
    if pose.xyz is not None:
        yield Element(name="xyz_offset", text=format_value(pose.xyz))
    if pose.rpy is not None:
        yield Element(name="rpy_offset", text=format_value(pose.rpy))


def _links_fixed_to(model: Model, link: str) -> set[str]:
    """The links that cannot move against a link: all that fixed joints lead to."""
    beside: dict[str, list[str]] = {}
    for joint in model.joints:
        if joint.type == "fixed" and joint.parent and joint.child:
            beside.setdefault(joint.parent, []).append(joint.child)
            beside.setdefault(joint.child, []).append(joint.parent)
    # Along fixed joints in both directions: the base may be the child of a fixed joint, as below a
    # base_footprint.
    found, open_ = {link}, [link]
    while open_:
        news = [each for each in beside.get(open_.pop(), ()) if each not in found]
        found.update(news)
        open_ += news
    return found
