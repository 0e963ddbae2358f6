"""xacro input through the API: arguments, packages, places, and what must never become a traceback."""

import importlib
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

import twinform
from twinform.compiler import LoadOptions, read
from twinform.diagnostics import Diagnostic
from twinform.installation import install_command

pytestmark = pytest.mark.slow

NAMESPACE = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
ROBOT = f"""\
<robot {NAMESPACE} name="r">
  <xacro:arg name="prefix" default="left"/>
  <xacro:include filename="$(find parts)/wheel.xacro"/>
  <link name="$(arg prefix)_base"/>
  <xacro:wheel radius="1"/>
</robot>
"""
WHEEL = f"""\
<robot {NAMESPACE}>
  <xacro:macro name="wheel" params="radius">
    <link name="wheel"/>
    <joint name="axle" type="fixed"><parent link="$(arg prefix)_base"/><child link="wheel"/></joint>
  </xacro:macro>
</robot>
"""
TWO_WHEELS = WHEEL.replace('<link name="wheel"/>', '<link name="wheel"/>\n<link name="wheel"/>')


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    """A robot that takes its wheel from a package."""
    parts = tmp_path / "elsewhere" / "parts"
    parts.mkdir(parents=True)
    (parts / "wheel.xacro").write_text(WHEEL)
    path = tmp_path / "robot.urdf.xacro"
    path.write_text(ROBOT)
    return path


def _rules(diagnostics: tuple[Diagnostic, ...]) -> list[str]:
    return [each.rule.name for each in diagnostics]


def _write(folder: Path, body: str) -> Path:
    path = folder / "robot.urdf.xacro"
    path.write_text(f'<robot {NAMESPACE} name="r">\n{body}\n<link name="base"/></robot>')
    return path


def test_packages_are_found_in_the_folders_given(robot: Path) -> None:
    document = twinform.load(robot, paths=[robot.parent / "elsewhere"])
    assert [link.name for link in document.models[0].links] == ["left_base", "wheel"]


def test_a_package_that_is_nowhere_is_an_error_on_its_line(robot: Path) -> None:
    checked = twinform.check(robot)
    error = next(each for each in checked.diagnostics if each.is_error)
    assert (error.rule.name, error.location.file, error.location.line) == ("missing-package", str(robot), 3)
    assert "looked in" in (error.help or "")


def test_arguments_take_the_place_of_defaults(robot: Path) -> None:
    document = twinform.load(robot, paths=[robot.parent / "elsewhere"], arguments={"prefix": "right"})
    assert document.models[0].links[0].name == "right_base"


def test_an_argument_that_nothing_asks_for_is_reported(robot: Path) -> None:
    checked = twinform.check(robot, paths=[robot.parent / "elsewhere"], arguments={"prefx": "right"})
    assert "unused-argument" in _rules(checked.diagnostics)


def test_a_finding_in_an_included_file_names_that_file_and_the_expanded_line(robot: Path) -> None:
    wheel = robot.parent / "elsewhere/parts/wheel.xacro"
    wheel.write_text(TWO_WHEELS)
    checked = twinform.check(robot, paths=[robot.parent / "elsewhere"])
    twice = next(each for each in checked.diagnostics if each.rule.name == "duplicate-name")
    assert (twice.location.file, twice.location.line) == (str(wheel), 4)
    expanded = twice.related[0]
    assert expanded.file == f"{robot} (expanded)"
    assert expanded.line > 5


def test_findings_of_later_stages_are_traced_too(tmp_path: Path) -> None:
    path = _write(tmp_path, '<link name="tip"><inertial>\n<mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" '
                  'iyz="0" izz="9"/></inertial></link>\n<joint name="j" type="fixed"><parent link="base"/>'
                  '<child link="tip"/></joint>')  # fmt: skip
    result = twinform.convert(path, to="sdf", passes="check-inertia")
    places = {each.location.file for each in result.diagnostics} | {
        each.location.file for each in result.ledger.entries
    }
    assert places == {str(path)}


def test_one_source_becomes_both_languages(robot: Path) -> None:
    paths = [robot.parent / "elsewhere"]
    assert "<robot" in twinform.convert(robot, to="urdf", paths=paths).text
    assert "<sdf" in twinform.convert(robot, to="sdf", paths=paths).text


def test_xacro_is_refused_where_it_is_not_wanted(robot: Path) -> None:
    checked = twinform.check(robot, xacro=False)
    assert checked.unreadable
    assert _rules(checked.diagnostics) == ["xacro-refused"]


