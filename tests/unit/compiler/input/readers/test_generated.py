"""The generated readers make what the schema reader and Pydantic make: nodes, sources, written fields and findings."""

from pathlib import Path
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from testbed.mutated.mutants import mutant
from tests.corpus.portions import chunks
from tests.profile import examples
from tests.unit.compiler.input.readers.judge import differences
from twinform.compiler.input.loading import read_tree
from twinform.compiler.input.parsing import UnreadableError
from twinform.compiler.input.readers import generate
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.schemas import XmlElement
from twinform.testing import strategies

ELEMENTS = sorted(Path("tests/cases").rglob("*.urdf")) + sorted(Path("tests/cases").rglob("*.sdf"))
CHUNKS = chunks()
DOCUMENTS = st.one_of(strategies.robots(), strategies.sdf_models(), strategies.worlds())


def tree_of(text: bytes) -> XmlElement | None:
    try:
        return read_tree(text, DiagnosticSink(file="file"))[0]
    except UnreadableError:
        return None


def differences_in(text: bytes, seed: str, mutants: int = 0) -> list[str]:
    """What differs for a text and for some documents like it, but with mistakes."""
    root = tree_of(text)
    if root is None:
        return []
    random = Random(seed)
    found = [*differences(root), *differences(root, strict=True)]
    for _ in range(mutants):
        again = tree_of(etree.tostring(mutant(root, random)))  # a default namespace is back in it
        found += differences(again) if again is not None else []
    return found


def test_the_modules_are_what_the_facts_say() -> None:
    assert generate.stale() == []
    assert generate.main(["--check"]) == 0


@examples()
@given(document=DOCUMENTS, seed=st.randoms(use_true_random=False))
def test_generated_readers_agree_with_the_schema_reader(document: Document, seed: Random) -> None:
    root = etree.fromstring(emit(document, DiagnosticSink()).encode())
    assert differences(root) == []
    assert differences(mutant(root, seed)) == []


@pytest.mark.parametrize("path", ELEMENTS, ids=str)
def test_they_agree_on_every_case(path: Path) -> None:
    assert differences_in(path.read_bytes(), str(path), mutants=3) == []


@pytest.mark.parametrize("chunk", CHUNKS)
def test_they_agree_on_real_files(corpus: Path, chunk: str) -> None:
    assert corpus.is_dir()
    for file in CHUNKS[chunk]:
        assert differences_in(file.path.read_bytes(), file.name, mutants=2) == [], file.name
