"""Topics of gz-transport that the plugins and sensors of a document publish and subscribe to."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Literal

from twinform.dataclass import dataclass
from twinform.ir import Document, Element, Format, Model, Plugin, Sensor
from twinform.ir.node import Node
from twinform.lazy import lazy_pattern
from twinform.passes.plugins.catalog import modern_class, systems_of_file
from twinform.passes.plugins.catalog_types import PluginKind, Published, SensorKind, TopicChannel
from twinform.passes.plugins.parameters import (
    as_valid_topic,
    fill_pattern,
    fill_topic_pattern,
    is_valid_topic,
    placeholders,
    qualified,
    without_parentheses,
)
from twinform.passes.plugins.sites import PluginSite, plugins_of, sensors_of
from twinform.passes.plugins.world_systems import custom_type, kind_of_sensor
from twinform.passes.shared.gazebo_tags import TRUE, lumped_joints, lumped_links

_CLOUD = lazy_pattern(r"points|cloud", re.IGNORECASE)
"""Occurs in names of topics with point clouds: `velodyne_points`, `lidar/points`, `cloud_in`."""
_CLOUD_TOPICS = frozenset({"{topic}/points", "({topic}/points)"})
# CameraSensor.cc reads <camera_info_topic>; other sensors choose the topic themselves.
_OWN_INFO = "camera"
_ANY_WORLD = "{world}"
"""Stands for the name of an unknown world."""
# Its topic is the same for all where the element is there and has the default (LogicalCamera.cc,
# AddLogicalCamera; LogicalCameraSensor.cc, Load).
_LOGICAL_CAMERA = "logical_camera"
_BOXES = "boundingbox_camera"
# BoundingBoxCameraSensor.cc, Load.
_BOX_TYPES = frozenset({"2d", "visible_2d", "visible_box_2d", "full_2d", "full_box_2d", "3d"})
# Sensors without a service for their rate (EnvironmentalSensorSystem.cc, Load, returns before it).
_WITHOUT_RATE = frozenset({"contact", "environmental_sensor"})
# The topic of a contact sensor stands in <contact> and is not made valid (contact/Contact.cc,
# Load).
_TRIGGER = "gz.msgs.Boolean"
# Its cameras refuse to be loaded without a topic for what triggers them (CameraSensor.cc, Load).
_NEEDS_TRIGGER = "fortress"
_CONTACT = "contact"
# `__default__` stands for no topic, but in <contact> (sdf/contact.sdf).
_UNNAMED = {_CONTACT: "__default_topic__"}
# In these releases, plugins leave the world out of the name that they have when they are loaded. A
# model of the world is in it by then; a spawned one is not, and so leaves out its own name
# (SdfEntityCreator.cc, PosePublisher.cc).
_WITHOUT_WORLD = frozenset({"ionic", "jetty"})


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic, and the plugin or sensor that makes it (`source`).

    `direction` is `<` if Gazebo writes it and `>` if Gazebo reads it. `short` is the name without the world and models
    around the source. `needs_world` means that the name contains that of an unknown world; `missing` says why Gazebo
    has no such topic, and is empty if it has one. `model` is the name of the outermost model around the source.
    """

    name: str
    short: str
    message: str
    direction: Literal["<", ">"]
    model: str
    source: Node
    needs_world: bool = False
    missing: str = ""


def topics_of(document: Document, release: str, world: str | None = None) -> Iterator[Topic]:
    """The topics of a document in a release; `world` is the name of the world that a model is put into.

    Gazebo lumps fixed joints when it reads URDF, and spawns such a robot.
    """
    urdf = document.format is Format.URDF
    lumped = _Lumped.of(document.models if urdf else ())
    for sensor, site in sensors_of(document):
        kind = kind_of_sensor(sensor, release)
        if kind is not None:
            yield from _sensor_topics(sensor, kind, _TopicPlace(site, release, world, urdf), lumped)
    for plugin, site in plugins_of(document):
        kind = _plugin_kind(plugin, release)
        if kind is not None:
            yield from _plugin_topics(plugin, kind, _TopicPlace(site, release, world, urdf))


def _plugin_kind(plugin: Plugin, release: str) -> PluginKind | None:
    kinds = [kind for kind in systems_of_file(plugin.filename or "") if release in kind.releases]
    named = [kind for kind in kinds if kind.class_name == modern_class(plugin.name or "")]
    return next(iter(named or kinds), None)


