"""Which geoms touch: `contype` and `conaffinity` of MJCF, as masks and self-collision of SDF.

In MJCF two geoms touch where the `contype` of one and the `conaffinity` of the other have a bit in common; in SDF where
their masks have one. With 1 and 1 everywhere no mask is needed. Where the two numbers of each geom are the same, that
is the mask; otherwise the mask has the bits of both, and more geoms touch than in MJCF.
"""

from collections.abc import Iterable, Sequence
from itertools import combinations
from typing import NamedTuple, Self

from twinform.compiler.input.mjcf.pieces import Piece

_BITS = 0xFFFF
"""The bits of a mask in SDF."""


class Bits(NamedTuple):
    """The two masks of a geom."""

    type: int
    affinity: int

    @classmethod
    def of(cls, geom: Piece) -> Self:
        """Return the masks of a geom, which are 1 where they are not written."""
        return cls(int(float(geom.peek("contype") or "1")), int(float(geom.peek("conaffinity") or "1")))

    @property
    def touches(self) -> bool:
        """Whether the geom touches anything: if not, it is only seen."""
        return bool(self.type or self.affinity)

    def meets(self, other: "Bits") -> bool:
        """Tell whether two geoms touch each other."""
        return bool(self.type & other.affinity or other.type & self.affinity)


_USUAL = Bits(1, 1)


class ContactMasks(NamedTuple):
    """How the masks of a file are written in SDF: `is_plain` is whether none is needed."""

    is_plain: bool

    @classmethod
    def of(cls, geoms: Iterable[Piece]) -> Self:
        """Look at all geoms of a file."""
        return cls(all(bits == _USUAL for bits in map(Bits.of, geoms) if bits.touches))

    def take(self, geom: Piece) -> int | None:
        """Return the mask of a geom that touches; None for the one that SDF has by default.

        Masks that SDF does not express stay with the geom.
        """
        bits = Bits.of(geom)
        if bits.type == bits.affinity and 0 <= bits.type <= _BITS:
            geom.take("contype")
            geom.take("conaffinity")
        return None if self.is_plain else (bits.type | bits.affinity) & _BITS


def touches_itself(links: Sequence[Sequence[Bits]]) -> bool | None:
    """Tell whether any two links of a model may touch; None where fewer than two could."""
    bodies = [frozenset(bits for bits in each if bits.touches) for each in links]
    bodies = [each for each in bodies if each]
    if len(bodies) < 2:
        return None
    seen: set[Bits] = set()
    several: set[Bits] = set()
    for each in bodies:
        several |= each & seen
        seen |= each
    return any(one.meets(other) for one, other in combinations(sorted(seen), 2)) or any(
        one.meets(one) for one in several
    )
