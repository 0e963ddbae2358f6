"""Texts of real models follow random changes of their trees: 10,000 in the deep profile."""

import random
from pathlib import Path

import pytest
from lxml import etree

from testbed.corpus.files import CorpusFile, Kind, corpus_files
from tests.corpus.portions import portions
from tests.patches import assert_patched
from tests.profile import DEEP
from tests.tree_changes import PARSER
from twinform.text import SourceText, spans

PORTIONS = portions([file for file in corpus_files() if file.kind in {Kind.URDF, Kind.SDF, Kind.XACRO}])
TIMES = (1, 1, 1, 1, 2, 5) if DEEP else (1, 1, 4)
"""How many changes are made at once, for each patch of a file."""


def _has_places(file: CorpusFile) -> bool:
    data = file.path.read_bytes()
    try:
        etree.fromstring(data, PARSER)
        spans(SourceText.of(data).text)
    except (ValueError, etree.XMLSyntaxError):
        return False
    return True


@pytest.mark.parametrize("portion", PORTIONS)
def test_the_text_of_a_real_model_follows_its_tree(corpus: Path, portion: str) -> None:
    assert corpus.is_dir()
    for file in filter(_has_places, PORTIONS[portion]):
        for seed, times in enumerate(TIMES):
            assert_patched(file.path.read_bytes(), random.Random(f"{file.name} {seed}"), times)
