"""What each command makes of MJCF."""

import json
from pathlib import Path

import pytest

from tests.unit.cli.conftest import GOOD, Run

PENDULUM = """\
<mujoco model="pendulum">
  <worldbody>
    <body name="arm" pos="0 0 1">
      <joint axis="0 1 0" name="swing"/>
      <geom size=".05 .5" type="capsule" name="rod"/>
    </body>
  </worldbody>
</mujoco>
"""


@pytest.fixture
def pendulum(tmp_path: Path) -> Path:
    path = tmp_path / "pendulum.xml"
    path.write_text(PENDULUM)
    (tmp_path / "package.xml").write_text("<package/>")
    return path


def test_it_is_found_in_folders_and_checked(run: Run, pendulum: Path) -> None:
    done = run("check", pendulum.parent, "--format", "json")
    files = json.loads(done.stdout)["files"]
    assert [each["path"] for each in files] == [str(pendulum)]
    assert done.exit_code == 0


def test_what_others_include_is_checked_with_them(run: Run, pendulum: Path) -> None:
    (pendulum.parent / "scene.xml").write_text('<mujoco><include file="pendulum.xml"/><worldbody/></mujoco>')
    pendulum.write_text(PENDULUM.replace("axis", "axsi"))
    found = json.loads(run("check", pendulum.parent, "--format", "json").stdout)["files"]
    assert [each["diagnostics"] for each in found if each["path"] == str(pendulum)] == [[]]


def test_attributes_get_the_order_of_mjcf(run: Run, pendulum: Path) -> None:
    pendulum.write_text(PENDULUM.replace(".05 .5", "5.00e-2 0.50"))
    assert run("format", pendulum, "--sort-attributes", "--numbers", "shortest").exit_code == 0
    text = pendulum.read_text()
    assert '<joint name="swing" axis="0 1 0"/>' in text
    assert '<geom name="rod" type="capsule" size="0.05 0.5"/>' in text


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["convert", "pendulum.xml", "--in-place"], "is MJCF, which is written anew"),
        (["fix", "pendulum.xml", "--passes", "fill-inertia"], "is not URDF or SDF"),
        (["convert", "pendulum.xml", "--split", "--to", "mjcf", "-o", "out"], "--split makes a file of every model"),
        (["batch", "convert", ".", "out", "--to", "mjcf", "--split"], "--split makes a file of every model"),
    ],
)
def test_what_is_not_for_mjcf_is_refused(
    run: Run, pendulum: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], complaint: str
) -> None:
    monkeypatch.chdir(pendulum.parent)
    Path("good.urdf").write_text(GOOD)
    done = run(*arguments)
    assert done.exit_code == 2
    assert complaint in " ".join(done.stderr.split())
    assert pendulum.read_text() == PENDULUM


def test_fixes_write_no_elements_of_other_formats(run: Run, pendulum: Path) -> None:
    pendulum.write_text(PENDULUM.replace("<geom size", "stray <geom sizze"))
    run("check", "--fix", "--unsafe-fixes", pendulum)
    text = pendulum.read_text()
    assert "<!-- stray -->" in text
    assert "<geom size" in text
    assert "<inertial" not in text


def test_a_batch_writes_it_as_xml(run: Run, pendulum: Path) -> None:
    (pendulum.parent / "good.urdf").write_text(GOOD)
    assert run("batch", "convert", pendulum.parent, pendulum.parent / "out", "--to", "mjcf").exit_code == 0
    assert sorted(each.name for each in (pendulum.parent / "out").glob("*.xml")) == ["good.xml", "pendulum.xml"]


def test_mujoco_reads_it_and_others_do_not(run: Run, pendulum: Path) -> None:
    assert run("check", pendulum, "--for", "mujoco").stdout.count("unread-format") == 0
    assert "Gazebo harmonic does not read MJCF" in run("check", pendulum, "--for", "gazebo").stdout


def test_its_format_is_called_by_its_name(run: Run, pendulum: Path) -> None:
    assert run("stats", pendulum).stdout.startswith(f"{pendulum}: mjcf\n")
    assert run("advise", pendulum).stdout.startswith(f"{pendulum}: MJCF, 'pendulum'\n")


