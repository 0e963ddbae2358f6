"""Which links of a model or world touch, and how MJCF says so: by bits of their geoms, and by pairs that are excluded.

In SDF two links of one model touch if one of them has `self_collide`, which a link has from its model, and never where
a joint connects them. Links of different models touch. In MJCF all geoms touch but those of one body, or of a parent
and its child that are both loose, where bodies that are fixed to each other are one. Two geoms touch if `contype` of
the one has a bit of `conaffinity` of the other.

A model whose links do not touch gets a bit of its own, which is in the `contype` of its geoms and in the `conaffinity`
of everything but them. So a robot alone has 1 and 0, and still touches what has the defaults, 1 and 1.
"""

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cached_property
from itertools import combinations
from typing import NamedTuple

from twinform.ir import Collision, Model, World
from twinform.ir.frames import WORLD
from twinform.ir.geometry import Empty
from twinform.ir.kinematic_tree import KinematicTree
from twinform.ir.scopes import SCOPE, scoped_models
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements
from twinform.passes.legalise.to_mjcf.said_parts import untyped, whole_number

MOST_BITS = 31
"""How many models may have a bit: the numbers are signed and have 32."""
ALL_TOUCH = 65535
"""The masks of a collision of SDF that has none written."""
Pair = tuple[str, str]


class Bits(NamedTuple):
    """What a geom is, and what it touches."""

    contype: int
    conaffinity: int

    def meets(self, other: "Bits") -> bool:
        """Tell whether two geoms touch."""
        return bool(self.contype & other.conaffinity or other.contype & self.conaffinity)


USUAL = Bits(1, 1)
"""What a geom of MJCF has where nothing is written."""
_NONE = Bits(0, 0)
_SIGN = 2**31
MASKS = ("collide_bitmask", "category_bitmask")
"""The masks of SDF, in the contacts of a surface."""


