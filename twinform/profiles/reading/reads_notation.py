"""The tables in `data/reads/`: what a consumer reads where, in which form, and what it does where it is not so.

A line has five columns with two blanks or more between them: a place, an item, a form, an effect, and what the
consumer does then. A place is a path below the root; `*` stands for all elements of a name, without it the first one
counts; `[revolute,prismatic]` are values of `type`, `[!fixed]` are values that it has not; `^` is an element only where
it is the first. Items are `@attribute`, `<element>`, `#text`, or a name that `tree.py` explains. `!` after a form means
that the item has to be there, and what follows ` => ` are the passes that help.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

_COLUMNS = re.compile(r"\s{2,}")
_STEP = re.compile(r"(?P<first>\^?)(?P<tag>[\w:.-]+)(?P<every>\*?)(?:\[(?P<other>!?)(?P<types>[^\]]*)\])?")


@dataclass(frozen=True, slots=True)
class PlaceStep:
    """One element on the way to a place."""

    tag: str
    every: bool
    first: bool
    types: frozenset[str]
    other: bool


@dataclass(frozen=True, slots=True)
class Demand:
    """What is read at a place; `needed` is whether it must be there."""

    place: tuple[PlaceStep, ...]
    item: str
    form: str
    needed: bool
    effect: str
    about: str
    pipeline: str


@dataclass(frozen=True, slots=True)
class Reads:
    """What a consumer reads: the XML parser that it has, and its demands."""

    parser: str
    demands: tuple[Demand, ...]
    skips: str = ""
    """The attribute that leaves a link or a joint out where it is `true`."""


@cache
def reads(name: str) -> Reads:
    """The table of a consumer."""
    parser, skips, demands = "", "", list[Demand]()
    for line in _lines(name):
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
            demands.append(_demand(columns))
    return Reads(parser, tuple(demands), skips)


def _lines(name: str) -> Iterator[str]:
    text = files("twinform.profiles").joinpath("data", "reads", f"{name}.reads").read_text(encoding="utf-8")
    return (line for line in map(str.strip, text.splitlines()) if line and not line.startswith("#"))


def _demand(columns: list[str]) -> Demand:
    place, item, form, effect, words = columns
    about, _, pipeline = words.partition(" => ")
    return Demand(_steps(place), item, form.removesuffix("!"), form.endswith("!"), effect, about, pipeline)


def _steps(place: str) -> tuple[PlaceStep, ...]:
    if place == "robot":
        return ()
    found = [_STEP.fullmatch(part) for part in place.split("/")]
    if None in found:
        raise ValueError(f"{place!r} is no place")
    return tuple(_step(each) for each in found if each)


def _step(found: re.Match[str]) -> PlaceStep:
    types = frozenset(found["types"].split(",")) if found["types"] is not None else frozenset[str]()
    return PlaceStep(found["tag"], bool(found["every"]), bool(found["first"]), types, bool(found["other"]))
