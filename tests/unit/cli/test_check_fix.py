"""`twinform check --fix`: what is written, what is printed, and when nothing is."""

import os
from pathlib import Path

import pytest
from click.testing import CliRunner

from twinform.cli import main
from twinform.compiler import LoadResult, read

from .conftest import Run

ROBOT = """<robot name="r">
  <link name="base"/> <!-- stays -->
  <link name="tip"/>
  <joint name="j" type="Fixed">
    <parent link="base"/><child link="tip"/>
    <origin xyz="0, 0, 1"/>
    <axis xyz="0 0 1"/>
  </joint>
</robot>
"""
FIXED = ROBOT.replace("Fixed", "fixed").replace("0, 0, 1", "0 0 1")
UNSAFE = ROBOT.replace('child link="tip"', 'child link="tpi"')
NOTES = FIXED.replace('    <axis xyz="0 0 1"/>\n', "")


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    path = tmp_path / "r.urdf"
    path.write_text(ROBOT)
    return path


def test_safe_fixes_are_written_and_counted(run: Run, robot: Path) -> None:
    done = run("check", "--fix", robot)
    assert (done.exit_code, done.stdout, robot.read_text()) == (0, "", FIXED)
    assert done.stderr == f"{robot}: fixed 2 x invalid-value\n1 file: 0 errors, 0 warnings, 1 note; 2 fixed\n"


def test_notes_are_fixed_where_they_are_shown(run: Run, robot: Path) -> None:
    run("check", "--fix", "--notes", robot)
    assert robot.read_text() == NOTES


def test_guesses_are_made_only_if_asked_for(run: Run, robot: Path) -> None:
    robot.write_text(UNSAFE)
    assert "1 fixable with --fix --unsafe-fixes" in run("check", "--fix", robot).stderr + run("check", robot).stderr
    assert run("check", "--fix", "--unsafe-fixes", robot).exit_code == 0
    assert robot.read_text() == FIXED


def test_a_plain_check_says_what_could_be_fixed(run: Run, robot: Path) -> None:
    assert run("check", robot).stderr.endswith("; 2 fixable with --fix\n")
    assert robot.read_text() == ROBOT


def test_the_difference_is_shown_and_nothing_written(run: Run, robot: Path) -> None:
    done = run("check", "--diff", robot)
    assert done.exit_code == 1
    assert [line for line in done.stdout.splitlines() if line[:1] in "+-"] == [
        f"--- {robot}",
        f"+++ {robot}",
        '-  <joint name="j" type="Fixed">',
        '+  <joint name="j" type="fixed">',
        '-    <origin xyz="0, 0, 1"/>',
        '+    <origin xyz="0 0 1"/>',
    ]
    assert robot.read_text() == ROBOT
    robot.write_text(FIXED)
    assert (run("check", "--diff", robot).stdout, run("check", "--diff", robot).exit_code) == ("", 0)


def test_a_difference_shows_a_missing_last_line_end(run: Run, robot: Path) -> None:
    robot.write_bytes(b"<robot name='r'>\n<link name='a'/>\n<material name='m'/></robot>")
    assert "\\ No newline at end of file\n" in run("check", "--diff", robot).stdout


def test_fix_only_reports_nothing_else(run: Run, robot: Path) -> None:
    robot.write_text(UNSAFE)
    done = run("check", "--fix-only", robot)
    assert (done.exit_code, done.stdout) == (0, "")
    assert done.stderr == f"{robot}: fixed 2 x invalid-value\n"


def test_standard_input_goes_to_standard_output() -> None:
    done = CliRunner().invoke(main, ["check", "--fix", "-"], input=ROBOT)
    assert (done.exit_code, done.stdout) == (0, FIXED)
    assert CliRunner().invoke(main, ["check", "--fix", "--format", "json", "-"], input=ROBOT).exit_code == 2


def test_what_the_project_allows_is_left(run: Run, robot: Path) -> None:
    text = FIXED.replace("<axis", "text\n    <axis")
    robot.write_text(text)
    run("check", "--fix", "--allow", "stray-text", robot)
    assert robot.read_text() == text


def test_the_target_of_a_link_is_written_and_keeps_its_mode(run: Run, robot: Path, tmp_path: Path) -> None:
    robot.chmod(0o640)
    link = tmp_path / "link.urdf"
    link.symlink_to(robot)
    run("check", "--fix", link)
    assert link.is_symlink()
    assert (robot.read_text(), robot.stat().st_mode & 0o777) == (FIXED, 0o640)