class ContactPlan:
    """The bits of each link, and the pairs of links that are excluded beside them.

    Raises:
        FrameError: an end of a joint is not known, or frames go round in a circle.
    """

    def __init__(self, holder: Model | World, tree: KinematicTree, static: frozenset[str], *, is_of_mjcf: bool) -> None:
        self._tree = tree
        self._static = static
        self._is_of_mjcf = is_of_mjcf
        self._welds: dict[str, str] = {}
        self._flagged = dict(_self_colliding(holder))
        self._groups: dict[str, list[str]] = defaultdict(list)
        """The links that have collisions, by the outermost model that they are in."""
        for name, link in tree.links.items():
            if any(map(_has_shape, link.collisions)):
                self._groups[name.partition(SCOPE)[0] if isinstance(holder, World) else ""].append(name)
        collisions = [each for link in tree.links.values() for each in link.collisions]
        self._has_masks = any(mask_of(each, name) is not None for each in collisions for name in MASKS)
        # Where an edit gave a geom bits of its own, the others keep what they have of their models.
        self._has_bits_of_geoms = self._has_masks or (is_of_mjcf and any(map(_kept_bits, collisions)))
        self._released = frozenset[str]()
        if is_of_mjcf:
            self._released = frozenset(link for links in self._groups.values() for link in self._told_to_touch(links))

    def bits(self, link: str, collision: Collision) -> Bits:
        """The bits of a geom; those of its collision where a collision has any, as SDF defines them."""
        kept = self.kept_bits(link, collision)
        if kept is not None:
            return kept
        if not self._has_masks:
            return self._bits.get(link, USUAL)
        mask, category = (mask_of(collision, name) for name in MASKS)
        affinity = ALL_TOUCH if mask is None else mask
        return Bits(affinity if category is None else category, affinity)

    def kept_bits(self, link: str, collision: Collision) -> Bits | None:
        """The bits that a collision keeps of its geom of MJCF; None where there are none, or an edit has replaced them.

        Where a file of MJCF was read, the mask had the bits of both numbers. Another mask, or none, was edited; and so
        was a model that touches itself while these bits keep it from that.
        """
        kept = _kept_bits(collision)
        if kept is None or not self._is_of_mjcf:
            return kept
        is_stale = mask_of(collision, MASKS[0]) != (kept.contype | kept.conaffinity) & ALL_TOUCH
        return None if is_stale or link in self._released else kept

    @property
    def are_usual(self) -> bool:
        """Whether all geoms that touch anything have the bits that need not be written."""
        return all(self._bits_of(link) <= {USUAL, _NONE} for links in self._groups.values() for link in links)

    def touch_by_bits(self, links: Collection[str]) -> bool:
        """Whether any two of these links touch by their bits, which is what a reader of the file sees."""
        counts = Counter(bits for link in links for bits in self._bits_of(link))
        pairs = [*combinations(counts, 2), *((bits, bits) for bits, count in counts.items() if count > 1)]
        return any(one.meets(other) for one, other in pairs)

    def loose_links(self) -> Iterator[list[str]]:
        """The links of each model that touch no others of it in SDF, where MuJoCo would let any of them touch."""
        return (loose for links in self._groups.values() if (loose := self._loose(links)))

    def has_all(self, names: Iterable[str]) -> bool:
        """Whether all of these names are those of links."""
        return all(each in self._tree.links for each in names)

    def _told_to_touch(self, links: Collection[str]) -> Collection[str]:
        """The links of a model that touches itself, if their bits do not."""
        is_told = len(links) > 1 and all(self._flagged[link] for link in links)
        return links if is_told and not self.touch_by_bits(links) else ()

    def is_told_apart(self, model: str) -> bool:
        """Whether links of a model touch by their bits, and only exclusions and the model keep them from it.

        A model in no world goes by no name.
        """
        links = self._groups.get(model, ())
        return not any(self._flagged[link] for link in links) and self.touch_by_bits(links)

    def could_touch_itself(self, model: str) -> bool:
        """Whether two links of a model or more have geoms that touch anything, so that their bits tell if they do."""
        touching = (link for link in self._groups.get(model, ()) if self._bits_of(link) - {_NONE})
        return len([*touching][:2]) > 1

    @cached_property
    def excluded(self) -> tuple[Pair, ...]:
        """The pairs of links that must not touch, and would by their bits."""
        pairs = {} if self._is_of_mjcf else dict.fromkeys(self._joined())
        for links in self._groups.values():
            found = self._needless_contacts(links)
            if any(link in self._bits for link in links):  # these do not touch, but where geoms keep others
                kept = {link for link in links if any(map(_kept_bits, self._tree.links[link].collisions))}
                found = (pair for pair in found if not kept.isdisjoint(pair)) if kept else iter(())
            pairs |= dict.fromkeys(pair for pair in found if self._touch(*pair))
        return tuple(pairs)

    @cached_property
    def _bits(self) -> Mapping[str, Bits]:
        """The bits of links in models that have a bit."""
        found: dict[str, Bits] = {}
        # The geoms of a file of MJCF keep the bits that they had: links that an edit keeps apart are excluded.
        if self._has_bits_of_geoms or self._is_of_mjcf:
            return found
        apart = [links for links in self._groups.values() if any(self._needless_contacts(links))][:MOST_BITS]
        everything = (1 << len(apart)) - 1
        for index, links in enumerate(apart):
            own = 1 << index
            for link in links:
                found[link] = Bits(own, everything if self._flagged[link] else everything ^ own)
        return found

    def _needless_contacts(self, links: list[str]) -> Iterator[Pair]:
        """Yield the pairs of links of one model that do not touch in SDF, and would in MuJoCo."""
        return (pair for pair in combinations(self._loose(links), 2) if not self.is_filtered(*pair))

    def _loose(self, links: list[str]) -> list[str]:
        """The links of a model that touch no others of it; none where all are fixed to one, as in a static model."""
        loose = [link for link in links if not self._flagged[link]]
        return loose if len({self.weld(link) for link in loose}) > 1 else []

    def _joined(self) -> Iterator[Pair]:
        """Yield the pairs of links that a joint connects, and that would touch by their bits."""
        return (pair for pair in self.joints() if not self.is_filtered(*pair) and self._touch(*pair))

    def joints(self) -> Iterator[Pair]:
        """Yield the pairs of links that a joint connects."""
        links = self._tree.links
        between = [above for name in links if (above := self._tree.joint_above(name))]
        pairs = ((each.parent, each.child) for each in (*between, *self._tree.closing))
        return (pair for pair in pairs if self.has_all(pair))

    def _touch(self, one: str, other: str) -> bool:
        """Whether any geoms of two links touch by their bits."""
        mine, others = self._bits_of(one), self._bits_of(other)
        return any(a.meets(b) for a in mine for b in others)

    def _bits_of(self, link: str) -> frozenset[Bits]:
        return frozenset(self.bits(link, each) for each in self._tree.links[link].collisions if _has_shape(each))

    def is_filtered(self, one: str, other: str) -> bool:
        """Whether MuJoCo leaves out the contacts of two links by itself."""
        first, second = self.weld(one), self.weld(other)
        if first == second:
            return True
        if WORLD in (first, second):
            return False
        return self.weld_above(first) == second or self.weld_above(second) == first

    def weld_above(self, weld: str) -> str:
        """The topmost link of what another one of these hangs from by a joint, or `world`."""
        above = self._tree.joint_above(weld)
        return self.weld(above.parent) if above is not None else WORLD

    def weld(self, link: str) -> str:
        """The topmost link that a link is fixed to, or `world`."""
        way = [link]
        while True:
            here = way[-1]
            if here in self._welds:
                top = self._welds[here]
                break
            if here in self._static or (here == WORLD and here not in self._tree.links):
                top = WORLD
                break
            above = self._tree.joint_above(here)
            if above is None or above.type != "fixed":
                top = here
                break
            way.append(above.parent)
        self._welds.update(dict.fromkeys(way, top))
        return top


