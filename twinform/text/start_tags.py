"""The layout of start tags: blanks between attributes, their order and lines, and the shortest spelling of numbers.

A tag on one line has one blank before each attribute. In a tag of several lines each attribute stays on its line, and
the lines are aligned below the first attribute, or below another one where the author has aligned them there.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from math import isfinite
from typing import NamedTuple

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern

_NAME = lazy_pattern(r"<([^\s/>]++)")
_ATTRIBUTE = lazy_pattern(r"""(\s*+)([^\s=<>/"']++)\s*+=\s*+("[^"]*+"|'[^']*+')""")
_END = lazy_pattern(r"(\s*+)(/?>)")
_LINE_END = lazy_pattern(r"\r\n|\n|\r")
TAB = 8
"""The width of a tab where a column is asked for, as terminals and most editors have it."""


class Attribute(NamedTuple):
    """An attribute with the blanks before it; `value` includes its quotes."""

    gap: str
    name: str
    value: str

    @property
    def text(self) -> str:
        """The attribute as it is written."""
        return f"{self.name}={self.value}"


@dataclass(frozen=True, slots=True)
class StartTag:
    """A start tag; `end` is `>` or `/>`, and `gap` the blanks before it."""

    name: str
    attributes: tuple[Attribute, ...]
    gap: str
    end: str

    @classmethod
    def of(cls, text: str) -> "StartTag":
        """Split a well-formed start tag."""
        name, found = name_of(text), list[Attribute]()
        here = len(name) + 1
        while attribute := _ATTRIBUTE.match(text, here):
            found.append(Attribute(*attribute.groups()))
            here = attribute.end()
        end = _END.match(text, here)
        assert end is not None  # noqa: S101 - the tokens of a text are well-formed
        return cls(name, tuple(found), end[1], end[2])

    @property
    def is_broken(self) -> bool:
        """Whether the tag has several lines, not counting line breaks in values."""
        return any(map(_LINE_END.search, (self.gap, *(each.gap for each in self.attributes))))

    def with_values(self, spelled: Callable[[str, str], str]) -> "StartTag":
        """Return the tag with its values changed by a function of attribute name and value."""
        changed = (
            each._replace(value=_quoted(each.value, spelled(each.name, each.value[1:-1]))) for each in self.attributes
        )
        return replace(self, attributes=tuple(changed))

    def sorted_by(self, ranks: Sequence[int]) -> "StartTag":
        """Return the tag with its attributes sorted by the given ranks, in the same places."""
        order = sorted(range(len(ranks)), key=ranks.__getitem__)
        pairs = zip(self.attributes, (self.attributes[i] for i in order), strict=True)
        return replace(self, attributes=tuple(new._replace(gap=old.gap) for old, new in pairs))

    def columns(self) -> dict[int, bool]:
        """Return where each attribute begins, and whether more than one blank stands before it.

        Empty for a tag of several lines.
        """
        found: dict[int, bool] = {}
        here = len(self.name)
        for each in self.attributes:
            if _LINE_END.search(each.gap + each.value):
                return {}
            here += len(each.gap)
            found[here] = len(each.gap) > 1
            here += len(each.text)
        return found

    def is_aligned_with(self, other: "StartTag") -> bool:
        """Tell whether an author aligned an attribute of this tag with one of another tag."""
        columns, others = self.columns(), other.columns()
        return any(columns[each] or others[each] for each in columns.keys() & others.keys())

    def on_one_line(self, *, keep_gaps: bool) -> str:
        """Write the tag on one line; `keep_gaps` keeps the blanks that align it with other tags."""
        if not keep_gaps:
            gap = " " if self.gap and self.end == "/>" else ""
            return f"{' '.join((f'<{self.name}', *(each.text for each in self.attributes)))}{gap}{self.end}"
        return f"<{self.name}{''.join(each.gap + each.text for each in self.attributes)}{self.gap}{self.end}"

    def on_lines(self, line: str, step: str, column: int) -> str:
        """Write a tag of several lines; `line` begins a line at its indent, and the tag stood at `column` before."""
        first_is_below = bool(self.attributes and _LINE_END.search(self.attributes[0].gap))
        aligning = _Aligning(column + len(self.name) + 1)
        below = f"{line}{step}" if first_is_below else f"{line}{' ' * (len(self.name) + 2)}"
        pieces = [f"<{self.name}"]
        for number, each in enumerate(self.attributes):
            if _LINE_END.search(each.gap):
                pieces.append(below + " " * aligning.next_line(each.gap))
            else:
                aligning.skip(each.gap if number else " ", each.gap)
                pieces.append(each.gap if number else " ")
            aligning.put(each.text)
            pieces.append(each.text)
        blank = " " if self.gap and self.end == "/>" else ""
        ending = f"{line}{self.end}" if _LINE_END.search(self.gap) else blank + self.end
        return "".join((*pieces, ending))


def name_of(tag: str) -> str:
    """Return the name in a start tag."""
    name = _NAME.match(tag)
    assert name is not None  # noqa: S101 - as above
    return name[1]


def _quoted(old: str, value: str) -> str:
    return f"{old[0]}{value}{old[-1]}"


class _Aligning:
    """The old and new columns of the attributes in a tag of several lines, counted from the first one.

    A line that was aligned with an attribute of the lines above is aligned with it again, and any other with the first.
    """

    def __init__(self, old: int) -> None:
        self.old, self.new = old, 0
        self.first: int | None = None
        self.known = True
        self.above: dict[int, int] = {}
        self.here: dict[int, int] = {}

    def next_line(self, gap: str) -> int:
        """Begin a line with these blanks; returns how much deeper it is than the first attribute."""
        self.above.update(self.here)
        self.here, self.known = {}, True
        self.old = len(_LINE_END.split(gap)[-1].expandtabs(TAB))
        self.new = self.above.get(self.old, 0)
        return self.new

    def skip(self, new: str, old: str) -> None:
        """Continue after blanks."""
        self.old += len(old)
        self.new += len(new) if self.first is not None else 0

    def put(self, text: str) -> None:
        """Write an attribute at the current column."""
        if self.first is None:
            self.first = self.old
        if self.known:
            self.here.setdefault(self.old, self.new)
        self.old += len(text)
        self.new += len(text)
        self.known = self.known and _LINE_END.search(text) is None  # behind a value of several lines nobody aligns


def rank(known: Sequence[str], attribute: str) -> int:
    """Return a sort key: smaller for attributes that come first in the usual order, which is `known`."""
    if attribute == "name":
        return -1
    return known.index(attribute) if attribute in known else len(known)


_NUMBER = lazy_pattern(r"[-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?", re.ASCII)
_EXPONENT = lazy_pattern(r"e([-+])0*(\d+)")
_ONLY_NUMBERS = lazy_pattern(rf"\s*+(?:{_NUMBER.pattern}(?:\s++|$))++", re.ASCII)


def all_numbers(text: str) -> bool:
    """Tell whether a text consists of numbers, and has at least one."""
    return _ONLY_NUMBERS.fullmatch(text) is not None


def shortest(text: str) -> str:
    """Spell each number of a text in the fewest characters, if the text consists of numbers."""
    return _NUMBER.sub(lambda found: _shortest(found.group()), text) if all_numbers(text) else text


def _shortest(number: str) -> str:
    value = float(number)
    if not isfinite(value):
        return number
    spelled = _EXPONENT.sub(r"e\1\2", repr(value)).replace("e+", "e").removesuffix(".0")
    return spelled if len(spelled) < len(number) and float(spelled) == value else number
