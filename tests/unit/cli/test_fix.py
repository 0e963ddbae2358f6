"""`twinform fix`: fixes and passes in the files themselves."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from twinform.cli import main

from .conftest import Run

ROBOT = """<?xml version="1.0"?>
<!-- by hand -->
<robot name="r">
  <link name="base"/>
  <link name="arm">
    <inertial>
      <mass value="1,5"/> <!-- weighed -->
      <inertia ixx="1" iyy="1" izz="1"/>
    </inertial>
  </link>
  <joint name="j" type="revolute">
    <parent link="base"/><child link="arm"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="+1" effort="10" velocity="1.0"/>
  </joint>
</robot>
"""
FIXED = ROBOT.replace("1,5", "1.5").replace('izz="1"', 'izz="1" ixy="0" ixz="0" iyz="0"')


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    path = tmp_path / "r.urdf"
    path.write_text(ROBOT)
    return path


def test_a_file_is_fixed_and_then_passes_run(run: Run, robot: Path) -> None:
    done = run("fix", "--passes", "rename{names=[arm:boom]}", robot)
    assert done.exit_code == 0
    assert robot.read_text() == FIXED.replace('"arm"', '"boom"')
    assert done.stderr == f"{robot}: fixed 3 x missing-attribute, 1 x invalid-value\n{robot}: 2 changes by passes\n"


def test_without_passes_only_fixes_are_made(run: Run, robot: Path) -> None:
    assert run("fix", robot).exit_code == 0
    assert robot.read_text() == FIXED


def test_the_difference_is_shown_and_nothing_written(run: Run, robot: Path) -> None:
    done = run("fix", "--diff", "--passes", "rename{names=[arm:boom]}", robot)
    assert done.exit_code == 1
    assert '+  <link name="boom">' in done.stdout
    assert robot.read_text() == ROBOT
    robot.write_text(FIXED)
    assert run("fix", "--diff", robot).exit_code == 0


def test_nothing_is_written_where_a_file_cannot_be_changed(run: Run, robot: Path, tmp_path: Path) -> None:
    wrong = tmp_path / "wrong.urdf"
    wrong.write_text(ROBOT.replace('child link="arm"', 'child link="leg"'))
    done = run("fix", "--passes", "check-inertia", robot, wrong)
    assert done.exit_code == 1
    assert "dangling-link" in done.stderr
    assert done.stderr.endswith("nothing is written: 1 of 2 files could not be changed\n")
    assert robot.read_text() == ROBOT


def test_standard_input_goes_to_standard_output() -> None:
    done = CliRunner().invoke(main, ["fix", "--passes", "rename{names=[arm:boom]}", "-"], input=ROBOT)
    assert (done.exit_code, done.stdout) == (0, FIXED.replace('"arm"', '"boom"'))


@pytest.mark.parametrize(
    ("name", "text", "passes", "message"),
    [
        ("r.urdf.xacro", ROBOT, "check-inertia", "is not URDF or SDF"),
        ("r.json", "{}", "check-inertia", "is not URDF or SDF"),
        ("r.sdf", "<sdf version='1.9'/>", "bridge-config{file=b.yaml}", "a pass writes"),
        ("missing.urdf", None, "check-inertia", "cannot read"),
        ("empty.urdf", "", "check-inertia", "the file is empty"),
    ],
)
def test_what_cannot_be_changed_in_its_place(
    run: Run, tmp_path: Path, name: str, text: str | None, passes: str, message: str
) -> None:
    path = tmp_path / name
    if text is not None:
        path.write_text(text)
    done = run("fix", "--passes", passes, path)
    assert done.exit_code == 2
    assert message in done.stderr
    assert text is None or path.read_text() == text
