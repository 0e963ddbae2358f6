"""A changed value is a difference or a note, or in the list of what is not compared; another spelling is nothing."""

from pathlib import Path

import pytest

from testbed.not_compared import NOT_COMPARED
from testbed.respellings import KINDS, respellings
from testbed.value_mutants import MISSED, mutants
from tests.profile import DEEP

_CASES = Path(__file__).parent / "cases"
_FILES = sorted(path for path in _CASES.rglob("*") if path.suffix in {".urdf", ".sdf"})
_OF_MJCF = sorted((_CASES / "from_mjcf").glob("*.mjcf"))
_EVERY = 1 if DEEP else 25
_EACH = 4


@pytest.mark.parametrize("path", _FILES[::_EVERY], ids=lambda path: path.relative_to(_CASES).as_posix())
def test_a_changed_value_is_found_or_documented(path: Path):
    assert [each.name for each in mutants(path, _EACH, 1) if each.verdict == MISSED] == []


@pytest.mark.parametrize("path", _OF_MJCF, ids=lambda path: path.stem)
def test_a_changed_value_of_mjcf_is_found_or_documented(path: Path):
    assert [each.name for each in mutants(path, _EACH * (5 if DEEP else 1), 1) if each.verdict == MISSED] == []


@pytest.mark.parametrize("path", _FILES[1::_EVERY], ids=lambda path: path.relative_to(_CASES).as_posix())
def test_another_spelling_is_not_found(path: Path):
    assert [each.name for each in respellings(path, len(KINDS), 1) if each.found] == []


def test_the_places_that_are_not_compared_are_told_apart():
    names = [each.what for each in NOT_COMPARED]
    assert len(set(names)) == len(names)