def mask_of(collision: Collision, name: str) -> int | None:
    """The number of a bit mask in the surface of a collision, or None."""
    element = untyped(collision.surface, name) if collision.surface is not None else None
    text = element.text if element is not None else None
    # MuJoCo has 32 bits, of which the first is the sign
    return (whole_number(text, ALL_TOUCH) + _SIGN) % (2 * _SIGN) - _SIGN if text else None


def _has_shape(collision: Collision) -> bool:
    """Whether a collision can touch anything: without a shape it has no geom."""
    shape = collision.geometry.shape if collision.geometry else None
    return shape is not None and not isinstance(shape, Empty)


def _kept_bits(collision: Collision) -> Bits | None:
    """The bits that a collision keeps of the geom of MJCF that it was read from."""
    if not collision.opaque:
        return None
    kept = {name: value for each in kept_elements(collision) if each.name == "geom" for name, value in each.attributes}
    if not kept.keys() & set(Bits._fields):
        return None
    return Bits(int(float(kept.get("contype", "1"))), int(float(kept.get("conaffinity", "1"))))


def _self_colliding(holder: Model | World) -> Iterator[tuple[str, bool]]:
    """Yield all links, each with whether it touches other links of its model."""
    tops = [("", holder)] if isinstance(holder, Model) else [(f"{each.name}{SCOPE}", each) for each in holder.models]
    for top, model in tops:
        of_models: dict[str, bool] = {}
        for scope, each in scoped_models(model, top):
            around = scope.removesuffix(SCOPE).rpartition(SCOPE)[0]
            inherited = of_models.get(f"{around}{SCOPE}" if around else "", False)
            of_models[scope] = inherited if each.self_collide is None else each.self_collide
            for link in each.links:
                own = link.self_collide
                yield scope + link.name, of_models[scope] if own is None else own
