"""Masks of geoms as masks of SDF: whether two geoms touch is the same where that can be said."""

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from twinform.compiler.input.mjcf.contact_masks import Bits, ContactMasks, touches_itself
from twinform.compiler.input.mjcf.pieces import Piece

_ALL = 0xFFFF
BITS = st.builds(Bits, st.integers(0, 7), st.integers(0, 7))


def geom(bits: Bits) -> Piece:
    """A geom with these masks."""
    return Piece(etree.Element("geom", contype=str(bits.type), conaffinity=str(bits.affinity)), "a.xml")


@given(st.lists(st.integers(0, 7).map(lambda both: Bits(both, both)), min_size=2, max_size=4))
def test_geoms_with_one_mask_for_both_touch_as_in_mujoco(masks: list[Bits]) -> None:
    pieces = [geom(each) for each in masks]
    plan = ContactMasks.of(pieces)
    written = [plan.take(each) for each in pieces]
    for (one, first), (other, second) in product(zip(masks, written, strict=True), repeat=2):
        if one.touches and other.touches:
            touches = bool((_ALL if first is None else first) & (_ALL if second is None else second))
            assert touches == one.meets(other)


@given(BITS, BITS)
def test_geoms_that_touch_in_mujoco_touch_in_sdf(one: Bits, other: Bits) -> None:
    pieces = [geom(one), geom(other)]
    plan = ContactMasks.of(pieces)
    first, second = (_ALL if (mask := plan.take(each)) is None else mask for each in pieces)
    assert not one.meets(other) or first & second


def test_masks_that_sdf_does_not_say_stay_with_the_geom() -> None:
    piece = geom(Bits(1, 2))
    assert ContactMasks.of([piece]).take(piece) == 3
    assert [name for name, _ in piece.untaken] == ["contype", "conaffinity"]


@pytest.mark.parametrize(
    ("links", "touches"),
    [
        ([[Bits(1, 1)]], None),
        ([[Bits(1, 1)], [Bits(0, 0)]], None),
        ([[Bits(1, 1)], [Bits(1, 1)]], True),
        ([[Bits(1, 0)], [Bits(1, 0)]], False),
        ([[Bits(1, 0)], [Bits(0, 1)]], True),
        ([[Bits(1, 0), Bits(2, 0)], [Bits(4, 0)]], False),
    ],
)
def test_a_model_touches_itself_where_two_of_its_links_may(links: list[list[Bits]], touches: bool | None) -> None:
    assert touches_itself(links) is touches
