"""Passes that skip what by the census does not concern them make what they make when they look at everything."""

import sys
from pathlib import Path
from typing import TypeVar

import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from testbed.corpus.files import CorpusFile
from tests.corpus.portions import chunks
from tests.profile import DEEP, examples
from twinform.compiler import CompileError
from twinform.ir import Document, Node, census_of
from twinform.ir.rewrite import ANYTHING, map_children
from twinform.request_options import Language
from twinform.testing import strategies

TARGETS: list[tuple[Language, str | None]] = [("urdf", None), ("sdf", "1.4"), ("sdf", "1.7"), ("sdf", "1.11")]
AnyNode = TypeVar("AnyNode", bound=Node)
CASES = Path(__file__).parents[1] / "cases"
FOLDERS = ["elements", "whole", *(["check", "convert", "versions"] if DEEP else [])]
CHUNKS = chunks()


def _outcome(source: Path | Document, to: Language, version: str | None) -> object:
    try:
        made = twinform.convert(source, to=to, sdf_version=version)
    except CompileError as error:
        return error.diagnostics
    return made.text, made.diagnostics, made.ledger


def _anything(_: Node) -> int:
    return ANYTHING


def _unpruned(source: Path | Document, to: Language, version: str | None) -> object:
    with pytest.MonkeyPatch.context() as patch:
        # by its full name: the package has a function `rewrite` too
        patch.setattr(sys.modules["twinform.ir.rewrite"], "_count", _anything)
        return _outcome(source, to, version)


def _forgetful(node: AnyNode) -> AnyNode:
    """The same without any census that was found before."""
    return map_children(node.copy(source=node.source), _forgetful)


@pytest.mark.parametrize(("to", "version"), TARGETS)
@pytest.mark.parametrize("folder", FOLDERS)
def test_files_become_the_same(folder: str, to: Language, version: str | None) -> None:
    files = [path for path in sorted((CASES / folder).rglob("*")) if path.suffix in {".urdf", ".sdf"}]
    different = [path.name for path in files if _outcome(path, to, version) != _unpruned(path, to, version)]
    assert files
    assert different == []


@pytest.mark.deep
@pytest.mark.parametrize("chunk", CHUNKS)
def test_real_files_become_the_same(corpus: Path, chunk: str) -> None:
    assert corpus.is_dir()
    assert [file.name for file in CHUNKS[chunk] if _differs(file)] == []


def _differs(file: CorpusFile) -> bool:
    return any(_outcome(file.path, *target) != _unpruned(file.path, *target) for target in TARGETS)


@examples(0.5)
@given(strategies.robots() | strategies.worlds(), st.sampled_from(TARGETS))
def test_generated_models_become_the_same(document: Document, target: tuple[Language, str | None]) -> None:
    census_of(document)
    assert _outcome(document, *target) == _unpruned(_forgetful(document), *target)
