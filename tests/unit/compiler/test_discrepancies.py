"""What counts as the content of a file: two texts each, and all that one lacks of the other."""

import pytest

from tests.unit.compiler.normal_form_snippets import compared, joint, link, robot, sdf, sdf_link
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.normal_form import normal_form

POINTS = "<collision name='c'><geometry><polyline>{}</polyline></geometry></collision>"
POINT = "/sdf/model[@name='m']/link[@name='l']/collision[@name='c']/geometry/polyline/point"
DIFFERENT: dict[str, tuple[str, str, list[str]]] = {
    # missing and added
    "a link that is gone": (
        robot('<link name="a"/><link name="b"/>'),
        robot('<link name="b"/>'),
        ["""missing /robot[@name='r']/link[@name='a'] <link name="a"/>"""],
    ),
    "a link that was made": (
        robot(""),
        robot('<link name="a"/>'),
        ["""added /robot[@name='r']/link[@name='a'] <link name="a"/>"""],
    ),
    "a link of another name": (
        robot('<link name="a"/>'),
        robot('<link name="b"/>'),
        [
            """missing /robot[@name='r']/link[@name='a'] <link name="a"/>""",
            """added /robot[@name='r']/link[@name='b'] <link name="b"/>""",
        ],
    ),
    "a name that was made": (
        link("<visual/><visual/>"),
        link('<visual name="v"/><visual name="w"/>'),
        [
            "added /robot[@name='r']/link[@name='l']/visual[@name='v']/@name 'v'",
            "added /robot[@name='r']/link[@name='l']/visual[@name='w']/@name 'w'",
        ],
    ),
    "a name that is gone": (
        link('<visual name="v"/>'),
        link("<visual/>"),
        ["missing /robot[@name='r']/link[@name='l']/visual[@name='v']/@name 'v'"],
    ),
    "what is in a part that lost its name": (
        link('<visual name="v"><origin y="1"/></visual>'),
        link("<visual><origin/></visual>"),
        [
            "missing /robot[@name='r']/link[@name='l']/visual[@name='v']/@name 'v'",
            """missing /robot[@name='r']/link[@name='l']/visual[@name='v']/origin <origin y="1"/>""",
        ],
    ),
    "a carrier of ours": (
        link(""),
        link('<tf:sdf xmlns:tf="urn:twinform:1"><a/></tf:sdf>'),
        ["left over /robot[@name='r']/link[@name='l']/tf:sdf <sdf>"],
    ),
    "an annotation": (
        link(""),
        link("").replace("<link", '<link xmlns:tf="urn:twinform:1" tf:made="."'),
        ["left over /robot[@name='r']/link[@name='l']/@{urn:twinform:1}made '.'"],
    ),
    "a carrier that the source had": (
        link('<tf:sdf xmlns:tf="urn:twinform:1"/>'),
        link(""),
        ["missing /robot[@name='r']/link[@name='l']/tf:sdf <sdf/>"],
    ),
    "another shape": (
        link('<collision><geometry><box size="1 1 1"/></geometry></collision>'),
        link('<collision><geometry><sphere radius="1"/></geometry></collision>'),
        [
            """missing /robot[@name='r']/link[@name='l']/collision/geometry/box <box size="1 1 1"/>""",
            """added /robot[@name='r']/link[@name='l']/collision/geometry/sphere <sphere radius="1"/>""",
        ],
    ),
    # values
    "a number": (
        joint('<limit lower="1" effort="2" velocity="3"/>'),
        joint('<limit lower="1.000001" effort="2" velocity="3"/>'),
        ["changed /robot[@name='r']/joint[@name='j']/limit/@lower '1' -> '1.000001'"],
    ),
    "a small moment of inertia": (
        link('<inertial><mass value="1"/><inertia ixx="1e-10"/></inertial>'),
        link('<inertial><mass value="1"/><inertia ixx="2e-10"/></inertial>'),
        ["changed /robot[@name='r']/link[@name='l']/inertial/inertia/@ixx '1e-10' -> '2e-10'"],
    ),
    "a number that is none": (
        link('<inertial><mass value="1,5"/></inertial>'),
        link('<inertial><mass value="1.5"/></inertial>'),
        ["changed /robot[@name='r']/link[@name='l']/inertial/mass/@value '1,5' -> '1.5'"],
    ),
    "what is not a number": (
        sdf_link("<inertial><mass>nan</mass></inertial>"),
        sdf_link("<inertial><mass>inf</mass></inertial>"),
        ["changed /sdf/model[@name='m']/link[@name='l']/inertial/mass 'nan' -> 'inf'"],
    ),
    "a value that became the default": (
        joint('<dynamics damping="1" friction="2"/>'),
        joint('<dynamics damping="0" friction="2"/>'),
        ["missing /robot[@name='r']/joint[@name='j']/dynamics/@damping '1'"],
    ),
    "a scheme": (
        link('<visual><geometry><mesh filename="package://a"/></geometry></visual>'),
        link('<visual><geometry><mesh filename="model://a"/></geometry></visual>'),
        ["changed /robot[@name='r']/link[@name='l']/visual/geometry/mesh/@filename 'package://a' -> 'model://a'"],
    ),
    "the case of a name": (robot("").replace('"r"', '"R"'), robot(""), ["changed /robot[@name='R']/@name 'R' -> 'r'"]),
    "blanks in a text": (
        sdf_link('<sensor name="s" type="imu"><topic>a  b</topic></sensor>'),
        sdf_link('<sensor name="s" type="imu"><topic>a b</topic></sensor>'),
        ["changed /sdf/model[@name='m']/link[@name='l']/sensor[@name='s']/topic 'a  b' -> 'a b'"],
    ),
    "a limit at the other end": (
        sdf('<joint name="j" type="revolute"><axis><limit><lower>1e16</lower></limit></axis></joint>'),
        sdf('<joint name="j" type="revolute"/>'),
        ["missing /sdf/model[@name='m']/joint[@name='j']/axis <axis>"],
    ),
    "the version": (sdf("", "1.8"), sdf("", "1.9"), ["changed /sdf/@version '1.8' -> '1.9'"]),
    "another format": (robot(""), sdf(""), ["""changed /robot[@name='r'] <robot name="r"/> -> <sdf version="1.9">"""]),
    # poses
    "a place": (
        sdf_link("<pose>1 0 0 0 0 0</pose>"),
        sdf_link("<pose>1 0 0 0 0 1e-6</pose>"),
        ["changed /sdf/model[@name='m']/link[@name='l']/pose <pose>1 0 0 0 0 0 -> <pose>1 0 0 0 0 1e-6"],
    ),
    "the frame of a place": (
        sdf_link('<pose relative_to="f">1 0 0 0 0 0</pose>'),
        sdf_link("<pose>1 0 0 0 0 0</pose>"),
        ["missing /sdf/model[@name='m']/link[@name='l']/pose/@relative_to 'f'"],
    ),
    "the notation of a turn": (
        sdf_link('<pose degrees="true">0 0 0 0 0 180</pose>'),
        sdf_link("<pose>0 0 0 0 0 3.141592653589793</pose>"),
        ["missing /sdf/model[@name='m']/link[@name='l']/pose/@degrees 'true'"],
    ),
    "a quaternion of URDF": (
        joint('<origin quat_xyzw="0 0 1 0"/>'),
        joint('<origin rpy="0 0 3.141592653589793"/>'),
        ["missing /robot[@name='r']/joint[@name='j']/origin/@quat_xyzw '0 0 1 0'"],
    ),
    "an origin that is none at all": (
        joint('<origin xyz="a b c"/>'),
        joint(""),
        ["""missing /robot[@name='r']/joint[@name='j']/origin <origin xyz="a b c"/>"""],
    ),
    # presence
    "an empty collision": (
        sdf_link('<collision name="c"/>'),
        sdf_link(""),
        ["""missing /sdf/model[@name='m']/link[@name='l']/collision[@name='c'] <collision name="c"/>"""],
    ),
    "a material without a word": (
        sdf_link('<visual name="v"><material><ambient>0 0 0 1</ambient></material></visual>'),
        sdf_link('<visual name="v"/>'),
        ["missing /sdf/model[@name='m']/link[@name='l']/visual[@name='v']/material <material>"],
    ),
    "a material without a name": (
        link('<visual><material name=""><color rgba="1 1 1 1"/></material></visual>'),
        link('<visual><material><color rgba="1 1 1 1"/></material></visual>'),
        ["missing /robot[@name='r']/link[@name='l']/visual/material[@name='']/@name ''"],
    ),
    "a limit of URDF 1.2": (
        joint("<limit/>").replace('"r"', '"r" version="1.2"'),
        joint("").replace('"r"', '"r" version="1.2"'),
        ["missing /robot[@name='r']/joint[@name='j']/limit <limit/>"],
    ),
    "the default of another version": (
        sdf_link(
            '<collision name="c"><surface><friction><ode><mu>1</mu></ode></friction></surface></collision>', "1.3"
        ),
        sdf_link('<collision name="c"/>', "1.3"),
        ["missing /sdf/model[@name='m']/link[@name='l']/collision[@name='c']/surface <surface>"],
    ),
    "an element twice": (
        joint('<origin xyz="1 0 0"/><origin xyz="2 0 0"/>'),
        joint('<origin xyz="1 0 0"/>'),
        ["""missing /robot[@name='r']/joint[@name='j']/origin[2] <origin xyz="2 0 0"/>"""],
    ),
    # order
    "the order of points": (
        sdf_link(POINTS.format("<point>2 2</point><point>1 1</point>")),
        sdf_link(POINTS.format("<point>1 1</point><point>2 2</point>")),
        [f"changed {POINT}[1] '2 2' -> '1 1'", f"changed {POINT}[2] '1 1' -> '2 2'"],
    ),
    "the link that comes first in SDF": (
        sdf('<link name="a"/><link name="b"/><link name="c"/>'),
        sdf('<link name="b"/><link name="a"/><link name="c"/>'),
        ["changed /sdf/model[@name='m']/@canonical_link 'a' -> 'b'"],
    ),
    "the order in a plugin": (
        sdf('<plugin name="p" filename="f"><a/><b>x</b></plugin>'),
        sdf('<plugin name="p" filename="f"><b>x</b><a/></plugin>'),
        ["order /sdf/model[@name='m']/plugin[@name='p']/a <a/> -> <b>x"],
    ),
    # what no table knows
    "a number that only others know": (
        sdf('<plugin name="p" filename="f"><a>1.0</a></plugin>'),
        sdf('<plugin name="p" filename="f"><a>1</a></plugin>'),
        ["changed /sdf/model[@name='m']/plugin[@name='p']/a '1.0' -> '1'"],
    ),
    "an attribute that nobody knows": (
        link("").replace("<link", '<link color="red  hot"'),
        link("").replace("<link", '<link color="red"'),
        ["changed /robot[@name='r']/link[@name='l']/@color 'red  hot' -> 'red'"],
    ),
    "an element that nobody knows": (
        link("<x>a<y/>b</x>"),
        link("<x>a<y/>c</x>"),
        ["changed /robot[@name='r']/link[@name='l']/x 'a b' -> 'a c'"],
    ),
    "a namespace of others": (
        link('<p:x xmlns:p="urn:a"/>'),
        link('<p:x xmlns:p="urn:b"/>'),
        ["missing /robot[@name='r']/link[@name='l']/p:x <x/>", "added /robot[@name='r']/link[@name='l']/p:x <x/>"],
    ),
    "text that is in the way": (link("stray"), link(""), ["missing /robot[@name='r']/link[@name='l'] 'stray'"]),
    # <gazebo>
    "a tag of an extension": (
        robot('<gazebo reference="l"><mu1>3</mu1></gazebo>'),
        robot('<gazebo reference="l"><mu2>3</mu2></gazebo>'),
        ["missing /robot[@name='r']/gazebo/mu1 <mu1>3", "added /robot[@name='r']/gazebo/mu2 <mu2>3"],
    ),
    "another word for the other truth": (
        robot('<gazebo reference="l"><turnGravityOff>true</turnGravityOff></gazebo>'),
        robot('<gazebo reference="l"><gravity>true</gravity></gazebo>'),
        ["changed /robot[@name='r']/gazebo/turnGravityOff 'true' -> 'true'"],
    ),
    "an extension of another link": (
        robot('<gazebo reference="a"><mu1>3</mu1></gazebo>'),
        robot('<gazebo reference="b"><mu1>3</mu1></gazebo>'),
        [
            """missing /robot[@name='r']/gazebo <gazebo reference="a">""",
            """added /robot[@name='r']/gazebo <gazebo reference="b">""",
        ],
    ),
    "a word that is no truth": (
        robot('<gazebo reference="l"><mu1>slippery</mu1></gazebo>'),
        robot('<gazebo reference="l"><mu1>3</mu1></gazebo>'),
        ["changed /robot[@name='r']/gazebo/mu1 'slippery' -> '3'"],
    ),
    "a tag twice": (
        robot('<gazebo reference="l"><mu1>3</mu1><mu1>2</mu1></gazebo>'),
        robot('<gazebo reference="l"><mu1>2</mu1></gazebo>'),
        ["changed /robot[@name='r']/gazebo/mu1[1] '3' -> '2'", "missing /robot[@name='r']/gazebo/mu1[2] <mu1>2"],
    ),
    "a tag and what it means, with another value": (
        robot('<gazebo reference="j"><stopErp>0.3</stopErp></gazebo>'),
        robot('<gazebo reference="j"><physics><ode><limit><erp>0.4</erp></limit></ode></physics></gazebo>'),
        ["changed /robot[@name='r']/gazebo/stopErp '0.3' -> '0.4'"],
    ),
    "one of two elements for all visuals": (
        robot(
            '<gazebo reference="l"><visual><transparency>0.5</transparency></visual>'
            '<visual><transparency>0.6</transparency><plugin name="p" filename="f"/></visual></gazebo>'
        ),
        robot('<gazebo reference="l"><visual><transparency>0.5</transparency></visual></gazebo>'),
        [
            "missing /robot[@name='r']/gazebo/visual[2]/transparency <transparency>0.6",
            "missing /robot[@name='r']/gazebo/visual[2]/plugin[@name='p'] <plugin name=\"p\" filename=\"f\"/>",
        ],
    ),
    "another number for one of the two dampings": (
        robot('<gazebo reference="l"><dampingFactor>0.1</dampingFactor></gazebo>'),
        robot('<gazebo reference="l"><velocity_decay><linear>0.1</linear></velocity_decay></gazebo>'),
        ["missing /robot[@name='r']/gazebo/dampingFactor <dampingFactor>0.1"],
    ),
    "a pose that is none, where there was one of zeros": (
        sdf_link("<pose>0 0 0 0 0 0</pose>"),
        sdf_link("<pose>x1y</pose>"),
        ["added /sdf/model[@name='m']/link[@name='l']/pose <pose>x1y"],
    ),
}


