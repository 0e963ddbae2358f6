"""What is remembered of a source: there and back is home, and what a person edited on the way stays edited."""

import string
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

import twinform
from tests.corpus.ir_difference import first_difference
from twinform.compiler.memory.document import forget
from twinform.compiler.memory.edits import apply, changes
from twinform.compiler.memory.keys import digest, same
from twinform.schemas import XmlElement

ARM = """
<robot name="arm">
  <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="base"/>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="upper"/><axis xyz="0 0 2"/>
    <limit lower="-1" upper="1" effort="3" velocity="4"/>
    <safety_controller k_velocity="1"/>
  </joint>
  <link name="upper">
    <inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <visual><origin xyz="0 0 1"/><geometry><box size="1 1 1"/></geometry><material name="grey"/></visual>
    <visual name="tip"><geometry><sphere radius="0.1"/></geometry></visual>
  </link>
  <gazebo reference="upper"><mu1>0.3</mu1><selfCollide>1</selfCollide></gazebo>
  <transmission name="t"><type>simple</type><joint name="turn"/></transmission>
</robot>
"""


def over(text: str = ARM) -> str:
    return twinform.convert(text.encode(), to="sdf", name="arm.urdf").text


def home(text: str) -> twinform.Conversion:
    return twinform.convert(text.encode(), to="urdf", name="arm.sdf")


def rules(made: twinform.Conversion) -> list[str]:
    return [found.rule.name for found in made.diagnostics]


def test_there_and_back_is_home():
    assert first_difference(twinform.loads(ARM), forget(home(over()).document)) is None


def test_home_again_nothing_is_left_to_say():
    made = home(over())
    assert made.ledger.entries == ()
    assert over(made.text) == over()


def test_what_was_edited_stays_and_the_rest_comes_home():
    made = home(over().replace("<mass>2</mass>", "<mass>7</mass>"))
    expected = ARM.replace('<mass value="2"/>', '<mass value="7"/>')
    assert first_difference(twinform.loads(expected), forget(made.document)) is None
    assert "stale-carrier" not in rules(made)


def test_what_was_added_stays_too():
    sensor = "<sensor name='eye' type='camera'/></link><link name='extra'/><joint name='more' type='fixed'>"
    joint = "<parent>upper</parent><child>extra</child></joint>"
    text = over()
    place = text.rindex("</link>", 0, text.index("<tf:source"))
    made = home(text[:place] + sensor + joint + text[place + len("</link>") :])
    assert [link.name for link in made.document.models[0].links] == ["base", "upper", "extra"]
    assert "eye" in made.text
    assert [visual.name for visual in made.document.models[0].links[1].visuals] == [None, "tip"]


def test_what_no_longer_fits_is_reported_and_left_alone():
    made = home(over().replace("upper", "lower", over()[: over().index("<tf:source")].count("upper")))
    assert "stale-carrier" in rules(made)
    assert [link.name for link in made.document.models[0].links] == ["base", "lower"]
    assert twinform.check(made.text.encode()).accepted


def test_what_was_taken_away_stays_away():
    text = over()
    start, end = text.index('<visual name="tip">'), text.index("</link>", text.index('<visual name="tip">'))
    made = home(text[:start] + text[end:])
    assert [visual.name for visual in made.document.models[0].links[1].visuals] == [None]


def test_without_carriers_nothing_is_remembered():
    assert "tf:" not in twinform.convert(ARM.encode(), to="sdf", carriers=False).text


def test_the_version_of_the_source_comes_home_unless_another_is_asked_for():
    there = twinform.convert(b"<sdf version='1.6'><model name='m'><link name='l'/></model></sdf>", to="urdf").text
    assert twinform.convert(there.encode(), to="sdf").document.version == "1.6"
    assert twinform.convert(there.encode(), to="sdf", sdf_version="1.9").document.version == "1.9"


def test_marks_that_are_no_list_of_what_was_made_are_taken_off_too():
    ball = "<gazebo><joint name='j' type='ball'><parent>base</parent><child>upper</child></joint></gazebo></robot>"
    text = ARM.replace("</robot>", ball)
    assert first_difference(twinform.loads(text), forget(home(over(text)).document)) is None


NO_WAY_BACK = ARM.replace(
    "</robot>",
    "<gazebo><link name='x'><inertial auto='true'/><collision name='c'><geometry><mesh><uri>model://p/m.stl</uri>"
    "</mesh></geometry></collision></link></gazebo></robot>",
)


def test_a_source_without_a_way_back_is_remembered_whole():
    assert first_difference(twinform.loads(NO_WAY_BACK), forget(home(over(NO_WAY_BACK)).document)) is None


def test_a_source_that_is_remembered_whole_is_not_applied_to_an_edited_file():
    with pytest.raises(twinform.CompileError, match="is not found"):
        home(over(NO_WAY_BACK).replace("<mass>2</mass>", "<mass>7</mass>"))


def test_the_ledger_says_what_is_carried_where_home_remembers_something_too():
    text = over()
    place = text.index("<tf:source")
    made = home(text[:place] + "<enable_wind>true</enable_wind><tf:other/>" + text[place:])
    assert "<tf:source" in made.text
    assert made.ledger.entries


def test_what_an_included_model_remembers_is_not_what_the_model_around_it_does(tmp_path: Path):
    (tmp_path / "inner.sdf").write_text(over())
    around = "<sdf version='1.11'><model name='m'><include merge='true'><uri>inner.sdf</uri></include></model></sdf>"
    (tmp_path / "outer.sdf").write_text(around)
    made = twinform.convert(tmp_path / "outer.sdf", to="urdf")
    assert "stale-carrier" not in rules(made)


NAMES = st.sampled_from(["a", "b", "c"])
ATTRIBUTES = st.dictionaries(st.sampled_from(["name", "k", "link"]), NAMES, max_size=2)
TEXTS = st.text(string.ascii_letters, max_size=3)


def _element(tag: str, attributes: dict[str, str], text: str, children: list[XmlElement]) -> XmlElement:
    made = etree.Element(tag, attributes)
    made.text = text
    made.extend(children)
    return made


LEAVES = st.builds(_element, NAMES, ATTRIBUTES, TEXTS, st.just([]))
TREES = st.recursive(
    LEAVES, lambda inside: st.builds(_element, NAMES, ATTRIBUTES, TEXTS, st.lists(inside, max_size=5)), max_leaves=12
)


@given(st.lists(TREES, max_size=6), st.lists(TREES, max_size=6))
def test_the_changes_turn_one_tree_into_the_other(wanted: list[XmlElement], made: list[XmlElement]):
    one, other = _element("root", {"k": "1"}, "", wanted), _element("root", {}, "x", made)
    edits = etree.Element("edits")
    edits.extend(changes(one, other))
    assert apply(edits, other) == []
    assert same(one, other)
    assert digest(one) == digest(other)


def test_attributes_come_back_in_their_order():
    wanted, made = (etree.fromstring(f"<r><a {each}/></r>") for each in ("k='a' link='c' m=''", "m='x' link='c' z='1'"))
    edits = etree.Element("edits")
    edits.extend(changes(wanted, made))
    assert apply(edits, made) == []
    assert etree.tostring(made) == etree.tostring(wanted)


@given(TREES)
def test_nothing_has_to_be_changed_in_a_tree_that_is_the_same(tree: XmlElement):
    assert changes(tree, etree.fromstring(etree.tostring(tree))) == []
