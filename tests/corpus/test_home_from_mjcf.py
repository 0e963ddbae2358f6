"""What a real file holds comes back from MJCF, unless it is known why not."""

from pathlib import Path

import pytest

from reports.text_survives.mjcf_home import KNOWN
from testbed.corpus.home_from_mjcf import come_home
from tests.corpus.portions import chunks

_EVERY = 5
"""One file of so many is tried; the report tries all."""

SAMPLE = {name: files[::_EVERY] for name, files in chunks().items()}


@pytest.mark.parametrize("chunk", SAMPLE)
def test_a_file_comes_home_from_mjcf(corpus: Path, chunk: str) -> None:
    assert corpus.is_dir()
    homes = [home for file in SAMPLE[chunk] for home in come_home(file)]
    assert [(home.name, home.lost[0]) for home in homes if home.lost and not KNOWN.why("lost", home.name)] == []
