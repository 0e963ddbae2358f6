"""Gearboxes of SDF: a mimic in URDF where two joints turn as they say, and gearboxes again in SDF."""

from math import pi

import pytest

import twinform
from twinform.compiler import Conversion
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Axis, Joint, Link, Mimic, Model, Pose
from twinform.ir.frames import FrameGraph
from twinform.ir.node import Vector3
from twinform.passes.carriers.annotations import annotate_synthesized, find_annotation, with_annotation
from twinform.passes.legalise.gearboxes import FoldGearboxes
from twinform.passes.shared.joint_ends import GEARED, Relation, UngearedError, relation

ROBOT = """<sdf version='1.11'><model name='m'><link name='body'/><link name='motor'/>
<link name='wheel'><pose>0 0 1 0.3 0 0</pose></link>
<joint name='drive' type='{first}'><parent>{top}</parent><child>{bottom}</child>
  <axis><xyz>0 {drive} 0</xyz>{mimic}</axis></joint>
<joint name='axle' type='revolute'><parent>body</parent><child>wheel</child>
  <axis><xyz expressed_in='__model__'>{axle}</xyz></axis></joint>
<joint name='gears' type='gearbox'><parent>motor</parent><child>wheel</child>
  <gearbox_ratio>4</gearbox_ratio>{reference}
  <axis><xyz expressed_in='__model__'>0 1 0</xyz></axis><axis2><xyz expressed_in='__model__'>0 1 0</xyz></axis2></joint>
</model></sdf>"""
USUAL = {
    "first": "revolute",
    "top": "body",
    "bottom": "motor",
    "drive": "1",
    "axle": "0 1 0",
    "mimic": "",
    "reference": "<gearbox_reference_body>body</gearbox_reference_body>",
}


def there(**changed: str) -> Conversion:
    return twinform.convert(ROBOT.format(**{**USUAL, **changed}).encode(), to="urdf")


def back(urdf: str) -> Conversion:
    return twinform.convert(urdf.encode(), to="sdf")


def joints(made: Conversion) -> dict[str, Joint]:
    return {joint.name: joint for joint in twinform.loads(made.text).models[0].joints}


def mimics(made: Conversion) -> dict[str, Mimic]:
    return {name: joint.axis.mimic for name, joint in joints(made).items() if joint.axis and joint.axis.mimic}


def rules(made: Conversion) -> list[tuple[str, str]]:
    return [(each.rule.name, str(each.severity)) for each in made.diagnostics]


@pytest.mark.parametrize(
    ("changed", "multiplier"),
    [
        ({}, -4.0),
        ({"axle": "0 -1 0"}, 4.0),
        ({"drive": "-1"}, 4.0),
        ({"drive": "-1", "axle": "0 -1 0"}, -4.0),
        ({"top": "motor", "bottom": "body"}, 4.0),
    ],
)
def test_the_joint_of_the_child_mimics_that_of_the_parent(changed: dict[str, str], multiplier: float):
    made = there(**changed)
    assert mimics(made) == {"axle": Mimic(joint="drive", multiplier=multiplier)}
    assert rules(made)[-1] == ("gearbox", "info")
    assert '<joint name="gears" type="gearbox">' in made.text


@pytest.mark.parametrize(
    ("changed", "reason"),
    [
        ({"reference": ""}, "no reference body"),
        ({"reference": "<gearbox_reference_body>motor</gearbox_reference_body>"}, "no joint turns"),
        ({"axle": "1 0 0"}, "another axis"),
        ({"first": "prismatic"}, "no joint turns"),
        ({"mimic": "<mimic joint='axle'><multiplier>1</multiplier></mimic>"}, "follows"),
    ],
)
def test_where_no_mimic_expresses_the_same_there_is_a_warning(changed: dict[str, str], reason: str):
    made = there(**changed)
    assert rules(made)[-1] == ("gearbox", "warning")
    assert reason in made.diagnostics[-1].message
    assert "axle" not in mimics(made)
    assert '<joint name="gears" type="gearbox">' in made.text


