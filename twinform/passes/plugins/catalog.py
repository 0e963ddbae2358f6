"""The catalog of gz-sim systems, sensors, releases and of Gazebo Classic's plugins for ROS.

The facts are package data in `data/`, read when they are first asked for. They were taken from the sources of gz-sim 6
to 10 and its main branch, of gazebo_ros_pkgs, gz_ros2_control and ros_gz_bridge.
"""

import tomllib
from collections import defaultdict
from collections.abc import Iterable, Iterator
from difflib import get_close_matches
from functools import cache
from importlib import resources
from importlib.resources.abc import Traversable
from typing import Any, Literal

from twinform.ir import Plugin
from twinform.lazy import lazy_pattern
from twinform.passes.plugins.catalog_types import PluginKind, Published, Release, SensorKind, read_plugins

__all__ = [
    "DEFAULT_SYSTEMS",
    "LATEST",
    "UnknownNameError",
    "classic_plugins",
    "classic_plugins_of_file",
    "custom_sensor",
    "is_ignition_name",
    "known_files",
    "modern_class",
    "modern_file",
    "nearest",
    "release",
    "releases",
    "ros2_kind",
    "ros_message",
    "sensor",
    "sensors",
    "suggestion",
    "system",
    "system_of_class",
    "systems",
    "systems_of_file",
]

LATEST = "main"
"""The development branch after the last release."""

DEFAULT_SYSTEMS = ("physics", "user-commands", "scene-broadcaster")
"""The systems that gz-sim adds to a world without any plugin, and to no other world."""

# Beyond this many names none is suggested: a comparison takes 10 us, and a hostile file has many of
# both.
_MOST_NAMES = 2000

Family = Literal["noetic", "ros2"]

_SYSTEM_FILE = lazy_pattern(r"(?:lib)?(?:ignition-gazebo|gz-sim)\d*-(.+?)(?:\.so|\.dylib|\.dll)?")
_FILE = lazy_pattern(r"(?:lib)?(.+?)(?:\.so|\.dylib|\.dll)?")
_IGNITION_CLASS = lazy_pattern(r"^(?:::)?(?:ignition::gazebo|gz::sim)(?:::v\d+)?::")
_BLOCK_START = lazy_pattern(r"\n(?=[a-z])")
_IN_FILE = lazy_pattern(r" file=(\S+)")


class UnknownNameError(LookupError):
    """The catalog has nothing of this name; the message suggests a similar one."""

    def __init__(self, what: str, name: str, known: Iterable[str]) -> None:
        listed = list(known)
        hint = suggestion(name, listed, f"there are {', '.join(listed)}")
        super().__init__(f"there is no {what} {name}; {hint}")


def suggestion(name: str, known: Iterable[str], otherwise: str | None = None) -> str | None:
    """The text `did you mean NAME?` with the most similar name, or another text if none is similar."""
    near = nearest(name, known)
    return f"did you mean {near.lstrip('@')}?" if near else otherwise


def nearest(name: str, known: Iterable[str]) -> str | None:
    """The most similar name; None if none is similar, or if there are too many to compare."""
    listed = list(known)
    if len(listed) > _MOST_NAMES:
        return None
    near = get_close_matches(name, listed, n=1)
    if near:
        return near[0]
    # A second try without case and dashes: difflib compares characters as they are, and DiffDrive
    # is far from diff-drive for it.
    folded = {each.lower().replace("-", "_"): each for each in listed}
    near = get_close_matches(name.lower().replace("-", "_"), folded, n=1)
    return folded[near[0]] if near else None


@cache
def releases() -> dict[str, Release]:
    """The releases by name, oldest first."""
    return {name: _make_release(name, row) for name, row in _read_toml("releases.toml").items()}


def release(name: str) -> Release:
    """A release.

    Raises:
        UnknownNameError: there is none of this name.
    """
    try:
        return releases()[name]
    except KeyError:
        raise UnknownNameError("release of Gazebo", name, list(releases())) from None