@dataclass(frozen=True, slots=True)
class _Lumped:
    """How Gazebo lumps the links of URDF: the host of each link, and the joints that it removes."""

    links: Mapping[str, str]
    joints: frozenset[str]

    @classmethod
    def of(cls, models: Sequence[Model]) -> "_Lumped":
        links = {name: host for model in models for name, host in lumped_links(model).items()}
        return cls(links, frozenset(joint.name for model in models for joint in lumped_joints(model).values()))


@dataclass(frozen=True, slots=True)
class _TopicPlace:
    """Where a plugin or sensor is; a model without a world may be `spawned` into `given_world`."""

    site: PluginSite
    release: str
    given_world: str | None
    spawned: bool

    @property
    def world(self) -> str | None:
        """The name of the world, if it is known."""
        return self.site.world.name if self.site.world else self.given_world

    @property
    def outer(self) -> str:
        """The name of the outermost model."""
        return self.site.models[0].name if self.site.models else ""

    @property
    def models(self) -> str:
        """The models around the source, as topics name them."""
        return "/".join(part for model in self.site.models for part in ("model", model.name))

    @property
    def scope(self) -> str:
        """The world and the models around the source (`Util.cc`, scopedName)."""
        return "/".join(filter(None, ("world", _ANY_WORLD if self.world is None else self.world, self.models)))

    def scopes(self) -> dict[str, str]:
        """The values of the placeholders for scopes (`Util.cc`, topicFromScopedName)."""
        part = "/part"
        return {
            "scope": _scope_topic(self.scope),
            "models": _scope_topic(_without_world(self.scope)),
            "loaded": _scope_topic(self._loaded()),
            "loaded_part": f"/{self._loaded(part)}".removesuffix(part),
        }

    def _loaded(self, end: str = "") -> str:
        """What a plugin knows of its place, or of a part of its model, when it is loaded."""
        if self.release not in _WITHOUT_WORLD:
            return (self.models or self.scope) + end
        return _without_world((self.models if self.spawned else self.scope) + end)


def _scope_topic(scope: str) -> str:
    return as_valid_topic(f"/{scope}") or ""


def _without_world(scope: str) -> str:
    """The names without the first two parts, whatever stands in them (`Util.cc`, removeParentScope)."""
    # removeParentScope drops the first two names without asking whether they are `world/NAME`, so a
    # name with a slash in it shifts the rest. The same is done here.
    for _ in range(2):
        scope = scope[scope.find("/") + 1 :]
    return scope


def _sensor_topics(sensor: Sensor, kind: SensorKind, place: _TopicPlace, lumped: "_Lumped") -> Iterator[Topic]:
    site = place.site
    # A sensor of URDF publishes below the link that its own is lumped into: the launch file spawns
    # the URDF. To write a <topic> into the user's file would be a change that nobody asked for.
    holder = lumped.links.get(site.holder, site.holder) if site.scope == "link" else site.holder
    # Gazebo's code decides what becomes of a topic with a blank, `@`, `~`, `//` or `:=`: most
    # systems make a valid name of it, a few take another topic, and some publish nowhere. The rows
    # of the catalog say which, from the sources; tests/unit/passes/plugins/advertised.py has a
    # second table for comparison.
    own, service = _written_topic(sensor), None
    if kind.type == _LOGICAL_CAMERA and own is None and sensor.topic is not None:
        names = (*(each.name for each in site.models), holder or "", sensor.name or "")
        own, service = f"/{_LOGICAL_CAMERA}", f"/{'::'.join(names)}"
    above = f"{place.scope}/{site.scope}/{holder}/sensor"
    suffix = custom_type(sensor) if (kind.custom or "").endswith("/") else kind.suffix
    text = own or "/".join(filter(None, (above, sensor.name, suffix)))
    name = fill_topic_pattern("{topic}", {"topic": text}, raw=kind.type == _CONTACT)
    rows = [row for row in kind.publishes if place.release in row.releases]
    made = [_sensor_topic(row, name, sensor, kind) for row in rows]
    waits = place.release in kind.triggered and (_text_at(sensor, "camera", "triggered") or "").lower() in TRUE
    trigger = _text_at(sensor, "camera", "trigger_topic")
    missing = _explain_box_type(sensor, kind)
    if waits and not trigger and place.release == _NEEDS_TRIGGER:
        missing = "it needs a <trigger_topic> for its <triggered>"
    if not missing and not all((*made, _rate_service(service or name, kind))):
        missing = _explain_refusal(text)  # with one of its topics, or the service, Gazebo refuses the sensor
    if site.scope == "joint" and holder in lumped.joints:
        missing = f"it leaves out fixed joint {holder!r} and its sensors; a <preserveFixedJoint> for it keeps them"
    for row, topic in zip(rows, made, strict=True):
        shown = qualified(topic or text)
        short = _short_cloud_name(shown, qualified(name or ""), kind) if own else _short_name(shown, f"/{above}")
        message, needs_world = _message_of(row, sensor), own is None and place.world is None
        yield Topic(shown, short, message, "<", place.outer, sensor, needs_world, missing)
    if waits and trigger:
        valid = is_valid_topic(trigger)
        shown, missing = qualified(trigger), missing or ("" if valid else _explain_refusal(trigger))
        yield Topic(shown, shown.lstrip("/"), _TRIGGER, ">", place.outer, sensor, missing=missing)
    elif waits:
        shown = qualified(fill_topic_pattern("{topic}/trigger", {"topic": name or text}) or text)
        short = shown.lstrip("/") if own else _short_name(shown, f"/{above}")
        yield Topic(shown, short, _TRIGGER, ">", place.outer, sensor, own is None and place.world is None, missing)


