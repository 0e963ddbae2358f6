"""Columns of findings about real files: each piece is in the part that the path of the finding leads to."""

import re
from collections.abc import Iterator

import pytest
from lxml import etree

from testbed.corpus.files import MISSING, CorpusFile, Kind
from tests.corpus.portions import chunks
from twinform.compiler import check
from twinform.compiler.input.finding_spans import located
from twinform.compiler.input.loading import read_tree_again
from twinform.diagnostics import Diagnostic, Span
from twinform.diagnostics.rules import UNUSED_AXIS
from twinform.text import SourceText, UnplacedError, spans

_CHUNKS = chunks(Kind.URDF, Kind.SDF)


@pytest.mark.parametrize("files", _CHUNKS.values(), ids=_CHUNKS)
def test_pieces_are_where_paths_lead(files: tuple[CorpusFile, ...]) -> None:
    if not files:
        pytest.skip(MISSING)
    without: list[str] = []
    found = 0
    for file in files:
        loaded = check(file.path, paths=file.paths)
        diagnostics = located(loaded)
        assert len(diagnostics) == len(loaded.diagnostics)
        assert not list(_astray(diagnostics, loaded.content or b"")), file.name
        found += len(diagnostics)
        without += [f"{file.name}:{each.location.line}: {each.location.path}" for each in diagnostics if _lacks(each)]
    assert len(without) <= 1 + found // 50, "\n".join(without)


def _lacks(found: Diagnostic) -> bool:
    """Whether it has no column, and is not about an axis: one that URDF has only the dynamics of is not there."""
    return bool(found.location.line) and not found.location.column and found.rule is not UNUSED_AXIS


def _astray(found: tuple[Diagnostic, ...], data: bytes) -> Iterator[Diagnostic]:
    """Findings with a piece that is in none of the elements that XPath finds, where expat says that these are."""
    placed = [each for each in found if each.location.column and each.location.path.strip("/")]
    try:
        text = SourceText.of(data).text
        root = read_tree_again(data)
        places = dict(zip(root.iter("*"), spans(text).walk(), strict=True))
    except (UnplacedError, ValueError):
        return
    except Exception:  # noqa: BLE001 - a file of another format
        return
    starts = [0, *(end.end() for end in re.finditer(r"\r\n|\n|\r", text))]
    for each in placed:
        where = each.location
        path = where.path.partition("/@")[0] if "']/@" not in where.path else where.path.rpartition("/@")[0]
        try:
            parts = root.getroottree().xpath(path)
        except etree.XPathError:
            continue
        begin = starts[where.line - 1] + where.column - 1
        piece = Span(begin, starts[where.end_line - 1] + where.end_column - 1)
        wholes = [places[part].whole for part in parts if part in places]
        if wholes and not any(whole.start < piece.start < piece.end <= whole.end for whole in wholes):
            yield each
