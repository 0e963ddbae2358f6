"""Which links have to collide with their own model, for all of its links to touch that do so in a file of MJCF.

In SDF a link with `self_collide` touches all others of its model but those that a joint connects with it. So of two
links that touch at least one needs it: the links without it are some of which no two touch. Links that touch few
others are the first among these. Pairs are never listed, since there are as many as the square of the links: how many
links a link touches is counted by the bits of their geoms and by what they are fixed to.
"""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache

from twinform.ir.frames import WORLD
from twinform.passes.legalise.to_mjcf.contact_plan import Bits, ContactPlan

LinkBits = frozenset[Bits | None]
"""What the geoms of a link are and touch; None for a collision that has no geom."""
_MOST_KINDS = 256
"""With more kinds of bits in a model all of its links collide: kinds are compared with each other."""


def links_that_touch(
    plan: ContactPlan, bits: Mapping[str, LinkBits], excluded: Iterable[frozenset[str]]
) -> Iterator[str]:
    """Yield the links that have to collide with their own model, by the bits of all links and excluded pairs."""
    apart = _neighbors(plan, {*excluded, *map(frozenset, plan.joints())})
    for links in plan.loose_links():
        if len({bits[link] for link in links}) > _MOST_KINDS:
            yield from links
        else:
            yield from _covering(links, lambda: _Counted(plan, bits, apart))


def _neighbors(plan: ContactPlan, pairs: Iterable[frozenset[str]]) -> Mapping[str, Sequence[str]]:
    """The links that each link does not touch, beside those that MuJoCo leaves out by itself."""
    found: dict[str, list[str]] = defaultdict(list)
    for pair in pairs:
        if len(pair) > 1 and plan.has_all(pair) and not plan.is_filtered(*pair):
            one, other = pair
            found[one].append(other)
            found[other].append(one)
    return found


def _covering(links: Sequence[str], none: Callable[[], "_Counted"]) -> Iterator[str]:
    """Yield all links but some of which no two touch, those that touch few others before the rest."""
    every, free = none(), none()
    for link in links:
        every.add(link)
    # of links that touch equally many, the first ones collide
    last_first = {link: (every.touched_by(link), -place) for place, link in enumerate(links)}
    for link in sorted(links, key=last_first.__getitem__):
        if not free.touched_by(link):
            free.add(link)
    return (link for link in links if link not in free.links)


class _Counted:
    """Links of a model, counted by their bits, with what they are fixed to and with what that hangs from."""

    def __init__(self, plan: ContactPlan, bits: Mapping[str, LinkBits], apart: Mapping[str, Sequence[str]]) -> None:
        self.links = set[str]()
        self._plan, self._bits, self._apart = plan, bits, apart
        self._all = Counter[LinkBits]()
        self._fixed, self._hanging = Counter[tuple[LinkBits, str]](), Counter[tuple[LinkBits, str]]()

    def add(self, link: str) -> None:
        """Count a link."""
        bits, weld = self._bits[link], self._plan.weld(link)
        self.links.add(link)
        self._all[bits] += 1
        self._fixed[bits, weld] += 1
        if weld != WORLD:
            self._hanging[bits, self._plan.weld_above(weld)] += 1

    def touched_by(self, link: str) -> int:
        """How many of these a link touches."""
        bits, weld = self._bits[link], self._plan.weld(link)
        above = WORLD if weld == WORLD else self._plan.weld_above(weld)
        found = 0
        for other, count in self._all.items():
            if _meet(bits, other):
                found += count - self._fixed[other, weld]
                if weld != WORLD:  # what is fixed to the world touches what hangs from it
                    found -= self._hanging[other, weld]
                if above != WORLD:
                    found -= self._fixed[other, above]
        near = (each for each in self._apart.get(link, ()) if each in self.links)
        return found - sum(_meet(bits, self._bits[each]) for each in near)


@lru_cache(_MOST_KINDS**2)
def _meet(one: LinkBits, other: LinkBits) -> bool:
    """Whether any geoms of two links touch by their bits."""
    return any(a.meets(b) for a in one if a for b in other if b)