def _explain_refusal(text: str) -> str:
    return f"gz-transport takes no topic {text!r}"


def _explain_box_type(sensor: Sensor, kind: SensorKind) -> str:
    boxes = _text_at(sensor, "camera", "box_type") or "2d"
    return f"it knows no <box_type> {boxes!r}" if kind.type == _BOXES and boxes not in _BOX_TYPES else ""


def _rate_service(name: str | None, kind: SensorKind) -> str | None:
    """The service that sets the rate of a sensor, without which the sensor is not loaded (Sensor.cc, Load)."""
    return name if kind.type in _WITHOUT_RATE else fill_topic_pattern(f"{name}/set_rate", {}, raw=True)


def _sensor_topic(published: Published, name: str | None, sensor: Sensor, kind: SensorKind) -> str | None:
    if name is None:
        return None
    info = _text_at(sensor, "camera", "camera_info_topic") if kind.type == _OWN_INFO else None
    if published.pattern.endswith("/camera_info") and info and info != "__default__":
        return fill_topic_pattern("{info}", {"info": info}, raw=True)
    beside = "".join(f"/{part}" for part in name.split("/")[:-1] if part)  # CameraSensor.cc, AdvertiseInfo
    return fill_topic_pattern(published.pattern, {"topic": name, "beside": beside}, raw=True)


def _short_cloud_name(made: str, name: str, kind: SensorKind) -> str:
    """The short name of a topic of a sensor; the cloud gets the name of the sensor if that names a cloud.

    Gazebo has the scan or image under that name, and the cloud in `points` below it.
    """
    # Plugins of Gazebo Classic for clouds published one topic, and what it was meant for stands
    # only in its name after the migration. An annotation would overrule the next edit of the topic,
    # or be overruled by it.
    if _CLOUD.search(name.rpartition("/")[2]) and any(each.pattern in _CLOUD_TOPICS for each in kind.publishes):
        made = {name: f"{name}/{kind.suffix}", f"{name}/points": name}.get(made, made)
    return made.lstrip("/")


def _written_topic(sensor: Sensor) -> str | None:
    """The topic that is written in a sensor; in a contact sensor the one in `<contact>`: Gazebo reads no other."""
    is_contact = sensor.type == _CONTACT
    topic = _text_at(sensor, "contact", "topic") if is_contact else sensor.topic
    return topic if topic and topic != _UNNAMED.get(sensor.type or "", "__default__") else None


def _text_at(sensor: Sensor, *path: str) -> str | None:
    """The first text at a path of elements of a sensor; None if it is empty."""
    return next(_texts_at((part.element for part in sensor.opaque if part.element), path), None)


def _message_of(published: Published, sensor: Sensor) -> str:
    """The message of a topic, which may depend on a setting of the sensor."""
    path, _, value = published.where.partition("=")
    return published.instead if path and _text_at(sensor, *path.split("/")) == value else published.message


