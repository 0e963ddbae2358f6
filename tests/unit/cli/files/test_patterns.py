"""Patterns of paths find what pathspec finds, which is held to git, and never take long to see that they do not fit."""

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pathspec import GitIgnoreSpec

from tests.patterns.growth import grows_too_fast
from twinform.cli.files.exclusion import PatternError
from twinform.cli.files.patterns import LONGEST, PathPatterns

_PIECES = st.sampled_from(["a", "b", "ab", "*", "**", "?", "/", "/**/", "[ab]", "[!a]", "*a", "b*", "!", ".", "\\*"])
_NAMES = st.text("ab.*", min_size=1, max_size=4).filter(lambda name: name.strip("."))


@given(
    st.lists(st.lists(_PIECES, min_size=1, max_size=7).map("".join), min_size=1, max_size=3),
    st.lists(_NAMES, min_size=1, max_size=5).map("/".join),
    st.booleans(),
)
def test_patterns_mean_what_they_mean_in_pathspec(lines: list[str], path: str, is_folder: bool) -> None:
    try:
        judge = GitIgnoreSpec.from_lines(lines, backend="simple")
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
