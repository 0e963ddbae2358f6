"""The table of built-in rules."""

from importlib import import_module
from pathlib import Path

import pytest

from twinform.diagnostics import catalog
from twinform.diagnostics.built_in import BUILT_IN
from twinform.diagnostics.built_in_table import built_in_table
from twinform.diagnostics.registry import OWN, find_rule


def test_the_committed_table_is_up_to_date() -> None:
    assert Path(str(import_module("twinform.diagnostics.built_in").__file__)).read_text() == built_in_table()


def test_every_rule_is_found_by_the_table() -> None:
    assert BUILT_IN.keys() == catalog().keys()
    for name, rule in catalog().items():
        found = find_rule(name)
        assert found
        assert (found.rule, found.owner) == (rule, OWN)


def test_a_built_in_rule_is_found_without_a_look_at_other_packages(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.metadata.entry_points", None)
    assert find_rule("shared-name")
