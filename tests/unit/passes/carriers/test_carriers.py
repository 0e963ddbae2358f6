"""What a carrier holds comes out as it went in, and has no attribute that a reader would find empty."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from twinform.ir import Element, Opaque
from twinform.passes.carriers.carriers import NAMESPACE, pack, unpack, without_bodies_for_gazebo, without_ours

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


_ROBOT = b"""<robot xmlns:tf="urn:twinform:1" name="r">
  <link name="a"><tf:offset xyz="0 0 1"/><visual><geometry><sphere radius="1"/></geometry><tf:sdf/></visual></link>
  <gazebo><joint name="j"/><plugin name="p"><tf:version/><rate>5</rate></plugin></gazebo>
  <gazebo><link name="b"/></gazebo>
  <gazebo/>
  <gazebo reference="a"><link>named so</link></gazebo>
</robot>"""


def test_nothing_of_ours_is_left_and_all_else_is():
    text = without_ours(_document()).model_dump_json()
    assert "urn:twinform:1}" not in text
    assert '"rate"' in text


def test_what_has_nothing_to_take_away_stays_the_same_object():
    bare = without_bodies_for_gazebo(without_ours(_document()))
    assert without_ours(bare) is bare
    assert without_bodies_for_gazebo(bare) is bare


def test_bodies_go_from_what_is_about_the_model():
    extensions = without_bodies_for_gazebo(_document()).models[0].extensions
    assert [(each.reference, [one.name for one in each.content]) for each in extensions] == [
        (None, ["plugin"]),
        (None, []),
        ("a", ["link"]),
    ]


def _document() -> twinform.Document:
    document = twinform.check(_ROBOT).document
    assert document is not None
    return document