# The tables are from the sources, since comments and tutorials of gz-sim are wrong too often. `make
# report NAME=systems` holds them against checkouts.
@cache
def systems() -> dict[str, PluginKind]:
    """The systems of gz-sim by their names in the catalog, such as `diff-drive`."""
    return {each.name: each for each in _read_tables("systems")}


def system(name: str) -> PluginKind:
    """A system by its name in the catalog; underscores work as well.

    Raises:
        UnknownNameError: there is none of this name.
    """
    try:
        return systems()[name.replace("_", "-")]
    except KeyError:
        raise UnknownNameError("system", name, list(systems())) from None


def systems_of_file(file: str) -> tuple[PluginKind, ...]:
    """The systems in a file, in any spelling of its name; one file may contain several."""
    return _kinds_of_file("systems", modern_file(file))


def system_of_class(name: str) -> PluginKind | None:
    """The system with a class, by its current name or that of Ignition; None if there is none."""
    return _systems_by_class().get(modern_class(name))


def modern_file(file: str) -> str:
    """The current name of the file of a system: `gz-sim-imu-system` for `libignition-gazebo6-imu-system.so`."""
    name = file.rsplit("/", 1)[-1].strip()
    found = _SYSTEM_FILE.fullmatch(name)
    if found:
        return f"gz-sim-{found[1]}"
    plain = _FILE.fullmatch(name)
    return plain[1] if plain else name


def modern_class(name: str) -> str:
    """The current name of the class of a system."""
    return _IGNITION_CLASS.sub("gz::sim::", name.strip())


def is_ignition_name(name: str) -> bool:
    """Whether a file or class has a name from the time when Gazebo was called Ignition."""
    return "ignition-gazebo" in name or "ignition::gazebo" in name


@cache
def classic_plugins(family: Family) -> dict[str, PluginKind]:
    """The plugins of Gazebo Classic for ROS 1 or 2, by the names of their files without `gazebo_ros_`."""
    kinds = read_plugins(_data("classic", f"{family}.facts").read_text(encoding="utf-8"), _all_releases())
    return {each.name: each for each in kinds}


def classic_plugins_of_file(file: str) -> dict[Family, PluginKind]:
    """The plugins in a file of Gazebo Classic, by the ROS that they are for: both have files of one name."""
    wanted = modern_file(file)
    families: tuple[Family, ...] = ("noetic", "ros2")
    return {each: kinds[-1] for each in families if (kinds := _kinds_of_file(f"classic/{each}.facts", wanted))}


def known_files() -> list[str]:
    """The current names of the files of all systems and of all plugins of Gazebo Classic."""
    tables = ("systems", "classic/noetic.facts", "classic/ros2.facts")
    return [file for table in tables for file in _blocks_by_file(table)]


@cache
def sensors() -> dict[str, SensorKind]:
    """The kinds of sensors by their type in SDF."""
    return {type_: _make_sensor_kind(type_, row) for type_, row in _read_toml("sensors.toml").items()}


def sensor(type_: str) -> SensorKind:
    """A kind of sensor by its type or an older name.

    Raises:
        UnknownNameError: gz-sim simulates none of this type.
    """
    kinds = sensors()
    word = type_.replace("-", "_")
    found = kinds.get(word) or next((kind for kind in kinds.values() if word in kind.aliases), None)
    # Custom sensors are found by their `gz:type`; their key in the table is no type of SDF.
    if found is None or found.custom is not None:
        raise UnknownNameError("sensor", type_, list(kinds))
    return found


def custom_sensor(word: str) -> SensorKind | None:
    """The kind of a sensor of type `custom` by its `gz:type`."""
    for kind in sensors().values():
        own = kind.custom
        if own is not None and (word.startswith(own) if own.endswith("/") else word == own):
            return kind
    return None


def ros_message(message: str) -> str | None:
    """The type of ROS 2 for a message of Gazebo; None if the bridge knows none."""
    found = _read_toml("messages.toml").get(message)
    return str(found) if found is not None else None


