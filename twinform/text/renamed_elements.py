"""Which elements have only got another name: most of what is in them is the same."""

from collections import Counter
from collections.abc import Iterator, Sequence

from twinform.schemas import XmlElement
from twinform.text.alignment import ElementContents, Pair, elements, stripped

_SHARE = 0.5
"""How much of the children of two elements is equal where one is the other with a new name."""
_MOST = 10_000
"""So many pairs are compared between two that stay; where there are more, nothing is taken for renamed."""


def renamed(old: XmlElement, new: XmlElement, contents: ElementContents) -> bool:
    """Whether an element is another one under a new name; one with a namespace never is."""
    if "{" in f"{old.tag}{new.tag}":
        return False
    before, after = elements(old), elements(new)
    if not before or not after:
        return len(before) == len(after) and stripped(old.text) == stripped(new.text) != ""
    same = Counter(map(contents.number, before)) & Counter(map(contents.number, after))
    return sum(same.values()) >= _SHARE * max(len(before), len(after))


def with_renamed(
    pairs: Sequence[Pair], before: Sequence[XmlElement], after: Sequence[XmlElement], contents: ElementContents
) -> list[Pair]:
    """Pairs of children that belong together, in order, and between them those that were renamed."""
    found: list[Pair] = []
    last = (-1, -1)
    for pair in (*pairs, (len(before), len(after))):
        old, new = range(last[0] + 1, pair[0]), range(last[1] + 1, pair[1])
        if old and new and len(old) * len(new) <= _MOST:
            found += _between(old, new, before, after, contents)
        found.append(pair)
        last = pair
    return found[:-1]


def _between(
    old: range, new: range, before: Sequence[XmlElement], after: Sequence[XmlElement], contents: ElementContents
) -> Iterator[Pair]:
    here = new.start
    for i in old:
        j = next((j for j in range(here, new.stop) if renamed(before[i], after[j], contents)), None)
        if j is not None:
            yield i, j
            here = j + 1