def test_it_follows_a_urdf_by_the_smallest_change_and_is_followed(run: Run, tmp_path: Path) -> None:
    urdf, mjcf = tmp_path / "good.urdf", tmp_path / "good.xml"
    urdf.write_text(GOOD)
    assert run("convert", urdf, "--to", "mjcf", "-o", mjcf).exit_code == 0
    before = mjcf.read_text()
    urdf.write_text(GOOD.replace('mass value="1"', 'mass value="2"'))
    assert run("convert", urdf, "--into", mjcf).exit_code == 0
    assert mjcf.read_text() == before.replace('mass="1"', 'mass="2"')
    mjcf.write_text(before.replace('mass="1"', 'mass="3"'))
    assert run("convert", mjcf, "--into", urdf).exit_code == 0
    assert urdf.read_text() == GOOD.replace('mass value="1"', 'mass value="3"')


def test_fixes_are_made_in_the_files_that_are_included(run: Run, pendulum: Path) -> None:
    (pendulum.parent / "scene.xml").write_text('<mujoco><include file="pendulum.xml"/></mujoco>')
    pendulum.write_text(PENDULUM.replace("axis", "axsi"))
    assert run("check", "--fix", "--unsafe-fixes", pendulum.parent).exit_code == 0
    assert pendulum.read_text() == PENDULUM


def test_a_text_without_a_folder_has_no_includes(run: Run) -> None:
    done = run("check", "-", text='<mujoco>\n<include file="arm.xml"/>\n</mujoco>')
    assert done.exit_code == 1
    assert "<stdin>:2" in done.stdout
    assert "include-not-expanded" in done.stdout


def test_a_floor_is_no_robot_without_carriers_either(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "arm.xml"
    path.write_text(
        '<mujoco model="arm"><worldbody><geom name="floor" type="plane" size="1 1 1"/><body name="base">'
        '<geom name="rod" size="0.1"/></body></worldbody></mujoco>'
    )
    robot = run("convert", path, "--to", "urdf", "--no-carriers").stdout
    assert robot.startswith('<?xml version="1.0"?>\n<robot name="arm">')
    (tmp_path / "arm.urdf").write_text(robot)
    assert run("sync", tmp_path / "arm.urdf", path, "--check").stdout.endswith("1 up to date\n")


_ARM = """\
<mujoco model="arm">
  <include file="common/classes.xml"/>
  <worldbody>
    <body name="arm">
      <joint name="swing" class="hinge"/>
      <include file="common/gripper.xml"/>
      <geom size=".1" class="shell" material="steel"/>
    </body>
  </worldbody>
</mujoco>
"""
_SCENE = """\
<mujoco model="scene">
  <include file="arm.xml"/>
  <include file="common/drives.xml"/>
  <worldbody><geom type="plane" size="1 1 1"/></worldbody>
</mujoco>
"""
_FRAGMENTS = {
    "common/classes.xml": """\
<mujocoinclude>
  <default><default class="shell"><geom rgba="1 0 0 1"/></default></default>
  <asset><material name="steel"/></asset>
</mujocoinclude>
""",
    "common/gripper.xml": """\
<mujoco>
  <body name="gripper"><geom size=".1" material="stel"/></body>
</mujoco>
""",
    "common/drives.xml": '<mujocoinclude><actuator><motor joint="swing"/></actuator></mujocoinclude>\n',
}


def test_fragments_are_judged_where_they_are_included(run: Run, tmp_path: Path) -> None:
    """As in many packages: a robot, a scene around it, and fragments in a folder; a fragment may be a `<mujoco>`."""
    (tmp_path / "common").mkdir()
    for name, text in {"arm.xml": _ARM, "scene.xml": _SCENE, **_FRAGMENTS}.items():
        (tmp_path / name).write_text(text)
    shown = run("check", tmp_path).stdout
    assert shown.count("error: ") == 2, shown  # each finding once, though the scene includes the arm
    assert f"{tmp_path}/arm.xml:5:34: error: there is no default class 'hinge' [unknown-class]" in shown
    assert f"{tmp_path}/common/gripper.xml:2:50: error: 'material' of <geom> is 'stel'" in shown
    assert "(expanded)" not in shown


@pytest.mark.parametrize("target", ["mjcf", "sdf", "urdf"])
def test_an_unknown_class_is_an_error_for_each_target(run: Run, pendulum: Path, target: str) -> None:
    pendulum.write_text(PENDULUM.replace("<geom", '<geom class="visul"'))
    done = run("convert", pendulum, "--to", target)
    assert done.exit_code == 1
    assert "error: there is no default class 'visul' [unknown-class]" in done.stderr