def _plugin_topics(plugin: Plugin, kind: PluginKind, place: _TopicPlace) -> Iterator[Topic]:
    model = place.site.model.name if place.site.model else ""
    defaults = {row.name: row.default for row in kind.parameters if row.default is not None}
    world = _ANY_WORLD if place.world is None else place.world
    names = {"model": model, "world": world, **place.scopes()}
    around = (f"/world/{world}", f"/{place.models}", f"/model/{model}")
    stopped = ""
    for channel in (*kind.checks, *kind.channels):
        # In the order in which the plugin advertises: at a topic that gz-transport refuses, some
        # plugins stop, and all that would follow is missing too.
        written = _read_parameters(plugin, kind, channel, place.release)
        if place.release not in channel.releases or not _channel_exists(channel, kind, written):
            continue
        pattern, message = _choose_pattern(channel, plugin, kind, written)
        needs_world = place.world is None and any(each in pattern for each in ("{world}", "{scope}"))
        for each in dict.fromkeys(_texts_at(plugin.content, channel.each)) if channel.each else ("",):
            known = {**defaults, **written, **_values_at_paths(pattern, plugin), **names, "each": each}
            text = fill_pattern(without_parentheses(pattern), known)
            if text is None:  # Gazebo refuses a plugin without that parameter, which is what its check says
                continue
            name = fill_topic_pattern(pattern, known, raw=channel.spelling in {"raw", "exact"})
            shown = qualified(name or text)
            missing = stopped or ("" if name else _explain_refusal(text))
            if missing and not stopped and channel.stops:
                stopped = f"{missing}, at which the plugin stops"
            if channel.direction != "!":
                short = _short_name(shown, *around)
                yield Topic(shown, short, message, channel.direction, place.outer, plugin, needs_world, missing)


def _read_parameters(plugin: Plugin, kind: PluginKind, channel: TopicChannel, release: str) -> dict[str, str]:
    """The parameters that the plugin of a release reads, the first of each name, if it accepts their texts."""
    written: dict[str, str] = {}
    for element in plugin.content:
        row = kind.parameter(element.name)
        if row is None or release in row.releases:
            written.setdefault(element.name, (element.text or "").strip())
    for name in [name for name in written if (row := kind.parameter(name)) is not None and row.type == "topic"]:
        text = _accepted_text(written.pop(name), channel)
        if text is not None:
            written[name] = text
    return written


def _accepted_text(text: str, channel: TopicChannel) -> str | None:
    """The text that a plugin takes for a topic; None if it takes its default."""
    match channel.spelling:
        # What each spelling in the catalog stands for: the plugin takes any text that is not empty;
        # takes a valid form of it or its default; takes it only if it is valid as written; or hands
        # it to gz-transport as it is.
        case "if-any":
            return text or None
        case "or-default":
            return as_valid_topic(text)
        case "exact":
            return text if is_valid_topic(text) else None
        case _:
            return text


def _channel_exists(channel: TopicChannel, kind: PluginKind, written: Mapping[str, str]) -> bool:
    if any(_are_on(each, kind, written) for each in channel.unless):
        return False
    return not channel.when or any(_are_on(each, kind, written) for each in channel.when)


def _are_on(parameters: Iterable[str], kind: PluginKind, written: Mapping[str, str]) -> bool:
    """Whether all parameters are written, and not false."""
    return all(_is_on(name, kind, written) for name in parameters)


def _is_on(name: str, kind: PluginKind, written: Mapping[str, str]) -> bool:
    row = kind.parameter(name)
    return name in written and (row is None or row.type != "bool" or written[name].lower() in TRUE)


def _texts_at(elements: Iterable[Element], path: Sequence[str]) -> Iterator[str]:
    """The texts of all elements at a path, which may end in an attribute."""
    name, *inside = path
    for element in elements:
        if element.name != name:
            continue
        if inside and inside[0].startswith("@"):
            yield element.get(inside[0][1:]) or ""
        elif inside:
            yield from _texts_at(element.children, inside)
        elif element.text and element.text.strip():
            yield element.text.strip()


def _values_at_paths(pattern: str, plugin: Plugin) -> dict[str, str]:
    """The values at paths that a pattern contains, such as `{breadcrumb/sdf/model/@name}`."""
    found = {
        path: next(_texts_at(plugin.content, tuple(path.split("/"))), "")
        for path in placeholders(pattern)
        if "/" in path
    }
    return {path: text for path, text in found.items() if text}


def _short_name(name: str, *around: str) -> str:
    """A topic without the world and the models around its source."""
    for scope in filter(None, map(as_valid_topic, around)):
        name = name.removeprefix(scope) if name.startswith(f"{scope}/") else name
    return name.lstrip("/")


def _choose_pattern(
    channel: TopicChannel, plugin: Plugin, kind: PluginKind, written: Mapping[str, str]
) -> tuple[str, str]:
    """The pattern and message of a channel: of its parameter, of the last alternative that applies, or the usual ones.

    A parameter that is written but not accepted still prevents alternative topics (DetachableJoint.cc, Configure).
    """
    own = channel.parameter
    asked = any(element.name == own for element in plugin.content)
    pattern, message = channel.pattern, channel.message
    for each in channel.alternatives:
        if _are_on(each.parameters, kind, written):
            pattern = pattern if asked else each.pattern or pattern
            message = each.message or message
    return f"{{{own}}}" if own and own in written else pattern, message
