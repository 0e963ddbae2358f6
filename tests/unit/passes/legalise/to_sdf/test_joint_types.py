"""A planar joint is a chain in SDF, and one joint again in URDF."""

from collections.abc import Iterator
from math import hypot

import pytest

import twinform
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Model
from twinform.ir.frames import FrameGraph
from twinform.request_options import Language

ROBOT = """
<robot name="r">
  <link name="floor"/>
  <link name="cart"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="arm"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="drive" type="planar">
    <origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><parent link="floor"/><child link="cart"/>
    <axis xyz="{axis}"/><limit effort="1" velocity="2"/><dynamics damping="0.5"/>
  </joint>
  <joint name="drive_x" type="continuous">
    <origin xyz="0 0 1"/><parent link="cart"/><child link="arm"/><axis xyz="0 0 1"/>
  </joint>
</robot>
"""
AXES = ("0 0 1", "1 0 0", "0 -1 0", "1 2 3")


def sdf_of(axis: str) -> Model:
    return twinform.loads(twinform.convert(ROBOT.format(axis=axis).encode(), to="sdf").text).models[0]


def axes(model: Model) -> Iterator[tuple[float, float, float]]:
    for joint in model.joints:
        if joint.name != "drive_x" and joint.axis and joint.axis.xyz:
            yield joint.axis.xyz


@pytest.mark.parametrize("axis", AXES)
def test_the_axes_of_the_chain_are_at_right_angles(axis: str):
    along, across, normal = axes(sdf_of(axis))
    length = hypot(*normal)
    for one, other in ((along, across), (along, normal), (across, normal)):
        assert sum(a * b for a, b in zip(one, other, strict=True)) == pytest.approx(0, abs=1e-15 * length)
    assert (hypot(*along), hypot(*across)) == (pytest.approx(1), pytest.approx(1))


@pytest.mark.parametrize("axis", AXES)
def test_the_links_stay_where_they_are(axis: str):
    there = FrameGraph(sdf_of(axis))
    here = FrameGraph(twinform.loads(ROBOT.format(axis=axis)).models[0])
    for link in ("cart", "arm"):
        assert there.pose(link, "floor").translation == pytest.approx(here.pose(link, "floor").translation)


@pytest.mark.parametrize("axis", AXES)
def test_it_is_one_joint_again_in_urdf(axis: str):
    source = twinform.loads(ROBOT.format(axis=axis)).models[0]
    text = twinform.convert(twinform.convert(ROBOT.format(axis=axis).encode(), to="sdf").text.encode(), to="urdf").text
    again = twinform.loads(text).models[0]
    assert [link.name for link in again.links] == [link.name for link in source.links]
    assert [(joint.name, joint.type, joint.parent, joint.child) for joint in again.joints] == [
        (joint.name, joint.type, joint.parent, joint.child) for joint in source.joints
    ]
    drive = again.joints[0]
    assert drive.axis
    assert source.joints[0].axis
    assert drive.axis.xyz == source.joints[0].axis.xyz
    assert drive.pose == source.joints[0].pose


def test_without_carriers_it_stays_a_chain():
    sdf = twinform.convert(ROBOT.format(axis="0 0 1").encode(), to="sdf", carriers=False).text
    again = twinform.loads(twinform.convert(sdf.encode(), to="urdf").text).models[0]
    assert [joint.type for joint in again.joints] == ["prismatic", "prismatic", "continuous", "continuous"]


FROM_SDF = '<tf:from xmlns:tf="urn:twinform:1" format="sdf" version="1.11"/>'
FROM_MJCF = FROM_SDF + '<tf:mjcf xmlns:tf="urn:twinform:1"><mujoco/></tf:mjcf>'
MADE = '<tf:made xmlns:tf="urn:twinform:1"/>'


@pytest.mark.parametrize(("origin", "to"), [(FROM_SDF, "sdf"), (FROM_MJCF, "sdf"), (FROM_MJCF, "mjcf")])
@pytest.mark.parametrize("mark", ["", MADE])
def test_a_joint_that_became_planar_in_a_file_of_another_language_is_one_again(
    origin: str, to: Language, mark: str
) -> None:
    """A mark says that a conversion made the joint, which was a fixed one then."""
    marked = (
        ROBOT.replace("floor", "world").replace("<axis", f"{mark}<axis", 1).replace("</robot>", f"{origin}</robot>")
    )
    robot = marked.format(axis="0 0 1")
    there = twinform.convert(robot.encode(), to=to)
    back = twinform.convert(there.text.encode(), to="urdf")
    assert [(joint.name, joint.type) for joint in back.document.models[0].joints] == [
        ("drive", "planar"),
        ("drive_x", "continuous"),
    ]
    assert STALE_CARRIER not in [each.rule for each in (*there.diagnostics, *back.diagnostics)]
