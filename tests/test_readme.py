"""The README shows what happens."""

import doctest
import os
from pathlib import Path

import pytest

_ROOT = Path(__file__).parents[1]


def test_the_python_tour_prints_what_it_shows(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(_ROOT)
    result = doctest.testfile(os.fspath(_ROOT / "README.md"), module_relative=False)
    assert result.attempted >= 7
    assert result.failed == 0
