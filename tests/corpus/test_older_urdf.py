"""Real robots in every version of URDF, to its readers and to Drake."""

from pathlib import Path

import pytest

from reports.harness.needs import drake, urdfdom, urdfdom_6
from reports.same_robot.older_urdf import judged
from reports.same_robot.other_urdf import judge
from testbed.corpus.files import CorpusFile, Kind
from tests.corpus.portions import chunks

_EVERY = 2
"""One file of so many is tried; `make report NAME=older_urdf` tries all."""
_SAMPLE: dict[str, tuple[CorpusFile, ...]] = {name: files[::_EVERY] for name, files in chunks(Kind.URDF).items()}
_MISSING = drake() or urdfdom() or urdfdom_6()


@pytest.mark.skipif(bool(_MISSING), reason=_MISSING)
@pytest.mark.parametrize("chunk", _SAMPLE)
def test_every_version_is_taken_and_the_same_robot(corpus: Path, chunk: str) -> None:
    assert corpus.is_dir()
    found = [outcome for file in _SAMPLE[chunk] for outcome in judge(file)]
    assert judged(found).unexplained() == []
