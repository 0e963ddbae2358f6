"""Which rules are reported: `--select`, `--ignore`, presets, and comments that `--add-allow` writes."""

import json
from pathlib import Path

import pytest

from .conftest import Run

ROBOT = """\
<robot name="r">
  <link name="base"><color/></link>
  <link name="arm"><visual><geometry><mesh filename="no.stl"/></geometry></visual></link>
  <joint name="j" type="revolute">
    <parent link="base"/>
    <child link="arm"/>
  </joint>
</robot>
"""


@pytest.fixture
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "robot.urdf").write_text(ROBOT)
    return tmp_path / "robot.urdf"


def _rules(run: Run, *options: str) -> set[str]:
    done = run("check", "robot.urdf", "--format", "json", *options)
    assert done.exit_code != 2, done.stderr
    return {each["rule"] for each in json.loads(done.stdout)["files"][0]["diagnostics"] if each["severity"] != "info"}


@pytest.mark.usefixtures("robot")
def test_rules_are_selected_by_name_and_group(run: Run) -> None:
    every = _rules(run)
    assert every >= {"unknown-element", "missing-file", "missing-limit"}
    assert _rules(run, "--select", "missing-file") == {"missing-file"}
    assert _rules(run, "--select", "limits") == {"missing-limit"}
    assert _rules(run, "--select", "limits", "--extend-select", "missing-file") == {"missing-limit", "missing-file"}
    assert _rules(run, "--ignore", "limits") == every - {"missing-limit"}
    assert _rules(run, "--select", "missing-file", "--ignore", "references") == {"missing-file"}
    assert _rules(run, "--select", "limits", "--deny", "missing-file") == {"missing-limit", "missing-file"}


@pytest.mark.usefixtures("robot")
def test_settings_select_and_the_command_line_wins(run: Run) -> None:
    Path("twinform.toml").write_text("select = ['limits']\nextend-select = ['missing-file']")
    assert _rules(run) == {"missing-limit", "missing-file"}
    assert _rules(run, "--select", "unknown-element") == {"unknown-element"}
    assert _rules(run, "--extend-select", "unknown-element") == {"missing-limit", "missing-file", "unknown-element"}
    Path("twinform.toml").write_text("ignore = ['limits']\n[[files]]\nmatch = ['*.urdf']\nextend-select = ['limits']")
    assert "missing-limit" in _rules(run)


def test_what_keeps_a_file_from_being_read_is_always_reported(run: Run, robot: Path) -> None:
    robot.write_text("<robot>")
    assert "not-well-formed" in _rules(run, "--select", "meshes")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--select", "mesh"], "did you mean meshes?"),
        (["--ignore", "missing-limt"], "did you mean missing-limit?"),
        (["--select", "limits", "--ignore", "limits"], "limits is allowed and selected"),
        (["--allow", "warnings"], "no rule is called warnings"),
        (["--preset", "strikt"], "'strict'"),
        (["--stdin-filename", "a.urdf"], "give - as an input"),
        (["--add-allow", "--fix"], "leave --fix"),
    ],
)
@pytest.mark.usefixtures("robot")
def test_wrong_usage(run: Run, options: list[str], message: str) -> None:
    done = run("check", "robot.urdf", *options)
    assert (done.exit_code, message in done.stderr) == (2, True), done.stderr


@pytest.mark.usefixtures("robot")
def test_presets_are_defaults_that_single_settings_go_before(run: Run) -> None:
    assert run("check", "robot.urdf", "--allow", "missing-limit").exit_code == 0
    strict = run("check", "robot.urdf", "--preset", "strict", "--select", "missing-file")
    assert (strict.exit_code, "error: " in strict.stdout) == (1, True)
    swift = '<limit lower="0" upper="1" effort="1" velocity="1e5"/><parent link="base"/>'
    Path("swift.urdf").write_text(ROBOT.replace('<parent link="base"/>', swift))
    assert "[implausible-limit]" not in run("check", "swift.urdf").stdout
    assert "[implausible-limit]" in run("check", "swift.urdf", "--preset", "doctor").stdout
    Path("twinform.toml").write_text("preset = 'strict'\nselect = ['unknown-element', 'zero-size']\nstrict = false")
    assert run("check", "robot.urdf").exit_code == 1
    assert run("check", "robot.urdf", "--allow", "unknown-element").exit_code == 0
    assert run("check", "robot.urdf", "--preset", "default", "--no-config").exit_code == run(
        "check", "robot.urdf", "--no-config"
    ).exit_code  # fmt: skip
    assert run("check", "robot.urdf", "--deny", "warnings", "--no-config", "--select", "missing-file").exit_code == 1


@pytest.mark.parametrize("style", ["text", "json", "sarif", "github", "junit"])
@pytest.mark.usefixtures("robot")
def test_findings_are_written_into_a_file(run: Run, style: str) -> None:
    printed = run("check", "robot.urdf", "--format", style)
    written = run("check", "robot.urdf", "--format", style, "--output-file", "out/found.txt")
    assert (written.exit_code, written.stdout, written.stderr) == (printed.exit_code, "", printed.stderr)
    assert Path("out/found.txt").read_text() == printed.stdout
    over = run("check", "robot.urdf", "--output-file", "robot.urdf")
    assert (over.exit_code, "which is read" in over.stderr) == (2, True)
    assert Path("robot.urdf").read_text() == ROBOT


