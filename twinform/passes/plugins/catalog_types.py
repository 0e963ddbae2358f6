"""Plugins, sensors and releases of the catalog, and the syntax of its plugin tables.

    system wheel-slip  file=gz-sim-wheel-slip-system class=gz::sim::systems::WheelSlip scope=model
      wheel         +  element
        @link_name  1  link
      limit         ?  number   default=1 since=harmonic
      > topic  gz.msgs.Twist  /model/{model}/cmd_vel  alt=sub_topic:/model/{model}/{sub_topic}

A block begins with `system` (of gz-sim) or `plugin` (of Gazebo Classic) and the name; a row is the name of a parameter,
its count, its type, and options: `default=`, `unit=` (`rad|m` where it is for what turns and for what slides),
`enum=a|b`, `since=`, `until=` and `except=` releases, `needed=` releases `a|b` that do not work without, `beside=`
the flag with which it has to be written, `any` for content that is not known (in the first line: for more parameters).
Rows that are indented further stand inside. `>`
and `<` are topics that the plugin reads and writes: the parameter that sets it or `-`, the message, the default;
`alt=PARAMETER[+PARAMETER]:TOPIC[:MESSAGE]` where these are written, `unless=` and `when=` with such
`PARAMETER[+PARAMETER]`, separated by `|`, `each=PATH/OF/PARAMETER` for one topic a value, the spelling (`or-default`,
`if-any`, `exact` or `raw`, see `Spelling`), the releases, and `stops` if there are no further topics without this one.
In a topic, `{...}` is a value, and what stands in `(...)` alone becomes a valid topic, or nothing; of `(...|...)` the
first that can. `! TOPIC` is a text of which the plugin makes a valid topic before all, and stops where it cannot; its
options are the same. Values with blanks stand in double quotes, and `#` begins a comment.
`needs=a|b` in the first line are systems of which the world has to have one.
"""

import shlex
from collections.abc import Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from typing import Literal, NamedTuple, cast, get_args

from twinform.dataclass import dataclass

Count = Literal["1", "?", "*", "+"]
"""How often a parameter stands: once, at most once, any number of times, at least once."""
ParameterType = Literal[
    "number", "integer", "bool", "text", "joint", "link", "collision", "topic", "vector", "numbers", "pose", "color",
    "element",
]  # fmt: skip
Parameters = tuple[str, ...]
"""The names of parameters."""
Scope = Literal["world", "model", "link", "joint", "sensor", "visual", "actor", "gui"]
"""What a plugin stands in."""
_DIRECTIONS = ("<", ">")
Spelling = Literal["valid", "if-any", "or-default", "exact", "raw"]
"""What a plugin does with a text that gz-transport refuses: it makes a valid topic of it; it makes one, and takes the
default for a parameter without text; it makes one, and takes the default where nothing is left of a parameter; it takes
the default at once; it has no topic."""


@dataclass(frozen=True, slots=True)
class Release:
    """A release of Gazebo. `frame_element` is the element for the frame of a sensor; None if none is known."""

    name: str
    sim: int
    sdf: str
    ros: tuple[str, ...]
    lts: bool
    frame_element: str | None


