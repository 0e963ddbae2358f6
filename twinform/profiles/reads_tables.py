"""The tables in `data/reads/`: what each consumer reads of a URDF, in each of its releases.

A line of a table has five columns with two blanks or more between them: a place, an item, a form, an effect, and what
the consumer does then. A place is a path below the root; `*` stands for all elements of a name, without it the first
one counts; `[revolute,prismatic]` are values of `type`, `[!fixed]` are values that it does not have; `^` is an element
only if it is the first. Items are `@attribute`, `<element>`, `#text`, or the name of a fact in `tree_facts.py`. `!`
after a form means that the item has to be there, ` => ` is followed by the passes that help, and ` # ` by the source
that a line was read in, where no release of the consumer was asked.

A line may begin with one more column that says when it holds: `@SINCE..UNTIL` in these releases, by any of their names,
`urdf=SINCE..UNTIL` for files of these versions. One of the two may be left out; without `..` it is this one alone.

Other lines have a word first: `parser NAME` is the XML parser, `skips NAME` the attribute by which the consumer skips
an element, `like CONSUMER@RELEASE` the table that this one adds to, and `without ITEM  EFFECT` leaves out what that
says of an item.
"""

import re
from functools import cache
from typing import NamedTuple

from twinform.dataclass import dataclass
from twinform.ir.versions import Version, parse_version
from twinform.lazy import lazy_pattern
from twinform.package_files import package_files
from twinform.profiles.profile import load, release_of, releases_of
from twinform.profiles.releases import Release, is_between

_COLUMNS = lazy_pattern(r"\s{2,}")
_STEP = lazy_pattern(r"(?P<first>\^?)(?P<tag>[\w:.-]+)(?P<every>\*?)(?:\[(?P<other>!?)(?P<types>[^\]]*)\])?")


class Span(NamedTuple):
    """The first and the last of something; an empty text is no bound."""

    since: str = ""
    until: str = ""


_ALWAYS = Span()


@dataclass(frozen=True, slots=True)
class PlaceStep:
    """One element on the path to a place."""

    tag: str
    every: bool
    first: bool
    types: frozenset[str]
    other: bool


@dataclass(frozen=True, slots=True)
class Demand:
    """What a consumer reads at a place; `needed` says whether it must be there.

    It holds for files of the `versions`. `source` is where it was read, empty where the consumer was asked.
    """

    place: tuple[PlaceStep, ...]
    item: str
    form: str
    needed: bool
    effect: str
    about: str
    pipeline: str
    source: str = ""
    versions: Span = _ALWAYS

    def is_about(self, version: Version) -> bool:
        """Whether the demand holds for files of a version of URDF."""
        since, until = self.versions
        return (not since or parse_version(since) <= version) and (not until or version <= parse_version(until))


@dataclass(frozen=True, slots=True)
class Reads:
    """What a consumer reads: its XML parser, and its demands."""

    parser: str
    demands: tuple[Demand, ...]
    skips: str = ""
    """The attribute that, where it is `true`, makes the consumer skip a link or a joint."""


@cache
def reads(consumer: str) -> Reads:
    """The table of a consumer, perhaps with a release after `@`, with the tables that it is based on."""
    name, _, called = consumer.partition("@")
    known, release = releases_of(name), release_of(name, called).name
    parser, skips, demands = "", "", list[Demand]()
    for releases, versions, columns in _table_lines(name):
        if not is_between(known, release, *releases):
            continue
        if columns[0] == "parser":
            parser = columns[1]
        elif columns[0] == "skips":
            skips = columns[1]
        elif columns[0] == "like":
            base = reads(columns[1])
            parser, demands = parser or base.parser, [*base.demands, *demands]
        elif columns[0] == "without":
            demands = _without(demands, *columns[1:])
        else:
            demands.append(_parse_demand(columns, versions))
    return Reads(parser, tuple(demands), skips)


def demands_by_release(name: str) -> dict[Demand, tuple[Release, ...]]:
    """Every demand of a consumer, with the releases that have it, in the order of the table."""
    found: dict[Demand, list[Release]] = {}
    for profile in (load(f"{name}@{release.name}")[0] for release in releases_of(name)):
        for demand in reads(profile.reads).demands if profile.reads else ():
            found.setdefault(demand, []).append(profile.release)
    return {demand: tuple(releases) for demand, releases in found.items()}


def _without(demands: list[Demand], item: str = "", effect: str = "") -> list[Demand]:
    """The demands but for those that say this of the item.

    Raises:
        ValueError: none does.
    """
    kept = [each for each in demands if (each.item, each.effect) != (item, effect)]
    if len(kept) == len(demands):
        raise ValueError(f"there is nothing about {item!r} with the effect {effect!r} to leave out")
    return kept


@cache
def _table_lines(name: str) -> tuple[tuple[Span, Span, list[str]], ...]:
    """The lines of a table: the releases and the versions of URDF that each is about, and its columns."""
    text = package_files("twinform.profiles").joinpath("data", "reads", f"{name}.reads").read_text(encoding="utf-8")
    return tuple(_split_line(line) for line in map(str.strip, text.splitlines()) if line and not line.startswith("#"))


def _split_line(line: str) -> tuple[Span, Span, list[str]]:
    releases, versions = _ALWAYS, _ALWAYS
    if line.startswith(("@", "urdf=")):
        conditions, line = _COLUMNS.split(line, maxsplit=1)
        for each in conditions.split():
            if each.startswith("@"):
                releases = _parse_span(each[1:])
            else:
                versions = _parse_span(each.removeprefix("urdf="))
    return releases, versions, _COLUMNS.split(line, maxsplit=4)


def _parse_span(text: str) -> Span:
    since, dots, until = text.partition("..")
    return Span(since, until if dots else since)


def _parse_demand(columns: list[str], versions: Span) -> Demand:
    place, item, form, effect, words = columns
    words, _, source = words.partition(" # ")
    about, _, pipeline = words.partition(" => ")
    said = (effect, about.strip(), pipeline.strip(), source.strip())
    return Demand(_parse_place(place), item, form.removesuffix("!"), form.endswith("!"), *said, versions)


def _parse_place(place: str) -> tuple[PlaceStep, ...]:
    if place == "robot":
        return ()
    found = [_STEP.fullmatch(part) for part in place.split("/")]
    if None in found:
        raise ValueError(f"{place!r} is no place")
    return tuple(_parse_step(each) for each in found if each)


def _parse_step(found: re.Match[str]) -> PlaceStep:
    types = frozenset(found["types"].split(",")) if found["types"] is not None else frozenset[str]()
    return PlaceStep(found["tag"], bool(found["every"]), bool(found["first"]), types, bool(found["other"]))