def test_a_read_only_file_is_refused(run: Run, robot: Path) -> None:
    robot.chmod(0o444)
    done = run("check", "--fix", robot)
    assert (done.exit_code, done.stderr) == (2, f"Error: {robot} is read-only; nothing is written\n")
    assert robot.read_text() == ROBOT


def test_a_file_that_changed_meanwhile_is_refused(run: Run, robot: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def changing(content: str | bytes, *args: object, **extra: str) -> LoadResult:
        robot.write_text(ROBOT + "<!-- somebody else -->")
        return read(content, *args, **extra)  # pyright: ignore[reportArgumentType] - as it was called

    monkeypatch.setattr("twinform.compiler.read", changing)
    done = run("check", "--fix", robot)
    assert done.exit_code == 2
    assert "has changed since it was read; nothing is written" in done.stderr
    assert robot.read_text() == ROBOT + "<!-- somebody else -->"


def test_of_several_files_each_is_fixed(run: Run, robot: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.urdf"
    other.write_text("<robot")
    done = run("check", "--fix", other, robot, tmp_path / "missing.urdf")
    assert done.exit_code == 2
    assert (robot.read_text(), other.read_text()) == (FIXED, "<robot")


MACROS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="part" params="name type">
    <link name="${name}">
      <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    </link>
    <joint name="${name}_joint" type="${type}"><parent link="base"/><child link="${name}"/><axis xyz="%s"/></joint>
  </xacro:macro>
</robot>
"""
CALLS = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="%s"/>
  <link name="base"/>
  <xacro:part name="a" type="%s"/>
</robot>
"""


def test_a_text_of_xacro_is_fixed_in_the_file_where_it_stands(run: Run, tmp_path: Path) -> None:
    robot, macros = tmp_path / "r.urdf.xacro", tmp_path / "macros.xacro"
    macros.write_text(MACROS % "0, 0, 1")
    robot.write_text(CALLS % ("macros.xacro", "continuous"))
    done = run("check", "--fix", tmp_path)
    assert macros.read_text() == MACROS % "0 0 1"
    assert robot.read_text() == CALLS % ("macros.xacro", "continuous")
    assert done.stderr.startswith(f"{robot}: fixed 1 x invalid-value\n{robot}: fixed in {macros}\n")


def test_a_shared_file_is_fixed_once_for_all_robots(run: Run, tmp_path: Path) -> None:
    macros = tmp_path / "macros.xacro"
    macros.write_text(MACROS % "0, 0, 1")
    for name in "ab":
        (tmp_path / f"{name}.urdf.xacro").write_text(CALLS % ("macros.xacro", "continuous"))
    done = run("fix", tmp_path, "--diff")
    assert done.stdout.count("+++") == 1
    assert run("fix", tmp_path).exit_code == 0
    assert macros.read_text() == MACROS % "0 0 1"


def test_a_shared_file_is_left_where_another_robot_would_be_wrong(run: Run, tmp_path: Path) -> None:
    macros = tmp_path / "macros.xacro"
    text = MACROS.replace('type="${type}"', 'type="continuous"').replace('parent link="base"', 'parent link="bsae"')
    macros.write_text(text % "0 0 1")
    robot = CALLS % ("macros.xacro", "x")
    (tmp_path / "a.urdf.xacro").write_text(robot)
    (tmp_path / "b.urdf.xacro").write_text(robot.replace('link name="base"', 'link name="bsae"'))
    done = run("check", "--fix", "--unsafe-fixes", tmp_path)
    assert macros.read_text() == text % "0 0 1"
    assert "a.urdf.xacro: not changed, for other robots: " in done.stderr


def test_a_file_outside_of_the_package_is_left(run: Run, tmp_path: Path) -> None:
    shared, own = tmp_path / "share", tmp_path / "own"
    for folder in (shared / "parts", own):
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(f"<package><name>{folder.name}</name></package>")
    (shared / "parts" / "macros.xacro").write_text(MACROS % "0, 0, 1")
    (own / "r.urdf.xacro").write_text(CALLS % ("$(find parts)/macros.xacro", "continuous"))
    done = run("check", "--fix", "--path", shared, own)
    assert "invalid-value" in done.stdout
    assert (shared / "parts" / "macros.xacro").read_text() == MACROS % "0, 0, 1"


def test_a_file_is_not_written_where_nothing_changes(run: Run, robot: Path) -> None:
    robot.write_text(FIXED)
    os.utime(robot, (1, 1))
    run("check", "--fix", robot)
    assert robot.stat().st_mtime == 1
