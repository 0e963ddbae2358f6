"""Mutants that change nothing are passed over."""

import pytest

pytest.importorskip("mutmut", reason="mutmut is not installed")

from reports.mistakes_found.mutants import is_assertion, is_wording


@pytest.mark.parametrize(
    ("before", "after", "wording"),
    [
        ('say("no link", where)', 'say("XXno linkXX", where)', True),
        ('say("no link", where)', 'say("NO LINK", where)', True),
        ('say("no link", "a")', 'say("no link", "XXaXX")', False),
        ('tag = "link"', 'tag = "LINK"', False),
        ('say("no link", where)', "say(None, where)", False),
        ('say("no link", where)', 'say("no link", None)', False),
        ('say("no link", "no joint")', 'say("no joint")', False),
    ],
)
def test_mutants_that_only_change_the_wording_are_known(before: str, after: str, wording: bool):
    assert is_wording((f"-    {before}", f"+    {after}")) is wording


@pytest.mark.parametrize("after", ["zip(a, b, strict=None)", "zip(a, b, )", "zip(a, b, strict=False)"])
def test_mutants_that_only_take_an_assertion_away_are_known(after: str):
    assert is_assertion(("-for x in zip(a, b, strict=True):", f"+for x in {after}:"))


@pytest.mark.parametrize("after", ["zip(a, None, strict=True)", "zip(a, strict=True)", "zip(b, strict=True)"])
def test_mutants_that_change_what_is_zipped_take_more(after: str):
    assert not is_assertion(("-for x in zip(a, b, strict=True):", f"+for x in {after}:"))


@pytest.mark.parametrize("after", ["None", '"NODE"', '"node"', '"XXNodeXX"'])
def test_the_type_of_a_cast_is_an_assertion(after: str) -> None:
    assert is_assertion(('-x = f(cast("Node", old or ()), 1)', f"+x = f(cast({after}, old or ()), 1)"))
    assert not is_assertion(('-x = f(cast("Node", old or ()), 1)', f"+x = f(cast({after}, old and ()), 1)"))
