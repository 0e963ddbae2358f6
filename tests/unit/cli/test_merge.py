"""`twinform merge`, alone and as git calls it."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.unit.cli.conftest import Run

_GIT = shutil.which("git")
needs_git = pytest.mark.skipif(_GIT is None, reason="git is not installed")
BASE = """<robot name="r">
  <link name="a"/>
  <link name="b"/>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin xyz="0 0 1"/></joint>
</robot>
"""
OURS, THEIRS = BASE.replace("0 0 1", "0 0 2"), BASE.replace("fixed", "continuous")
BOTH = OURS.replace("fixed", "continuous")


@pytest.fixture
def sides(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name, text in {"base": BASE, "ours": OURS, "theirs": THEIRS}.items():
        Path(f"{name}.urdf").write_text(text)


@pytest.mark.usefixtures("sides")
def test_the_result_goes_where_the_caller_says(run: Run) -> None:
    files = ("base.urdf", "ours.urdf", "theirs.urdf")
    assert run("merge", *files).stdout == BOTH
    assert run("merge", *files, "-o", "new.urdf").stdout == ""
    assert (Path("new.urdf").read_text(), Path("ours.urdf").read_text()) == (BOTH, OURS)
    assert run("merge", *files, "robots/r.urdf").exit_code == 0
    assert (Path("ours.urdf").read_text(), Path("theirs.urdf").read_text()) == (BOTH, THEIRS)


@pytest.mark.usefixtures("sides")
def test_a_conflict_is_written_and_named(run: Run) -> None:
    Path("theirs.urdf").write_text(BASE.replace("0 0 1", "0 0 3"))
    done = run("merge", "base.urdf", "ours.urdf", "theirs.urdf", "robots/r.urdf", "--marker-size", "9")
    assert done.exit_code == 1
    assert done.stderr == (
        "robots/r.urdf: conflict: xyz of <origin> was '0 0 1', is '0 0 2' here, and becomes '0 0 3'\n"
    )
    assert [line for line in Path("ours.urdf").read_text().splitlines() if "joint" not in line][3:6] == [
        "<<<<<<<<< ours",
        "=========",
        ">>>>>>>>> theirs",
    ]


@pytest.mark.usefixtures("sides")
@pytest.mark.parametrize(
    "arguments",
    [(), ("base.urdf", "ours.urdf"), ("base.urdf", "ours.urdf", "none.urdf"), ("--install", "base.urdf")],
)
def test_what_cannot_be_merged_changes_nothing(run: Run, arguments: tuple[str, ...]) -> None:
    assert run("merge", *arguments).exit_code == 2
    assert Path("ours.urdf").read_text() == OURS


def _git(*arguments: str, code: int = 0) -> str:
    assert _GIT is not None
    who = {f"GIT_{who}_{what}": "a@b" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    quiet = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
    done = subprocess.run(
        [_GIT, *arguments], env={**os.environ, **who, **quiet}, capture_output=True, text=True, check=False
    )
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository with a model, whose branch `theirs` has changed it; the checked out one has not yet."""
    monkeypatch.chdir(tmp_path)
    _git("init", "-q", "-b", "ours")
    _commit(BASE, "base")
    _git("checkout", "-q", "-b", "theirs")
    _commit(THEIRS, "theirs")
    _git("checkout", "-q", "ours")
    return tmp_path


def _commit(text: str, message: str) -> None:
    Path("r.urdf").write_text(text)
    _git("add", "-A")
    _git("commit", "-q", "-m", message)


@needs_git
@pytest.mark.usefixtures("repository")
def test_git_alone_cannot_merge_two_edits_of_a_line() -> None:
    _commit(OURS, "ours")
    assert "CONFLICT" in _git("merge", "theirs", code=1)


@needs_git
@pytest.mark.slow
@pytest.mark.usefixtures("repository")
def test_git_merges_models_with_the_driver(run: Run) -> None:
    Path(".gitattributes").write_text("*.png binary")
    assert run("merge", "--install").exit_code == 0
    assert run("merge", "--install").exit_code == 0
    lines = Path(".gitattributes").read_text().splitlines()
    assert (lines[0], len(lines), lines.count("*.urdf merge=twinform diff=twinform")) == ("*.png binary", 6, 1)
    _commit(OURS, "ours")
    _git("merge", "theirs")
    assert Path("r.urdf").read_text() == BOTH


@needs_git
@pytest.mark.slow
@pytest.mark.usefixtures("repository")
def test_git_stops_at_a_conflict_of_the_driver(run: Run) -> None:
    run("merge", "--install")
    _commit(BASE.replace("fixed", "floating"), "ours")
    said = _git("merge", "theirs", code=1)
    assert "CONFLICT (content): Merge conflict in r.urdf" in said
    assert "r.urdf: conflict: type of <joint> 'j'" in said
    assert "<<<<<<< ours\n" in Path("r.urdf").read_text()


@needs_git
@pytest.mark.slow
@pytest.mark.usefixtures("repository")
def test_git_shows_what_changed_without_the_layout(run: Run) -> None:
    run("merge", "--install")
    _commit(BASE, "settings")
    Path("r.urdf").write_text(
        BASE.replace("\n", "\r\n").replace('"0 0 1"', '"0.0 0 1.00"').replace("fixed", "floating")
    )
    changed = [line for line in _git("diff").splitlines() if line[:1] in "+-" and line[:3] not in {"---", "+++"}]
    assert changed == ['-  <joint name="j" type="fixed">', '+  <joint name="j" type="floating">']
    Path("r.urdf").write_text("<robot")
    assert "+<robot" in _git("diff")


@needs_git
def test_there_has_to_be_a_repository(run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    done = run("merge", "--install")
    assert (done.exit_code, "not a git repository" in done.stderr) == (2, True)
