"""Texts of real models and xacro files keep what they mean when they are formatted."""

from pathlib import Path

import pytest

from testbed.corpus.files import CorpusFile, Kind, corpus_files
from tests.corpus.portions import portions
from tests.layouts import assert_formatted
from twinform.text import SourceText, UnplacedError
from twinform.text.formatting import FormatOptions, format_text

PORTIONS = portions(corpus_files())


def _is_formatted(file: CorpusFile) -> bool:
    try:
        format_text(SourceText.of(file.path.read_bytes()), FormatOptions())
    except UnplacedError:
        return False
    return True


@pytest.mark.parametrize("portion", PORTIONS)
def test_a_real_text_is_formatted(corpus: Path, portion: str) -> None:
    assert corpus.is_dir()
    for file in filter(_is_formatted, PORTIONS[portion]):
        assert_formatted(file.path.read_bytes(), is_model=file.kind in {Kind.URDF, Kind.SDF})
