"""Everything that libsdformat finds, and what it misses, has a rule with a case of its own."""

import pytest

from generators.libsdformat_codes import CODES, UNSEEN, Row, announced
from twinform.diagnostics import catalog

WITHOUT_CASE = {"unreadable-file"}
"""What no case file can show."""


@pytest.mark.parametrize("row", [*CODES, *UNSEEN], ids=lambda row: row.title)
def test_each_has_rules_with_cases_or_a_reason(row: Row):
    assert row.rules or row.note
    for rule in row.rules:
        assert rule in catalog()
        assert announced()[rule] or rule in WITHOUT_CASE


def test_there_are_43_codes():
    assert len({row.title for row in CODES}) == 43
