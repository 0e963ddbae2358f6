"""Topics of gz-transport that the plugins and sensors of a document publish and subscribe to."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from twinform.ir import Document, Element, Plugin, Sensor
from twinform.ir.node import Node
from twinform.passes.plugins.catalog import modern_class, systems_of_file
from twinform.passes.plugins.parts import Channel, PluginKind, Published, SensorKind
from twinform.passes.plugins.sites import Site, plugins_of, sensors_of
from twinform.passes.plugins.worlds import kind_of_sensor

_PLACE = re.compile(r"\{([^{}]++)\}")
_UNDER_MODEL = "/model/"
_CLOUD = re.compile(r"points|cloud", re.IGNORECASE)
"""What is in names of topics with point clouds: `velodyne_points`, `lidar/points`, `cloud_in`."""
_CLOUD_TOPIC = "{topic}/points"
_OWN_INFO = "camera"
"""The kind of sensor that reads `<camera_info_topic>` (CameraSensor.cc): others put it where they want."""


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic, and what makes it: `direction` is `<` for what Gazebo writes and `>` for what it reads.

    `short` is what is left of it inside of the model. `needs_world` means that its name contains that of a world which
    the document does not have. `source` is the plugin or sensor, `model` the name of the model around it.
    """

    name: str
    short: str
    message: str
    direction: Literal["<", ">"]
    model: str
    source: Node
    needs_world: bool = False


def topics_of(document: Document, release: str, world: str | None = None) -> Iterator[Topic]:
    """The topics of a document in a release; `world` is the name of the world that a model is put into."""
    for sensor, site in sensors_of(document):
        yield from _of_sensor(sensor, site, release, world)
    for plugin, site in plugins_of(document):
        kind = _kind_of(plugin, release)
        if kind is not None:
            yield from _of_plugin(plugin, kind, site, release, world)


def _kind_of(plugin: Plugin, release: str) -> PluginKind | None:
    kinds = [kind for kind in systems_of_file(plugin.filename or "") if release in kind.releases]
    named = [kind for kind in kinds if kind.class_name == modern_class(plugin.name or "")]
    return next(iter(named or kinds), None)


def _of_sensor(sensor: Sensor, site: Site, release: str, world: str | None) -> Iterator[Topic]:
    kind = kind_of_sensor(sensor, release)
    if kind is None:
        return
    own = _written_topic(sensor)
    scope = "/".join(["", "world", _world_of(site, world), *_scoped(site), site.scope, site.holder])
    suffix = f"/{kind.suffix}" if kind.suffix else ""
    name = _absolute(own) if own else f"{scope}/sensor/{sensor.name}{suffix}"
    needs_world = own is None and site.world is None and world is None
    model = site.models[0].name if site.models else ""
    for each in kind.publishes:
        if release not in each.releases:
            continue
        beside = name.rsplit("/", 1)[0]
        made = each.pattern.format(topic=name, beside=beside)
        info = _text_in(sensor, "camera", "camera_info_topic") if kind.type == _OWN_INFO else None
        if made.endswith("/camera_info") and info and info != "__default__":
            made = _absolute(info)
        short = _named_for_cloud(made, name, kind) if own else made.removeprefix(f"{scope}/sensor/")
        yield Topic(made, short, _message(each, sensor, kind), "<", model, sensor, needs_world)


def _named_for_cloud(made: str, name: str, kind: SensorKind) -> str:
    """What is left of a topic of a sensor; the cloud has the sensor's own name where that names a cloud.

    gz has the scan or image under that name and the cloud on `points` below it.
    """
    if _CLOUD.search(name.rpartition("/")[2]) and any(each.pattern == _CLOUD_TOPIC for each in kind.publishes):
        made = {name: f"{name}/{kind.suffix}", _CLOUD_TOPIC.format(topic=name): name}.get(made, made)
    return made.lstrip("/")


