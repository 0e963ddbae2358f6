"""`twinform convert --into`: a file follows the edits of the one that was made of it."""

import errno
import os
from collections.abc import Iterator
from copy import deepcopy
from itertools import count
from pathlib import Path
from typing import Any

import pytest

from twinform import file_access
from twinform.compiler import in_place, into
from twinform.compiler.input import parsing
from twinform.compiler.into import convert_into
from twinform.schemas import XmlElement
from twinform.text import Merge

from .conftest import Run

HAND_WRITTEN = """<robot name="r">
  <!-- two links, and the joint between them stands in between -->
  <link name='base'/>
  <joint name="j" type="continuous"> <!-- turns -->
    <parent link='base'/>  <child link='arm'/>
    <axis xyz="0.0 0 1"/>
  </joint>
  <link name='arm'> <inertial> <mass value="1.50"/>
    <inertia ixx="1e-2" ixy="0" ixz="0" iyy="0.010" iyz="0" izz="0.01"/> </inertial> </link>
</robot>
"""


@pytest.fixture
def twins(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a file that somebody wrote, and what it is converted to."""
    monkeypatch.chdir(tmp_path)
    Path("r.urdf").write_text(HAND_WRITTEN)
    assert run("convert", "r.urdf", "-o", "r.sdf").exit_code == 0
    return tmp_path


def _edit(name: str, old: str, new: str) -> None:
    text = Path(name).read_text()
    assert old in text
    Path(name).write_text(text.replace(old, new))


def test_nothing_changed_and_nothing_touched(run: Run, twins: Path) -> None:
    done = run("convert", "r.sdf", "--into", "r.urdf")
    assert (done.exit_code, Path("r.urdf").read_text()) == (0, HAND_WRITTEN)
    assert "r.urdf stays as it is" in done.stderr


def test_each_file_is_parsed_once(run: Run, twins: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _edit("r.sdf", "<mass>1.5</mass>", "<mass>2.5</mass>")
    files = {name: Path(name).read_bytes() for name in ("r.sdf", "r.urdf")}
    parsed: list[bytes] = []

    def counting(text: bytes, *given: Any, **options: Any) -> XmlElement:
        parsed.append(text)
        return parsing.parse(text, *given, **options)

    monkeypatch.setattr("twinform.compiler.input.loading.parse", counting)
    assert run("convert", "r.sdf", "--into", "r.urdf").exit_code == 0
    # the file into which the edits went is read once more as it became
    assert {name: parsed.count(data) for name, data in files.items()} == {"r.sdf": 1, "r.urdf": 1}


def test_an_edit_is_made_in_the_other_file(run: Run, twins: Path) -> None:
    _edit("r.sdf", "<mass>1.5</mass>", "<mass>2.5</mass>")
    done = run("convert", "r.sdf", "--into", "r.urdf")
    assert (done.exit_code, Path("r.urdf").read_text()) == (0, HAND_WRITTEN.replace("1.50", "2.5"))
    assert done.stderr.splitlines() == ["r.urdf:8:45: 1.50 becomes 2.5", "r.urdf: 1 change"]


def test_the_other_way_too(run: Run, twins: Path) -> None:
    made = Path("r.sdf").read_text()
    _edit("r.urdf", "1.50", "2.50")
    done = run("convert", "r.urdf", "--into", "r.sdf", "--base", "r.urdf")
    assert (done.exit_code, Path("r.sdf").read_text()) == (0, made), "the base is the edited file itself"
    assert run("convert", "r.urdf", "--into", "r.sdf").exit_code == 0
    assert Path("r.sdf").read_text() == made.replace("<mass>1.5<", "<mass>2.5<")


def test_both_sides_may_change_different_parts(run: Run, twins: Path) -> None:
    Path("old.sdf").write_text(Path("r.sdf").read_text())
    _edit("r.sdf", "<mass>1.5</mass>", "<mass>2.5</mass>")
    _edit("r.urdf", "0.0 0 1", "0 1.0 0")
    assert run("convert", "r.sdf", "--into", "r.urdf", "--base", "old.sdf").exit_code == 0
    assert Path("r.urdf").read_text() == HAND_WRITTEN.replace("1.50", "2.5").replace("0.0 0 1", "0 1.0 0")


def test_what_both_have_changed_is_a_conflict(run: Run, twins: Path) -> None:
    Path("old.sdf").write_text(Path("r.sdf").read_text())
    _edit("r.sdf", "<mass>1.5</mass>", "<mass>2.5</mass>")
    _edit("r.urdf", "1.50", "3.50")
    before = Path("r.urdf").read_text()
    done = run("convert", "r.sdf", "--into", "r.urdf", "--base", "old.sdf")
    assert (done.exit_code, Path("r.urdf").read_text()) == (1, before)
    assert "r.urdf:8:45: error: cannot be changed in place: value of <mass> was '1.5', is '3.50' here" in done.stderr
    assert "[edit-conflict]" in done.stderr


WORLD = """<sdf version="1.9">
  <world name="w">  <!-- a yard -->
    <model name="other"><link name="l"/></model>
    <model name="r"><link name='base'><inertial><mass>2.0</mass></inertial></link></model>
  </world>
</sdf>
"""


def test_a_robot_in_a_world_follows_in_its_place(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("w.sdf").write_text(WORLD)
    assert run("convert", "w.sdf", "--model", "r", "-o", "r.urdf").exit_code == 0
    _edit("r.urdf", 'mass value="2"', 'mass value="3"')
    assert run("convert", "r.urdf", "--into", "w.sdf", "--model", "r").exit_code == 0
    assert Path("w.sdf").read_text() == WORLD.replace("2.0", "3")
    _edit("w.sdf", "<mass>3<", "<mass>4<")
    done = run("convert", "w.sdf", "--into", "r.urdf", "--model", "r")
    assert (done.exit_code, done.stderr.splitlines()[-2:]) == (0, ["r.urdf:5:20: 3 becomes 4", "r.urdf: 1 change"])


def test_new_parts_are_of_the_version_of_the_file(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("r.urdf").write_text(HAND_WRITTEN)
    assert run("convert", "r.urdf", "-o", "r.sdf", "--sdf-version", "1.6").exit_code == 0
    _edit("r.urdf", 'xyz="0.0 0 1"/>', 'xyz="0.0 0 1"/><origin xyz="0 0 0.5"/>')
    assert run("convert", "r.urdf", "--into", "r.sdf").exit_code == 0
    assert "\n      <pose>0 0 0.5 0 0 0</pose>\n" in Path("r.sdf").read_text()
    assert run("diff", "r.urdf", "r.sdf").exit_code == 0


def test_a_new_name_is_followed_into_a_world(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("w.sdf").write_text(WORLD.replace('    <model name="other"><link name="l"/></model>\n', ""))
    assert run("convert", "w.sdf", "-o", "r.urdf").exit_code == 0
    _edit("r.urdf", 'name="r"', 'name="s"')
    _edit("r.urdf", 'mass value="2"', 'mass value="3"')
    _edit("w.sdf", '"r"', '"t"')
    before = Path("w.sdf").read_text()
    done = run("convert", "r.urdf", "--into", "w.sdf")
    assert Path("w.sdf").read_text() == before.replace("2.0", "3").replace('"t"', '"s"')
    assert done.exit_code == 0


def test_a_file_that_would_be_another_robot_is_not_written(
    run: Run, twins: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def wrong(_before: XmlElement, _after: XmlElement, own: XmlElement, **_: object) -> Merge:
        made = deepcopy(own)
        for mass in made.iter("mass"):
            mass.set("value", "7")
        return Merge(made, ())

    monkeypatch.setattr(in_place, "merge", wrong)
    _edit("r.sdf", "<mass>1.5</mass>", "<mass>2.5</mass>")
    done = run("convert", "r.sdf", "--into", "r.urdf")
    assert (done.exit_code, Path("r.urdf").read_text()) == (1, HAND_WRITTEN)
    assert "cannot be changed in place: inertial/mass of link 'arm' is 7" in done.stderr


def test_a_file_that_somebody_changes_meanwhile_is_not_written(
    run: Run, twins: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def slow(*arguments: Any, **options: Any) -> Any:
        made = convert_into(*arguments, **options)
        _edit("r.urdf", "turns", "turns on")
        return made

    monkeypatch.setattr("twinform.compiler.into.convert_into", slow)
    _edit("r.sdf", "<mass>1.5</mass>", "<mass>2.5</mass>")
    done = run("convert", "r.sdf", "--into", "r.urdf")
    assert (done.exit_code, Path("r.urdf").read_text()) == (2, HAND_WRITTEN.replace("turns", "turns on"))
    assert "r.urdf" in done.stderr


@pytest.mark.parametrize(
    ("command", "complaint"),
    [
        ("r.sdf --into other.sdf", "other.sdf is no file"),
        ("r.sdf --into r.sdf", "takes a file of another format"),
        ("r.sdf --base r.sdf", "--base is for --into"),
        ("r.sdf --into r.urdf --base none.sdf", "none.sdf is no file"),
        ("r.sdf --into r.urdf -o x.urdf", "leave -o, --in-place, --to, --passes and --depfile out"),
        ("r.sdf r.urdf --into r.urdf", "--into takes one input"),
        ("- --into r.urdf", "is no file that could have been made of r.urdf"),
    ],
)
def test_what_makes_no_sense_is_wrong_usage(run: Run, twins: Path, command: str, complaint: str) -> None:
    done = run("convert", *command.split(), text="<robot/>")
    assert (done.exit_code, Path("r.urdf").read_text()) == (2, HAND_WRITTEN)
    assert complaint in done.stderr


def test_a_file_that_cannot_be_read_stays(run: Run, twins: Path) -> None:
    Path("r.urdf").write_text("<robot")
    assert run("convert", "r.sdf", "--into", "r.urdf").exit_code == 2
    assert Path("r.urdf").read_text() == "<robot"


@pytest.mark.parametrize(
    ("source", "into", "old", "new"), [("r.urdf", "r.sdf", "1.50", "2.5"), ("r.sdf", "r.urdf", "1.5<", "2.5<")]
)
def test_a_file_that_cannot_be_read_any_more_is_an_error_with_a_message(
    source: str, into: str, old: str, new: str, run: Run, twins: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _edit(source, old, new)
    before, really = Path(into).read_text(), file_access.read_regular
    failed = 0
    for number in range(1, 9):
        calls = count(1)

        def failing(*given: Any, calls: Iterator[int] = calls, number: int = number) -> Any:
            if next(calls) == number:
                raise OSError(errno.EIO, os.strerror(errno.EIO))
            return really(*given)

        monkeypatch.setattr(file_access, "read_regular", failing)
        done = run("convert", source, "--into", into)
        if done.exit_code:  # a look at what a file is may fail: it is read after that
            failed += 1
            assert (done.exit_code, "Input/output error" in done.stderr) == (2, True)
            assert Path(into).read_text() == before
        Path(into).write_text(before)
    assert failed == 2  # each file is read once


FOLLOWER = """<link name="finger"><inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="k" type="continuous"><parent link="base"/><child link="finger"/><mimic joint="j"/></joint>"""


def test_what_only_a_carrier_says_has_not_followed(run: Run, twins: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _edit("r.urdf", "</robot>", f"{FOLLOWER}</robot>")
    assert run("convert", "r.urdf", "-o", "r.sdf", "--sdf-version", "1.11").exit_code == 0
    _edit("r.urdf", "1.50", "2.50")
    assert run("convert", "r.urdf", "-o", "carried.sdf", "--sdf-version", "1.10").exit_code == 0
    assert run("diff", "--carriers", "r.urdf", "carried.sdf").exit_code == 0
    right = into.updated

    def hide(*given: Any, **options: Any) -> in_place.Updated:
        return right(*given, **options)._replace(data=Path("carried.sdf").read_bytes())

    monkeypatch.setattr(into, "updated", hide)
    done = run("convert", "r.urdf", "--into", "r.sdf")
    assert done.exit_code == 1
    assert "mimic" in done.stderr
