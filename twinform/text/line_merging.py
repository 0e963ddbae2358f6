"""Three-way merges of lines, or of other pieces of texts, and git's markers around lines that two texts disagree on."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from twinform.text.alignment import Pair, blocks, moved_pairs

Pieces = Sequence[str]


class Hunk(NamedTuple):
    """Pieces between two that all texts have."""

    base: Pieces
    ours: Pieces
    theirs: Pieces


Choice = Callable[[Hunk], Pieces]
"""Decides what becomes of pieces that both sides have changed."""


def split_lines(text: str) -> list[str]:
    r"""Split a text behind each `\n`, as git does."""
    lines = text.split("\n")
    return [*(f"{line}\n" for line in lines[:-1]), *filter(None, lines[-1:])]


def merge_pieces(base: Pieces, ours: Pieces, theirs: Pieces, choose: Choice) -> list[str]:
    """Make the changes of both sides in a base; `choose` decides about hunks that both have changed."""
    merged: list[str] = []
    for hunk in _hunks(base, ours, theirs):
        if hunk.theirs in (hunk.base, hunk.ours):
            merged += hunk.ours
        else:
            merged += hunk.theirs if hunk.ours == hunk.base else choose(hunk)
    return merged


def _hunks(base: Pieces, ours: Pieces, theirs: Pieces) -> Iterator[Hunk]:
    """Split three texts at the pieces that all of them have; changes that touch each other are one hunk, as for git."""
    mine, others = dict(common(base, ours)), dict(common(base, theirs))
    ends = (len(base), len(ours), len(theirs))
    last = (-1, -1, -1)
    for here in (*((i, mine[i], others[i]) for i in sorted(mine.keys() & others.keys())), ends):
        between = [slice(before + 1, stop) for before, stop in zip(last, here, strict=True)]
        yield Hunk(base[between[0]], ours[between[1]], theirs[between[2]])
        same = base[here[0] : here[0] + 1]
        yield Hunk(same, same, same)
        last = here


def changed_pieces(before: Pieces, after: Pieces) -> Iterator[tuple[Pieces, Pieces]]:
    """Yield both texts in pieces that differ, and the single ones between them that are equal."""
    for hunk in _hunks(before, before, after):
        yield hunk.ours, hunk.theirs


def common(one: Pieces, other: Pieces) -> list[Pair]:
    """Pair the equal pieces of two texts, in the order of both.

    The ones that stand once in each are paired first, which leaves little to compare between them, as in patience diff.
    """
    counts = Counter(one), Counter(other)
    once = {piece: i for i, piece in enumerate(one) if counts[0][piece] == 1}
    pairs = sorted((once[piece], j) for j, piece in enumerate(other) if counts[1][piece] == 1 and piece in once)
    moved = set(moved_pairs(pairs))
    found: list[Pair] = []
    last = (-1, -1)
    for i, j in (*(pair for pair in pairs if pair not in moved), (len(one), len(other))):
        start, other_start = last[0] + 1, last[1] + 1
        for old, new, equal in blocks(one[start:i], other[other_start:j]):
            found += [(start + a, other_start + b) for a, b in zip(old, new, strict=True)] if equal else []
        found.append((i, j))
        last = (i, j)
    return found[:-1]


def with_markers(ours: Pieces, theirs: Pieces, size: int) -> list[str]:
    """Make one text of two by their lines, with git's markers around those that differ."""
    marked: list[str] = []
    for one, other in changed_pieces(ours, theirs):
        marked += one if one == other else conflict(Hunk((), one, other), size)
    return marked


def conflict(hunk: Hunk, size: int) -> list[str]:
    """Return both states of some lines between the markers of git."""
    return [
        f"{'<' * size} ours\n",
        *map(_whole_line, hunk.ours),
        f"{'=' * size}\n",
        *map(_whole_line, hunk.theirs),
        f"{'>' * size} theirs\n",
    ]


def _whole_line(line: str) -> str:
    return line if line.endswith("\n") else f"{line}\n"
