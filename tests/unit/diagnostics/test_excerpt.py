"""The source line of a finding: the marks stand under the piece, whatever the line has in it."""

import pytest

from twinform.diagnostics import Location
from twinform.diagnostics.reporters.text import excerpt


def shown(line: str | None, column: int, end_column: int, end_line: int = 7) -> list[str]:
    """Both lines, without the gutter."""
    where = Location("a.urdf", 7, "/robot", column, end_line, end_column)
    return [f"{line}{marks}"[8:] for line, marks in excerpt(where, line)]


CASES = {
    "plain": ('<a b="c"/>', 7, 8, ['<a b="c"/>', "      ^"]),
    "tabs": ('\t<a\tb="c"/>', 8, 9, ['    <a    b="c"/>', "             ^"]),
    "wide": ('<a 中="文文"/>', 7, 9, ['<a 中="文文"/>', "       ^^^^"]),
    "combining": ('<a b="e\u0301" c=""/>', 11, 12, ['<a b="e\u0301" c=""/>', "         ^"]),
    "controls": ('<a b="\x1b" c=""/>', 10, 11, [r'<a b="\x1b" c=""/>', "            ^"]),
    "on its end": ("<a>", 4, 4, ["<a>", "   ^"]),
    "nothing of it": ("<a>", 0, 0, ["<a>"]),
}


@pytest.mark.parametrize(("line", "column", "end", "lines"), CASES.values(), ids=CASES)
def test_the_marks_are_under_the_piece(line: str, column: int, end: int, lines: list[str]) -> None:
    assert shown(line, column, end) == lines


def test_a_piece_of_several_lines_is_marked_to_the_end_of_the_first() -> None:
    assert shown('<a b="1  ', 4, 2, end_line=9) == ['<a b="1', "   ^^^^"]


@pytest.mark.parametrize("begin", [1, 60, 119, 120, 500, 9_990])
def test_of_a_long_line_the_part_with_the_piece_is_shown(begin: int) -> None:
    line = "." * (begin - 1) + "here" + "." * (10_000 - begin - 3)
    text, marks = shown(line, begin, begin + 4)
    assert len(text) <= 126
    assert text[marks.index("^") :].startswith("here")
    assert marks.strip() == "^^^^"


@pytest.mark.parametrize("line", [None, "", "  \t "])
def test_a_line_that_is_not_known_or_blank_is_not_shown(line: str | None) -> None:
    assert shown(line, 1, 2) == []


def test_the_gutter_has_the_number() -> None:
    (line, _), (rule, marks) = excerpt(Location("a", 1234567, "/a", 1, 1234567, 2), "<a/>")
    assert line == "1234567 | <a/>"
    assert f"{rule}{marks}" == "        | ^"
