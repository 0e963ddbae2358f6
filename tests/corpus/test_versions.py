"""Real models in older versions of SDF, and back in the newest."""

from pathlib import Path

import pytest

from testbed.corpus.files import CorpusFile, Kind
from testbed.corpus.versions import Trip, there_and_back
from tests.corpus.portions import chunks

_EVERY = 5
"""One file of so many is tried; `make report NAME=versions` tries all."""

SAMPLE = {name: files[::_EVERY] for name, files in chunks(Kind.SDF).items()}
VERSIONS = ("1.4", "1.6", "1.9")


def _trips(files: tuple[CorpusFile, ...], version: str) -> list[Trip]:
    found = [there_and_back(file, version) for file in files]
    return [trip for trip in found if trip is not None]


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("chunk", SAMPLE)
def test_an_older_version_and_back_is_the_same_or_accounted_for(corpus: Path, chunk: str, version: str):
    assert corpus.is_dir()
    trips = _trips(SAMPLE[chunk], version)
    assert {trip.name: trip.difference for trip in trips if trip.difference and not trip.accounted} == {}
    assert [trip.name for trip in trips if trip.stale] == []


@pytest.mark.parametrize("chunk", SAMPLE)
def test_an_older_version_has_nothing_of_newer_ones(corpus: Path, chunk: str):
    assert corpus.is_dir()
    trips = _trips(SAMPLE[chunk], "1.5")
    assert {trip.name: trip.unclean for trip in trips if trip.unclean} == {}
