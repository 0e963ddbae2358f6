"""`twinform sync`: which files belong together, which one is their source, and what is written."""

import json
from pathlib import Path

import pytest

from twinform.compiler.in_place import Updated
from twinform.compiler.into import Follower

from .conftest import GOOD, Run

HEAVY = GOOD.replace('mass value="1"', 'mass value="2"')
SDF = '<sdf version="1.9">\n  <model name="one">\n    <link name="base"/>\n  </model>\n</sdf>\n'
GROUPS = '[sync]\none = ["r.urdf", "r.sdf"]\nother = ["s.urdf", "s.sdf"]\n'


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two robots, each in two files that say the same."""
    monkeypatch.chdir(tmp_path)
    for name in ("r", "s"):
        Path(f"{name}.urdf").write_text(GOOD)
        Path(f"{name}.sdf").write_text(SDF)
    return tmp_path


def test_only_what_differs_is_changed_and_then_all_is_up_to_date(run: Run, here: Path) -> None:
    Path("r.urdf").write_text(HEAVY)
    assert run("sync", "r.urdf", "r.sdf", "--check").exit_code == 1
    assert Path("r.sdf").read_text() == SDF
    done = run("sync", "r.urdf", "r.sdf")
    assert (done.exit_code, done.stderr.splitlines()[-1]) == (0, "r.sdf: 1 change")
    assert "<mass>2</mass>" in Path("r.sdf").read_text()
    assert run("sync", "r.urdf", "r.sdf", "--check").exit_code == 0
    before = Path("r.sdf").read_bytes()
    assert run("sync", "r.urdf", "r.sdf").stdout == "r.urdf is the source: 1 up to date\n"
    assert Path("r.sdf").read_bytes() == before


def test_the_difference_is_shown_and_not_written(run: Run, here: Path) -> None:
    Path("r.urdf").write_text(HEAVY)
    done = run("sync", "r.urdf", "r.sdf", "--diff")
    assert (done.exit_code, Path("r.sdf").read_text()) == (1, SDF)
    assert done.stdout.startswith("--- r.sdf\n+++ r.sdf\n")
    Path("r.urdf").write_text(GOOD)
    assert run("sync", "r.urdf", "r.sdf", "--diff").exit_code == 0


def test_a_program_is_told_the_state_the_differences_and_the_changes(run: Run, here: Path) -> None:
    Path("r.urdf").write_text(HEAVY)
    done = run("sync", "r.urdf", "r.sdf", "new.sdf", "s.sdf", "--format", "json")
    (group,) = json.loads(done.stdout)["groups"]
    assert (group["name"], group["source"]) == ("", "r.urdf")
    old, new, _ = group["files"]
    assert (old["path"], old["format"], old["state"], old["anew"]) == ("r.sdf", "sdf", "out of date", False)
    assert [each["aspect"] for each in old["differences"]] == ["inertial/mass"]
    assert [each["line"] for each in old["changes"]] == [3]
    assert (new["state"], new["differences"], new["changes"], new["anew"]) == ("missing", [], [], True)
    assert Path("new.sdf").is_file()


@pytest.mark.parametrize(
    ("words", "source"),
    [
        (("r.sdf", "r.urdf"), "r.sdf"),
        (("r.sdf", "r.urdf", "--source", "r.urdf"), "r.urdf"),
        (("r.sdf", "--source", "r.urdf"), "r.urdf"),
    ],
)
def test_the_source_is_the_one_that_is_named_or_the_first(run: Run, here: Path, words: tuple[str, ...], source: str):
    assert run("sync", *words).stdout == f"{source} is the source: 1 up to date\n"


def test_groups_of_the_configuration_have_their_source(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    Path("twinform.toml").write_text(GROUPS)
    one, other = "one: r.urdf is the source: 1 up to date\n", "other: s.urdf is the source: 1 up to date\n"
    assert run("sync").stdout == one + other
    assert run("sync", "@other").stdout == other
    assert run("sync", "s.sdf").stdout == other
    assert run("sync", "s.sdf", "s.urdf").stdout == other
    assert run("sync", "@one", "--source", "r.sdf").stdout == "one: r.sdf is the source: 1 up to date\n"
    below = here / "below"
    below.mkdir()
    monkeypatch.chdir(below)
    assert f"{here / 'r.urdf'} is the source" in run("sync", "@one").stdout


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        ((), "name two or more files of a robot"),
        (("r.urdf",), "r.urdf is one file"),
        (("r.urdf", "r.urdf"), "r.urdf is there twice"),
        (("r.urdf", "r.sdf", "./r.sdf"), "r.sdf is there twice"),
        (("none.urdf", "r.sdf"), "none.urdf is no file"),
        (("r.urdf", "r.json"), "r.json is no URDF, SDF or MJCF"),
        (("r.urdf", "r.txt"), "r.txt is no URDF, SDF or MJCF"),
        (("r.urdf", "r.urdf.xacro"), "is xacro, which is never written"),
        (("r.urdf", "folder.sdf"), "folder.sdf is no file"),
        (("r.urdf", "-"), "- is no URDF, SDF or MJCF"),
        (("@one",), "the table [sync] has no group one"),
        (("@one", "r.urdf"), "name groups as @NAME or files"),
        (("--source", "r.urdf"), "--source is for one robot"),
    ],
)
def test_what_makes_no_sense_is_wrong_usage(run: Run, here: Path, words: tuple[str, ...], complaint: str) -> None:
    Path("folder.sdf").mkdir()
    Path("r.json").write_text("{}")
    done = run("sync", *words)
    assert (done.exit_code, complaint in done.stderr) == (2, True), done.stderr
    assert (Path("r.urdf").read_text(), Path("r.sdf").read_text()) == (GOOD, SDF)


def test_a_file_is_made_once_and_no_source_of_another(run: Run, here: Path) -> None:
    Path("twinform.toml").write_text('[sync]\na = ["r.urdf", "r.sdf"]\nb = ["r.sdf", "s.urdf"]\n')
    assert "r.sdf is the source of one group, and made in another one" in run("sync").stderr
    Path("twinform.toml").write_text('[sync]\na = ["r.urdf", "r.sdf"]\nb = ["s.urdf", "r.sdf"]\n')
    assert "r.sdf is there twice" in run("sync").stderr


def test_a_configuration_names_no_file_outside_of_its_folder(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch):
    inner = here / "inner"
    inner.mkdir()
    (inner / "twinform.toml").write_text('[sync]\none = ["../r.urdf", "r.sdf"]\n')
    monkeypatch.chdir(inner)
    done = run("sync")
    assert (done.exit_code, Path("r.sdf").exists()) == (2, False)
    assert "leads out of the folder of the configuration" in done.stderr
    assert run("sync", "--trust-config").exit_code == 0
    assert Path("r.sdf").exists()


def test_where_one_file_has_an_error_none_is_written(run: Run, here: Path) -> None:
    Path("r.urdf").write_text(HEAVY)
    Path("broken.sdf").write_text("<sdf")
    done = run("sync", "r.urdf", "r.sdf", "broken.sdf")
    assert (done.exit_code, Path("r.sdf").read_text()) == (2, SDF)
    assert "nothing is written" in done.stderr


def test_what_cannot_be_changed_alone_is_written_anew_only_when_asked(
    run: Run, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Follower, "updated", _no_change)
    Path("r.urdf").write_text(HEAVY)
    done = run("sync", "r.urdf", "r.sdf")
    assert (done.exit_code, Path("r.sdf").read_text()) == (1, SDF)
    assert "cannot be changed in place" in done.stderr
    done = run("sync", "r.urdf", "r.sdf", "--rewrite")
    assert (done.exit_code, done.stderr.splitlines()[-1]) == (0, "r.sdf is written anew")
    assert "<mass>2</mass>" in Path("r.sdf").read_text()


def test_a_file_with_a_world_is_never_written_anew(run: Run, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Follower, "updated", _no_change)
    world = SDF.replace("<model", '<world name="w"><light name="sun" type="point"/><model').replace(
        "</sdf>", "</world></sdf>"
    )
    Path("r.sdf").write_text(world)
    Path("r.urdf").write_text(HEAVY)
    done = run("sync", "r.urdf", "r.sdf", "--rewrite")
    assert (done.exit_code, Path("r.sdf").read_text()) == (1, world)
    assert "cannot be changed in place" in done.stderr


def _no_change(follower: Follower) -> object:
    content = follower.into.content or b""
    return Updated(follower.conversion, content, (), content)


def test_carriers_go_only_where_there_are_some_or_they_are_asked_for(run: Run, here: Path) -> None:
    Path("r.urdf").write_text(HEAVY)
    run("sync", "r.urdf", "r.sdf")
    assert "tf:" not in Path("r.sdf").read_text()
    Path("r.sdf").write_text(SDF)
    run("sync", "r.urdf", "r.sdf", "--carriers")
    assert "tf:from" in Path("r.sdf").read_text()
