import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from twinform.cli import main

from .conftest import GOOD, Run


@pytest.mark.parametrize(
    ("names", "code"),
    [
        (["good"], 0),
        (["warned"], 0),
        (["wrong"], 1),
        (["broken"], 1),
        (["missing"], 2),
        (["good", "wrong"], 1),
        (["wrong", "broken", "good"], 1),
    ],
)
def test_exit_code_is_that_of_the_worst_file(run: Run, folder: Path, names: list[str], code: int) -> None:
    assert run("check", *(folder / f"{name}.urdf" for name in names)).exit_code == code


def test_strict_refuses_unknown_names(run: Run, folder: Path) -> None:
    assert run("check", "--strict", folder / "warned.urdf").exit_code == 1


@pytest.mark.parametrize("engine", ["libxml2", "xmlschema"])
def test_both_engines_agree(run: Run, folder: Path, engine: str) -> None:
    assert run("check", "--engine", engine, folder / "good.urdf").exit_code == 0
    assert run("check", "--engine", engine, folder / "wrong.urdf").exit_code == 1


def test_findings_are_on_stdout_and_the_summary_on_stderr(run: Run, folder: Path) -> None:
    file = folder / "warned.urdf"
    done = run("check", file, folder / "broken.urdf")
    assert done.stdout.startswith(f"{file}:2:22: warning: ")
    assert "[unknown-element]\n    at /" in done.stdout
    assert done.stderr == "2 files: 1 error, 1 warning, 0 notes; 1 could not be read\n"


def test_json_has_a_row_for_every_file(run: Run, folder: Path) -> None:
    files = [folder / "good.urdf", folder / "wrong.urdf", folder / "missing.urdf"]
    rows = json.loads(run("check", "--format", "json", *files).stdout)["files"]
    assert [row["path"] for row in rows] == [str(file) for file in files]
    assert [bool(row["diagnostics"]) for row in rows] == [False, True, True]


@pytest.mark.parametrize(
    ("style", "start"), [("sarif", "{\n"), ("github", "::error file="), ("junit", "<?xml "), ("concise", "")]
)
def test_other_formats(run: Run, folder: Path, style: str, start: str) -> None:
    done = run("check", "--format", style, folder / "wrong.urdf")
    assert done.exit_code == 1
    assert done.stdout.startswith(start)


def test_standard_input(run: Run) -> None:
    done = run("check", "-", "--format", "json", text=GOOD)
    assert json.loads(done.stdout) == {"files": [{"path": "<stdin>", "diagnostics": []}]}


def test_color_is_for_terminals_without_no_color(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def output(*, terminal: bool) -> str:
        arguments = ["check", str(folder / "warned.urdf")]
        return CliRunner().invoke(main, arguments, color=terminal).stdout

    monkeypatch.delenv("NO_COLOR", raising=False)
    assert "\x1b[" in output(terminal=True)
    assert "\x1b[" not in output(terminal=False)
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b[" not in output(terminal=True)


REPEATED = '<robot name="r">\n  <link name="a"/>\n' + '  <tag name="b"/>\n' * 5 + "</robot>\n"


def test_findings_of_one_cause_are_one_unless_all_are_wanted(run: Run) -> None:
    def output(*options: str) -> str:
        return run("check", "-", *options, text=REPEATED).stdout

    grouped = output()
    assert grouped.count("[unknown-element]") == 1
    assert "<stdin>:3:4: warning: <tag> is not an element of <robot> [unknown-element], 5 x\n" in grouped
    assert "    also at 4:4, 5:4, 6:4 and 1 more; --all shows each\n" in grouped
    assert output("--all").count("[unknown-element]\n") == 5
    assert len(output("--format", "concise").splitlines()) == 5


def test_the_short_form_has_notes_where_one_asks(run: Run) -> None:
    text = '<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous"><parent link="a"/>'
    text += '<child link="b"/></joint></robot>'
    assert "[missing-axis]" not in run("check", "-", "--format", "concise", text=text).stdout
    assert "<stdin>:1:50: info: " in run("check", "-", "--format", "concise", "--notes", text=text).stdout


TURNING = """<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<limit lower="-20" upper="21" effort="1" velocity="1"/></joint></robot>"""


def test_passes_that_only_look_are_run(run: Run, tmp_path: Path) -> None:
    robot = tmp_path / "turning.urdf"
    robot.write_text(TURNING)
    assert run("check", robot).stdout == ""
    assert (
        f"{robot}:4:2: warning: joint 'j' turns from -20 to 21 rad"
        in run("check", robot, "--passes", "check-limits").stdout
    )
    for passes in ("fill-limits{damping=1}", "bridge-config{file=b.yaml}"):
        done = run("check", robot, "--passes", passes)
        assert done.exit_code == 2
        assert "and check runs read-only passes" in done.stderr
    assert run("check", robot, "--passes", "chek-limits").exit_code == 2


def test_a_configuration_makes_passes_the_rule(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("turning.urdf").write_text(TURNING)
    Path("twinform.toml").write_text(
        'passes = "fill-limits{damping=1}"\ncheck-passes = "@look"\n[pipelines]\nlook = "check-limits,check-inertia"\n'
    )
    assert "range-in-degrees" in run("check", "turning.urdf").stdout
    assert run("check", "turning.urdf", "--passes", "").stdout == ""
    assert run("check", "turning.urdf", "--no-config").stdout == ""
    Path("twinform.toml").write_text('check-passes = "no-such-pass"\n')
    assert "twinform.toml: check-passes: " in run("check", "turning.urdf").stderr


def test_a_file_of_xacro_that_is_not_called_so_is_expanded_where_one_asks(run: Run, tmp_path: Path) -> None:
    robot = tmp_path / "robot.urdf"
    robot.write_text(
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r"><xacro:arg name="side" default="left"/>\n'
        '<link name="${1+1}$(arg side)"/></robot>'
    )
    done = run("check", robot)
    assert done.exit_code == 1
    assert "help: give the file the suffix .xacro, or pass --xacro" in done.stdout
    assert run("check", "--xacro", robot).exit_code == 0
    assert '<link name="2right"/>' in run("convert", "--xacro", robot, "side:=right", "--to", "urdf").stdout
    assert run("check", robot, "side:=right").exit_code == 2