@pytest.mark.parametrize("case", DIFFERENT)
def test_what_is_not_written_alike_is_found(case: str) -> None:
    source, back, expected = DIFFERENT[case]
    assert compared(source, back) == expected
    assert len(compared(back, source)) == len(expected)
    assert compared(source, source) == []


def test_a_discrepancy_is_printed_with_its_place() -> None:
    source, back = robot('\n<link name="a"/>\n<link name="b"/>'), robot('<link name="c"/>\n<link name="b" x="1"/>')
    forms = [normal_form(text.encode(), name=name) for text, name in ((source, "a.urdf"), (back, "b.urdf"))]
    assert [each.message for each in forms[0].compare(forms[1])] == [
        """a.urdf:2: /robot[@name='r']/link[@name='a']: <link name="a"/> is not back""",
        "b.urdf:2: /robot[@name='r']/link[@name='b']/@x: '1' was not in the source",
        """b.urdf:1: /robot[@name='r']/link[@name='c']: <link name="c"/> was not in the source""",
    ]


@pytest.mark.parametrize("text", [b"", b"<robot", b"<model/>", b"{}"])
def test_what_is_no_model_has_no_normal_form(text: bytes) -> None:
    with pytest.raises(CompileError) as raised:
        normal_form(text)
    assert raised.value.diagnostics


@pytest.mark.parametrize(("tag", "depth"), [("model", 63), ("plugin", 250), ("x", 250)])
def test_what_is_nested_as_deep_as_it_may_be_is_compared(tag: str, depth: int) -> None:
    source = sdf(f'<{tag} name="n">' * depth + f"</{tag}>" * depth)
    changed = source.replace("><", ' kind="k"><', depth).replace(' kind="k"><', "><", depth - 1)
    assert len(compared(source, changed)) == 1
