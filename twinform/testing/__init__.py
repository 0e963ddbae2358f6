"""The kit that this project tests itself with, for tests of models, passes and rules.

    from twinform.testing import assert_round_trip, strategies

    @given(strategies.robots())
    def test_my_pass(robot):
        assert_pass_contract(MyPass(), robot)

Names are imported when they are first used: pytest loads the plugin in here at every start.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from twinform.testing import strategies
    from twinform.testing.case_files import Case, CaseCheckOptions, Finding, cases
    from twinform.testing.pass_case_files import PassCase, pass_cases
    from twinform.testing.properties import (
        assert_pass_contract,
        assert_round_trip,
        assert_same_robot,
        assert_valid,
    )

__all__ = [
    "Case",
    "CaseCheckOptions",
    "Finding",
    "PassCase",
    "assert_pass_contract",
    "assert_round_trip",
    "assert_same_robot",
    "assert_valid",
    "cases",
    "pass_cases",
    "strategies",
]

_MODULES = {
    **dict.fromkeys(("Case", "CaseCheckOptions", "Finding", "cases"), "case_files"),
    **dict.fromkeys(("PassCase", "pass_cases"), "pass_case_files"),
    **dict.fromkeys(("assert_pass_contract", "assert_round_trip", "assert_same_robot", "assert_valid"), "properties"),
}


def __getattr__(name: str) -> object:
    if name == "strategies":
        return import_module("twinform.testing.strategies")
    if name not in _MODULES:
        raise AttributeError(f"module 'twinform.testing' has no attribute {name!r}")
    return getattr(import_module(f"twinform.testing.{_MODULES[name]}"), name)


def __dir__() -> list[str]:
    return list(__all__)
