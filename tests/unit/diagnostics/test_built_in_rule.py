"""Built-in rules and their pages, which are read late."""

import pickle

import pytest

from twinform.diagnostics import Rule, Severity, catalog, rules
from twinform.diagnostics.built_in_rule import rule as built_in
from twinform.diagnostics.rule_registry import OWN, find_rule


def test_every_rule_is_found_by_its_name_and_by_its_constant() -> None:
    for name, rule in catalog().items():
        found = find_rule(name)
        assert found
        assert (found.rule, found.owner) == (rule, OWN)
        assert vars(rules)[name.upper().replace("-", "_")] is rule


def test_a_built_in_rule_is_found_without_a_look_at_other_packages(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.metadata.entry_points", None)
    assert find_rule("shared-name")


def test_a_page_is_read_once_and_only_when_it_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    rule, other = built_in("zero-axis", Severity.ERROR), built_in("zero-axis", Severity.ERROR)
    assert rule.finds == rules.ZERO_AXIS.finds
    monkeypatch.setattr("twinform.diagnostics.rule_files.read_page", None)
    assert rule.better == rules.ZERO_AXIS.better
    assert (other, hash(other), repr(other)) == (rule, hash(rule), repr(rule))
    with pytest.raises(TypeError):
        _ = other.better


def test_a_rule_has_no_other_fields() -> None:
    with pytest.raises(AttributeError, match="a rule has no find"):
        getattr(rules.ZERO_AXIS, "find")  # noqa: B009 - a constant name would be a type error


def test_a_rule_is_the_same_one_in_another_process() -> None:
    assert pickle.loads(pickle.dumps(rules.ZERO_AXIS)) is rules.ZERO_AXIS


def test_a_rule_of_a_plugin_is_told_apart_by_its_head() -> None:
    mine = Rule(name="mine", severity=Severity.INFO, finds="a", matters="b", example="c", better="d")
    assert pickle.loads(pickle.dumps(mine)) == mine
    assert mine != Rule(name="mine", severity=Severity.ERROR, finds="a", matters="b", example="c", better="d")