def test_on_the_way_back_the_gearbox_alone_couples_them():
    made = back(there().text)
    assert mimics(made) == {}
    gears = joints(made)["gears"]
    assert (gears.type, gears.gearbox_ratio, gears.gearbox_reference_body) == ("gearbox", 4.0, "body")
    assert "stale-carrier" not in [name for name, _ in rules(made)]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('multiplier="-4"', 'multiplier="-5"'),
        ('multiplier="-4"', 'multiplier="-4" offset="1"'),
        ("<gearbox_ratio>4", "<gearbox_ratio>3"),
    ],
)
def test_a_mimic_that_was_edited_stands_for_itself(old: str, new: str):
    urdf = there().text
    assert old in urdf
    made = back(urdf.replace(old, new, 1))
    assert ("stale-carrier", "warning") in rules(made)
    assert mimics(made)["axle"].joint == "drive"


def test_names_that_change_change_in_gearboxes_too():
    urdf = (
        "<robot name='r'><link name='__a__'/><link name='b'/>"
        "<joint name='b' type='continuous'><parent link='__a__'/><child link='b'/><axis xyz='0 0 1'/></joint>"
        "<gazebo><joint name='g' type='gearbox'><parent>__a__</parent><child>b</child>"
        "<gearbox_reference_body>__a__</gearbox_reference_body><axis2><mimic joint='b'/></axis2></joint></gazebo>"
        "</robot>"
    )
    gears = joints(back(urdf))["g"]
    assert (gears.parent, gears.gearbox_reference_body) == ("a_link", "a_link")
    assert gears.axis2
    assert gears.axis2.mimic == Mimic(joint="b_joint")


def test_a_mimic_that_was_edited_is_annotated_as_synthesized_no_more():
    made = back(there().text.replace('multiplier="-4"', 'multiplier="-5"', 1))
    stale = next(each for each in made.diagnostics if each.rule.name == "stale-carrier")
    assert stale.message == "joint 'axle' mimics 'drive', and no gearbox couples them so any more"
    assert stale.found == "axle"
    assert stale.location.path == "/robot[@name='m']/joint[@name='axle']"
    assert stale.location.line > 0
    assert mimics(made) == {"axle": Mimic(joint="drive", multiplier=-5.0)}
    assert find_annotation(joints(made)["axle"], GEARED) is None
    assert mimics(back(twinform.convert(made.text.encode(), to="urdf").text)) == mimics(made)


def turning(name: str, child: str, direction: Vector3, mimic: Mimic | None = None) -> Joint:
    return Joint(name=name, type="revolute", parent="body", child=child, axis=Axis(xyz=direction, mimic=mimic))


GEARS = Joint(
    name="gears",
    type="gearbox",
    parent="motor",
    child="wheel",
    gearbox_ratio=4,
    gearbox_reference_body="body",
    axis=Axis(xyz=(0, 1, 0)),
    axis2=Axis(xyz=(0, 1, 0)),
)
TURNED = Pose(rpy=(pi / 2, 0, 0))
"""That of the wheel, whose y is the body's z."""


def geared(*joints: Joint) -> Model:
    links = (Link(name="body"), Link(name="motor"), Link(name="wheel", pose=TURNED))
    return Model(name="m", links=links, joints=(*joints, GEARS))


@pytest.mark.parametrize(
    ("multiplier", "left"), [(-4.0, None), (-5.0, Mimic(joint="drive", multiplier=-5.0)), (None, Mimic(joint="drive"))]
)
def test_the_annotation_of_the_mimic_goes_and_every_other_stays(multiplier: float | None, left: Mimic | None):
    axle = turning("axle", "wheel", (0, 1, 0), Mimic(joint="drive", multiplier=multiplier))
    drive = turning("drive", "motor", (0, 0, 1))
    sink = DiagnosticSink()
    made = FoldGearboxes().run_model(geared(drive, with_annotation(annotate_synthesized(axle), GEARED)), sink)
    assert made.joints == (drive, annotate_synthesized(turning("axle", "wheel", (0, 1, 0), left)), GEARS)
    assert [(each.rule.name, each.found) for each in sink.diagnostics] == ([("stale-carrier", "axle")] if left else [])


def test_a_joint_with_the_name_of_a_link_is_the_joint():
    axle = turning("axle", "wheel", (0, 1, 0))
    for direction, fits in (((0.0, 0.0, 1.0), True), ((0.0, 1.0, 0.0), False)):
        model = geared(turning("wheel", "motor", direction), axle)
        joints = {joint.name: joint for joint in model.joints if joint is not GEARS}
        if fits:
            assert relation(GEARS, joints, FrameGraph(model)) == Relation("wheel", "axle", -4.0)
        else:
            with pytest.raises(UngearedError, match="joint 'wheel' turns about another axis"):
                relation(GEARS, joints, FrameGraph(model))
