"""No real file breaks the compiler, and none is refused without a line."""

from pathlib import Path

import pytest

from testbed.corpus.examine import examined
from tests.corpus.portions import chunks

CHUNKS = chunks()


@pytest.mark.parametrize("chunk", CHUNKS)
def test_a_file_is_converted_or_refused_with_a_line(corpus: Path, chunk: str):
    assert corpus.is_dir()
    assert {found.name: found.faults for found in examined(CHUNKS[chunk]) if found.faults} == {}


@pytest.mark.parametrize("chunk", CHUNKS)
def test_an_accepted_file_is_converted_or_the_rules_against_it_are_named(corpus: Path, chunk: str):
    assert corpus.is_dir()
    accepted = [found for found in examined(CHUNKS[chunk]) if found.accepted and not found.faults]
    assert [
        one.name for one in accepted if [one.converted, one.without_robot, bool(one.not_converted_by)].count(True) != 1
    ] == []


@pytest.mark.parametrize("chunk", CHUNKS)
def test_a_robot_comes_back_from_the_other_format_as_it_was(corpus: Path, chunk: str):
    assert corpus.is_dir()
    assert {found.name: found.mismatches[:3] for found in examined(CHUNKS[chunk]) if found.mismatches} == {}


@pytest.mark.parametrize("chunk", CHUNKS)
def test_every_part_of_a_file_is_accounted_for(corpus: Path, chunk: str):
    assert corpus.is_dir()
    assert {found.name: found.unaccounted for found in examined(CHUNKS[chunk]) if found.unaccounted} == {}
