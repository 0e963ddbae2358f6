"""Migration of Gazebo Classic sensors, and of the plugins in them."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, Location, rules
from twinform.ir import Element, Plugin, Sensor
from twinform.ir.sensor import RENAMED_ELEMENTS
from twinform.passes.classic.moving import (
    DroppedParameter,
    MigrationReport,
    Moved,
    accept_trial,
    camera_height,
    camera_width,
    focal_length,
    needed_checks,
    set_text,
    text_at,
    trial_sink,
    truth_of,
)
from twinform.passes.classic.systems import RosNames, unused_parameters, without_unread_parameters
from twinform.passes.classic.tables import ClassicSensorRow, Migration, migration_of, unread_parts
from twinform.passes.plugins.catalog import ros2_kind, sensors
from twinform.passes.plugins.catalog_types import Release
from twinform.passes.plugins.sites import PluginSite, sensor_element, sensor_of
from twinform.schemas import format_value

_FRAMES = ("frame_id", "gz_frame_id", "ignition_frame_id")
# Fortress has another name for the element with a sensor's frame; gz-sensors 7 renamed it.
_FRAME_BEFORE = "ignition_frame_id"
_MANY = "multicamera"


@dataclass(frozen=True, slots=True)
class SensorMigration:
    """Migrates the sensors of a document for one release."""

    release: Release
    sink: DiagnosticSink

    def __call__(self, sensor: Sensor, site: PluginSite) -> Iterable[Sensor]:
        """The sensors that replace one."""
        found = [(plugin, migration) for plugin in sensor.plugins if (migration := self._migration_for(plugin))]
        if sensor.type == _MANY:
            yield from self._split(sensor, site, found)
            return
        yield self._migrate_one(sensor, site, found)

    def _migration_for(self, plugin: Plugin) -> Migration | None:
        migration = migration_of(plugin.filename or "", plugin.content)
        return migration if migration and migration.sensor is not None else None

    def _migrate_one(self, sensor: Sensor, site: PluginSite, found: list[tuple[Plugin, Migration]]) -> Sensor:
        type_ = self._migrated_type(sensor, found)
        element = rename_frame_element(_bare_element(sensor, type_), self.release)
        trial = SensorMigration(self.release, trial_sink(self.sink))
        for plugin, migration in found:
            element = trial.apply_plugin(plugin, migration, element, _site_in_sensor(sensor, site))
        trial.report_type(sensor, type_, site)
        gone = {id(plugin) for plugin, _ in found}
        rest = tuple(plugin for plugin in sensor.plugins if id(plugin) not in gone)
        made = _changed_sensor(sensor, complete_lens(element), rest)
        if made is None:
            return sensor
        accept_trial(self.sink, trial.sink)
        return made

    def _migrated_type(self, sensor: Sensor, found: list[tuple[Plugin, Migration]]) -> str:
        """The current type of a sensor, which its plugin may decide."""
        for _, migration in found:
            row = migration.sensor or ClassicSensorRow()
            if sensor.type is not None and sensor.type in row.types:
                return row.types[sensor.type]
        return current_types().get(sensor.type or "", sensor.type or "")

    def apply_plugin(
        self, plugin: Plugin, migration: Migration, element: Element, site: PluginSite, camera: str | None = None
    ) -> Element:
        """The sensor with the parameters of a plugin; `camera` is the name of one camera of several."""
        row, read = migration.sensor or ClassicSensorRow(), without_unread_parameters(plugin)
        names = RosNames(read, sensor=element.get("name") if camera is None else site.holder, camera=camera)
        moved = Moved(element, is_valid=_is_sensor)
        moved.apply(read.content, {**migration.shared, **row.moves})
        moved.frame = moved.frame or _default_frame(plugin, site)
        element = _set_defaults(_set_frame_and_pose(moved, self.release), migration, row, moved.moved)
        for path, pattern in _sensor_topics(row, element):
            topic = names.topic(pattern)
            if text_at(element, path) is None and migration.nothing is None:
                element = set_text(element, path, topic)
        taken = moved.moved | set(migration.make.of if migration.make else ())
        lost: list[DroppedParameter] = [*moved.lost, *unused_parameters(plugin, taken, names)]
        report = MigrationReport(self.sink, plugin, site)
        if migration.nothing is not None:
            report.needless(migration.nothing, lost)
        else:
            report.migrated(f"a part of the {element.get('type')} {element.get('name')!r}", lost)
            for reason in needed_checks(migration, read, element.get("type")):
                report.missing(reason)
        return element

    def report_type(self, sensor: Sensor, type_: str, site: PluginSite) -> None:
        """Report a type that was renamed, or that no release simulates."""
        where = sensor.location
        reason = unread_parts()["sensors"].get(type_)
        kind = sensors().get(type_)
        if reason is None and kind is not None and self.release.name not in kind.releases:
            reason = f"gz-sim of {self.release.name} has none of its type"
        if reason is not None:
            message = f"sensor {sensor.name!r} on {site.holder!r} is {type_}, and measures nothing: {reason}"
            self.sink.report(rules.SENSOR_WITHOUT_COUNTERPART, message, where, found=type_)
        if type_ != sensor.type:
            message = f"sensor {sensor.name!r} on {site.holder!r} had the type {sensor.type} and is now {type_}"
            self._account_type(message, where, sensor.type)

    def _account_type(self, message: str, where: Location, found: str | None) -> None:
        self.sink.report(rules.MIGRATED_SENSOR, message, where, found=found)
        self.sink.account(Fate.APPROXIMATED, rules.MIGRATED_SENSOR, message, where.at("@type"))

    def _split(self, sensor: Sensor, site: PluginSite, found: list[tuple[Plugin, Migration]]) -> Iterator[Sensor]:
        """One sensor for each camera of a multicamera."""
        whole = _bare_element(sensor, "camera")
        cameras = whole.find_all("camera")
        shared = tuple(child for child in whole.children if child.name != "camera")
        gone = {id(plugin) for plugin, _ in found}
        rest = tuple(plugin for plugin in sensor.plugins if id(plugin) not in gone)
        # gz-sim has no multicamera. Each camera becomes a sensor, and the plugins are applied to
        # all of them, but reported once.
        quiet = SensorMigration(self.release, DiagnosticSink())
        for number, camera in enumerate(cameras):
            # Sensors of a link need names of their own; the name of the camera alone may be taken
            # by that of another multicamera.
            name = f"{sensor.name}_{camera.get('name') or number}"
            element = _single_camera(whole, name, camera, shared)
            for plugin, migration in found:
                teller = self if number == 0 else quiet  # what is lost is lost once
                here, called = _site_in_sensor(sensor, site), camera.get("name") or str(number)
                element = teller.apply_plugin(plugin, migration, element, here, called)
            made = sensor_of(complete_lens(rename_frame_element(element, self.release)))
            if made is not None:
                yield made.copy(plugins=rest if number == 0 else (), source=sensor.source)
        message = f"sensor {sensor.name!r} on {site.holder!r} had the type {_MANY} and is now {len(cameras)} cameras"
        self._account_type(message, sensor.location, sensor.type)
        where = sensor.location
        self.sink.account(Fate.APPROXIMATED, rules.MIGRATED_SENSOR, message, where.at("@name"))
        for part in sensor.opaque:
            if part.element is not None and part.element.name == "camera" and not part.at:
                self.sink.account(Fate.APPROXIMATED, rules.MIGRATED_SENSOR, message, part.location.at("@name"))


def _site_in_sensor(sensor: Sensor, site: PluginSite) -> PluginSite:
    """The site of the plugins in a sensor."""
    return replace(site, scope="sensor", holder=sensor.name or "", sensor=sensor)


def _sensor_topics(row: ClassicSensorRow, element: Element) -> Iterator[tuple[str, str]]:
    """The paths of the topics that a sensor needs, and the patterns for their names."""
    yield from row.topics_of.get(element.get("type") or "", row.topics).items()
    for path, topics in row.topics_where.items():
        if truth_of(text_at(element, path) or ""):
            yield from topics.items()


def _default_frame(plugin: Plugin, site: PluginSite) -> str | None:
    """The frame of a plugin for ROS 2 that names none: the link of its sensor (utils.cpp, SensorFrameID)."""
    kind = ros2_kind(plugin)
    reads_one = kind is not None and kind.parameter("frame_name") is not None and site.scope == "sensor"
    return site.link_or_joint if reads_one else None


def rename_frame_element(element: Element, release: Release) -> Element:
    """The sensor with the element for its frame as a release names it."""
    wanted = release.frame_element or _FRAME_BEFORE
    children = tuple(
        child.copy(name=wanted) if child.name in _FRAMES and _is_newer(child.name, wanted) else child
        for child in element.children
    )
    return element if children == element.children else element.copy(children=children)


def set_frame(element: Element, frame: str, release: Release) -> Element:
    """The sensor with the frame of its messages."""
    return set_text(element, release.frame_element or _FRAME_BEFORE, frame)


def complete_lens(element: Element) -> Element:
    """The camera with all values of its lens if any is written: each of them has a default of its own."""
    values = {"fx": focal_length, "fy": focal_length, "cx": _center_x, "cy": _center_y}
    for group, prefix in (("intrinsics", ""), ("projection", "p_")):
        path = f"camera/lens/{group}"
        camera = element.find("camera")
        lens = camera.find("lens") if camera is not None else None
        # SDF gives each missing value of <intrinsics> its own default (fx 277, cx 160, cy 120),
        # which belongs to an image of 320 x 240 pixels: a plugin that sets only fx would leave the
        # others at those.
        if lens is None or lens.find(group) is None:
            continue
        for name, value in values.items():
            if text_at(element, f"{path}/{prefix}{name}") is None:
                element = set_text(element, f"{path}/{prefix}{name}", format_value(value(element)))
    return element


@cache
def current_types() -> dict[str, str]:
    """The current types of sensors by their names in Gazebo Classic and in older files."""
    older = {alias: kind.type for kind in sensors().values() for alias in kind.aliases}
    return older | {word: kind.type for kind in sensors().values() for word in kind.classic}


def _bare_element(sensor: Sensor, type_: str) -> Element:
    """The element of a sensor with a type, without its plugins."""
    element = sensor_element(sensor.copy(plugins=()))
    if type_ == sensor.type:
        return element
    element = set_text(element, "@type", type_)
    children = tuple(
        child.copy(name=RENAMED_ELEMENTS[child.name]) if child.name in RENAMED_ELEMENTS else child
        for child in element.children
    )
    return element.copy(children=children)


def _is_newer(old: str, wanted: str) -> bool:
    """Whether the wanted name came after the old one."""
    return _FRAMES.index(old) > _FRAMES.index(wanted)


def _set_frame_and_pose(moved: Moved, release: Release) -> Element:
    """The sensor with the frame and the offset that its plugin names."""
    element = moved.element
    if moved.frame and not any(child.name in _FRAMES for child in element.children):
        element = set_frame(element, moved.frame, release)
    # A pose of the sensor itself counts more than the offset of its plugin.
    if moved.offsets and element.find("pose") is None:
        pose = f"{moved.offsets.get('xyz', '0 0 0')} {moved.offsets.get('rpy', '0 0 0')}"
        element = set_text(element, "pose", pose)
    return element


def _set_defaults(element: Element, migration: Migration, row: ClassicSensorRow, moved: set[str]) -> Element:
    """The sensor with the defaults of its plugin, where no parameter has chosen another value."""
    moves = {**migration.shared, **row.moves}
    chosen = {path for name in moved for texts in (moves[name].choose or {}).values() for path in texts}
    for path, value in row.sets.items():
        if path not in chosen and text_at(element, path) is None:
            element = set_text(element, path, value)
    return element


def _single_camera(whole: Element, name: str, camera: Element, shared: tuple[Element, ...]) -> Element:
    """A sensor with one camera, which keeps its pose in the sensor."""
    bare = camera.copy(attributes=())
    return set_text(whole.copy(children=(*shared, bare)), "@name", name)


def _changed_sensor(sensor: Sensor, element: Element, plugins: tuple[Plugin, ...]) -> Sensor | None:
    if element == sensor_element(sensor.copy(plugins=())):
        return sensor if plugins == sensor.plugins else sensor.copy(plugins=plugins)
    made = sensor_of(element)
    return made and made.copy(plugins=plugins, source=sensor.source)


def _is_sensor(element: Element) -> bool:
    return sensor_of(element) is not None


def _center_x(sensor: Element) -> float:
    return camera_width(sensor) / 2


def _center_y(sensor: Element) -> float:
    return camera_height(sensor) / 2
