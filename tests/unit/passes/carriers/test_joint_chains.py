"""Joints of SDF that URDF does not have: chains there, and the same joints again here."""

import math

import pytest

import twinform
from twinform.compiler import Conversion
from twinform.diagnostics import Fate
from twinform.ir import Joint, Model
from twinform.passes.carriers.annotations import SYNTHESIZED, is_annotation
from twinform.passes.carriers.joint_chains import CHAIN, PART
from twinform.passes.carriers.token_mass import CHAIN_TOKEN

ROBOT = """<sdf version='1.11'><model name='m'>
<link name='a'/><link name='b'><pose>1 0 2 0.1 0.2 0.3</pose></link><link name='c'><pose>0 0 3 0 0 0</pose></link>
<joint name='j' type='{}'><pose>0 0 0.5 0 0 0</pose><parent>a</parent><child>b</child>{}</joint>
<joint name='k' type='revolute'><parent>b</parent><child>c</child><axis><xyz>0 1 0</xyz>{}</axis></joint>
</model></sdf>"""

TWO_AXES = """
<axis><xyz>1 0 0</xyz><dynamics><damping>0.5</damping><spring_stiffness>4</spring_stiffness></dynamics>
<limit><lower>-1</lower><upper>2</upper><effort>3</effort><velocity>4</velocity></limit></axis>
<axis2><xyz>0 0.6 0.8</xyz><limit><lower>-0.5</lower><upper>0.25</upper><effort>5</effort><velocity>6</velocity></limit>
</axis2>"""
MIMICS = """<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz>
<mimic joint='k'><multiplier>2</multiplier><offset>0.25</offset><reference>0.5</reference></mimic></axis2>"""
DAMPED = "<axis><xyz>0 1 0</xyz><dynamics><damping>0.25</damping></dynamics></axis>"
Z = "<axis><xyz>0 0 1</xyz></axis>"
PHYSICS = "<physics><ode><cfm_damping>1</cfm_damping></ode></physics>"
SENSOR = "<sensor name='ft' type='force_torque'><update_rate>30</update_rate></sensor>"

JOINTS = [
    ("universal", TWO_AXES),
    ("universal", TWO_AXES + PHYSICS + SENSOR),
    ("universal", MIMICS),
    ("revolute2", TWO_AXES),
    ("revolute2", "<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 0 1</xyz></axis2>"),
    ("ball", ""),
    ("ball", DAMPED),
    ("screw", Z + "<screw_thread_pitch>0.25</screw_thread_pitch>"),
    ("screw", Z + "<thread_pitch>-12.566</thread_pitch>"),
    ("screw", Z + "<thread_pitch>7</thread_pitch><screw_thread_pitch>0.5</screw_thread_pitch>"),
    ("screw", Z),
]


def there(kind: str, inside: str, mimic: str = "", *, carriers: bool = True) -> Conversion:
    return twinform.convert(ROBOT.format(kind, inside, mimic).encode(), to="urdf", carriers=carriers)


def back(urdf: str) -> Conversion:
    return twinform.convert(urdf.encode(), to="sdf")


def robot(text: str) -> Model:
    return twinform.loads(text).models[0]


def rules(made: Conversion) -> list[str]:
    return [each.rule.name for each in made.diagnostics]


def the(name: str, model: Model) -> Joint:
    return next(joint for joint in model.joints if joint.name == name)


@pytest.mark.parametrize(
    ("kind", "inside", "expected"),
    [
        ("universal", TWO_AXES, [("j_axis", "revolute", "a"), ("j", "revolute", "j_axis_link")]),
        ("revolute2", "", [("j_axis", "continuous", "a"), ("j", "continuous", "j_axis_link")]),
        ("screw", Z, [("j_slide", "prismatic", "a"), ("j", "continuous", "j_slide_link")]),
        (
            "ball",
            "",
            [("j_z", "continuous", "a"), ("j_y", "continuous", "j_z_link"), ("j", "continuous", "j_y_link")],
        ),
    ],
)
def test_a_joint_becomes_a_chain_whose_last_joint_has_its_name(
    kind: str, inside: str, expected: list[tuple[str, str, str]]
):
    made = there(kind, inside)
    chain = [joint for joint in robot(made.text).joints if joint.name != "k"]
    assert [(joint.name, joint.type, joint.parent) for joint in chain] == expected
    assert chain[-1].child == "b"
    assert rules(made) == ["unfolded-joint"] or "missing-axis" in rules(made)


