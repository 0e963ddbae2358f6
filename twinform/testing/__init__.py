"""The testing kit of twinform, for tests of models, passes and rules.

    from twinform.testing import assert_round_trip, strategies

    @given(strategies.robots())
    def test_my_pass(robot):
        assert_pass_contract(MyPass(), robot)

Names are imported when they are first used, since pytest loads the plugin in this package at every start.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from twinform.lazy import lazy_attributes

if TYPE_CHECKING:
    from twinform.testing import strategies
    from twinform.testing.case_files import (
        Case,
        CaseCheckOptions,
        Finding,
        MjcfCase,
        PassCase,
        cases,
        mjcf_cases,
        pass_cases,
    )
    from twinform.testing.properties import assert_pass_contract, assert_round_trip, assert_same_robot, assert_valid

__all__ = [
    "Case",
    "CaseCheckOptions",
    "Finding",
    "MjcfCase",
    "PassCase",
    "assert_pass_contract",
    "assert_round_trip",
    "assert_same_robot",
    "assert_valid",
    "cases",
    "mjcf_cases",
    "pass_cases",
    "strategies",
]

_find_attribute = lazy_attributes(
    __name__,
    {
        "twinform.testing.case_files": "Case CaseCheckOptions Finding MjcfCase PassCase cases mjcf_cases pass_cases",
        "twinform.testing.properties": "assert_pass_contract assert_round_trip assert_same_robot assert_valid",
    },
)


def __getattr__(name: str) -> object:
    return import_module("twinform.testing.strategies") if name == "strategies" else _find_attribute(name)


def __dir__() -> list[str]:
    return list(__all__)
