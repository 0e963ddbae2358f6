"""What once did not come home: every file of `tests/cases/home` goes to the other format and back, and is as it was."""

from pathlib import Path

import pytest

import twinform
from twinform.testing.round_trips import RoundTrip

CASES = Path(__file__).parent / "cases" / "home"


@pytest.mark.parametrize("path", sorted(CASES.iterdir()), ids=lambda path: path.name)
def test_it_comes_home(path: Path) -> None:
    trip = RoundTrip.of(path, twinform.load(path))
    there = twinform.convert(path, to="urdf" if path.suffix == ".sdf" else "sdf").text
    assert list(trip.astray(trip.back(there))) == []