def test_a_machine_without_xacro_gets_a_hint_what_to_run(robot: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shadow = robot.parent / "shadow"
    shadow.mkdir()
    (shadow / "xacro.py").write_text("raise ImportError('there is none')")
    monkeypatch.setenv("PYTHONPATH", str(shadow))
    error = twinform.check(robot).diagnostics[0]
    assert error.rule.name == "xacro-missing"
    assert error.help == f"run: {install_command()}"


def test_a_file_that_is_not_there_is_unreadable(tmp_path: Path) -> None:
    checked = twinform.check(tmp_path / "none.urdf.xacro")
    assert checked.unreadable
    assert _rules(checked.diagnostics) == ["unreadable-file"]


def test_messages_of_the_file_are_reported_at_their_places(tmp_path: Path) -> None:
    path = _write(tmp_path, "<xacro:property name='a' value=\"${xacro.message('hello')}\"/>\n<link name='b${a}'/>")
    message = next(each for each in twinform.check(path).diagnostics if each.rule.name == "xacro-message")
    assert (message.message, message.location.line) == ("hello", 3)


@pytest.mark.parametrize(("name", "meant"), [("parts/wheels.xacro", "wheel.xacro"), ("parts/sensor.xacro", None)])
def test_a_file_with_a_name_like_one_that_is_included_is_suggested(
    name: str, meant: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts/wheel.xacro").write_text(WHEEL)
    (tmp_path / "r.urdf.xacro").write_text(f'<robot {NAMESPACE} name="r"><xacro:include filename="{name}"/></robot>')
    monkeypatch.chdir(tmp_path)
    for path in ("r.urdf.xacro", str(tmp_path / "r.urdf.xacro")):
        (found,) = twinform.check(path).diagnostics
        assert "No such file" in found.message
        assert found.help == (meant and f"did you mean {meant!r}?")


def test_printing_and_reading_do_not_disturb_the_conversation(tmp_path: Path) -> None:
    path = _write(tmp_path, "${xacro.message('[1]')}${xacro.load_yaml('/dev/stdin')}")
    message, error = twinform.check(path).diagnostics
    assert (message.message, error.rule.name) == ("[1]", "xacro-error")
    assert "outside of the folders" in error.message


def test_an_expansion_without_an_end_is_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.import_module("twinform.compiler.input.expand_xacro"), "_SECONDS", 0.5)
    path = _write(tmp_path, f"<xacro:macro name='m' params='a:={'b' * 60}\"'/>")
    assert "did not end" in twinform.check(path).diagnostics[0].message


def test_what_wants_all_memory_is_stopped(tmp_path: Path) -> None:
    path = _write(tmp_path, f"<xacro:macro name='m'><a>{'x' * 2**24}</a></xacro:macro>{'<xacro:m/>' * 60}")
    assert "memory" in twinform.check(path).diagnostics[0].message


def test_the_process_has_no_variables_of_the_environment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = _write(tmp_path, '<link name="$(optenv SIDE left)"/>')
    monkeypatch.setenv("SIDE", "right")
    for given, side in (((), "left"), (("SIDE",), "right")):
        document = read(path, LoadOptions(variables=given)).document
        assert document
        assert document.models[0].links[0].name == side
    passed_on = importlib.import_module("twinform.compiler.input.expand_xacro").environment()
    assert "SIDE" not in passed_on


def test_a_set_is_written_in_the_same_order_each_time(tmp_path: Path) -> None:
    path = _write(tmp_path, "${xacro.message(python.set('right front left rear'.split()))}")
    assert len({twinform.check(path).diagnostics for _ in range(3)}) == 1


@pytest.mark.parametrize("answer", ["no json", "", '{"read": 1', "[]"])
def test_a_process_that_talks_nonsense_is_an_error(
    answer: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    worker = tmp_path / "worker.py"
    worker.write_text(f"print({answer!r})")
    monkeypatch.setattr(importlib.import_module("twinform.compiler.input.expand_xacro"), "_WORKER", worker)
    assert "the expansion died" in twinform.check(_write(tmp_path, "")).diagnostics[0].message


def test_bytes_are_never_expanded() -> None:
    assert read(ROBOT.encode(), LoadOptions(), name="robot.urdf.xacro").document is not None


def test_the_process_has_the_folders_of_libraries_and_not_the_current_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "xacro").mkdir()
    (tmp_path / "xacro" / "__init__.py").write_text("raise SystemExit")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", ["", str(tmp_path), *sys.path])
    assert twinform.check(_write(tmp_path, "")).accepted


@pytest.mark.parametrize("folders", [(), ("/nowhere",)])
def test_where_the_libraries_are_not_known_python_looks_for_them(
    folders: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    conversation = importlib.import_module("twinform.compiler.input.expand_xacro")
    monkeypatch.setattr(conversation, "_library_folders", lambda: folders)
    assert twinform.check(_write(tmp_path, "")).accepted


def test_data_that_only_an_included_file_reads_is_read(tmp_path: Path) -> None:
    (tmp_path / "data.txt").write_text("name: left\n")
    inner = f"<robot {NAMESPACE}><link name=\"${{xacro.load_yaml('data.txt')['name']}}\"/></robot>"
    (tmp_path / "inner.xacro").write_text(inner)
    document = twinform.check(_write(tmp_path, '<xacro:include filename="inner.xacro"/>')).document
    assert document
    assert document.models[0].links[0].name == "left"


def test_most_files_are_expanded_without_the_yaml_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    conversation = importlib.import_module("twinform.compiler.input.expand_xacro")
    tasks: list[Mapping[str, object]] = []
    ask = conversation._ask

    def noted(path: Path, search: object, task: Mapping[str, object], folders: object) -> object:
        tasks.append(task)
        return ask(path, search, task, folders)

    monkeypatch.setattr(conversation, "_ask", noted)
    assert twinform.check(_write(tmp_path, '<xacro:if value="${1 + 1 == 3}"><oops/></xacro:if>')).accepted
    assert [task["yaml"] for task in tasks] == [False]