def test_text_of_an_editor_has_the_name_and_the_settings_of_its_file(run: Run, robot: Path) -> None:
    Path("arm").mkdir()
    Path("arm/no.stl").write_text("solid a\nendsolid a\n")
    Path("arm/twinform.toml").write_text("deny = ['unknown-element']")
    done = run("check", "-", "--stdin-filename", "arm/robot.urdf", text=ROBOT)
    assert "arm/robot.urdf:2:22: error: " in done.stdout
    assert "[missing-file]" not in done.stdout
    assert "[missing-file]" in run("check", "-", "--stdin-filename", "robot.urdf", text=ROBOT).stdout
    fixed = run("check", "-", "--stdin-filename", "arm/robot.urdf", "--fix", text=ROBOT)
    assert fixed.stdout == ROBOT
    assert not Path("arm/robot.urdf").exists()
    assert robot.read_text() == ROBOT


def test_comments_allow_what_is_found_today_and_nothing_else_changes(run: Run, robot: Path) -> None:
    shown = run("check", "robot.urdf", "--add-allow", "--diff")
    assert (shown.exit_code, robot.read_text()) == (1, ROBOT)
    assert '+  <link name="base"><color/></link>  <!-- twinform: allow unknown-element -->' in shown.stdout
    done = run("check", "robot.urdf", "--add-allow")
    assert done.exit_code == 0, done.output
    text = robot.read_text()
    without = text.replace("  <!-- twinform: allow ", "\0").split("\0")
    assert "".join([without[0], *(each.partition(" -->")[2] for each in without[1:])]) == ROBOT
    again = run("check", "robot.urdf")
    assert (again.exit_code, again.stdout) == (0, "")
    assert run("check", "robot.urdf", "--add-allow").exit_code == 0
    assert robot.read_text() == text


def test_a_comment_stands_behind_a_long_tag_and_never_in_a_text(run: Run, robot: Path) -> None:
    text = (
        '<robot name="r">\r\n  <link\r\n     name="a"\r\n     nme="b"\r\n  />\r\n  <link name="c">\r\n    <inertial>'
        "<mass value=\"1\"/>\r\n      <inertia ixx='-1'\r\n iyy='1' izz='1'/></inertial>\r\n  </link>\r\n</robot>\r\n"
    )
    robot.write_bytes(text.encode())
    run("check", "robot.urdf", "--add-allow", "--allow", "several-roots")
    after = robot.read_bytes().decode()
    assert "  />  <!-- twinform: allow unknown-attribute -->\r\n" in after
    assert after.count("\r\n") == after.count("\n")
    model = '<model name="m"><link name="a"><inertial>\n<mass>\n-1\n</mass></inertial></link></model>'
    Path("m.sdf").write_text(f'<sdf version="1.9">{model}</sdf>')
    run("check", "m.sdf", "--add-allow")
    after = Path("m.sdf").read_text()
    assert "<!-- twinform: allow" in after
    assert "<mass>\n-1\n</mass>" in after
    assert run("check", "m.sdf").exit_code == 0


def test_files_that_were_not_asked_for_are_left_alone(run: Run, robot: Path, tmp_path: Path) -> None:
    ns = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    part = f'<robot {ns}>\n  <link name="a"><color/></link>\n</robot>\n'
    Path("part.xacro").write_text(part)
    Path("whole.urdf.xacro").write_text(f'<robot name="w" {ns}><xacro:include filename="part.xacro"/></robot>\n')
    done = run("check", "whole.urdf.xacro", "--add-allow")
    assert Path("part.xacro").read_text() == part
    assert "part.xacro" in done.stderr
    assert "[[files]]" in done.stderr
    run("check", ".", "--add-allow")
    assert "allow unknown-element" in Path("part.xacro").read_text()
    assert "unknown-element" not in run("check", ".").stdout


@pytest.mark.parametrize("saved", [True, False])
def test_xacro_of_an_editor_is_expanded_with_what_it_includes(
    run: Run, tmp_path: Path, robot: Path, saved: bool
) -> None:
    ns = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    Path("part.xacro").write_text(f'<robot {ns}><link name="a"><color/></link></robot>')
    text = f'<robot name="w" {ns}>\n<xacro:include filename="part.xacro"/>\n<xacro:property name="n" value="b"/>\n'
    joint = '<joint name="j" type="fixed"><parent link="a"/><child link="${n}"/></joint>'
    if saved:
        Path("w.urdf.xacro").write_text("<robot/>")
    done = run("check", "-", "--stdin-filename", "w.urdf.xacro", text=f'{text}<link name="${{n}}"/>{joint}</robot>')
    assert done.exit_code == 0, done.stdout
    assert "part.xacro:1:" in done.stdout
    wrong = run("check", "-", "--stdin-filename", "w.urdf.xacro", text=f"{text}{joint}</robot>")
    assert (wrong.exit_code, "w.urdf.xacro:4" in wrong.stdout) == (1, True)
