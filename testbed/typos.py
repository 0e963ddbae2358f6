"""Typing mistakes in the names of a model: a letter is missing, doubled, wrong, or exchanged with the next one."""

import re
from collections.abc import Iterator
from random import Random
from typing import NamedTuple

from twinform.schemas.facts import named_kinds

_NAMES = re.compile(
    rb"""(?x)
    <(?:parent|child)\s+link="(?P<link>[^"${]{4,})"
    | <(?:parent|child)>(?P<end>[^<${]{4,})</
    | <mimic\s[^>]*?joint="(?P<leader>[^"${]{4,})"
    | <(?P<tag>[a-z_]{4,})[\s/>]
    | \s(?P<attribute>[a-z_]{4,})="
    """
)

_IN_MJCF = re.compile(
    rb"<!--.*?-->"
    rb"|<(?P<tag>[a-z_]{4,})(?=[^<>]*/>)"
    rb"|(?<!<default)\s(?:"
    + b"|".join(sorted(name.encode() for name in named_kinds("mjcf")))
    + rb')="(?P<reference>[^"]{4,})"'
    rb'|\s(?P<attribute>[a-z_]{4,})="',
    re.DOTALL,
)
"""Elements that end where they begin, names that attributes refer to by the table of MJCF, and attributes."""


class Typo(NamedTuple):
    """A text with one name misspelt: which kind of name, what it was and is, and the line that it is on."""

    text: bytes
    kind: str
    name: str
    written: str
    line: int


def typos(text: bytes, random: Random, count: int) -> Iterator[Typo]:
    """Yield as many texts as there may be, each with one mistake in one name."""
    names = _IN_MJCF if b"<mujoco" in text else _NAMES
    places = [place for place in names.finditer(text) if place.lastgroup]
    for place in random.sample(places, min(count, len(places))):
        kind = str(place.lastgroup)
        start, end = place.span(kind)
        name = text[start:end].decode(errors="replace")
        written = misspelt(name, random)
        if written != name:
            yield Typo(
                text[:start] + written.encode() + text[end:], kind, name, written, text.count(b"\n", 0, start) + 1
            )


def misspelt(name: str, random: Random) -> str:
    """Misspell a name at one place."""
    at = random.randrange(len(name) - 1)
    ways = (
        name[:at] + name[at + 1 :],
        name[: at + 1] + name[at:],
        name[:at] + random.choice("aeinrst") + name[at + 1 :],
        name[:at] + name[at + 1] + name[at] + name[at + 2 :],
    )
    return random.choice(ways)
