"""What fuzzing has found stays mended, and the targets hold for documents of every kind."""

from pathlib import Path
from random import Random

import pytest
from lxml import etree

from tests.differential.mutants import mutant
from tests.fuzz import targets
from tests.profile import DEEP
from twinform.schemas import table
from twinform.testing.documents import document

_FOUND = Path(__file__).with_name("found")
_VERSIONS = [(format, version) for format in ("urdf", "sdf") for version in table(format).versions]


@pytest.mark.parametrize("name", ["load", "pipeline"])
def test_what_was_found_stays_mended(name: str) -> None:
    files = sorted((_FOUND / name).iterdir())
    assert files
    for file in files:
        getattr(targets, name)(file.read_bytes())


@pytest.mark.parametrize(("format", "version"), _VERSIONS)
def test_documents_of_every_version_and_their_mutants_hold(format: str, version: str) -> None:
    for seed in range(1000 if DEEP else 30):
        random = Random(seed)
        text = document(random, format, version)
        targets.load(text)
        targets.load(etree.tostring(mutant(etree.fromstring(text), random)))
