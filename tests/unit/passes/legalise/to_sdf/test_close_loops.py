"""Loops that other readers close in URDF: which of them SDF has joints for, and what becomes of an edited one."""

from pathlib import Path

import pytest

import twinform
from tests.snippets import INERTIAL

_CASE = Path(__file__).parents[4] / "cases/convert/closed_loops.urdf"
_ROBOT = f"""<robot xmlns:drake="http://drake.mit.edu" name="r">
<link name="a">{INERTIAL}</link><link name="b">{INERTIAL}</link><link name="c">{INERTIAL}</link>
<joint name="ab" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
<joint name="ac" type="continuous"><parent link="a"/><child link="c"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
{{}}</robot>"""
_PIN = '<loop_joint name="pin" type="spherical"><link1 link="b" xyz="1 0 0"/><link2 link="c"/></loop_joint>'

_BALL = """<drake:ball_constraint><drake:ball_constraint_body_A name="b"/><drake:ball_constraint_p_AP value="1 0 0"/>
<drake:ball_constraint_body_B name="{}"/><drake:ball_constraint_p_BQ value="0 0 0"/></drake:ball_constraint>"""


def _sdf(loop: str) -> twinform.Conversion:
    return twinform.convert(_ROBOT.format(loop).encode(), to="sdf")


def test_what_sdf_has_no_joint_for_is_said_and_carried() -> None:
    found = [each.message for each in twinform.convert(_CASE, to="sdf").diagnostics if each.rule.name == "open-loop"]
    assert found == [
        "<loop_joint> 'open' closes no loop in SDF: its ends are 0.1 m apart where all joints are at zero",
        "<loop_joint> 'floating' closes no loop in SDF: its type is 'floating'",
        "<loop_joint> 'still' closes no loop in SDF: its ends are turned by 1.57 rad where all joints are at zero",
        "<loop_joint> 'more' closes no loop in SDF: it says more than such a joint has",
    ]


@pytest.mark.parametrize(
    ("loop", "why"),
    [
        ("<constraint name='k' type='revolute'><parent link='b'/><child link='c'/></constraint>", "1 m apart"),
        (_PIN.replace("spherical", "screw"), "its type is 'screw'"),
        (_PIN.replace("1 0 0", "1 0 0 0"), "numbers that are none"),
        (_PIN.replace("1 0 0", "nan 0 0"), "numbers that are none"),
        (_PIN.replace("spherical", "revolute").replace("</", "<axis xyz='0 0 0'/></", 1), "points nowhere"),
        (_PIN.replace("<link1", "<link2 link='c'/><link1"), "says more"),
        (_PIN.replace("type=", "quiet='1' type="), "says more"),
        (_BALL.format("world"), "on no link"),
    ],
)
def test_other_loops_stay_open(loop: str, why: str) -> None:
    found = [each.message for each in _sdf(loop).diagnostics if each.rule.name == "open-loop"]
    assert len(found) == 1
    assert why in found[0]


def test_loops_between_links_that_are_fixed_to_each_other_stay_open() -> None:
    text = _ROBOT.replace("continuous", "fixed").format(_PIN)
    found = twinform.convert(text.encode(), to="sdf").diagnostics
    assert any("fixed to each other" in each.message for each in found)


def test_without_carriers_a_joint_is_a_joint_and_the_rest_is_dropped() -> None:
    made = twinform.convert(_CASE, to="sdf", carriers=False)
    assert '<joint name="pin" type="ball">' in made.text
    assert "urn:twinform" not in made.text
    dropped = [each for each in made.ledger.entries if each.rule.name == "open-loop"]
    assert [each.fate.value for each in dropped] == ["dropped"] * 4


def test_a_moved_joint_moves_both_ends() -> None:
    sdf = _sdf(_PIN).text
    moved = sdf.replace('<joint name="pin" type="ball">', '<joint name="pin" type="ball"><pose>0 0.5 0 0 0 0</pose>')
    back = twinform.convert(moved.encode(), to="urdf").text
    assert '<link1 link="b" xyz="1 0.5 0"/>' in back
    assert '<link2 link="c" xyz="0 0.5 0"/>' in back


