"""What differs between the catalog of systems and sensors and the sources of a release of Gazebo."""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from reports.who_reads_it.sensor_sources import SensorSource
from reports.who_reads_it.system_sources import Read, SystemSource
from twinform.passes.plugins.catalog import sensors, systems
from twinform.passes.plugins.catalog_types import Alternative, PluginKind, PluginParameter, SensorKind, TopicChannel
from twinform.passes.plugins.parameters import without_parentheses

# Names are compared wherever they stand in a plugin: the path of an element goes through variables in
# the C++. A difference needs a reason in known.toml, and a reason for what no release has any more is
# an error too.
_AS_READ = {"topic": "text", "joint": "text", "link": "text", "collision": "text"}
"""The kind of value that a type of the catalog is read as, where it has another name."""
_ZEROS = {"bool": {"false"}, "number": {"0"}, "integer": {"0"}, "vector": {"0 0 0"}}
"""What is read where an element lacks and no default is given."""
_PLACE = re.compile(r"\{[^{}]*\}")
_STRUCTURE = frozenset({"model", "world", "joint", "link", "sensor"})
"""Parts of topics that only give where in the simulation something is."""


@dataclass(frozen=True, slots=True, order=True)
class Difference:
    """One difference: `what` is the parameter, topic or message; `here` is the catalog, `there` the source."""

    owner: str
    kind: str
    what: str
    here: str = ""
    there: str = ""

    @property
    def key(self) -> str:
        """What explanations are found by."""
        return f"{self.owner} {self.kind} {self.what}"


def of_systems(sources: Mapping[str, SystemSource], release: str) -> Iterator[Difference]:
    """The differences of all systems in a release."""
    known = {kind.class_name.rpartition("::")[2]: kind for kind in systems().values() if release in kind.releases}
    shipped = {name: kind for name, kind in known.items() if is_of_sim(kind)}
    for name in sorted({*shipped} - {*sources}):
        yield Difference(shipped[name].name, "system", "not in the source")
    for name in sorted({*sources} - {*shipped}):
        yield Difference(name, "system", "not in the catalog")
    for name, kind in sorted(shipped.items()):
        if name in sources:
            yield from of_system(kind, sources[name], release)


def is_of_sim(kind: PluginKind) -> bool:
    """Whether a system comes with gz-sim; others come with ros2_control."""
    return kind.class_name.startswith("gz::sim::systems::")


def of_system(kind: PluginKind, source: SystemSource, release: str) -> Iterator[Difference]:
    """The differences of one system."""
    rows = list(_rows(kind.parameters, release))
    by_name = {row.name.lstrip("@"): row for row in rows}
    for name, read in sorted(source.parameters.items()):
        mine = [row for row in rows if row.matches(name) or row.matches(f"@{name}")]
        if mine:
            yield from _of_parameter(kind.name, name, mine, read)
        else:
            yield Difference(kind.name, "lacks", name, there=", ".join(sorted(read.kinds)))
    for name, row in by_name.items():
        if name not in source.parameters and "[" not in name:
            yield Difference(kind.name, "unread", name, here=row.type)
    in_defaults = {
        part for read in source.parameters.values() for default in read.defaults for part in default.split("/")
    }
    yield from _compared(kind.name, "topic", _topic_parts(kind, release), source.topics - _STRUCTURE - in_defaults)
    yield from _compared(kind.name, "message", _messages(kind, release), source.messages)


def _rows(rows: Iterable[PluginParameter], release: str) -> Iterator[PluginParameter]:
    for row in rows:
        if release in row.releases:
            yield row
            yield from _rows(row.children, release)


def _of_parameter(owner: str, name: str, rows: list[PluginParameter], read: Read) -> Iterator[Difference]:
    types = {_AS_READ.get(row.type, row.type) for row in rows}
    if read.kinds and not types & read.kinds and types != {"element"}:
        yield Difference(owner, "type", name, ", ".join(sorted(types)), ", ".join(sorted(read.kinds)))
    places = {"attribute" if row.is_attribute else "element" for row in rows}
    if read.places and not places & read.places:
        yield Difference(owner, "place", name, ", ".join(sorted(places)), ", ".join(sorted(read.places)))
    here = {_comparable_default(row.default) for row in rows if row.default is not None}
    there = {_comparable_default(default) for default in read.defaults}
    unsaid = {zero for type_ in types for zero in _ZEROS.get(type_, set[str]())}
    if here != there and not (not there and here <= unsaid):
        yield Difference(owner, "default", name, ", ".join(sorted(here)), ", ".join(sorted(there)))


def _comparable_default(value: str) -> str:
    """A default as it is compared: numbers to nine digits."""
    try:
        return " ".join(f"{float(part):.9g}" for part in value.split()) or value
    except ValueError:
        return value.strip()


def _topic_parts(kind: PluginKind, release: str) -> set[str]:
    patterns = list[str]()
    for channel in kind.channels:
        if release in channel.releases:
            patterns += [channel.pattern, *(each.pattern for each in _alternatives(kind, channel, release))]
    patterns += [each.suffix for each in sensors().values() if kind.name in each.systems and kind.name != "sensors"]
    return {
        part
        for pattern in patterns
        for part in _PLACE.sub("{}", without_parentheses(pattern)).split("/")
        if part and "{" not in part
    } - _STRUCTURE


def _alternatives(kind: PluginKind, channel: TopicChannel, release: str) -> Iterator[Alternative]:
    """Those whose parameters the release reads."""
    for each in channel.alternatives:
        rows = [kind.parameter(name) for name in each.parameters]
        if all(row is not None and release in row.releases for row in rows):
            yield each


def _messages(kind: PluginKind, release: str) -> set[str]:
    found = set[str]()
    for channel in kind.channels:
        if release in channel.releases:
            more = (each.message for each in _alternatives(kind, channel, release))
            found |= {channel.message, *(message for message in more if message)}
    return {message.rpartition(".")[2] for message in found}


def _compared(owner: str, kind: str, here: Iterable[str], there: Iterable[str]) -> Iterator[Difference]:
    mine, theirs = {*here}, {*there}
    for what in sorted(mine ^ theirs):
        yield Difference(owner, kind, what, what if what in mine else "", what if what in theirs else "")


def of_sensors(sources: Mapping[str, SensorSource], release: str) -> Iterator[Difference]:
    """The differences of all sensors in a release."""
    for type_, kind in sensors().items():
        if release in kind.releases and type_ in sources:
            yield from _of_sensor(kind, sources[type_], release)


def _of_sensor(kind: SensorKind, source: SensorSource, release: str) -> Iterator[Difference]:
    owner = f"sensor {kind.type}"
    if source.suffix is not None:
        yield from _compared(owner, "suffix", {kind.suffix}, {source.suffix})
    published = [each for each in kind.publishes if release in each.releases]
    ends = {without_parentheses(each.pattern).rpartition("}")[2].rpartition("/")[2] for each in published}
    yield from _compared(owner, "topic", ends - {""}, source.topics)
    messages = {part for each in published for part in (each.message, each.instead) if part}
    yield from _compared(owner, "message", {each.rpartition(".")[2] for each in messages}, source.messages)