@pytest.mark.parametrize("kind", ["revolute", "prismatic", "fixed"])
def test_a_joint_that_urdf_has_stays_one(kind: str):
    made = there(kind, Z)
    assert [joint.name for joint in robot(made.text).joints] == ["j", "k"]
    assert "unfolded-joint" not in rules(made)


@pytest.mark.parametrize("kind", ["universal", "revolute2", "ball", "screw"])
def test_the_links_between_have_next_to_no_mass(kind: str):
    links = robot(there(kind, TWO_AXES if kind != "ball" else "").text).links
    assert [each.inertial for each in links if each.name.startswith("j_")] == [CHAIN_TOKEN] * (1 + (kind == "ball"))


@pytest.mark.parametrize(
    ("pitch", "metres_per_radian"),
    [
        ("<screw_thread_pitch>0.5</screw_thread_pitch>", 0.5 / math.tau),
        ("<screw_thread_pitch>-0.5</screw_thread_pitch>", -0.5 / math.tau),
        ("<thread_pitch>20</thread_pitch>", -0.05),
        ("<thread_pitch>-20</thread_pitch>", 0.05),
        ("<screw_thread_pitch>0.5</screw_thread_pitch><thread_pitch>20</thread_pitch>", 0.5 / math.tau),
        ("", 1 / math.tau),
    ],
)
def test_a_screw_slides_by_its_pitch(pitch: str, metres_per_radian: float):
    slide = the("j_slide", robot(there("screw", Z + pitch).text))
    assert slide.axis
    assert slide.axis.mimic
    assert (slide.axis.mimic.joint, slide.axis.mimic.multiplier) == ("j", pytest.approx(metres_per_radian))


def test_the_limits_of_a_screw_are_those_of_both_joints():
    limit = "<limit><lower>-1</lower><upper>3</upper><velocity>2</velocity></limit>"
    axis = f"<axis><xyz>0 0 1</xyz>{limit}</axis><thread_pitch>10</thread_pitch>"
    slide = the("j_slide", robot(there("screw", axis).text)).axis
    assert slide
    assert slide.limit
    assert (slide.limit.lower, slide.limit.upper) == (pytest.approx(-0.3), pytest.approx(0.1))
    assert slide.limit.velocity == pytest.approx(0.2)


def test_a_screw_that_moves_infinitely_far_is_an_error():
    with pytest.raises(twinform.CompileError) as caught:
        there("screw", Z + "<thread_pitch>0</thread_pitch>")
    assert [each.rule.name for each in caught.value.diagnostics if each.is_error] == ["joint-type-unsupported"]


def test_the_angles_of_a_ball_are_approximate_and_the_ledger_has_why():
    entries = there("ball", DAMPED).ledger.entries
    assert [entry.message for entry in entries if entry.fate is Fate.APPROXIMATED] == [
        "2 links between the joints of 'j', of 2e-06 kg",
        "where the second of the three joints of 'j' is at 90 deg, the others turn about one axis",
    ]


@pytest.mark.parametrize(("kind", "inside"), JOINTS)
def test_a_chain_becomes_the_joint_that_it_was(kind: str, inside: str):
    source = robot(ROBOT.format(kind, inside, ""))
    made = back(there(kind, inside).text)
    again = robot(made.text)
    assert rules(made) == []
    assert [joint.name for joint in again.joints] == ["j", "k"]
    assert [link.name for link in again.links] == ["a", "b", "c"]
    for field in ("type", "parent", "child", "axis", "axis2", "thread_pitch", "screw_thread_pitch", "sensors"):
        assert getattr(again.joints[0], field) == getattr(source.joints[0], field)
    assert "physics" not in inside or any(part.name == "<physics>" for part in again.joints[0].opaque)


