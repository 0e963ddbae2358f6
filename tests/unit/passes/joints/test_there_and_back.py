from pathlib import Path
from typing import Literal

import pytest

import twinform

CASES = Path(__file__).parents[3] / "cases/passes/control"
THERE, BACK = "ros2-control-from-transmissions", "transmissions-from-ros2-control"


@pytest.mark.parametrize("language", ["urdf", "sdf"])
def test_there_back_and_there_is_there(language: Literal["urdf", "sdf"]) -> None:
    once = twinform.convert(CASES / f"simple.{language}", to=language, passes=THERE).text
    thrice = twinform.convert(once.encode(), to=language, passes=f"{BACK},{THERE}").text
    assert thrice == once


ARM = """<robot name="arm"><link name="a"/><link name="b"/>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>
{}</robot>"""
DRIVE = """<transmission name="drive{}"><type>transmission_interface/SimpleTransmission</type>
<joint name="j">{}</joint><actuator name="m"/></transmission>"""


@pytest.mark.parametrize(
    ("drives", "commands"),
    [
        ([["JointState"]], []),
        ([["PositionJoint"]], ["position"]),
        ([["PosVelAccJoint", "EffortJoint"]], ["position", "velocity", "acceleration", "effort"]),
        ([["VelocityJoint", "PositionJoint", "VelocityJoint"]], ["velocity", "position"]),
        ([["PositionJoint"], ["EffortJoint", "PositionJoint"], ["JointState"]], ["position", "effort"]),
    ],
)
def test_a_joint_is_commanded_by_all_that_its_transmissions_say(drives: list[list[str]], commands: list[str]) -> None:
    interfaces = [
        "".join(f"<hardwareInterface>{each}Interface</hardwareInterface>" for each in words) for words in drives
    ]
    text = ARM.format("".join(DRIVE.format(number, each) for number, each in enumerate(interfaces)))
    made = twinform.convert(text.encode(), to="urdf", passes=THERE)
    [part] = made.document.models[0].opaque
    joint = part.element.find("joint") if part.element else None
    assert joint
    assert [(each.name, each.get("name")) for each in joint.children] == [
        *(("command_interface", each) for each in commands),
        *(("state_interface", each) for each in ("position", "velocity", "effort")),
    ]
