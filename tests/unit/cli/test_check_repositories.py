"""`twinform check DIR` on what a repository is made of: robots, the files that they include, arguments and packages."""

import json
from pathlib import Path

import pytest

from .conftest import Run

pytest.importorskip("xacro")

_HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"'
_ROBOT = f'{_HEAD} name="r">'
_PART = f"{_HEAD}>"


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _findings(run: Run, *words: str) -> list[tuple[str, str, str, int]]:
    done = run("check", *words, "--format", "json", "--notes")
    return [
        (row["rule"], row["severity"], row.get("file") or file["path"], row["line"])
        for file in json.loads(done.stdout)["files"]
        for row in file["diagnostics"]
        if row["severity"] != "info"
    ]


def _include(name: str) -> str:
    return f'<xacro:include filename="{name}"/>'


def test_a_part_is_checked_where_it_is_included_and_not_as_a_robot(run: Run, here: Path) -> None:
    Path("arm.urdf.xacro").write_text(
        f'{_ROBOT}<xacro:arg name="side" default="left"/><link name="torso"/>\n{_include("part.xacro")}</robot>'
    )
    joint = '<joint name="c" type="fixed"><parent link="{}"/><child link="$(arg side)"/></joint>'
    Path("part.xacro").write_text(f'{_ROBOT}<link name="$(arg side)"/>\n{joint.format("torso")}</robot>')
    assert _findings(run, ".") == []
    Path("part.xacro").write_text(f'{_ROBOT}<link name="$(arg side)"/>\n{joint.format("torsoo")}</robot>')
    assert _findings(run, ".") == [("dangling-link", "error", "part.xacro", 2)]


def test_one_fault_in_a_part_is_one_finding_however_many_robots_include_it(run: Run, here: Path) -> None:
    for name in ("one", "two", "three"):
        Path(f"{name}.urdf.xacro").write_text(f'{_ROBOT}{_include("part.xacro")}<link name="base"/></robot>')
    Path("part.xacro").write_text(f'{_PART}<link name="arm"/>\n\n oops\n<joint name="j" type="fixed">'
                                  '<parent link="base"/><child link="arm"/></joint></robot>')  # fmt: skip
    assert _findings(run, ".") == [("stray-text", "warning", "part.xacro", 3)]
    assert "2 in other files too" in run("check", ".").stderr
    assert run("check", ".", "--baseline", "known.json", "--update-baseline").exit_code == 0
    Path("one.urdf.xacro").unlink()
    assert run("check", ".", "--baseline", "known.json").stdout == ""


def test_a_macro_that_is_called_twice_has_its_fault_once(run: Run, here: Path) -> None:
    Path("r.urdf.xacro").write_text(
        f'{_ROBOT}{_include("wheel.xacro")}<link name="base"/>'
        '<xacro:wheel name="left"/><xacro:wheel name="right"/></robot>'
    )
    joint = '<joint name="${name}" type="fixed"><parent link="base"/><child link="${name}"/></joint>'
    Path("wheel.xacro").write_text(
        f'{_PART}<xacro:macro name="wheel" params="name">\n<link name="${{name}}"><colour/></link>{joint}'
        "</xacro:macro></robot>"
    )
    assert _findings(run, ".") == [("unknown-element", "warning", "wheel.xacro", 2)]


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("<xacro:macro name='m' params='a'>\n<link name='${a +}'/></xacro:macro>", 2, "'a +' is no expression"),
        ("\n<xacro:macro params='a'/>", 2, "<xacro:macro> has no attribute 'name'"),
        ("\n<xacro:include/>", 2, "<xacro:include> has no attribute 'filename'"),
        ("<xacro:property name='p' value='${1'/>", 1, "has no closing brace"),
        ("<xacro:macro name='a.b'/>", 1, "a macro cannot be called 'a.b'"),
        ("\n<link", 2, "not well-formed"),
    ],
)
def test_a_file_of_macros_is_checked_as_one(run: Run, here: Path, text: str, line: int, words: str) -> None:
    Path("macros.xacro").write_text(f"{_PART}{text}</robot>")
    done = run("check", ".")
    assert (done.exit_code, f"macros.xacro:{line}:" in done.stdout, words in done.stdout) == (1, True, True)
    assert "link" not in done.stdout.replace("<link", "").partition("[")[0]
    assert run("check", ".", "--allow", "xacro-error", "--allow", "not-well-formed").exit_code == 0


