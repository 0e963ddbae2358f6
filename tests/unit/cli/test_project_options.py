"""`--for` and `--keep-physics`: what consumers mind, and conversions that they take."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

import twinform

from .conftest import Run

IMPOSSIBLE = """\
<robot name="r">
  <link name="a"/>
  <link name="b">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="9" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
</robot>
"""
GOOD = IMPOSSIBLE.replace('izz="9"', 'izz="1.5"')


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    path = tmp_path / "robot.urdf"
    path.write_text(IMPOSSIBLE, encoding="utf-8")
    return path


def test_a_finding_names_those_who_mind_it_once(run: Run, robot: Path) -> None:
    done = run("check", robot, "--for", "mujoco", "--format", "json")
    found = json.loads(done.stdout)["files"][0]["diagnostics"]
    minded = [each for each in found if "MuJoCo 4.0.0 refuses" in each["message"]]
    assert done.exit_code == 1
    assert [(each["severity"], each["line"]) for each in minded] == [("error", 4)]
    places = [(each["rule"], each["line"]) for each in found]
    assert len(places) == len(set(places))


def test_without_consumers_it_is_what_it_was(run: Run, robot: Path) -> None:
    assert run("check", robot).exit_code == 0
    assert "MuJoCo" not in run("check", robot, "--notes").stdout


def test_a_comment_allows_it(run: Run, robot: Path) -> None:
    comment = "<!-- twinform: allow impossible-inertia - as it was weighed -->"
    marked = IMPOSSIBLE.replace("    <inertial>", f"    {comment}\n    <inertial>")
    robot.write_text(marked, encoding="utf-8")
    done = run("check", robot, "--for", "mujoco", "--format", "json")
    assert done.exit_code == 0
    assert not json.loads(done.stdout)["files"][0]["diagnostics"]


def test_a_format_that_nobody_reads_is_told(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "robot.sdf"
    path.write_text(twinform.convert(GOOD.encode(), to="sdf").text, encoding="utf-8")
    done = run("check", path, "--for", "mujoco")
    assert done.exit_code == 0
    assert "MuJoCo 4.0.0 does not read SDF; it reads MJCF and URDF" in done.stdout
    assert "[unread-format]" in done.stdout


def test_the_result_is_one_that_they_take(run: Run, robot: Path, tmp_path: Path) -> None:
    out, ledger = tmp_path / "out.urdf", tmp_path / "ledger.json"
    done = run("convert", robot, "-o", out, "--to", "urdf", "--for", "mujoco", "--ledger", ledger)
    assert done.exit_code == 0, done.output
    assert run("check", out, "--for", "mujoco").exit_code == 0
    (entry,) = [each for each in json.loads(ledger.read_text())["entries"] if each["rule"] == "changed-physics"]
    assert (entry["fate"], entry["weight"], entry["line"]) == ("approximated", 3, 3)
    change = entry["change"]
    assert (change["pass"], change["part"], change["name"]) == ("balance-inertia", "link", "b")
    assert {key: change["values"][2][key] for key in ("path", "was")} == {"path": "inertial/inertia/izz", "was": 9.0}


def test_the_passes_are_those_that_are_needed(run: Run, robot: Path) -> None:
    done = run("convert", robot, "--to", "urdf", "--for", "mujoco", "--print-pipeline")
    assert done.stdout == "balance-inertia\n"
    robot.write_text(GOOD, encoding="utf-8")
    assert run("convert", robot, "--to", "urdf", "--for", "mujoco", "--print-pipeline").stdout == "\n"


LATE = GOOD.replace('"r"', '"r" version="1.2"').replace(
    '<joint name="j" type="continuous">',
    '<joint name="j" type="revolute"><origin quat_xyzw="0 0 1 0"/><limit lower="0" upper="1" jerk="2"/>',
)


@pytest.mark.parametrize(
    ("release", "root"),
    [
        ("humble", '<robot name="r">'),
        ("jazzy", '<robot name="r">'),
        ("5.1", '<robot name="r" version="1.1">'),
        ("rolling", '<robot name="r" version="1.2">'),
    ],
)
def test_a_version_that_a_release_reads(run: Run, robot: Path, tmp_path: Path, release: str, root: str) -> None:
    out = tmp_path / "out.urdf"
    robot.write_text(LATE, encoding="utf-8")
    done = run("convert", robot, "-o", out, "--to", "urdf", "--for", f"urdfdom@{release}")
    assert done.exit_code == 0, done.output
    made = out.read_text(encoding="utf-8")
    assert root in made
    assert ("rpy=" in made) is ("version" not in root)
    assert run("check", out, "--for", f"urdfdom@{release}").exit_code == 0
    before = run("check", robot, "--for", f"urdfdom@{release}")
    assert before.exit_code == (0 if release == "rolling" else 1)
    assert (f"help: twinform convert --to urdf --for urdfdom@{release}" in before.stdout) is (release != "rolling")


def test_an_older_version_stays_for_a_newer_release(run: Run, robot: Path, tmp_path: Path) -> None:
    robot.write_text(GOOD, encoding="utf-8")
    assert run("convert", robot, "-o", tmp_path / "out.urdf", "--to", "urdf", "--for", "urdfdom@rolling").exit_code == 0
    assert '<robot name="r">' in (tmp_path / "out.urdf").read_text(encoding="utf-8")


def test_a_version_that_was_asked_for_is_judged(run: Run, robot: Path, tmp_path: Path) -> None:
    robot.write_text(LATE, encoding="utf-8")
    arguments = ("--to", "urdf", "--for", "urdfdom@jazzy", "--urdf-version", "1.2")
    done = run("convert", robot, "-o", tmp_path / "out.urdf", *arguments)
    assert done.exit_code == 1
    assert "urdfdom jazzy refuses: it knows version 1.0 alone" in done.stderr


def test_every_part_is_still_accounted_for(run: Run, robot: Path, tmp_path: Path) -> None:
    done = run("convert", robot, "-o", tmp_path / "out.sdf", "--for", "drake", "--audit")
    assert "0 unaccounted" in done.output
    assert "approximated 4" in done.output


def test_physics_that_is_to_be_kept_is_an_error(run: Run, robot: Path, tmp_path: Path) -> None:
    out = tmp_path / "out.urdf"
    done = run("convert", robot, "-o", out, "--to", "urdf", "--for", "mujoco", "--keep-physics")
    assert done.exit_code == 1
    assert not out.exists()
    assert "robot.urdf:3:" in done.stderr
    assert "balance-inertia would change the physics, which is to be kept: link 'b': inertial" in done.stderr
    assert "[kept-physics]" in done.stderr


def test_a_pass_that_changes_what_is_seen_alone_keeps_the_physics(run: Run, robot: Path, tmp_path: Path) -> None:
    capsule = '<geometry><capsule radius="1" length="2"/></geometry>'
    out = tmp_path / "out.urdf"
    arguments = ("convert", robot, "-o", out, "--to", "urdf", "--for", "urdfdom", "--keep-physics")
    robot.write_text(GOOD.replace('<link name="a"/>', f'<link name="a"><visual>{capsule}</visual></link>'))
    assert run(*arguments).exit_code == 0
    assert "<cylinder" in out.read_text(encoding="utf-8")
    robot.write_text(GOOD.replace('<link name="a"/>', f'<link name="a"><collision>{capsule}</collision></link>'))
    assert "tidy-shapes would change the physics" in run(*arguments).stderr


def test_in_place_only_what_a_consumer_minds_is_changed(run: Run, robot: Path) -> None:
    assert run("convert", robot, "--in-place", "--for", "mujoco").exit_code == 0
    before, after = IMPOSSIBLE.splitlines(), robot.read_text(encoding="utf-8").splitlines()
    assert [number for number, pair in enumerate(zip(before, after, strict=True), 1) if pair[0] != pair[1]] == [4]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--for", "mujocco"), "did you mean 'mujoco'?"),
        (("--keep-physics",), "--keep-physics is for --for"),
        (("--for", "drake", "--split"), "--for takes neither --split nor --into"),
    ],
)
def test_options_that_make_no_sense(run: Run, robot: Path, arguments: tuple[str, ...], message: str) -> None:
    done = run("convert", robot, "--to", "urdf", *arguments)
    assert done.exit_code == 2
    assert message in done.stderr


def test_a_target_that_a_named_consumer_does_not_read_is_an_error(run: Run, robot: Path) -> None:
    done = run("convert", robot, "--to", "sdf", "--for", "mujoco")
    assert done.exit_code == 1
    assert "MuJoCo 4.0.0 does not read SDF" in done.stderr


def test_a_project_names_its_consumers(run: Run, robot: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(robot.parent)
    Path("twinform.toml").write_text('for = ["mujoco"]\n', encoding="utf-8")
    assert run("check", "robot.urdf").exit_code == 1
    assert run("check", "robot.urdf", "--for", "pinocchio").exit_code == 0
    assert run("convert", "robot.urdf", "--to", "sdf").exit_code == 0  # MuJoCo reads no SDF: that is not for it
    Path("twinform.toml").write_text('for = ["mujocco"]\n', encoding="utf-8")
    wrong = run("check", "robot.urdf")
    assert wrong.exit_code == 2
    assert "did you mean 'mujoco'?" in wrong.stderr


@pytest.mark.slow
def test_a_batch_is_for_consumers_too(run: Run, robot: Path, tmp_path: Path) -> None:
    source, out = tmp_path / "src", tmp_path / "out"
    source.mkdir()
    robot.rename(source / "robot.urdf")
    assert run("batch", "check", source, "--for", "mujoco", "--jobs", "1").exit_code == 1
    assert run("batch", "convert", source, out, "--to", "urdf", "--jobs", "1").exit_code == 0
    assert 'izz="9"' in (out / "robot.urdf").read_text(encoding="utf-8")
    done = run("batch", "convert", source, out, "--to", "urdf", "--for", "mujoco", "--jobs", "1")
    assert done.exit_code == 0, done.output
    assert 'izz="9"' not in (out / "robot.urdf").read_text(encoding="utf-8")


def test_for_nobody_no_profile_is_imported(robot: Path) -> None:
    code = (
        "import sys; from twinform.cli import main\n"
        f"try: main(['check', {str(robot)!r}])\n"
        "except SystemExit: pass\n"
        "print([name for name in sys.modules if name.startswith('twinform.profiles')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


def test_the_same_from_python() -> None:
    found = twinform.check(IMPOSSIBLE.encode(), profiles="mujoco")
    assert any(each.is_error for each in found.diagnostics)
    made = twinform.convert(IMPOSSIBLE.encode(), to="urdf", profiles="mujoco")
    assert [entry.change.step for entry in made.ledger.entries if entry.change] == ["balance-inertia"]
    with pytest.raises(twinform.CompileError):
        twinform.convert(IMPOSSIBLE.encode(), to="urdf", profiles="mujoco", keep_physics=True)
