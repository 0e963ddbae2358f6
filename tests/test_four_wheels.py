"""The four-wheeled robot and its relatives, to SDF and back, point by point where a naive converter goes wrong.

The outputs are read with lxml here, so that the judge of each point is not the compiler.
"""

import math
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from lxml import etree
from lxml.etree import _Element as Xml  # pyright: ignore[reportPrivateUsage] - lxml has no public name for it

import twinform
from testbed.oracles.xml_trees import first_difference

_EXAMPLES = Path(__file__).parents[1] / "examples"


@cache
def _sdf(name: str) -> Xml:
    return etree.fromstring(twinform.convert(_EXAMPLES / name, to="sdf").text.encode())


@cache
def _urdf_again(name: str) -> Xml:
    sdf = etree.tostring(_sdf(name))
    return etree.fromstring(twinform.convert(sdf, to="urdf").text.encode())


@cache
def _urdf(name: str) -> Xml:
    return etree.parse(_EXAMPLES / name).getroot()


def _numbers(text: str | None) -> list[float]:
    return [float(word) for word in (text or "").split()]


def _one(element: Xml, path: str) -> Xml:
    found = element.find(path)
    assert found is not None, path
    return found


def _link(root: Xml, name: str) -> Xml:
    return _one(root, f".//link[@name='{name}']")


def _joint(root: Xml, name: str) -> Xml:
    return _one(root, f".//joint[@name='{name}']")


def test_every_visual_and_collision_of_a_link_is_there() -> None:
    for link in _urdf("four_wheels.urdf").iterfind("link"):
        for converted in (_sdf("four_wheels.urdf"), _urdf_again("four_wheels.urdf")):
            twin = _link(converted, link.attrib["name"])
            for tag in ("visual", "collision"):
                assert len(twin.findall(tag)) == len(link.findall(tag))


def test_origins_of_shapes_keep_their_place_and_rotation() -> None:
    pose = _numbers(_one(_link(_sdf("four_wheels.urdf"), "base_link"), "visual[@name='headlight']/pose").text)
    assert pose == [0.285, 0.1, 0.03, 0, math.pi / 2, 0]
    origin = _one(_link(_urdf_again("four_wheels.urdf"), "base_link"), "visual[@name='headlight']/origin")
    assert _numbers(origin.get("xyz")) + _numbers(origin.get("rpy")) == pose


def test_rotations_of_joints_survive_the_way_back() -> None:
    for joint in _urdf("four_wheels.urdf").iterfind("joint"):
        twin = _joint(_urdf_again("four_wheels.urdf"), joint.attrib["name"])
        for attribute in ("xyz", "rpy"):
            expected = _numbers(_one(joint, "origin").get(attribute, "0 0 0"))
            assert _numbers(_one(twin, "origin").get(attribute, "0 0 0")) == pytest.approx(expected, abs=1e-12)


def test_a_sphere_is_a_collision_too() -> None:
    radius = _one(_link(_sdf("four_wheels.urdf"), "base_link"), "collision[@name='nose']//radius")
    assert float(radius.text or "") == 0.05
    sphere = _one(_link(_urdf_again("four_wheels.urdf"), "base_link"), "collision[@name='nose']//sphere")
    assert sphere.get("radius") == "0.05"


def test_limits_stand_inside_the_axis() -> None:
    for joint in _sdf("four_wheels.urdf").iterfind(".//joint"):
        assert joint.find("limit") is None
    limit = _one(_joint(_sdf("four_wheels.urdf"), "mast_joint"), "axis/limit")
    written = _one(_joint(_urdf("four_wheels.urdf"), "mast_joint"), "limit")
    for name in ("lower", "upper", "effort", "velocity"):
        assert float(_one(limit, name).text or "") == float(written.attrib[name])


def test_limits_that_are_not_written_are_not_zero() -> None:
    for name in ("front_left_wheel_joint", "rear_left_wheel_joint"):
        joint = _joint(_sdf("four_wheels.urdf"), name)
        assert joint.find("axis/limit/lower") is None
        assert joint.find("axis/limit/upper") is None
    assert _joint(_sdf("four_wheels.urdf"), "front_left_wheel_joint").find("axis/limit") is None


