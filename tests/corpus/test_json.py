"""Every accepted file of the corpus as JSON: valid by the schema, and the text that comes back is the file's own."""

import json
from pathlib import Path

import pytest

import twinform
from testbed.corpus.files import CorpusFile, Kind
from tests.corpus.portions import chunks
from tests.json_judge import complaints
from twinform.compiler import CompileError

CHUNKS = chunks()


@pytest.mark.parametrize("chunk", CHUNKS)
def test_a_file_comes_back_from_json_as_from_its_own_format(corpus: Path, chunk: str) -> None:
    assert corpus.is_dir()
    assert [fault for file in CHUNKS[chunk] for fault in _faults(file)] == []


def _faults(file: CorpusFile) -> list[str]:
    to = "urdf" if file.kind is Kind.URDF else "sdf"
    try:
        expected = twinform.convert(file.path, to=to, comments=False).text
    except CompileError:
        return []
    as_json = twinform.convert(file.path, to="json").text
    faults = [f"{file.name}: {message}" for message in complaints(json.loads(as_json))]
    back = twinform.convert(as_json.encode(), to=to).text
    return faults if back == expected else [*faults, f"{file.name} is another text"]
