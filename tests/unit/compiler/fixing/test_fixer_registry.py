"""The fixers of rules: each rule that says so has one, and no other has."""

from importlib.metadata import EntryPoint

import pytest

from twinform.compiler.fixing import offering
from twinform.compiler.fixing.offering import FixRegistryError, fixer_of, fixers, text_fixer_of, text_fixers
from twinform.diagnostics import catalog


def test_rules_say_whether_they_have_fixes() -> None:
    declared = {name for name, rule in catalog().items() if rule.fix}
    assert {*fixers(), *text_fixers()} == declared
    assert not {*fixers()} & {*text_fixers()}
    assert len(declared) >= 55


def test_a_built_in_rule_is_found_without_a_look_at_other_packages(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(offering, "strangers", None)
    assert fixer_of("unknown-element")
    assert fixer_of("repaired-xml") is None
    assert text_fixer_of("repaired-xml")


def _fixer(_: object) -> None:
    """A fixer that never has a fix."""


def _install(monkeypatch: pytest.MonkeyPatch, *entries: EntryPoint) -> None:
    def entry_points(group: str) -> tuple[EntryPoint, ...]:
        return tuple(each for each in entries if each.group == group)

    monkeypatch.setattr("importlib.metadata.entry_points", entry_points)
    offering.strangers.cache_clear()


_HERE = f"{__name__}:_fixer"


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ((EntryPoint("unknown-element", _HERE, offering.GROUP),), "has one already"),
        ((EntryPoint("own-rule", f"{__name__}:nothing", offering.GROUP),), "cannot be imported"),
        ((EntryPoint("own-rule", f"{__name__}:_HERE", offering.GROUP),), "has one already or is none"),
    ],
)
def test_wrong_registrations_are_reported(
    monkeypatch: pytest.MonkeyPatch, entries: tuple[EntryPoint, ...], message: str
) -> None:
    _install(monkeypatch, *entries)
    with pytest.raises(FixRegistryError, match=message):
        fixer_of("own-rule")
    offering.strangers.cache_clear()


def test_other_packages_bring_fixers(monkeypatch: pytest.MonkeyPatch) -> None:
    _install(monkeypatch, EntryPoint("own-rule", _HERE, offering.GROUP))
    assert fixer_of("own-rule") is _fixer
    offering.strangers.cache_clear()