def test_joint_types_stay_what_they_are() -> None:
    types = {joint.attrib["name"]: joint.attrib["type"] for joint in _urdf("four_wheels.urdf").iterfind("joint")}
    assert len(set(types.values())) >= 3
    again = _urdf_again("four_wheels.urdf")
    assert {joint.attrib["name"]: joint.attrib["type"] for joint in again.iterfind("joint")} == types
    # what turns without an end is revolute without limits in SDF
    in_sdf = {name: "revolute" if kind == "continuous" else kind for name, kind in types.items()}
    made = _sdf("four_wheels.urdf")
    assert {joint.attrib["name"]: joint.attrib["type"] for joint in made.iterfind(".//joint[@type]")} == in_sdf
    endless = [joint for joint in made.iterfind(".//joint[@type]") if types[joint.attrib["name"]] == "continuous"]
    assert len(endless) == 4
    assert all(joint.find("axis/limit/lower") is None and joint.find("axis/limit/upper") is None for joint in endless)


def test_colors_named_and_inline_are_written() -> None:
    base = _link(_sdf("four_wheels.urdf"), "base_link")
    for visual, color in (("hull", [0.1, 0.25, 0.7, 1]), ("headlight", [1, 1, 0.85, 1])):
        assert _numbers(_one(base, f"visual[@name='{visual}']/material/diffuse").text) == color
    again = _link(_urdf_again("four_wheels.urdf"), "base_link")
    assert _one(again, "visual[@name='hull']/material").get("name") == "blue"
    color = _one(_urdf_again("four_wheels.urdf"), "material[@name='blue']/color")
    assert _numbers(color.get("rgba")) == [0.1, 0.25, 0.7, 1]


def test_the_center_of_mass_keeps_its_place() -> None:
    pose = _one(_link(_sdf("four_wheels.urdf"), "base_link"), "inertial/pose")
    assert _numbers(pose.text)[:3] == [-0.04, 0.02, -0.01]
    origin = _one(_link(_urdf_again("four_wheels.urdf"), "base_link"), "inertial/origin")
    assert _numbers(origin.get("xyz")) == [-0.04, 0.02, -0.01]


def test_products_of_inertia_are_kept() -> None:
    inertia = _one(_link(_sdf("four_wheels.urdf"), "base_link"), "inertial/inertia")
    assert [float(_one(inertia, name).text or "") for name in ("ixy", "ixz", "iyz")] == [0.0144, -0.0072, 0.0036]
    again = _one(_link(_urdf_again("four_wheels.urdf"), "base_link"), "inertial/inertia")
    assert [float(again.attrib[name]) for name in ("ixy", "ixz", "iyz")] == [0.0144, -0.0072, 0.0036]


def test_joints_are_posed_in_their_parent_and_links_on_their_joint() -> None:
    for joint in _urdf("four_wheels.urdf").iterfind("joint"):
        twin = _joint(_sdf("four_wheels.urdf"), joint.attrib["name"])
        assert _one(twin, "pose").get("relative_to") == _one(joint, "parent").get("link")
        child = _link(_sdf("four_wheels.urdf"), _one(joint, "child").attrib["link"])
        assert _one(child, "pose").get("relative_to") == joint.attrib["name"]


def test_axes_are_those_that_were_meant() -> None:
    axes = {"front_right_wheel_joint": [0, 0, -1], "left_lid_joint": [1, 0, 0]}
    for name, axis in axes.items():
        assert _numbers(_one(_joint(_sdf("four_wheels.urdf"), name), "axis/xyz").text) == axis
    again = _one(_joint(_urdf_again("four_wheels.urdf"), "front_right_wheel_joint"), "axis")
    assert _numbers(again.get("xyz")) == axes["front_right_wheel_joint"]
    lid = _one(_joint(_urdf_again("four_wheels.urdf"), "left_lid_joint"), "axis")
    assert _numbers(lid.get("xyz")) == [1, 0, 0]  # the default, which the source leaves out


def test_a_fixed_joint_has_no_axis() -> None:
    for joint in _sdf("four_wheels.urdf").iterfind(".//joint[@type='fixed']"):
        assert joint.find("axis") is None


