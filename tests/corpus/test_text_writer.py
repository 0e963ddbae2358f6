"""The generated writers of text write real models as the tree writer does, and the XSD accepts or refuses both."""

from collections.abc import Iterator
from pathlib import Path
from typing import Literal

import pytest

import twinform
from tests.corpus.files import CorpusFile, Kind, chunks
from twinform.compiler.output.emitting import document_tree, serialized, text_without_tree, written_version
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


def _difference(document: Document) -> str:
    text, root = text_without_tree(document), document_tree(document)
    errors = libxml2_errors(root, document.format, written_version(document))
    if text is None:
        return ""
    if text != serialized(root, document):
        return "another text"
    return "" if is_valid_text(text, document.format, written_version(document)) == (not errors) else "another verdict"


@pytest.mark.deep
@pytest.mark.parametrize("chunk", CHUNKS)
def test_real_models_are_written_as_by_the_tree_writer(corpus: Path, chunk: str):
    assert corpus.is_dir()
    found = {
        (file.name, document.format): _difference(document) for file in CHUNKS[chunk] for document in _documents(file)
    }
    assert {where: difference for where, difference in found.items() if difference} == {}
