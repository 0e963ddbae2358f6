"""Suppression comments: `<!-- twinform: allow RULE, ... - reason -->` and `allow-file`, and the findings they cover.

Pure: from comments and their lines to suppressions, and from these and findings to those that stay.
"""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import field
from typing import NamedTuple

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern

_OURS = lazy_pattern(r"\s*twinform\s*(?::|\s(?=allow\b))\s*", re.IGNORECASE)
_WORDS = lazy_pattern(
    # One hyphen, since XML has no `--` in a comment: libxml2 and expat refuse such a file, and only
    # tinyxml does not. Two are understood, and the file gets a `repaired-xml` finding as any other
    # with such a comment.
    r"(?P<word>allow|allow-file)\s+(?P<rules>[^\s,]+(?:\s*,\s*[^\s,]+)*)(?:\s+--?\s+\S.*)?\s*",
    re.DOTALL,
)
USAGE = "write 'twinform: allow RULE, RULE - reason', or 'allow-file' for all of the file; the reason may be left out"

_FEW = 20
"""A suppression that covers fewer lines is looked up by line; findings are held to all others."""
MOST = 1000
"""So many rules count in the suppressions of a file: a hostile file has a million."""
_LONGEST = 2**16
"""The longest suppression, in characters; one with all rules has 6,000."""


class Suppression(NamedTuple):
    """The rules that a comment allows, its line, and the lines it covers; 0 covers the whole file."""

    rules: tuple[str, ...]
    line: int
    first: int = 0
    last: int = 0

    def covers(self, rule: str, line: int) -> bool:
        """Whether a finding of this rule on this line is allowed."""
        return rule in self.rules and (not self.last or self.first <= line <= self.last)


class Flaw(NamedTuple):
    """A mistake in a comment that was meant to be a suppression."""

    line: int
    message: str
    help: str = USAGE


@dataclass(slots=True)
class Suppressions:
    """The suppressions of one file; `used` are those that have covered a finding, as numbers in `entries` and rules."""

    entries: tuple[Suppression, ...] = ()
    flaws: tuple[Flaw, ...] = ()
    used: set[tuple[int, str]] = field(default_factory=set[tuple[int, str]])
    _by_line: dict[int, list[int]] = field(init=False)
    """For each line, the places in `entries` of what covers it; 0 is the key of entries that cover many lines."""

    def __post_init__(self) -> None:
        self._by_line = defaultdict(list)
        for place, each in enumerate(self.entries):
            is_short = each.last and each.last - each.first < _FEW
            for line in range(each.first, each.last + 1) if is_short else (0,):
                self._by_line[line].append(place)

    def covers(self, rule: str, line: int) -> bool:
        """Whether a comment allows a finding of this rule on this line."""
        near = (*self._by_line.get(0, ()), *(self._by_line.get(line, ()) if line else ()))
        found = [(place, rule) for place in near if self.entries[place].covers(rule, line)]
        self.used.update(found)
        return bool(found)

    def unused(self) -> Iterator[tuple[Suppression, str]]:
        """Yield each allowed rule that has covered no finding, with its comment."""
        for place, each in enumerate(self.entries):
            yield from ((each, rule) for rule in each.rules if (place, rule) not in self.used)


NO_SUPPRESSIONS = Suppressions()


def is_meant(text: str) -> bool:
    """Tell whether a comment addresses us."""
    return _OURS.match(text) is not None


def parse_suppressions(comments: Iterable[tuple[str, int, int, int]]) -> Suppressions:
    """The suppressions in comments: of each its text, its line, and the first and last line of what it is about."""
    entries: list[Suppression] = []
    flaws: list[Flaw] = []
    count = 0
    for text, line, first, last in (each for each in comments if is_meant(each[0])):
        found = _parsed(text, line, first, last)
        count += 1 if isinstance(found, Flaw) else len(found.rules)
        if count > MOST:
            flaws.append(Flaw(line, f"more than {MOST} suppressions: the rest is ignored"))
            break
        if isinstance(found, Flaw):
            flaws.append(found)
        else:
            entries.append(found)
    return Suppressions(tuple(entries), tuple(flaws))


def _parsed(text: str, line: int, first: int, last: int) -> Suppression | Flaw:
    if len(text) > _LONGEST:
        return Flaw(line, f"this comment is no suppression: it has more than {_LONGEST:,} characters")
    begin = _OURS.match(text)
    words = _WORDS.fullmatch(text, begin.end()) if begin else None
    if words is None:
        return Flaw(line, f"this comment is no suppression: {' '.join(text.split())[:80]!r}")
    rules = tuple(dict.fromkeys(each.strip() for each in words["rules"].split(",")))
    if words["word"] == "allow-file":
        return Suppression(rules, line)
    if not last:
        message = "no element follows this comment in the element around it, so it allows nothing"
        return Flaw(line, message, "put it before the element, or behind it on the same line")
    return Suppression(rules, line, first, last)
