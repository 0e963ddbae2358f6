"""No real xacro file breaks the compiler, and none is refused without a place to look at."""

from pathlib import Path

import pytest

from tests.corpus.examine_xacro import examine_xacro
from tests.corpus.files import portions, xacro_files

PORTIONS = portions(xacro_files())


@pytest.mark.parametrize("portion", PORTIONS)
def test_a_xacro_file_is_expanded_or_refused_with_a_line(corpus: Path, portion: str):
    assert corpus.is_dir()
    found = [examine_xacro(file.path, file.name) for file in PORTIONS[portion]]
    assert {each.name: each.faults for each in found if each.faults} == {}
    assert [each.name for each in found if each.accepted and not each.expanded] == []
