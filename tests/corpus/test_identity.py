"""What is read and not changed is written as it was, judged by a comparison that knows nothing of the compiler."""

from pathlib import Path

import pytest

from testbed.corpus.examine import examined
from tests.corpus.portions import chunks

CHUNKS = chunks()


@pytest.mark.parametrize("chunk", CHUNKS)
def test_an_accepted_file_is_written_as_it_was_read(corpus: Path, chunk: str):
    assert corpus.is_dir()
    accepted = [found for found in examined(CHUNKS[chunk]) if found.accepted]
    assert {found.name: found.difference for found in accepted if not found.identical} == {}
