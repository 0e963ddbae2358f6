"""Comments of real files are in what these are converted to, and in what comes back."""

from pathlib import Path

import pytest

from testbed.comments import OTHER, assert_comments_kept, comments
from testbed.corpus.files import CorpusFile, Kind
from tests.corpus.portions import chunks
from twinform import CompileError, convert
from twinform.compiler.input.load_options import XACRO

CHUNKS = chunks()


@pytest.mark.parametrize("chunk", CHUNKS)
def test_comments_of_real_files_travel(corpus: Path, chunk: str) -> None:
    assert corpus.is_dir()
    for file in CHUNKS[chunk]:
        # what is expanded has the comments of macros, and one of xacro's own
        if b"<!--" in file.path.read_bytes() and not file.path.name.endswith(XACRO):
            _assert_travel(file)


def _assert_travel(file: CorpusFile) -> None:
    own = "urdf" if file.kind is Kind.URDF else "sdf"
    for to in (own, OTHER[own]):
        try:
            made = convert(file.path, to=to, paths=file.paths)
            without = convert(file.path, to=to, paths=file.paths, comments=False)
        except CompileError:
            continue
        assert_comments_kept(file.path.read_bytes(), made, without)
        try:
            back = convert(made.text.encode(), to=own)
        except CompileError:
            continue  # what becomes of the robot is the business of other tests
        assert comments(back.text.encode()) == comments(made.text.encode())
