import pytest

from twinform.diagnostics.suppressions import MOST, Suppression, parse_suppressions


@pytest.mark.parametrize(
    ("text", "rules"),
    [
        (" twinform: allow dangling-link ", ("dangling-link",)),
        ("twinform:allow a,b", ("a", "b")),
        (" twinform: allow a , b - they are\n mounted later", ("a", "b")),
        (" twinform: allow a -- a reason as others write it", ("a",)),
        ("\n  Twinform : allow a, a\n", ("a",)),
        (" twinform allow a", ("a",)),
    ],
)
def test_a_comment_names_rules_and_perhaps_a_reason(text: str, rules: tuple[str, ...]) -> None:
    found = parse_suppressions([(text, 1, 2, 4)])
    assert (found.entries, found.flaws) == ((Suppression(rules, 1, 2, 4),), ())


def test_a_comment_can_be_about_the_whole_file() -> None:
    found = parse_suppressions([(" twinform: allow-file a - old ", 7, 0, 0)])
    assert found.entries == (Suppression(("a",), 7),)
    assert found.covers("a", 0)
    assert not found.covers("b", 0)


@pytest.mark.parametrize(
    "text",
    ["twinform: allow", "twinform: alow a", "twinform: allow a b", "twinform: allow a,", "twinform:", "twinform: x"],
)
def test_what_was_meant_and_is_none_is_said(text: str) -> None:
    found = parse_suppressions([(text, 3, 4, 4)])
    assert not found.entries
    assert [flaw.line for flaw in found.flaws] == [3]


@pytest.mark.parametrize("text", ["", " expect: error a ", "made by twinform: allow a", "twinforms", " allow a "])
def test_other_comments_are_left_alone(text: str) -> None:
    found = parse_suppressions([(text, 3, 4, 4)])
    assert (found.entries, found.flaws) == ((), ())


def test_lines_decide_and_uses_are_counted_by_rule() -> None:
    found = parse_suppressions([(" twinform: allow a, b", 1, 2, 4), (" twinform: allow a", 3, 4, 4)])
    assert [found.covers("a", line) for line in (1, 2, 4, 5)] == [False, True, True, False]
    assert [(entry.line, rule) for entry, rule in found.unused()] == [(1, "b")]


def test_a_hostile_file_cannot_have_a_million() -> None:
    found = parse_suppressions((" twinform: allow a", line, line, line) for line in range(1, 10**5))
    assert len(found.entries) == MOST
    assert len(found.flaws) == 1


def test_a_comment_cannot_have_a_million_rules() -> None:
    """A rule that does not exist is compared with all that do: a comment of 10 MB took 20 minutes."""
    many = ",".join(f"rule-{number}" for number in range(MOST + 1))
    found = parse_suppressions([(f" twinform: allow {many}", 1, 1, 1), (" twinform: allow a", 2, 2, 2)])
    assert (found.entries, len(found.flaws)) == ((), 1)


def test_a_long_comment_is_not_taken_apart() -> None:
    found = parse_suppressions([(" twinform: allow " + "x, " * 100_000, 1, 1, 1), (" twinform: allow a", 2, 2, 2)])
    assert (len(found.entries), len(found.flaws)) == (1, 1)