@dataclass(frozen=True, slots=True)
class PluginParameter:
    """An element or attribute that a plugin reads. Names such as `[xyz][UVW]` stand for all names that match them.

    `free` means that any content is allowed. `releases` are those whose plugin reads it, `needed` those that do not
    work without it if only some do not. `beside` is the flag with which it has to be written. `unit` is the unit of its
    numbers, or two units if it is for revolute and for prismatic joints.
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
    beside: str | None = None

    @property
    def is_required(self) -> bool:
        """Whether the plugin does not work without the parameter."""
        return self.count in {"1", "+"}

    def is_required_in(self, release: str) -> bool:
        """Whether the plugin of a release does not work without the parameter."""
        return self.is_required or release in self.needed

    @property
    def is_many(self) -> bool:
        """Whether the parameter may stand several times."""
        return self.count in {"*", "+"}

    def matches(self, name: str) -> bool:
        """Whether this is the parameter with a name."""
        return self.name == name or ("[" in self.name and fnmatchcase(name, self.name))


@dataclass(frozen=True, slots=True)
class Alternative:
    """Another topic or message if all these parameters are written and not false; an empty pattern keeps the topic."""

    parameters: Parameters
    pattern: str
    message: str | None = None


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
        """The parameter at a path of names, such as `left_track`, `link`; names of attributes begin with `@`."""
        rows, found = self.parameters, None
        for name in path:
            found = next((row for row in rows if row.matches(name)), None)
            if found is None:
                return None
            rows = found.children
        return found

    def walk(self) -> Iterator[tuple[tuple[str, ...], PluginParameter]]:
        """Every parameter with its path, outer ones first."""
        yield from _walk_parameters((), self.parameters)


def _walk_parameters(
    above: tuple[str, ...], rows: tuple[PluginParameter, ...]
) -> Iterator[tuple[tuple[str, ...], PluginParameter]]:
    for row in rows:
        path = (*above, row.name)
        yield path, row
        yield from _walk_parameters(path, row.children)


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


class _CatalogLine(NamedTuple):
    depth: int
    words: list[str]


def read_plugins(text: str, releases: Sequence[str]) -> Iterator[PluginKind]:
    """Read the plugins of a table; `releases` are the names of all releases, oldest first."""
    lines = [
        _CatalogLine((len(line) - len(line.lstrip())) // 2, _split_line(line))
        for line in text.splitlines()
        if _split_line(line)
    ]
    starts = [index for index, line in enumerate(lines) if line.depth == 0]
    for start, end in zip(starts, [*starts[1:], len(lines)], strict=True):
        yield _read_plugin(lines[start].words, lines[start + 1 : end], releases)


def _split_line(line: str) -> list[str]:
    return [] if line.startswith("#") else shlex.split(line)


def _read_plugin(head: list[str], lines: list[_CatalogLine], releases: Sequence[str]) -> PluginKind:
    options = _read_options(head[2:])
    own = _releases_between(options, releases)
    channels = tuple(_read_channel(line.words, own, releases) for line in lines if line.words[0] in _DIRECTIONS)
    checks = (["!", "-", "", *line.words[1:]] for line in lines if line.words[0] == "!")
    return PluginKind(
        name=head[1],
        file=options["file"],
        class_name=options["class"],
        scopes=cast("tuple[Scope, ...]", tuple(options["scope"].split("|"))),
        releases=own,
        parameters=_read_parameters(
            [line for line in lines if line.words[0] not in {"!", *_DIRECTIONS}], 1, own, releases
        ),
        channels=channels,
        free="any" in head[2:],
        needs=tuple(options["needs"].split("|")) if "needs" in options else (),
        checks=tuple(_read_channel(words, own, releases) for words in checks),
    )


def _read_parameters(
    lines: list[_CatalogLine], depth: int, above: frozenset[str], releases: Sequence[str]
) -> tuple[PluginParameter, ...]:
    """The parameters in rows of a depth, each with those in the deeper rows that follow it."""
    starts = [index for index, line in enumerate(lines) if line.depth == depth]
    ends = [*starts[1:], len(lines)] if starts else []
    return tuple(
        _read_parameter(lines[start].words, lines[start + 1 : end], depth + 1, above, releases)
        for start, end in zip(starts, ends, strict=True)
    )


def _read_parameter(
    words: list[str], inside: list[_CatalogLine], depth: int, above: frozenset[str], releases: Sequence[str]
) -> PluginParameter:
    name, count, type_, *rest = words
    options = _read_options(rest)
    own = _releases_between(options, releases) & above
    choices = options.get("enum")
    return PluginParameter(
        name=name,
        count=cast("Count", count),
        type=cast("ParameterType", type_),
        default=options.get("default"),
        choices=tuple(choices.split("|")) if choices else (),
        free="any" in rest,
        releases=own,
        is_attribute=name.startswith("@"),
        children=_read_parameters(inside, depth, own, releases),
        unit=options.get("unit"),
        needed=own & frozenset(options.get("needed", "").split("|")),
        beside=options.get("beside"),
    )


def _read_channel(words: list[str], above: frozenset[str], releases: Sequence[str]) -> TopicChannel:
    direction, parameter, message, pattern, *rest = words
    alternatives = [word.removeprefix("alt=").split(":") for word in rest if word.startswith("alt=")]
    options = _read_options(rest)
    return TopicChannel(
        direction=cast('Literal["<", ">", "!"]', direction),
        parameter=None if parameter == "-" else parameter,
        message=message,
        pattern=pattern,
        alternatives=tuple(Alternative(tuple(each[0].split("+")), *each[1:]) for each in alternatives),
        unless=_split_conditions(options.get("unless")),
        when=_split_conditions(options.get("when")),
        each=tuple(options.get("each", "").split("/")) if "each" in options else (),
        releases=_releases_between(options, releases) & above,
        spelling=next((each for each in get_args(Spelling) if each in rest), "valid"),
        stops="stops" in rest or direction == "!",
    )


def _split_conditions(text: str | None) -> tuple[tuple[str, ...], ...]:
    return tuple(tuple(each.split("+")) for each in text.split("|")) if text else ()


def _read_options(words: Sequence[str]) -> dict[str, str]:
    return dict(word.split("=", 1) for word in words if "=" in word)


def _releases_between(options: Mapping[str, str], releases: Sequence[str]) -> frozenset[str]:
    """The releases from `since` to `until`, without those of `except`."""
    first = options.get("since", releases[0])
    last = options.get("until", releases[-1])
    span = releases[releases.index(first) : releases.index(last) + 1]
    return frozenset(span) - frozenset(options.get("except", "").split("|"))
