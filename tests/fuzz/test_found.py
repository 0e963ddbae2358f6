"""What fuzzing has found stays fixed, and the targets hold for seeds, documents of every kind, and their mutants."""

from pathlib import Path
from random import Random

import pytest
from lxml import etree

from fuzz.table import TARGETS
from testbed.mutated.mutants import mutant
from tests.profile import DEEP
from tests.schema_documents import document
from twinform.schemas import table

_FOUND = Path(__file__).with_name("found")
_VERSIONS = [(format, version) for format in ("urdf", "sdf") for version in table(format).versions]
_MUTANTS = 2000 if DEEP else 20


def test_what_was_found_is_of_a_target() -> None:
    assert {each.name for each in _FOUND.iterdir()} <= {*TARGETS}


@pytest.mark.parametrize("file", sorted(_FOUND.glob("*/*")), ids=lambda file: f"{file.parent.name}/{file.name}")
def test_what_was_found_stays_fixed(file: Path) -> None:
    TARGETS[file.parent.name](file.read_bytes())


@pytest.mark.parametrize("name", TARGETS)
def test_seeds_with_other_bytes_hold(name: str) -> None:
    random, target = Random(name), TARGETS[name]
    seeds = [seed for seed in target.seeds() if len(seed) <= target.longest]
    words = [word.encode() for word in sorted(target.words())] or [b"\0"]
    for _ in range(_MUTANTS):
        data = bytearray(random.choice(seeds))
        for _ in range(random.randrange(4)):
            at = random.randrange(len(data) + 1)
            data[at : at + random.randrange(3)] = random.choice([random.randbytes(1), random.choice(words)])
        target(bytes(data))


@pytest.mark.parametrize(("format", "version"), _VERSIONS)
def test_documents_of_every_version_and_their_mutants_hold(format: str, version: str) -> None:
    for seed in range(1000 if DEEP else 30):
        random = Random(seed)
        text = document(random, format, version)
        TARGETS["load"](text)
        TARGETS["load"](etree.tostring(mutant(etree.fromstring(text), random)))
