"""`twinform convert --into`: a file follows the edits of the one that was made of it."""

from pathlib import Path

import pytest

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
    assert "r.urdf:8:45: error: cannot be changed in place: value is '3.50' here and was '1.5'" in done.stderr
    assert "[edit-conflict]" in done.stderr


@pytest.mark.parametrize(
    ("command", "complaint"),
    [
        ("r.sdf --into other.sdf", "other.sdf is no file"),
        ("r.sdf --into r.sdf", "takes a file of the other format"),
        ("r.sdf --base r.sdf", "--base is for --into"),
        ("r.sdf --into r.urdf --base none.sdf", "none.sdf is no file"),
        ("r.sdf --into r.urdf -o x.urdf", "leave -o, --in-place, --to and --passes out"),
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
