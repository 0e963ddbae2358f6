"""What a carrier holds comes out as it went in, and has no attribute that a reader would find empty."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from twinform.ir import Element, Opaque
from twinform.passes.carriers.carriers import NAMESPACE, pack, unpack

BLANKS = st.text(alphabet=" \t\n\r\u00a0\u2003", max_size=4)
VALUES = st.one_of(BLANKS, st.text(alphabet="ab \u00a0", max_size=4))


@given(VALUES, VALUES, VALUES)
def test_a_piece_comes_out_as_it_went_in(outer: str, inner: str, alone: str) -> None:
    child = Element(name="b", attributes=(("k", inner),))
    whole = Opaque(element=Element(name="a", attributes=(("k", outer), ("l", "1")), children=(child,)))
    attribute = Opaque(at="limit", attribute=("k", alone))
    carriers = pack([whole, attribute], "urdf")
    for each in carriers:
        assert each.element is not None
        assert all(value.strip() for one in each.element.walk() for _, value in one.attributes)
    (back,), (alone_back,) = map(unpack, carriers)
    assert alone_back == attribute
    assert back.element is not None
    assert dict(back.element.attributes) == {"k": outer, "l": "1"}
    assert back.element.children == (child,)


@pytest.mark.parametrize("blanks", ["", "0", "41", "d800", "1c", "20 zz", "ffffff", "-20", "20" * 100])
def test_what_somebody_writes_for_blanks_is_blank_or_nothing(blanks: str) -> None:
    carrier = Element(name=f"{{{NAMESPACE}}}urdf", attributes=(("attribute", "k"), ("blanks", blanks)))
    (piece,) = unpack(Opaque(element=carrier))
    assert piece.attribute is not None
    assert not piece.attribute[1].strip(" ")


def test_a_blank_attribute_comes_back() -> None:
    robot = """<robot name="r"><link name="a"><foo name=" " k="&#9;"/></link></robot>"""
    there = twinform.convert(robot.encode(), name="r.urdf", to="sdf").text
    assert 'name=" "' not in there
    back = twinform.convert(there.encode(), name="r.sdf", to="urdf").text
    assert '<foo name=" " k="&#9;"/>' in back
