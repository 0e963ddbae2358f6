"""Data types of the catalog: plugins, sensors and releases."""

from collections.abc import Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Literal

Count = Literal["1", "?", "*", "+"]
"""How often a parameter stands: once, at most once, any number of times, at least once."""

ParameterType = Literal[
    "number", "integer", "bool", "text", "joint", "link", "collision", "topic", "vector", "numbers", "pose", "color",
    "element",
]  # fmt: skip

Parameters = tuple[str, ...]
"""The names of parameters."""

Spelling = Literal["valid", "if-any", "or-default", "exact", "raw"]
"""What a plugin does with text that gz-transport refuses: it makes a valid topic of it; it makes one, and takes the
default for a parameter without text; it makes one, and takes the default where nothing is left of a parameter; it takes
the default at once; it has no topic."""

Scope = Literal["world", "model", "link", "joint", "sensor", "visual", "actor", "gui"]
"""What a plugin stands in."""


@dataclass(frozen=True, slots=True)
class Release:
    """A release of Gazebo. `frame_element` names the frame of a sensor there; None where nothing is known to."""

    name: str
    sim: int
    sdf: str
    ros: tuple[str, ...]
    lts: bool
    frame_element: str | None


@dataclass(frozen=True, slots=True)
class PluginParameter:
    """An element or attribute that a plugin reads. Names such as `[xyz][UVW]` stand for all that match them.

    `free` means that what stands inside is not known. `releases` are those whose plugin reads it, `needed` those that
    do not work without, where only some do not. `unit` is that of its numbers, or two of them where it
    is for what turns and for what slides.
    """

    name: str
    count: Count
    type: ParameterType
    default: str | None
    choices: tuple[str, ...]
    free: bool
    releases: frozenset[str]
    is_attribute: bool
    children: tuple["PluginParameter", ...]
    unit: str | None = None
    needed: frozenset[str] = frozenset()

    @property
    def is_required(self) -> bool:
        """Whether the plugin does not work without."""
        return self.count in {"1", "+"}

    def is_required_in(self, release: str) -> bool:
        """Whether the plugin of a release does not work without."""
        return self.is_required or release in self.needed

    @property
    def is_many(self) -> bool:
        """Whether it may stand several times."""
        return self.count in {"*", "+"}

    def matches(self, name: str) -> bool:
        """Whether this is the parameter of a name."""
        return self.name == name or ("[" in self.name and fnmatchcase(name, self.name))


@dataclass(frozen=True, slots=True)
class Alternative:
    """Another topic or message where all of some parameters are written and not false; an empty pattern keeps it."""

    parameters: Parameters
    pattern: str
    message: str | None


@dataclass(frozen=True, slots=True)
class TopicChannel:
    """A topic of gz-transport that a plugin reads (`>`) or writes (`<`), or a text that it only checks (`!`).

    `parameter` sets it; else it follows the pattern, in which `{model}`, `{world}` and names of parameters stand for
    their values. `{scope}` is the topic of the world and the models around the plugin, `{models}` the same without the
    world, `{loaded}` what a plugin sees of that when it is loaded, and `{loaded_part}` that around a part of its model.
    The last alternative that applies wins. The topic is not there where one of the conditions `unless` holds, nor where
    there are conditions `when` and none holds; each of them names parameters that are all written and not false.
    With `each`, the path of a parameter that repeats, there is one topic for each of its values, which `{each}` stands
    for. `spelling` is what becomes of text that is no valid topic. A plugin that `stops` where it gets no valid topic
    has none of those behind it.
    """

    direction: Literal["<", ">", "!"]
    parameter: str | None
    message: str
    pattern: str
    alternatives: tuple[Alternative, ...]
    unless: tuple[Parameters, ...]
    when: tuple[Parameters, ...]
    each: tuple[str, ...]
    releases: frozenset[str]
    spelling: Spelling = "valid"
    stops: bool = False


@dataclass(frozen=True, slots=True)
class PluginKind:
    """A plugin: a system of gz-sim, or a plugin of Gazebo Classic for ROS.

    `file` is as gz-sim finds it: without path, and for systems without `lib` and `.so`. `class_name` is the word that
    `<plugin name=...>` has to have in gz-sim; in Gazebo Classic that name is free. `free` means that it takes
    parameters besides these. `needs` are systems of which the world has to have one. `checks` are texts of which it
    makes valid topics first, and has no topic at all where it cannot; they are no topics themselves.
    """

    name: str
    file: str
    class_name: str
    scopes: tuple[Scope, ...]
    releases: frozenset[str]
    parameters: tuple[PluginParameter, ...]
    channels: tuple[TopicChannel, ...]
    free: bool
    needs: tuple[str, ...] = ()
    checks: tuple[TopicChannel, ...] = ()

    def parameter(self, *path: str) -> PluginParameter | None:
        """The parameter at a path of names, such as `left_track`, `link`; attributes begin with `@`."""
        rows, found = self.parameters, None
        for name in path:
            found = next((row for row in rows if row.matches(name)), None)
            if found is None:
                return None
            rows = found.children
        return found

    def walk(self) -> Iterator[tuple[tuple[str, ...], PluginParameter]]:
        """Every parameter with its path, from the outside in."""
        yield from _walk((), self.parameters)


def _walk(
    above: tuple[str, ...], rows: tuple[PluginParameter, ...]
) -> Iterator[tuple[tuple[str, ...], PluginParameter]]:
    for row in rows:
        path = (*above, row.name)
        yield path, row
        yield from _walk(path, row.children)


@dataclass(frozen=True, slots=True)
class Published:
    """A topic of a sensor: a pattern of `{topic}` or `{beside}`, and the message.

    `where` is a setting that has the message `instead`, such as `camera/box_type=3d`. `releases` are those that publish
    it.
    """

    pattern: str
    message: str
    where: str
    instead: str
    releases: frozenset[str]


@dataclass(frozen=True, slots=True)
class SensorKind:
    """A kind of sensor that gz-sim simulates.

    `aliases` are older names for `type` that are still read, `classic` the names in Gazebo Classic for what becomes
    this. `element` has its parameters. `systems` are what the world needs to have, `world_elements` what else.
    `suffix` ends the topic where none is written. `custom` is the `gz:type` of those whose type is `custom`, or what it
    begins with where that ends in a slash. `triggered` are the releases in which it can wait for a message.
    """

    type: str
    aliases: tuple[str, ...]
    classic: tuple[str, ...]
    element: str
    systems: tuple[str, ...]
    world_elements: tuple[str, ...]
    holders: tuple[Literal["link", "joint"], ...]
    suffix: str
    releases: frozenset[str]
    publishes: tuple[Published, ...]
    custom: str | None = None
    triggered: frozenset[str] = frozenset()
