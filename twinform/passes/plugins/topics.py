"""The topics of gz-transport that the plugins and sensors of a document read and write."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from twinform.ir import Document, Plugin, Sensor
from twinform.ir.node import Node
from twinform.passes.plugins.catalogue import modern_class, systems_of_file
from twinform.passes.plugins.parts import Channel, PluginKind
from twinform.passes.plugins.sites import Site, plugins_of, sensors_of
from twinform.passes.plugins.worlds import kind_of_sensor

_PLACE = re.compile(r"\{([^}]+)\}")
_UNDER_MODEL = "/model/"


@dataclass(frozen=True, slots=True)
class Topic:
    """A topic, and what makes it: `direction` is `<` for what Gazebo writes and `>` for what it reads.

    `short` is what is left of it inside of the model. `needs_world` says that its name contains that of a world which
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
            yield from _of_plugin(plugin, kind, site, world)


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
        beside = name.rsplit("/", 1)[0]
        made = each.pattern.format(topic=name, beside=beside)
        if made.endswith("/camera_info") and _info_topic(sensor):
            made = _absolute(_info_topic(sensor) or "")
        short = made.lstrip("/") if own else made.removeprefix(f"{scope}/sensor/")
        yield Topic(made, short, each.message, "<", model, sensor, needs_world)


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


def _info_topic(sensor: Sensor) -> str | None:
    for part in sensor.opaque:
        inner = part.element.find("camera_info_topic") if part.element and part.element.name == "camera" else None
        if inner is not None and inner.text and inner.text != "__default__":
            return inner.text
    return None


def _scoped(site: Site) -> Iterator[str]:
    for model in site.models:
        yield from ("model", model.name)


def _world_of(site: Site, world: str | None) -> str:
    return site.world.name if site.world else world or ""


def _of_plugin(plugin: Plugin, kind: PluginKind, site: Site, world: str | None) -> Iterator[Topic]:
    values = {row.name: row.default for row in kind.parameters if row.default is not None}
    written: dict[str, str] = {}
    for element in plugin.content:
        written.setdefault(element.name, (element.text or "").strip())
    model = site.model.name if site.model else ""
    values = {**values, **written, "model": model, "world": _world_of(site, world)}
    for channel in kind.channels:
        if channel.unless and _is_on(written, channel.unless):
            continue
        pattern, message = _choose(channel, written)
        name = _absolute(_filled(pattern, values))
        short = name.removeprefix(f"/world/{values['world']}").removeprefix(f"{_UNDER_MODEL}{model}/").lstrip("/")
        needs_world = "{world}" in pattern and not values["world"]
        outer = site.models[0].name if site.models else ""
        yield Topic(name, short, message, channel.direction, outer, plugin, needs_world)


def _choose(channel: Channel, written: Mapping[str, str]) -> tuple[str, str]:
    """The pattern and message of a channel: those of the parameter, of the last alternative, or the usual ones."""
    pattern, message = channel.pattern, channel.message
    for each in channel.alternatives:
        if _is_on(written, each.parameter):
            pattern, message = each.pattern, each.message or message
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
