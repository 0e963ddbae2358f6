"""The table of built-in passes."""

import pytest

from twinform.passes import find_pass, registered_passes
from twinform.passes.framework.built_in import BUILT_IN
from twinform.passes.framework.pass_registry import HOME, OWN


def test_the_table_says_what_the_entry_points_say() -> None:
    installed = {name: each.entry.value for name, each in registered_passes().items() if each.owner == OWN}
    assert {name: HOME + value for name, value in BUILT_IN.items()} == installed
    for name in BUILT_IN:
        assert find_pass(name) is registered_passes()[name].load()


def test_a_built_in_pass_is_found_without_a_look_at_other_packages(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.metadata.entry_points", None)
    assert find_pass("check-inertia").name == "check-inertia"