def test_damping_and_friction_are_kept() -> None:
    dynamics = _one(_joint(_urdf("four_wheels.urdf"), "mast_joint"), "dynamics")
    twin = _one(_joint(_sdf("four_wheels.urdf"), "mast_joint"), "axis/dynamics")
    again = _one(_joint(_urdf_again("four_wheels.urdf"), "mast_joint"), "dynamics")
    for name in ("damping", "friction"):
        assert float(_one(twin, name).text or "") == float(dynamics.attrib[name]) == float(again.attrib[name])


def test_a_mimic_joint_follows_its_leader() -> None:
    mimic = _one(_joint(_sdf("four_wheels.urdf"), "right_lid_joint"), "axis/mimic")
    assert mimic.get("joint") == "left_lid_joint"
    assert [float(_one(mimic, name).text or "") for name in ("multiplier", "offset")] == [0.9, 0.02]
    again = _one(_joint(_urdf_again("four_wheels.urdf"), "right_lid_joint"), "mimic")
    assert (again.get("joint"), again.get("multiplier"), again.get("offset")) == ("left_lid_joint", "0.9", "0.02")


def test_shapes_keep_their_names_and_differ_in_them() -> None:
    for link in _sdf("four_wheels.urdf").iterfind(".//link"):
        for tag in ("visual", "collision"):
            names = [shape.attrib["name"] for shape in link.iterfind(tag)]
            assert len(set(names)) == len(names)
    assert _link(_sdf("four_wheels.urdf"), "base_link").find("visual[@name='hull']") is not None


def test_transmissions_come_back() -> None:
    names = [each.get("name") for each in _urdf("four_wheels.urdf").iterfind("transmission")]
    assert names
    assert [each.get("name") for each in _urdf_again("four_wheels.urdf").iterfind("transmission")] == names


def test_the_xacro_source_makes_the_same_robot() -> None:
    command = [sys.executable, "-c", "import xacro; xacro.main()", str(_EXAMPLES / "four_wheels.urdf.xacro")]
    expanded = subprocess.run(command, check=True, capture_output=True).stdout
    assert first_difference((_EXAMPLES / "four_wheels.urdf").read_bytes(), expanded) is None
    made = twinform.convert(expanded, to="sdf").text
    assert first_difference(etree.tostring(_sdf("four_wheels.urdf")), made.encode()) is None


def test_one_xacro_source_becomes_the_same_two_files() -> None:
    for language in ("urdf", "sdf"):
        from_xacro, from_urdf = (
            twinform.convert(_EXAMPLES / name, to=language).text
            for name in ("four_wheels.urdf.xacro", "four_wheels.urdf")
        )
        assert first_difference(from_urdf.encode(), from_xacro.encode()) is None


def test_an_argument_of_the_xacro_source_takes_the_mast_away() -> None:
    document = twinform.load(_EXAMPLES / "four_wheels.urdf.xacro", arguments={"with_mast": "false"})
    assert not any("mast" in link.name for link in document.models[0].links)


_POINTS: list[tuple[str, Callable[[Xml], object]]] = [
    ("the IMU is on its link", lambda sdf: _one(sdf, ".//link/sensor[@type='imu']/imu")),
    ("its noise is there", lambda sdf: _one(sdf, ".//sensor[@type='imu']//angular_velocity/x/noise[@type='gaussian']")),
    ("the drive is a plugin of the model", lambda sdf: _one(sdf, "model/plugin[@name='gz::sim::systems::DiffDrive']")),
    ("its joints exist", lambda sdf: _joint(sdf, _one(sdf, "model/plugin/left_joint").text or "")),
]


@pytest.mark.parametrize(("point", "look"), _POINTS, ids=[point for point, _ in _POINTS])
def test_a_base_with_imu_and_drive(point: str, look: Callable[[Xml], object]) -> None:
    assert look(_sdf("sensor_base.urdf")) is not None, point


def test_sensor_and_drive_come_back_in_gazebo_elements() -> None:
    again = _urdf_again("sensor_base.urdf")
    assert again.find("gazebo[@reference='base_link']/sensor[@type='imu']") is not None
    assert again.find("gazebo/plugin[@name='gz::sim::systems::DiffDrive']") is not None
