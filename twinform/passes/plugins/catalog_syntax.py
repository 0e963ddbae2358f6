"""Syntax of the plugin tables in the catalog.

    system wheel-slip  file=gz-sim-wheel-slip-system class=gz::sim::systems::WheelSlip scope=model
      wheel         +  element
        @link_name  1  link
      limit         ?  number   default=1 since=harmonic
      > topic  gz.msgs.Twist  /model/{model}/cmd_vel  alt=sub_topic:/model/{model}/{sub_topic}

A block begins with `system` (of gz-sim) or `plugin` (of Gazebo Classic) and the name; a row is the name of a parameter,
its count, its type, and options: `default=`, `unit=` (`rad|m` where it is for what turns and for what slides),
`enum=a|b`, `since=`, `until=` and `except=` releases, `needed=` releases `a|b` that do not work without, `any` for
content that is not known (in the first line: for more parameters). Rows that are indented further stand inside. `>`
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
from typing import Literal, NamedTuple, cast, get_args

from twinform.passes.plugins.catalog_types import (
    Alternative,
    Count,
    ParameterType,
    PluginKind,
    PluginParameter,
    Scope,
    Spelling,
    TopicChannel,
)

_DIRECTIONS = ("<", ">")


class _CatalogLine(NamedTuple):
    depth: int
    words: list[str]


def read_plugins(text: str, releases: Sequence[str]) -> Iterator[PluginKind]:
    """The plugins of a table; `releases` are the names of all releases, oldest first."""
    lines = [
        _CatalogLine((len(line) - len(line.lstrip())) // 2, _words(line)) for line in text.splitlines() if _words(line)
    ]
    starts = [index for index, line in enumerate(lines) if line.depth == 0]
    for start, end in zip(starts, [*starts[1:], len(lines)], strict=True):
        yield _plugin(lines[start].words, lines[start + 1 : end], releases)


def _words(line: str) -> list[str]:
    return [] if line.startswith("#") else shlex.split(line)


def _plugin(head: list[str], lines: list[_CatalogLine], releases: Sequence[str]) -> PluginKind:
    options = _options(head[2:])
    own = _span(options, releases)
    channels = tuple(_channel(line.words, own, releases) for line in lines if line.words[0] in _DIRECTIONS)
    checks = (["!", "-", "", *line.words[1:]] for line in lines if line.words[0] == "!")
    return PluginKind(
        name=head[1],
        file=options["file"],
        class_name=options["class"],
        scopes=cast("tuple[Scope, ...]", tuple(options["scope"].split("|"))),
        releases=own,
        parameters=_rows([line for line in lines if line.words[0] not in {"!", *_DIRECTIONS}], 1, own, releases),
        channels=channels,
        free="any" in head[2:],
        needs=tuple(options["needs"].split("|")) if "needs" in options else (),
        checks=tuple(_channel(words, own, releases) for words in checks),
    )


def _rows(
    lines: list[_CatalogLine], depth: int, above: frozenset[str], releases: Sequence[str]
) -> tuple[PluginParameter, ...]:
    """The rows at a depth, each with those further in that follow it."""
    starts = [index for index, line in enumerate(lines) if line.depth == depth]
    ends = [*starts[1:], len(lines)] if starts else []
    return tuple(
        _row(lines[start].words, lines[start + 1 : end], depth + 1, above, releases)
        for start, end in zip(starts, ends, strict=True)
    )


def _row(
    words: list[str], inside: list[_CatalogLine], depth: int, above: frozenset[str], releases: Sequence[str]
) -> PluginParameter:
    name, count, type_, *rest = words
    options = _options(rest)
    own = _span(options, releases) & above
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
        children=_rows(inside, depth, own, releases),
        unit=options.get("unit"),
        needed=own & frozenset(options.get("needed", "").split("|")),
    )


def _channel(words: list[str], above: frozenset[str], releases: Sequence[str]) -> TopicChannel:
    direction, parameter, message, pattern, *rest = words
    alternatives = [word.removeprefix("alt=").split(":") for word in rest if word.startswith("alt=")]
    options = _options(rest)
    return TopicChannel(
        direction=cast('Literal["<", ">", "!"]', direction),
        parameter=None if parameter == "-" else parameter,
        message=message,
        pattern=pattern,
        alternatives=tuple(_alternative(*each) for each in alternatives),
        unless=_conditions(options.get("unless")),
        when=_conditions(options.get("when")),
        each=tuple(options.get("each", "").split("/")) if "each" in options else (),
        releases=_span(options, releases) & above,
        spelling=next((each for each in get_args(Spelling) if each in rest), "valid"),
        stops="stops" in rest or direction == "!",
    )


def _conditions(text: str | None) -> tuple[tuple[str, ...], ...]:
    return tuple(tuple(each.split("+")) for each in text.split("|")) if text else ()


def _alternative(parameters: str, pattern: str, message: str | None = None) -> Alternative:
    return Alternative(tuple(parameters.split("+")), pattern, message)


def _options(words: Sequence[str]) -> dict[str, str]:
    return dict(word.split("=", 1) for word in words if "=" in word)


def _span(options: Mapping[str, str], releases: Sequence[str]) -> frozenset[str]:
    """The releases from the first to the last that are named, without the exceptions."""
    first = options.get("since", releases[0])
    last = options.get("until", releases[-1])
    span = releases[releases.index(first) : releases.index(last) + 1]
    return frozenset(span) - frozenset(options.get("except", "").split("|"))
