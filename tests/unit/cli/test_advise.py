"""`twinform advise`: a table for people, an object for programs, and its errors."""

import json
from pathlib import Path

import pytest

from twinform import profiles

from .conftest import BROKEN, WRONG, Run

_IMPOSSIBLE = """\
<robot name="r">
  <link name="a"/>
  <link name="b">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="9" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>
</robot>
"""

_STICKER = """<link name="a">
    <inertial><mass value="1e-7"/><inertia ixx="3e-22" iyy="3e-22" izz="5e-22" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>"""


def test_a_row_for_each_consumer(run: Run) -> None:
    done = run("advise", "-", text=_IMPOSSIBLE)
    assert done.exit_code == 0
    lines = done.stdout.splitlines()
    for name in profiles.names():
        for profile in profiles.load(name):
            assert any(line.startswith(profile.label) for line in lines), profile.label


def test_what_a_consumer_minds_and_what_helps(run: Run) -> None:
    done = run("advise", "-", "--for", "mujoco", text=_IMPOSSIBLE)
    (row,) = [line for line in done.stdout.splitlines() if line.startswith("MuJoCo") and "balance-inertia" in line]
    assert "refuses" in row
    assert "* changes the physics" in done.stdout
    assert ": line 4: " in done.stdout


def test_a_pass_is_named_once_for_people_and_with_its_options_for_programs(run: Run) -> None:
    text = _IMPOSSIBLE.replace('<link name="a"/>', _STICKER)
    said = run("advise", "-", "--for", "mujoco", text=text).stdout
    (row,) = [line for line in said.splitlines() if line.startswith("MuJoCo") and "balance-inertia" in line]
    assert row.count("balance-inertia") == 1
    assert "refuses: line 2: link 'a' has a moment that is not positive, or next to nothing, and 1 more" in said
    found = json.loads(run("advise", "-", "--for", "mujoco", "--format", "json", text=text).stdout)
    assert found["consumers"][0]["passes"] == ["balance-inertia{least=2e-14}", "balance-inertia"]


def test_the_same_for_programs(run: Run) -> None:
    done = run("advise", "-", "--for", "mujoco,drake", "--format", "json", text=_IMPOSSIBLE)
    found = json.loads(done.stdout)
    assert (found["format"], found["keep"]) == ("urdf", "urdf")
    drake, mujoco = sorted(found["consumers"], key=lambda each: each["name"])
    assert set(drake["forms"]) == {"urdf", "sdf"}
    assert set(mujoco["forms"]) == {"urdf"}
    assert mujoco["forms"]["urdf"]["verdict"] == "refuses"
    (finding,) = [each for each in mujoco["forms"]["urdf"]["findings"] if each["rule"] == "impossible-inertia"]
    assert (finding["effect"], finding["line"]) == ("refuses", 4)


def test_the_file_is_not_changed(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(_IMPOSSIBLE, encoding="utf-8")
    assert run("advise", path).exit_code == 0
    assert path.read_text(encoding="utf-8") == _IMPOSSIBLE
    assert [each.name for each in tmp_path.iterdir()] == ["robot.urdf"]


@pytest.mark.parametrize(("text", "code"), [(BROKEN, 2), (WRONG, 1), ("", 2)])
def test_files_with_errors(run: Run, text: str, code: int) -> None:
    done = run("advise", "-", text=text)
    assert done.exit_code == code
    assert not done.stdout
    assert "error" in done.stderr


def test_wrong_names_of_consumers(run: Run) -> None:
    done = run("advise", "-", "--for", "mujocco", text=_IMPOSSIBLE)
    assert done.exit_code == 2
    assert "did you mean 'mujoco'?" in done.stderr


def test_a_hostile_name_is_printed_as_text(run: Run) -> None:
    done = run("advise", "-", text=_IMPOSSIBLE.replace('name="r"', 'name="r&#27;[31m"'))
    assert "\x1b" not in done.stdout


def test_two_files_are_refused(run: Run) -> None:
    assert run("advise", "a.urdf", "b.urdf").exit_code == 2
