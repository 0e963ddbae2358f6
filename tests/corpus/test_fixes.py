"""Fixes of real models: the same robot, no new finding, every comment and byte of the rest; deep: of all files."""

from pathlib import Path

import pytest

from testbed.corpus.files import models
from testbed.fixed_files import fixed_file
from tests.corpus.portions import portions
from tests.profile import DEEP

PORTIONS = portions(models())


@pytest.mark.parametrize("portion", PORTIONS)
def test_fixes_keep_their_promises(corpus: Path, portion: str) -> None:
    assert corpus.is_dir()
    for file in PORTIONS[portion][:: 1 if DEEP else 4]:
        assert fixed_file(str(file.path), file.path.read_bytes()).faults == (), file.name