# `check` asks for the few plugins of a robot: to read all tables takes ten times as long as its check.
@cache
def _kinds_of_file(table: str, file: str) -> tuple[PluginKind, ...]:
    """Read the plugins in a file from one of the tables, and no others."""
    blocks = _blocks_by_file(table).get(file)
    return tuple(read_plugins("\n".join(blocks), _all_releases())) if blocks else ()


@cache
def _blocks_by_file(table: str) -> dict[str, list[str]]:
    """The texts of the plugins in a table, or in all tables of a folder, by the files that the plugins are in."""
    found = defaultdict[str, list[str]](list)
    for text in _texts_of(table):
        for block in _BLOCK_START.split(text):
            if own := _IN_FILE.search(block.partition("\n")[0]):
                found[modern_file(own[1])].append(block)
    return dict(found)


def _texts_of(table: str) -> list[str]:
    place = _data(*table.split("/"))
    files = [place] if place.is_file() else sorted(place.iterdir(), key=lambda each: each.name)
    return [each.read_text(encoding="utf-8") for each in files if each.name.endswith(".facts")]


@cache
def _systems_by_class() -> dict[str, PluginKind]:
    return {each.class_name: each for each in systems().values()}


@cache
def _all_releases() -> tuple[str, ...]:
    return (*releases(), LATEST)


def _read_tables(folder: str) -> Iterator[PluginKind]:
    for text in _texts_of(folder):
        yield from read_plugins(text, _all_releases())


@cache
def _read_toml(name: str) -> dict[str, Any]:
    return tomllib.loads(_data(name).read_text(encoding="utf-8"))


def _data(*path: str) -> Traversable:
    return resources.files("twinform.passes.plugins").joinpath("data", *path)


def ros2_kind(plugin: Plugin) -> PluginKind | None:
    """The kind of a plugin for ROS 2; None if it is, or may be, for ROS 1.

    A plugin is for ROS 2 if it has `<ros>`, or if its file or its parameters only exist there.
    """
    kinds = classic_plugins_of_file(plugin.filename or "")
    if "ros2" not in kinds:
        return None
    written = {child.name for child in plugin.content}
    new = {row.name for row in kinds["ros2"].parameters}
    old = {row.name for row in kinds["noetic"].parameters} if "noetic" in kinds else set[str]()
    # Files of gazebo_ros_pkgs have one name for ROS 1 and ROS 2, and many robots keep parameters of
    # both in one plugin. A mixture counts as ROS 1 unless <ros> says otherwise: nothing that was
    # read then gets lost.
    # <ros> holds the settings of a node, which only plugins for ROS 2 have.
    is_new = "ros" in written or not old or (bool(written & new - old) and not written & old - new)
    return kinds["ros2"] if is_new else None


def _make_release(name: str, row: dict[str, Any]) -> Release:
    return Release(name, row["sim"], row["sdf"], tuple(row["ros"]), row["lts"], row.get("frame"))


def _make_sensor_kind(type_: str, row: dict[str, Any]) -> SensorKind:
    everything = _all_releases()
    return SensorKind(
        type=type_,
        aliases=tuple(row.get("aliases", ())),
        classic=tuple(row.get("classic", ())),
        element=row["element"],
        systems=tuple(row["systems"]),
        world_elements=tuple(row.get("world", ())),
        holders=tuple(row.get("holder", ("link",))),
        suffix=row["suffix"],
        releases=frozenset(everything[everything.index(row.get("since", everything[0])) :]),
        publishes=tuple(_make_published(*each, everything=everything) for each in row["publishes"]),
        custom=row.get("custom"),
        triggered=frozenset(row.get("triggered", ())),
    )


def _make_published(pattern: str, message: str, *options: str, everything: tuple[str, ...]) -> Published:
    """A topic of a sensor. Options are `since=RELEASE`, `until=RELEASE`, and a setting followed by its message."""
    spans = dict(each.split("=") for each in options if each.startswith(("since=", "until=")))
    first, last = spans.get("since", everything[0]), spans.get("until", everything[-1])
    where, instead = [*(each for each in options if not each.startswith(("since=", "until="))), "", ""][:2]
    span = frozenset(everything[everything.index(first) : everything.index(last) + 1])
    return Published(pattern, message, where, instead, span)