@pytest.mark.parametrize(
    ("axis", "leader"), [("axis='axis2'", "j"), ("axis='axis'", "j_axis"), ("", "j_axis")], ids=str
)
def test_who_mimics_an_axis_mimics_its_joint_in_the_chain(axis: str, leader: str):
    mimic = f"<mimic joint='j' {axis}><multiplier>2</multiplier></mimic>"
    urdf = there("universal", TWO_AXES, mimic).text
    follower = the("k", robot(urdf)).axis
    assert follower
    assert follower.mimic
    assert follower.mimic.joint == leader
    again = the("k", robot(back(urdf).text)).axis
    assert again
    assert again.mimic
    assert (again.mimic.joint, again.mimic.axis == "axis2") == ("j", leader == "j")


EDITS = [
    ("universal", TWO_AXES, '<parent link="j_axis_link"/>', '<parent link="j_axis_link"/><origin xyz="0 0 1"/>'),
    (
        "universal",
        TWO_AXES,
        '<link name="j_axis_link">',
        '<link name="j_axis_link"><inertial><mass value="1"/></inertial>',
    ),
    ("universal", TWO_AXES, 'type="revolute"', 'type="prismatic"'),
    ("universal", TWO_AXES, '<tf:chain type="universal"/>', '<tf:chain type="piston"/>'),
    ("universal", TWO_AXES, '<tf:part joint="j"/>', '<tf:part joint="k"/>'),
    ("universal", TWO_AXES, '<tf:part joint="j"/>', ""),
    ("ball", "", '<axis xyz="0 1 0"/>', '<axis xyz="0 1 1"/>'),
    ("ball", DAMPED, '<dynamics damping="0.25"/>', '<dynamics damping="0.5"/>'),
    ("screw", Z, '<mimic joint="j" ', '<mimic joint="k" '),
    ("screw", Z, "<mimic ", '<mimic offset="1" '),
    ("screw", Z, '<axis xyz="0 0 1"/>', '<axis xyz="0 1 0"/>'),
    ("ball", DAMPED, "<damping>0.25</damping>", "<damping>a lot</damping>"),
    ("universal", MIMICS, '<tf:mimic reference="0.5"/>', '<tf:mimic reference="half"/>'),
]


@pytest.mark.parametrize(("kind", "inside", "old", "new"), EDITS)
def test_an_edited_chain_stays_as_it_stands(kind: str, inside: str, old: str, new: str):
    urdf = there(kind, inside).text
    assert old in urdf
    made = back(urdf.replace(old, new, 1))
    assert "stale-carrier" in rules(made)
    again = robot(made.text)
    assert len(again.joints) == (4 if kind == "ball" else 3)
    parts = [part for node in (*again.links, *again.joints) for part in node.opaque]
    assert not [
        part
        for part in parts
        if is_annotation(part, PART) or is_annotation(part, CHAIN) or is_annotation(part, SYNTHESIZED)
    ]