def _written_topic(sensor: Sensor) -> str | None:
    """The topic in the sensor; of a contact sensor the one in `<contact>`, as Gazebo reads no other."""
    topic = _text_in(sensor, "contact", "topic") if sensor.type == "contact" else sensor.topic
    return topic if topic and topic != "__default_topic__" else None


def _text_in(sensor: Sensor, holder: str, name: str) -> str | None:
    for part in sensor.opaque:
        inner = part.element.find(name) if part.element and part.element.name == holder else None
        if inner is not None and inner.text:
            return inner.text
    return None


def _message(published: Published, sensor: Sensor, kind: SensorKind) -> str:
    """The message of a topic, which a setting of the sensor may have chosen."""
    name, _, value = published.where.partition("=")
    return published.instead if name and _text_in(sensor, kind.element, name) == value else published.message


def _scoped(site: Site) -> Iterator[str]:
    for model in site.models:
        yield from ("model", model.name)


def _world_of(site: Site, world: str | None) -> str:
    return site.world.name if site.world else world or ""


def _of_plugin(plugin: Plugin, kind: PluginKind, site: Site, release: str, world: str | None) -> Iterator[Topic]:
    values = {row.name: row.default for row in kind.parameters if row.default is not None}
    written: dict[str, str] = {}
    for element in plugin.content:
        written.setdefault(element.name, (element.text or "").strip())
    model = site.model.name if site.model else ""
    models = "/model/".join(each.name for each in site.models)
    scope = "/".join(_scoped(site))
    values |= {**written, "model": model, "models": models, "scope": scope, "world": _world_of(site, world)}
    for channel in kind.channels:
        if release not in channel.releases or not _is_there(channel, written):
            continue
        pattern, message = _choose(channel, written)
        needs_world = "{world}" in pattern and not values["world"]
        outer = site.models[0].name if site.models else ""
        for each in dict.fromkeys(_texts(plugin.content, channel.each)) if channel.each else ("",):
            name = _absolute(_filled(pattern, {**values, "each": each}))
            short = _inside(name, values["world"], model, models)
            yield Topic(name, short, message, channel.direction, outer, plugin, needs_world)


def _is_there(channel: Channel, written: Mapping[str, str]) -> bool:
    if channel.unless and _is_on(written, channel.unless):
        return False
    return channel.when is None or _is_on(written, channel.when)


def _texts(elements: Iterable[Element], path: tuple[str, ...]) -> Iterator[str]:
    """The texts of all elements at a path."""
    for element in elements:
        if element.name == path[0]:
            if path[1:]:
                yield from _texts(element.children, path[1:])
            elif element.text and element.text.strip():
                yield element.text.strip()


def _inside(name: str, world: str, model: str, models: str) -> str:
    """What is left of a topic inside of the model."""
    short = name.removeprefix(f"/world/{world}")
    for scope in (models, model):
        short = short.removeprefix(f"{_UNDER_MODEL}{scope}/")
    return short.lstrip("/")


def _choose(channel: Channel, written: Mapping[str, str]) -> tuple[str, str]:
    """The pattern and message of a channel: those of the parameter, of the last alternative, or the usual ones."""
    pattern, message = channel.pattern, channel.message
    for each in channel.alternatives:
        if all(_is_on(written, name) for name in each.parameters):
            pattern, message = each.pattern or pattern, each.message or message
    if channel.parameter and written.get(channel.parameter):
        pattern = written[channel.parameter]
    return pattern, message


def _is_on(written: Mapping[str, str], parameter: str) -> bool:
    return written.get(parameter, "").lower() not in {"", "false", "0"}


def _filled(pattern: str, values: Mapping[str, str]) -> str:
    """The pattern with values; `{a|b}` is the first of them that there is."""

    def fill(found: re.Match[str]) -> str:
        return next((values[name] for name in found[1].split("|") if values.get(name)), "")

    return _PLACE.sub(fill, pattern)


def _absolute(name: str) -> str:
    """A topic as gz-transport knows it, with one slash before every part."""
    return "/" + "/".join(filter(None, name.split("/")))
