"""The tables in `data/reads/`: what a consumer reads where, in which form, and what it does otherwise.

A line has five columns with two blanks or more between them: a place, an item, a form, an effect, and what the
consumer does then. A place is a path below the root; `*` stands for all elements of a name, without it the first one
counts; `[revolute,prismatic]` are values of `type`, `[!fixed]` are values that it does not have; `^` is an element only
if it is the first. Items are `@attribute`, `<element>`, `#text`, or the name of a fact in `tree_facts.py`. `!` after a
form means that the item has to be there, and ` => ` is followed by the passes that help.
"""

import re
from collections.abc import Iterator
from functools import cache
from importlib.resources import files

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern

_COLUMNS = lazy_pattern(r"\s{2,}")
_STEP = lazy_pattern(r"(?P<first>\^?)(?P<tag>[\w:.-]+)(?P<every>\*?)(?:\[(?P<other>!?)(?P<types>[^\]]*)\])?")


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
    """What a consumer reads at a place; `needed` says whether it must be there."""

    place: tuple[PlaceStep, ...]
    item: str
    form: str
    needed: bool
    effect: str
    about: str
    pipeline: str


@dataclass(frozen=True, slots=True)
class Reads:
    """What a consumer reads: its XML parser, and its demands."""

    parser: str
    demands: tuple[Demand, ...]
    skips: str = ""
    """The attribute that, where it is `true`, makes the consumer skip a link or a joint."""


@cache
def reads(name: str) -> Reads:
    """The table of a consumer, with the tables that it is based on."""
    parser, skips, demands = "", "", list[Demand]()
    for line in _table_lines(name):
        columns = _COLUMNS.split(line, maxsplit=4)
        if columns[0] == "parser":
            parser = columns[1]
        elif columns[0] == "skips":
            skips = columns[1]
        elif columns[0] == "like":
            base = reads(columns[1])
            parser, demands = parser or base.parser, [*base.demands, *demands]
        elif columns[0] == "without":
            demands = [each for each in demands if each.item != columns[1]]
        else:
            demands.append(_parse_demand(columns))
    return Reads(parser, tuple(demands), skips)


def _table_lines(name: str) -> Iterator[str]:
    text = files("twinform.profiles").joinpath("data", "reads", f"{name}.reads").read_text(encoding="utf-8")
    return (line for line in map(str.strip, text.splitlines()) if line and not line.startswith("#"))


def _parse_demand(columns: list[str]) -> Demand:
    place, item, form, effect, words = columns
    about, _, pipeline = words.partition(" => ")
    return Demand(_parse_place(place), item, form.removesuffix("!"), form.endswith("!"), effect, about, pipeline)


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
