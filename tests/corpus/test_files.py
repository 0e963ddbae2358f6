"""The corpus itself."""

from pathlib import Path

from testbed.corpus.files import Kind, corpus_files, models


def test_every_file_of_the_index_is_there(corpus: Path):
    assert corpus.is_dir()
    assert all(file.path.is_file() for file in corpus_files())
    assert len(models()) > 1000


def test_what_a_file_is_agrees_with_the_index(corpus: Path):
    assert corpus.is_dir()
    formats = {Kind.URDF: {"urdf", "xacro"}, Kind.SDF: {"sdf", "world"}}
    wrong = [file.name for file in models() if file.row and file.row["format"] not in formats[file.kind]]
    assert wrong == []
