"""What once did not come back: the files of `cases/round_trip`, and those of `cases/home_from_mjcf` of MJCF, do now."""

from pathlib import Path

import pytest

import twinform
from twinform.compiler.audit import audit
from twinform.testing.properties import RoundTrip

CASES = Path(__file__).parent / "cases"
ROUND_TRIPS = sorted((CASES / "round_trip").iterdir())
ACCEPTED = [
    path
    for path in sorted((CASES / "convert").iterdir())
    if path.is_file() and ".expected." not in path.name and not path.name.startswith("refused")
]


def _name(path: Path) -> str:
    return f"{path.parent.name}/{path.name}"


@pytest.mark.parametrize("path", ROUND_TRIPS, ids=_name)
def test_it_comes_back(path: Path) -> None:
    trip = RoundTrip.of(path, twinform.load(path))
    there = twinform.convert(path, to="urdf" if path.suffix == ".sdf" else "sdf").text
    assert list(trip.mismatches(trip.back(there))) == []


@pytest.mark.parametrize("path", sorted((CASES / "home_from_mjcf").iterdir()), ids=_name)
def test_it_comes_home_from_mjcf(path: Path) -> None:
    """A world does so as a whole."""
    document = twinform.load(path)
    trip = RoundTrip.of_whole(path, document)
    there = twinform.convert(path, to="mjcf")
    assert list(trip.mismatches(trip.back(there.text))) == []
    assert there.source is not None
    assert audit(there.source, there.text, there.ledger).unaccounted == ()


@pytest.mark.parametrize("name", ["fixed_joint_of_old_sdf.sdf", "computed_inertia.sdf", "repeated_poses.sdf"])
def test_it_comes_home_by_way_of_mjcf_and_urdf(name: str) -> None:
    path = CASES / "home_from_mjcf" / name
    trip = RoundTrip.of_whole(path, twinform.load(path))
    mjcf = twinform.convert(path, to="mjcf").text
    urdf = twinform.convert(mjcf.encode(), to="urdf").text
    assert list(trip.mismatches(trip.back(urdf))) == []


@pytest.mark.parametrize("path", [*ROUND_TRIPS, *ACCEPTED], ids=_name)
def test_an_audit_accounts_for_every_part_there_and_back(path: Path) -> None:
    own, other = ("sdf", "urdf") if path.suffix == ".sdf" else ("urdf", "sdf")
    there = twinform.convert(path, to=other)
    for made in (there, twinform.convert(there.text.encode(), to=own)):
        assert made.source is not None
        assert audit(made.source, made.text, made.ledger).unaccounted == ()