def test_macros_without_a_fault_are_no_robot_and_no_error(run: Run, here: Path) -> None:
    Path("macros.xacro").write_text(
        f"{_PART}<xacro:property name='r' value='${{arg(1) &gt; 0 and\n 2}}'/>"
        "<xacro:macro name='m' params='a b:=1'><link name='${a}_$(arg side)'/></xacro:macro></robot>"
    )
    Path("empty.urdf").write_text("<robot><!-- a place for what others add --></robot>")
    Path("groups.srdf.xacro").write_text(f'{_PART}<xacro:macro name="m"><group name="arm"/></xacro:macro></robot>')
    Path("plane.world").write_text("define floorplan model ( boundary 1 )")
    done = run("check", ".")
    assert (done.exit_code, done.stdout) == (0, "")
    assert done.stderr == "3 files: 0 errors, 0 warnings, 0 notes\n"


def test_a_circle_of_includes_names_its_files(run: Run, here: Path) -> None:
    Path("a.urdf.xacro").write_text(f'{_ROBOT}<link name="l"/>\n{_include("more/b.xacro")}</robot>')
    Path("more").mkdir()
    Path("more/b.xacro").write_text(f"{_PART}\n\n{_include('../a.urdf.xacro')}</robot>")
    assert "a.urdf.xacro includes b.xacro, which includes a.urdf.xacro" in run("check", ".").stdout