def test_a_moved_link_moves_the_end_that_is_not_on_it() -> None:
    sdf = _sdf(_PIN).text
    back = twinform.convert(sdf.replace(">1 0 0 0 0 0<", ">3 0 0 0 0 0<").encode(), to="urdf").text
    assert '<link1 link="b" xyz="3 0 0"/>' in back


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('type="ball">', 'type="screw"><axis><xyz>0 0 1</xyz></axis><screw_thread_pitch>1</screw_thread_pitch>'),
        ("<parent>b", "<axis><xyz>0 0 1</xyz><dynamics><damping>1</damping></dynamics></axis><parent>b"),
        ('as="loop_joint"', 'as="joint"'),
        ('as="loop_joint"', 'as="loop_joint" xyz="nan 0 0"'),
        ('as="loop_joint"', 'as="drake:ball_constraint" xyz="1"'),
    ],
)
def test_what_the_element_could_not_say_is_a_joint_for_gazebo(old: str, new: str) -> None:
    sdf = _sdf(_PIN).text
    head, _, joint = sdf.partition('<joint name="pin"')
    back = twinform.convert(f'{head}<joint name="pin"{joint.replace(old, new, 1)}'.encode(), to="urdf").text
    assert "<loop_joint" not in back
    assert '<joint name="pin"' in back.partition("<gazebo>")[2]


def test_what_nothing_else_holds_hangs_from_the_joint() -> None:
    sdf = _sdf(_PIN).text
    start = sdf.index('<joint name="ac"')
    cut = sdf[:start] + sdf[sdf.index("</joint>", start) + len("</joint>") :]
    back = twinform.convert(cut.replace(' relative_to="ac"', "").encode(), to="urdf")
    assert "<loop_joint" not in back.text
    assert [each.name for each in back.document.models[0].joints][-1] == "pin"
    assert [each.message for each in twinform.check(back.text.encode()).diagnostics if each.is_error] == []


def test_loops_of_a_robot_that_came_from_sdf_are_not_annotated() -> None:
    sdf = "<sdf version='1.9'><model name='m'><link name='a'/><link name='b'/><joint name='j' type='fixed'><parent>a"
    urdf = twinform.convert(f"{sdf}</parent><child>b</child></joint></model></sdf>".encode(), to="urdf").text
    loop = _PIN.replace('"b"', '"a"').replace('"c"', '"b"').replace("1 0 0", "0 0 0")
    edited = urdf.replace('type="fixed"', 'type="continuous"').replace("</robot>", f"{loop}</robot>")
    assert "tf:extension" not in twinform.convert(edited.encode(), to="sdf").text


def test_two_equal_loops_are_two_joints() -> None:
    made = _sdf(_BALL.format("c") * 2)
    assert [each.name for each in made.document.models[0].joints][-2:] == ["b_c_loop", "b_c_loop_1"]
    back = twinform.convert(made.text.encode(), to="urdf").text
    assert back.count("<drake:ball_constraint>") == 2


def test_a_loop_that_was_carried_goes_with_its_link() -> None:
    sdf = _sdf(_PIN.replace("1 0 0", "5 0 0")).text
    start = sdf.index('<link name="c"')
    bare = sdf[:start] + sdf[sdf.index("</link>", start) + len("</link>") :]
    start = bare.index('<joint name="ac"')
    bare = bare[:start] + bare[bare.index("</joint>", start) + len("</joint>") :]
    back = twinform.convert(bare.encode(), to="urdf")
    assert "<loop_joint" not in back.text
    assert [each.message for each in back.diagnostics if each.rule.name == "stale-carrier"] == [
        "<loop_joint> of model 'r' is not restored: there is no link 'c'"
    ]


_SECOND = '<joint name="bc" type="fixed"><parent link="b"/><child link="c"/><origin xyz="{} 0 0"/></joint>'


def test_a_second_parent_closes_a_loop_where_both_have_the_link_in_one_place() -> None:
    made = _sdf(_SECOND.format(1))
    assert [each.name for each in made.document.models[0].joints] == ["ab", "ac", "bc"]
    back = twinform.convert(made.text.encode(), to="urdf")
    assert '<joint name="bc" type="fixed">' in back.text.partition("<gazebo>")[2]
    assert twinform.diff(_ROBOT.format(_SECOND.format(1)).encode(), back.text.encode(), carriers=True).same


def test_a_second_parent_that_has_the_link_elsewhere_is_carried() -> None:
    text = _ROBOT.format(_SECOND.format(2))
    made = _sdf(_SECOND.format(2))
    assert [each.name for each in made.document.models[0].joints] == ["ab", "ac"]
    back = twinform.convert(made.text.encode(), to="urdf").text
    assert list(twinform.normal_form(text.encode()).compare(twinform.normal_form(back.encode()))) == []


def test_joints_that_go_round_are_no_robot() -> None:
    loop = '<joint name="ca" type="fixed"><parent link="c"/><child link="b"/></joint>'
    back = '<joint name="bc" type="fixed"><parent link="b"/><child link="c"/></joint>'
    with pytest.raises(twinform.CompileError) as refused:
        _sdf(loop + back)
    assert {each.rule.name for each in refused.value.diagnostics if each.is_error} == {"two-parents"}
