"""Patterns of paths find what pathspec finds, which is held to git, and never take long to see that they do not fit."""

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pathspec import GitIgnoreSpec

from tests.patterns.growth import grows_too_fast
from tests.write_files import write_files
from twinform.cli.inputs import discover
from twinform.cli.model_files import Exclusion, PatternError
from twinform.cli.path_patterns import ENGINE, LONGEST, PathPatterns

_PIECES = st.sampled_from(["a", "b", "ab", "*", "**", "?", "/", "/**/", "[ab]", "[!a]", "*a", "b*", "!", ".", "\\*"])
_NAMES = st.text("ab.*", min_size=1, max_size=4).filter(lambda name: name.strip("."))


@given(
    st.lists(st.lists(_PIECES, min_size=1, max_size=7).map("".join), min_size=1, max_size=3),
    st.lists(_NAMES, min_size=1, max_size=5).map("/".join),
    st.booleans(),
)
def test_patterns_mean_what_they_mean_in_pathspec(lines: list[str], path: str, is_folder: bool) -> None:
    try:
        judge = GitIgnoreSpec.from_lines(lines, **ENGINE)
    except (ValueError, re.error):
        with pytest.raises(PatternError):
            PathPatterns.of("/top", lines)
        return
    expected = judge.check_file(f"{path}/" if is_folder else path).include
    assert PathPatterns.of("/top", lines).decide(f"/top/{path}", is_folder=is_folder) is expected


@pytest.mark.parametrize(
    ("again", "end", "name"),
    [
        ("*a", "*b", "a"),
        ("a*", "b", "a"),
        ("?*", "b", "a"),
        ("*[a]", "b", "a"),
        ("**/a/", "b", "a/"),
        ("**/*a/", "**/b", "a/"),
        ("*a/", "*/b", "aa/"),
        ("**/a*a/", "b", "aaa/"),
    ],
)
def test_a_pattern_that_does_not_fit_is_done_in_linear_time(again: str, end: str, name: str) -> None:
    patterns = PathPatterns.of("/top", [again * 12 + end])
    assert not grows_too_fast(lambda size: patterns.match("/top/" + name * (size // len(name))), 1000)


def test_what_no_path_is_as_long_as_is_no_pattern(tmp_path: Path) -> None:
    with pytest.raises(PatternError, match="4,097 characters"):
        PathPatterns.of(tmp_path, ["a" * (LONGEST + 1)])


def test_more_patterns_than_anybody_writes_are_an_error(tmp_path: Path) -> None:
    with pytest.raises(PatternError, match="2,001 patterns"):
        PathPatterns.of(tmp_path, ["# a comment", *(f"a{number}" for number in range(2001))])


LAYOUT = {
    ".gitignore": "# made\n/out/\n*.tmp.urdf\n!keep.tmp.urdf\ngenerated\ndeep/**/x.urdf\n\\#odd.urdf\n",
    "a/.gitignore": "local.urdf\n!b.tmp.urdf\n",
    ".git/info/exclude": "secret.urdf\n",
}
MODELS = (
    "out/a.urdf", "a/out/a.urdf", "c.tmp.urdf", "a/b.tmp.urdf", "keep.tmp.urdf", "generated/keep.tmp.urdf",
    "a/generated", "local.urdf", "a/local.urdf", "a/n/local.urdf", "deep/x.urdf", "deep/1/2/x.urdf", "deep/1/y.urdf",
    "secret.urdf", "a/secret.urdf", "#odd.urdf", "plain.urdf",
)  # fmt: skip


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    if shutil.which("git"):
        subprocess.run(["git", "init", "-q", tmp_path], check=True)
    write_files(tmp_path, {**LAYOUT, **dict.fromkeys(MODELS, "")})
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.skipif(not shutil.which("git"), reason="git is the judge")
def test_what_git_ignores_is_left_out(repository: Path) -> None:
    listed = subprocess.run(
        ["git", "ls-files", "--others", "--exclude-standard"], check=True, capture_output=True, text=True
    ).stdout.splitlines()
    expected = sorted(name for name in listed if name.endswith(".urdf"))
    assert expected
    assert discover(["."], Exclusion(())) == expected


def test_patterns_above_count_below(repository: Path) -> None:
    assert discover(["a"], Exclusion(())) == ["a/b.tmp.urdf", "a/out/a.urdf"]
    assert discover(["out"], Exclusion(())) == ["out/a.urdf"]


def test_another_repository_begins_anew(repository: Path) -> None:
    for name in ("sub/.git/HEAD", "sub/c.tmp.urdf"):
        (repository / name).parent.mkdir(parents=True, exist_ok=True)
        (repository / name).write_text("")
    assert discover(["sub"], Exclusion(())) == ["sub/c.tmp.urdf"]
    assert "sub/c.tmp.urdf" in discover(["."], Exclusion(()))


@pytest.mark.skipif(not shutil.which("git"), reason="git makes the worktree")
def test_a_worktree_has_the_patterns_of_its_repository(repository: Path, tmp_path: Path) -> None:
    git = ["git", "-c", "user.name=a", "-c", "user.email=a@b"]
    subprocess.run([*git, "commit", "-q", "--allow-empty", "-m", "x"], check=True)
    subprocess.run([*git, "worktree", "add", "-q", tmp_path / "tree"], check=True)
    for name in ("secret.urdf", "plain.urdf"):
        (tmp_path / "tree" / name).write_text("")
    assert discover(["tree"], Exclusion(())) == ["tree/plain.urdf"]


def test_bytes_that_are_no_text_and_patterns_that_are_none_ignore_nothing(tmp_path: Path) -> None:
    (tmp_path / ".gitignore").write_bytes(b"\xff\xfe\n!\n")
    (tmp_path / "a.urdf").write_text("")
    assert discover([str(tmp_path)], Exclusion(())) == [str(tmp_path / "a.urdf")]
