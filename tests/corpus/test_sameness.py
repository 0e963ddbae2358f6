"""Every conversion of a real file is the same robot, unless it is known why not."""

from pathlib import Path
from typing import Literal

import pytest

import twinform
from reports.same_robot.sameness import KNOWN
from testbed.corpus.files import CorpusFile, Kind
from testbed.corpus.there_and_back import robots
from tests.corpus.portions import chunks

_EVERY = 10
"""One file of so many is tried; the report tries all."""

SAMPLE = {name: files[::_EVERY] for name, files in chunks().items()}


@pytest.mark.parametrize("chunk", SAMPLE)
def test_a_file_and_its_conversion_are_the_same_robot(corpus: Path, chunk: str):
    assert corpus.is_dir()
    tried = [file for file in SAMPLE[chunk] if not KNOWN.why("different", file.name)]
    found = {file.name: difference for file in tried if (difference := _first_difference(file))}
    assert found == {}


def _first_difference(file: CorpusFile) -> str:
    checked = twinform.check(file.path, paths=file.paths)
    if checked.document is None or not checked.accepted:
        return ""
    for robot in robots(checked.document):
        try:
            to: Literal["sdf", "urdf"] = "sdf" if file.kind is Kind.URDF else "urdf"
            text = twinform.convert(file.path, to=to, model=robot, paths=file.paths).text
        except twinform.CompileError:
            continue
        found = twinform.diff(file.path, text.encode(), model=robot, carriers=True, paths=file.paths)
        if not found.same:
            return found.differences[0].message
    return ""