def test_paths_are_relative_to_where_the_check_began(run: Run, here: Path) -> None:
    Path("bot/urdf").mkdir(parents=True)
    Path("bot/package.xml").write_text("<package><name>bot</name></package>")
    Path("bot/urdf/r.urdf.xacro").write_text(f"{_ROBOT}{_include('$(find bot)/urdf/part.xacro')}</robot>")
    Path("bot/urdf/part.xacro").write_text(f"{_PART}\n<link name='a'><colour/></link></robot>")
    assert _findings(run, ".") == [("unknown-element", "warning", "bot/urdf/part.xacro", 2)]
    sarif = json.loads(run("check", "bot", "--format", "sarif").stdout)["runs"][0]["results"]
    places = [each["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] for each in sarif]
    assert places == ["bot/urdf/part.xacro"]


def test_a_package_is_found_in_the_folder_that_is_checked(run: Run, here: Path) -> None:
    Path("src/one/urdf").mkdir(parents=True)
    Path("src/deep/er/two-ros").mkdir(parents=True)
    Path("src/deep/er/two-ros/package.xml").write_text("<package><name>two</name></package>")
    Path("src/deep/er/two-ros/part.xacro").write_text(f"{_PART}<link name='a'/></robot>")
    Path("src/one/urdf/r.urdf.xacro").write_text(f"{_ROBOT}{_include('$(find two)/part.xacro')}</robot>")
    assert _findings(run, "src") == []
    assert _findings(run, "src/one") == [("missing-package", "warning", "src/one/urdf/r.urdf.xacro", 1)]


def test_missing_arguments_are_named_all_at_once_with_what_to_write(run: Run, here: Path) -> None:
    Path("urdf").mkdir()
    Path("urdf/arm.urdf.xacro").write_text(
        f"{_ROBOT}\n<xacro:arg name='given' default='1'/><link name='$(arg dof)_$(arg given)'/>"
        f"{_include('part.xacro')}</robot>"
    )
    Path("urdf/part.xacro").write_text(f"{_PART}<link name='$(arg side)'/><!-- $(arg none) --></robot>")
    Path("package.xml").write_text("<package><name>arm</name></package>")
    Path("launch").mkdir()
    Path("launch/view.launch.py").write_text(
        "raise SystemExit('run')\n"
        "DeclareLaunchArgument('dof', description='joints', default_value='7')\n'arm.urdf.xacro'"
    )
    done = run("check", "urdf/arm.urdf.xacro")
    assert done.exit_code == 1
    assert "urdf/arm.urdf.xacro:2:" in done.stdout
    assert "error: the arguments 'dof', 'side' have no values [missing-argument]" in done.stdout
    assert "pass dof:=7 side:=VALUE (values from view.launch.py)" in done.stdout
    assert '<xacro:arg name="dof" default="..."/>' in done.stdout
    assert 'match = ["arm.urdf.xacro"], arguments = { dof = "7", side = "..." }' in done.stdout
    assert run("check", "urdf/arm.urdf.xacro", "--allow", "missing-argument").exit_code == 0
    done = run("check", ".")
    assert (done.exit_code, "warning: the arguments" in done.stdout) == (0, True)
    assert "1 not checked, for want of arguments or packages" in done.stderr
    assert run("check", ".", "--deny", "missing-argument").exit_code == 1
    Path("twinform.toml").write_text('[[files]]\nmatch = ["arm.urdf.xacro"]\narguments = { dof = "7", side = "left" }')
    assert "missing-argument" not in run("check", ".").stdout


def test_a_package_that_is_missing_for_a_text_hides_nothing_else(run: Run, here: Path) -> None:
    Path("r.urdf.xacro").write_text(
        f"{_ROBOT}<link name='a'><colour/></link>\n<gazebo><plugin name='p' filename='libp.so'>"
        "<file>$(find nowhere)/control.yaml</file></plugin></gazebo></robot>"
    )
    found = {(rule, severity, line) for rule, severity, _, line in _findings(run, "r.urdf.xacro")}
    assert {("missing-package", "warning", 2), ("unknown-element", "warning", 1)} <= found
    done = run("convert", "r.urdf.xacro", "--to", "sdf")
    assert (done.exit_code, "error: package 'nowhere' is not found" in done.stderr) == (1, True)


def test_arguments_of_a_folder_are_for_the_files_that_have_them(run: Run, here: Path) -> None:
    Path("one.urdf.xacro").write_text(f"{_ROBOT}<link name='$(arg side)'/></robot>")
    Path("two.urdf.xacro").write_text(f"{_ROBOT}<link name='b'/></robot>")
    assert _findings(run, ".", "side:=left") == []
    assert "unused-argument" in run("check", "two.urdf.xacro", "side:=left").stdout
    assert "no file has the argument 'sdie'" in run("check", ".", "sdie:=left", "side:=left").stderr


def test_a_file_that_is_no_model_is_a_finding_and_a_path_that_is_none_is_wrong_usage(run: Run, here: Path) -> None:
    Path("broken.urdf").write_text("<robot")
    Path("gone.urdf").symlink_to("nowhere.urdf")
    assert run("check", ".").exit_code == 1
    assert run("check", ".", "--allow", "not-well-formed", "--allow", "unreadable-file").exit_code == 0
    assert run("check", ".", "--baseline", "known.json", "--update-baseline").exit_code == 0
    assert run("check", ".", "--baseline", "known.json").exit_code == 0
    assert run("check", "broken.urdf").exit_code == 1
    assert run("check", "nowhere.urdf").exit_code == 2


def test_links_of_strangers_lead_to_no_file_outside(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (here / "project").mkdir()
    monkeypatch.chdir(here / "project")
    secret = here / "key.xacro"
    secret.write_text(f"{_PART}<xacro:include filename='more.xacro'/><xacro:macro/></robot>")
    Path("link.xacro").symlink_to(secret)
    Path("r.urdf.xacro").write_text(f"{_ROBOT}<link name='a'/>{_include(str(secret))}</robot>")
    done = run("check", ".")
    assert "<xacro:macro" not in done.stdout
    assert done.stdout.count("outside of the folders") == 2


def test_the_exit_code_is_as_it_was_asked_for(run: Run, here: Path) -> None:
    Path("a.urdf").write_text("<robot name='r'><link name='a'><colour/><colour/></link></robot>")
    Path("b.urdf").write_text("<robot name='r'/>")
    assert run("check", "a.urdf", "--max-warnings", "2").exit_code == 0
    done = run("check", "a.urdf", "--max-warnings", "1")
    assert (done.exit_code, "more warnings than --max-warnings 1" in done.stderr) == (1, True)
    assert run("check", ".", "--exit-zero", "--max-warnings", "0").exit_code == 0
    assert run("check", "nowhere.urdf", "--exit-zero").exit_code == 2
    assert "     2  unknown-element\n" in run("check", ".", "--statistics").stderr


def test_an_unknown_rule_is_answered_in_a_line(run: Run, here: Path) -> None:
    Path("a.urdf").write_text("<robot name='r'><link name='a'/></robot>")
    for name, words in (("unknwn-element", "did you mean unknown-element?"), ("qqq", "`twinform explain` lists")):
        done = run("check", "a.urdf", "--allow", name)
        assert (done.exit_code, words in done.stderr, len(done.stderr) < 400) == (2, True, True)


def test_the_configuration_has_a_schema(run: Run, here: Path) -> None:
    schema = json.loads(run("schema", "config").stdout)
    assert {"allow", "extend-exclude", "for", "files", "max-size"} <= schema["properties"].keys()
    assert schema["additionalProperties"] is False


def test_groups_of_rules_are_allowed_and_denied_and_rules_win_over_them(run: Run, here: Path) -> None:
    Path("a.urdf").write_text("<robot name='r'><link name='a'><colour/></link></robot>")
    assert run("check", "a.urdf", "--ignore", "structure").stdout == ""
    assert run("check", "a.urdf", "--allow", "physics").stdout != ""
    assert run("check", "a.urdf", "--deny", "structure").exit_code == 1
    assert run("check", "a.urdf", "--deny", "structure", "--allow", "unknown-element").exit_code == 0
    assert run("check", "a.urdf", "--allow", "structure", "--deny", "unknown-element").exit_code == 1
    Path("twinform.toml").write_text("allow = ['structure']")
    assert run("check", "a.urdf").stdout == ""
    assert "did you mean physics?" in run("check", "a.urdf", "--allow", "physcs").stderr


def test_two_links_to_one_file_are_two_names_of_a_robot(run: Run, tmp_path: Path) -> None:
    (tmp_path / "one.urdf").write_text('<robot name="r"><link name="a"/></robot>')
    for name in ("two.urdf", "three.urdf"):
        (tmp_path / name).symlink_to("one.urdf")
    done = run("check", str(tmp_path))
    assert (done.exit_code, done.output.splitlines()[-1]) == (0, "3 files: 0 errors, 0 warnings, 0 notes")


def test_an_argument_that_is_missing_everywhere_is_one_finding(run: Run, here: Path) -> None:
    for name in ("one", "two"):
        Path(f"{name}.urdf.xacro").write_text(f'{_ROBOT}{_include("part.xacro")}<link name="base"/></robot>')
    Path("part.xacro").write_text(f'{_PART}<link name="$(arg side)"/></robot>')
    assert _findings(run, ".") == [("missing-argument", "warning", "part.xacro", 1)]


def test_an_argument_that_is_empty_unless_passed_is_missing_where_a_path_is_made_of_it(run: Run, here: Path) -> None:
    text = f'{_ROBOT}<xacro:arg name="kind" default=""/>\n{_include("arms/$(arg kind)/arm.xacro")}</robot>'
    Path("r.urdf.xacro").write_text(text)
    assert _findings(run, ".") == [("missing-argument", "warning", "r.urdf.xacro", 2)]
    assert "kind:=VALUE" in run("check", ".").stdout
    Path("r.urdf.xacro").write_text(text.replace('default=""', 'default="short"'))
    assert _findings(run, ".") == [("xacro-error", "error", "r.urdf.xacro", 2)]


def test_a_default_that_stands_behind_its_use_is_said_to(run: Run, here: Path) -> None:
    text = f'{_HEAD} name="$(arg name)">\n<xacro:arg name="name" default="r"/><link name="a"/></robot>'
    Path("r.urdf.xacro").write_text(text)
    assert "the default of 'name' stands behind this place" in run("check", ".").stdout


def test_a_robot_called_xacro_urdf_is_expanded(run: Run, here: Path) -> None:
    Path("r.xacro.urdf").write_text(f'{_ROBOT}<xacro:property name="n" value="a"/><link name="${{n}}"/></robot>')
    Path("parts.xacro.urdf").write_text(
        f'{_PART}<xacro:macro name="m" params="n"><link name="${{n}}"/></xacro:macro></robot>'
    )
    assert _findings(run, ".") == []
    assert _findings(run, "r.xacro.urdf") == []


@pytest.mark.parametrize(("root", "severity"), [("control_surface", "info"), ("model", "error"), ("robto", "error")])
def test_a_template_of_another_program_is_no_broken_model(run: Run, here: Path, root: str, severity: str) -> None:
    Path("t.sdf").write_text(f"<{root}/>")
    done = run("check", ".", "--notes")
    assert f"t.sdf:1:2: {severity}: the root element is <{root}>" in done.stdout
    assert ("could not be read" in done.stderr, done.exit_code) == ((False, 0) if severity == "info" else (True, 1))
    assert run("check", "t.sdf").exit_code == 1


def test_what_a_build_puts_elsewhere_is_found_where_it_comes_from(run: Run, here: Path) -> None:
    Path("bot/description/control").mkdir(parents=True)
    Path("bot/description/meshes").mkdir()
    Path("bot/package.xml").write_text("<package><name>bot</name></package>")
    Path("bot/CMakeLists.txt").write_text(
        "# install(DIRECTORY nothing DESTINATION share/bot)\n"
        "install(\n  DIRECTORY description/control description/meshes/\n  DESTINATION share/${PROJECT_NAME}\n)\n"
    )
    Path("bot/description/meshes/a.stl").write_bytes(b"")
    mesh = '<visual><geometry><mesh filename="package://bot/a.stl"/></geometry></visual>'
    Path("bot/r.urdf.xacro").write_text(f"{_ROBOT}{_include('$(find bot)/control/part.xacro')}</robot>")
    Path("bot/description/control/part.xacro").write_text(f'{_ROBOT}\n<link name="a">{mesh}</link></robot>')
    assert _findings(run, ".") == [("broken-mesh", "warning", "bot/description/control/part.xacro", 2)]
    assert "the mesh 'package://bot/a.stl' is empty" in run("check", "bot/r.urdf.xacro").stdout
    Path("bot/CMakeLists.txt").unlink()
    assert "xacro-error" in [each[0] for each in _findings(run, ".")]


def test_a_package_that_is_missing_is_one_finding(run: Run, here: Path) -> None:
    for name in ("one", "two", "three"):
        Path(f"{name}.urdf.xacro").write_text(f"{_ROBOT}{_include('$(find nowhere)/a.xacro')}</robot>")
    Path("three.urdf.xacro").write_text(f"{_ROBOT}{_include('$(find elsewhere)/a.xacro')}</robot>")
    assert [each[0] for each in _findings(run, ".")] == ["missing-package"] * 2
    assert "3 not checked, for want of arguments or packages; 1 in other files too" in run("check", ".").stderr


def test_two_places_on_a_line_are_not_in_other_robots(run: Run, here: Path) -> None:
    Path("r.urdf.xacro").write_text(f'{_ROBOT}{_include("part.xacro")}<link name="base"/></robot>')
    Path("part.xacro").write_text(f'{_PART}<link name="arm"><colour/></link><link name="leg"><colour/></link></robot>')
    assert "other files" not in run("check", ".").stderr


def test_a_path_made_by_find_is_named_as_the_file_is(run: Run, here: Path) -> None:
    Path("arm").mkdir()
    Path("arm/package.xml").write_text("<package><name>arm</name></package>")
    for number, uri in enumerate(("$(find arm)/no.stl", "file://$(find arm)/no.stl")):
        mesh = f'<visual><geometry><mesh filename="{uri}"/></geometry></visual>'
        Path(f"arm/r{number}.urdf.xacro").write_text(f'{_ROBOT}<link name="base">{mesh}</link></robot>')
    assert run("check", ".").stdout.count("the mesh 'arm/no.stl' is not there") == 2


def test_xacro_in_a_file_that_is_called_so_is_expanded(run: Run, here: Path) -> None:
    text = (
        f'{_ROBOT}<xacro:macro name="m" params="n"><link name="${{n}}"/></xacro:macro><xacro:m n="a"/><link name="b"/>'
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin rpy="0 ${pi} 0"/></joint></robot>'
    )
    Path("r.xacro.urdf").write_text(text)
    assert _findings(run, ".") == _findings(run, "r.xacro.urdf") == []
    assert " 3.14" in run("convert", "r.xacro.urdf", "--to", "urdf").stdout
    Path("r.urdf").write_text(text)
    assert [each[:2] for each in _findings(run, "r.urdf")] == [("unexpanded-xacro", "error")]


def test_a_plain_file_of_properties_is_no_robot(run: Run, here: Path) -> None:
    text = '<xacro:property name="a" value="1"/><material name="m"><color rgba="${a} 0 0 1"/></material>'
    Path("common.urdf").write_text(f"{_ROBOT}{text}</robot>")
    assert _findings(run, ".") == []
    Path("common.urdf").write_text('<robot name="r"><material name="m"><color rgba="1 0 0 1"/></material></robot>')
    assert ("no-links", "error", "common.urdf", 1) in _findings(run, ".")


def test_a_folder_of_meshes_that_was_moved_is_one_finding(run: Run, here: Path) -> None:
    Path("package.xml").write_text("<package><name>bot</name></package>")
    Path("here.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")

    def robot(count: int) -> str:
        uris = ["here.obj", *(f"old/part_{number}.obj" for number in range(count))]
        visual = '<visual><geometry><mesh filename="package://bot/{}"/></geometry></visual>\n'
        return f'<robot name="r"><link name="a">\n{"".join(map(visual.format, uris))}</link></robot>'

    Path("r.urdf").write_text(robot(4))
    assert [row[0] for row in _findings(run, ".")] == 4 * ["missing-file"]
    Path("r.urdf").write_text(robot(7))
    assert [row[0] for row in _findings(run, ".")] == ["missing-file"]
    assert "is not there, nor are 6 more files of package://bot" in run("check", ".").stdout