@pytest.mark.parametrize(
    ("kind", "inside", "old", "new", "why"),
    [
        (*EDITS[0], "joint 'j' is not at the place of the others"),
        (*EDITS[1], "link 'j_axis_link' has a body"),
        (*EDITS[2], "joint 'j_axis' does not turn"),
        (*EDITS[4], "the parent of 'j' is not part of the chain"),
        (*EDITS[5], "the parent of 'j' is not part of the chain"),
        (*EDITS[6], "joint 'j_y' does not turn freely about (0.0, 1.0, 0.0)"),
        (*EDITS[7], "its joints differ in damping"),
        (*EDITS[8], "joint 'j_slide' does not follow 'j'"),
        (*EDITS[9], "joint 'j_slide' does not follow 'j'"),
        (*EDITS[10], "it slides along another axis than it turns about"),
        (*EDITS[11], "<damping> is 'a lot'; expected a number"),
        (*EDITS[12], "joint 'j' no longer mimics as it did"),
        (
            "universal",
            TWO_AXES,
            '<limit lower="-1"',
            '<limit jerk="1" lower="-1"',
            "joint 'j_axis' has limits that SDF does not have",
        ),
        (
            "universal",
            TWO_AXES,
            '<limit lower="-0.5"',
            '<limit jerk="1" lower="-0.5"',
            "joint 'j' has limits that SDF does not have",
        ),
        (
            "universal",
            TWO_AXES,
            "</robot>",
            '<link name="x"/><joint name="y" type="ball"><parent link="j_axis_link"/><child link="x"/></joint></robot>',
            "joint 'y' is attached to one of its links",
        ),
    ],
)
def test_what_was_edited_is_reported(kind: str, inside: str, old: str, new: str, why: str) -> None:
    urdf = there(kind, inside).text.replace("<robot ", '<robot version="1.2" ')
    assert old in urdf
    made = back(urdf.replace(old, new, 1))
    messages = [each.message for each in made.diagnostics if (each.rule.name, each.found) == ("stale-carrier", "j")]
    assert messages == [f"joint 'j' was {kind}, and the chain that it became has changed: {why}"]


def test_a_part_that_was_given_a_name_is_one_joint_and_a_warning():
    made = back(there("ball", "").text.replace('name="j_y"', 'name="elbow"'))
    assert the("j", robot(made.text)).type == "ball"
    assert [each.found for each in made.diagnostics if each.rule.name == "stale-carrier"] == ["elbow"]
    assert "elbow" in next(each.message for each in made.diagnostics)


def test_a_limit_that_was_edited_is_the_limit_of_the_axis():
    urdf = there("universal", TWO_AXES).text
    made = robot(back(urdf.replace('lower="-1"', 'lower="-1.25"')).text).joints[0]
    assert made.type == "universal"
    assert made.axis
    assert made.axis.limit
    assert made.axis.limit.lower == -1.25


def test_a_multiplier_that_was_edited_is_another_pitch():
    urdf = there("screw", Z + "<thread_pitch>-20</thread_pitch>").text
    made = robot(back(urdf.replace('multiplier="0.05"', 'multiplier="0.1"')).text).joints[0]
    assert (made.type, made.thread_pitch) == ("screw", None)
    assert made.screw_thread_pitch == pytest.approx(0.1 * math.tau)


@pytest.mark.parametrize(("kind", "inside"), JOINTS)
def test_without_carriers_a_chain_stays_a_chain(kind: str, inside: str):
    urdf = there(kind, inside, carriers=False).text
    assert "twinform" not in urdf
    made = back(urdf)
    assert len(robot(made.text).joints) == (4 if kind == "ball" else 3)
    assert "stale-carrier" not in rules(made)


def test_a_joint_that_closes_a_loop_stays_one_joint():
    loop = "</axis></joint><joint name='l' type='ball'><parent>a</parent><child>c</child></joint><frame name='f'"
    text = ROBOT.format("revolute", Z, "").replace("</axis></joint>\n</model>", f"{loop}/></model>")
    made = twinform.convert(text.encode(), to="urdf")
    assert "cut-loop" in rules(made)
    assert '<joint name="l" type="ball">' in made.text
    assert the("l", robot(back(made.text).text)).type == "ball"


@pytest.mark.parametrize("kind", ["spherical", "ball"])
def test_a_ball_joint_of_a_dialect_of_urdf_comes_back(kind: str):
    body = "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
    urdf = f"""<robot name='r'><link name='a'>{body}</link><link name='b'>{body}</link>
    <joint name='j' type='{kind}'><parent link='a'/><child link='b'/><dynamics damping='0.1'/></joint></robot>"""
    sdf = back(urdf).text
    assert robot(sdf).joints[0].type == "ball"
    again = robot(twinform.convert(sdf.encode(), to="urdf").text).joints
    assert [(joint.name, joint.type) for joint in again] == [("j", kind)]
