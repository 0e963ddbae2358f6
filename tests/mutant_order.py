"""How a mutant of mutmut meets the tests: with empty caches, what is nearest first, and of that the fastest."""

import json
import os
import sys
from functools import cache
from itertools import accumulate, takewhile
from pathlib import Path

import pytest

_MEASURED = Path("mutmut-stats.json")
_MOST = 15.0
"""A mutant that all tests of so many seconds let pass has survived: some functions are reached by nearly every test."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Sort by the room of the mutant, then by the seconds that mutmut measured, and leave out what takes too long."""
    seconds = _seconds()  # first of all in the process that mutants are forked from, which then has them for all
    mutant = os.environ.get("MUTANT_UNDER_TEST", "")
    if "__mutmut_" not in mutant:
        return
    room = mutant.split(".")[1]
    items.sort(key=lambda item: (not item.nodeid.startswith(f"tests/unit/{room}"), seconds.get(item.nodeid, 0.0)))
    ends = accumulate(seconds.get(item.nodeid, 0.0) for item in items)
    del items[max(1, sum(1 for _ in takewhile(lambda end: end <= _MOST, ends))) :]
    _empty_caches(f"twinform.{room}.")


def pytest_sessionfinish(session: pytest.Session) -> None:
    """A file of tests that cannot be imported fails: mutmut takes pytest's exit code for an interruption by hand."""
    if session.testsfailed and session.exitstatus == pytest.ExitCode.INTERRUPTED:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


@cache
def _seconds() -> dict[str, float]:
    return json.loads(_MEASURED.read_text(encoding="utf-8"))["duration_by_test"] if _MEASURED.exists() else {}


def _empty_caches(room: str) -> None:
    """Forget what was made while the tests were collected."""
    for module in [module for name, module in sys.modules.items() if name.startswith(room)]:
        for value in list(vars(module).values()):
            if hasattr(value, "cache_clear"):
                value.cache_clear()
