"""Typing mistakes in the names of a model: a letter is missing, doubled, wrong, or exchanged with the next one."""

import re
from collections.abc import Iterator
from random import Random
from typing import NamedTuple

_NAMES = re.compile(
    rb"""(?x)
    <(?:parent|child)\s+link="(?P<link>[^"${]{4,})"
    | <(?:parent|child)>(?P<end>[^<${]{4,})</
    | <mimic\s[^>]*?joint="(?P<leader>[^"${]{4,})"
    | <(?P<tag>[a-z_]{4,})[\s/>]
    | \s(?P<attribute>[a-z_]{4,})="
    """
)


class Typo(NamedTuple):
    """A text with one name misspelt: which kind of name, and what it was and is."""

    text: bytes
    kind: str
    name: str
    written: str


def typos(text: bytes, random: Random, count: int) -> Iterator[Typo]:
    """Yield as many texts as there may be, each with one mistake in one name."""
    places = [*_NAMES.finditer(text)]
    for place in random.sample(places, min(count, len(places))):
        kind = str(place.lastgroup)
        start, end = place.span(kind)
        name = text[start:end].decode(errors="replace")
        written = misspelt(name, random)
        if written != name:
            yield Typo(text[:start] + written.encode() + text[end:], kind, name, written)


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
