"""Real models are written as lxml lays out their trees, and the XSD accepts or refuses both."""

from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import pytest

import twinform
from testbed.corpus.files import CorpusFile, Kind
from tests.corpus.portions import chunks
from tests.written_text import assert_laid_out
from twinform.compiler.output.emitting import document_tree, written_version
from twinform.ir import Document
from twinform.schemas import is_valid_text, libxml2_errors

CHUNKS = chunks()
_OTHER: dict[Kind, Literal["urdf", "sdf"]] = {Kind.URDF: "sdf", Kind.SDF: "urdf"}


def _documents(file: CorpusFile) -> Iterator[Document]:
    """A file as it was read, and converted, if it can be."""
    loaded = twinform.check(file.path)
    if loaded.document is None or not loaded.accepted:
        return
    yield loaded.document
    try:
        yield twinform.convert(file.path, to=_OTHER[file.kind]).document
    except twinform.CompileError:
        return


def _assert_written(document: Document) -> None:
    text = assert_laid_out(document)
    if not any(not prefix for prefix, _ in document.namespaces):  # the XSD takes plain names
        errors = libxml2_errors(document_tree(document), document.format, written_version(document))
        assert is_valid_text(text, document.format, written_version(document)) == (not errors)


@pytest.mark.deep
@pytest.mark.parametrize("chunk", CHUNKS)
def test_real_models_are_laid_out(corpus: Path, chunk: str):
    assert corpus.is_dir()
    for file in CHUNKS[chunk]:
        for document in _documents(file):
            _assert_written(document)
