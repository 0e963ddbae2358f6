"""What is looked for only under `--for`: meshes in COLLADA, and what is of Gazebo Classic."""

from pathlib import Path

import pytest

import twinform

_URDF = (
    '<robot name="r"><link name="a"><{tag}><geometry><mesh filename="{uri}"/></geometry></{tag}>'
    '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>'
)
_COLLADA = Path("tests/cases/passes/meshes/meshes").resolve()


@pytest.mark.parametrize(
    ("uri", "found"),
    [
        ("package://arm/base.dae", True),
        ("package://arm/BASE.DAE", True),
        ("file:///arm/a b.dae", True),
        ("base.dae.stl", False),
        ("dae", False),
        (".stl", False),
    ],
)
def test_meshes_in_collada_are_found_by_their_ending(uri: str, found: bool) -> None:
    text = _URDF.format(uri=uri, tag="collision").encode()
    told = [each for each in twinform.check(text, profiles="mujoco").diagnostics if each.rule.name == "collada-mesh"]
    assert [(each.found, each.is_error) for each in told] == ([(uri, False)] if found else [])


@pytest.mark.parametrize(("tag", "profile"), [("collision", "pinocchio"), ("visual", "mujoco"), ("collision", "")])
def test_nobody_is_told_who_does_not_mind(tag: str, profile: str) -> None:
    found = twinform.check(_URDF.format(uri="base.dae", tag=tag).encode(), profiles=profile or ())
    assert "collada-mesh" not in {each.rule.name for each in found.diagnostics}


def test_a_file_that_is_there_is_an_error_and_converted(tmp_path: Path) -> None:
    (source,) = list(_COLLADA.glob("*.dae"))[:1]
    (tmp_path / "a.dae").write_bytes(source.read_bytes())
    robot = tmp_path / "r.urdf"
    robot.write_text(_URDF.format(uri="a.dae", tag="collision"), encoding="utf-8")
    (found,) = [each for each in twinform.check(robot, profiles="mujoco").diagnostics if each.is_error]
    assert found.rule.name == "collada-mesh"
    made = twinform.convert(robot, to="urdf", profiles="mujoco", keep_physics=True)
    assert "a.dae" not in made.text
    assert made.side_files[0].path == "meshes/a.obj"


_CLASSIC = (
    b'<robot name="r"><link name="a"/><link name="b"/>'
    b'<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
    b'<gazebo reference="j"><disableFixedJointLumping>%s</disableFixedJointLumping></gazebo>'
    b'<gazebo reference="a"><sensor name="s" type="%s"><plugin name="p" filename="%s"/></sensor></gazebo></robot>'
)


_OF_CLASSIC = {"loosened-fixed-joint", "plugin-not-in-release", "unsupported-sensor"}


@pytest.mark.parametrize("profile", ["gazebo@harmonic", "mujoco"])
def test_what_is_of_gazebo_classic_is_told_of_gazebo_alone(profile: str) -> None:
    found = twinform.check(_CLASSIC % (b"true", b"ray", b"libgazebo_ros_laser.so"), profiles=profile).diagnostics
    expected = _OF_CLASSIC if profile == "gazebo@harmonic" else set[str]()
    assert {each.rule.name for each in found} & _OF_CLASSIC == expected


def test_what_gazebo_takes_is_not_told() -> None:
    text = _CLASSIC % (b"false", b"gpu_lidar", b"libmy_laser.so")
    found = twinform.check(text, profiles="gazebo@harmonic").diagnostics
    assert {each.rule.name for each in found} & _OF_CLASSIC == set()


def test_a_root_with_an_inertia_is_found_for_kdl_and_gets_another_root() -> None:
    text = _URDF.format(uri="a.stl", tag="collision").encode()
    (found,) = [each for each in twinform.check(text, profiles="kdl").diagnostics if each.rule.name == "root-inertia"]
    assert (found.found, (found.help or "").splitlines()[0]) == ("a", "--passes 'add-root'")
    made = twinform.convert(text, to="urdf", profiles="kdl")
    assert [link.name for link in made.document.models[0].links] == ["base_footprint", "a"]
    left = twinform.check(made.text.encode(), profiles="kdl").diagnostics
    assert "root-inertia" not in {each.rule.name for each in left}
