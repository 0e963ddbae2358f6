"""What the server itself computes for a request: twice the document, twice the calls, whatever shape it has."""

import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from lsprotocol import types

from tests.profile import DEEP
from twinform.diagnostics import Span
from twinform.server.checking import no_settings
from twinform.server.closing_tags import closing, linked_names
from twinform.server.code_lens import lenses, resolve_lens
from twinform.server.completion import complete
from twinform.server.document_outline import outline, search
from twinform.server.documents import TextDocument
from twinform.server.hover import hover
from twinform.server.inlay_hints import inlay_hints
from twinform.server.navigation import RenameRefusedError, references, rename
from twinform.server.session import Session

pytestmark = pytest.mark.slow

_SIZE = 400 if DEEP else 70
_MOST_GROWTH = 2.4
"""Twice as much, and something for what is sorted."""
_MACRO = '<xacro:macro name="m" params="p">'


def _urdf(inside: str) -> str:
    return f'<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">{inside}</robot>'


def _sdf(inside: str) -> str:
    return f'<sdf version="1.11"><world name="w">{inside}</world></sdf>'


_JOINT = '<joint name="j"><child link="a"/></joint>'
_MODEL = '<model name="a"/>'
_CHILD = '<joint name="j"><child>a</child></joint>'
SHAPES: Mapping[str, tuple[str, Callable[[int], str]]] = {
    "references": ('link="a', lambda n: _urdf('<link name="a"/>' + _JOINT * n)),
    "definitions": ('link="a', lambda n: _urdf('<link name="a"/>' * n + _JOINT)),
    "both": ('link="a', lambda n: _urdf(('<link name="a"/>' + _JOINT) * n)),
    "not closed": ('link="a', lambda n: '<robot name="r">' + '<link name="a">' * n + _JOINT * n),
    "models": ("<child>a", lambda n: _sdf(f'<model name="a"><link name="a"/>{_CHILD}</model>' * n)),
    "models in models": ("<child>a", lambda n: _sdf('<model name="a">' * n + _CHILD + "</model>" * n)),
    "poses in models": ('to="a', lambda n: _sdf('<model name="a"><pose relative_to="a"/>' * n + "</model>" * n)),
    "states": (
        'name="a',
        lambda n: _sdf(_MODEL * n + f'<state world_name="w">{_MODEL * n}</state>'),
    ),
    "states in models": (
        'name="a',
        lambda n: _sdf('<state world_name="w">' + '<model name="a">' * n + "</model>" * n + "</state>"),
    ),
    "steps": ("<child>a", lambda n: _sdf('<model name="a">' * n + f"<child>a{'::a' * n}</child>" + "</model>" * n)),
    "paths": (
        "<child>a",
        lambda n: _sdf('<model name="m">' + _MODEL * n + "".join(f"<child>a::x{i}::a</child>" for i in range(n))),
    ),
    "plugins": ("<link_name>a", lambda n: _sdf(f'<plugin name="p">{"<a>" * n}<link_name>a</link_name></plugin>' * 2)),
    "macros": ("${p", lambda n: _urdf(f'{_MACRO}<link name="${{p}}"/></xacro:macro>' * n)),
    "macros in macros": ("${p", lambda n: _urdf(_MACRO * n + '<link name="${p}"/>' * n + "</xacro:macro>" * n)),
    "calls": ("<xacro:m", lambda n: _urdf(f"{_MACRO}</xacro:macro>" + '<xacro:m p="1"/>' * n)),
    "expressions": ("${p", lambda n: _urdf(f'{_MACRO}<link name="{"${p}" * n}"/></xacro:macro>')),
}
ANSWERS: Mapping[str, Callable[[Session, TextDocument, int], object]] = {
    "completion": complete,
    "completion of elements": lambda session, document, _: complete(session, document, len(document.text) // 2),
    "closing tags": lambda _, document, offset: (closing(document, offset, ">"), linked_names(document, offset)),
    "hints": lambda session, document, _: inlay_hints(session, document, _whole(document)),
    "lenses": lambda session, document, _: [resolve_lens(session, each) for each in lenses(document)[:1]],
    "hover": hover,
    "references": references,
    "rename": lambda session, document, offset: rename(session, document, offset, "b"),
    "outline": lambda _session, document, _offset: outline(document),
    "search": lambda session, _document, _offset: search(session, ""),
}


def _whole(document: TextDocument) -> types.Range:
    return document.positions.range(Span(0, len(document.text)))


def calls(shape: str, answer: str, size: int, folder: Path) -> int:
    """How many functions are called for an answer, once the tables are read."""
    before, made = SHAPES[shape]
    session = Session(no_settings, lambda _: None)
    session.folders = [folder]
    text = made(size)
    document = session.documents.follow((folder / ("r.sdf" if text[1] == "s" else "r.xacro")).as_uri(), text, 1, "")
    count = 0

    def look(_frame: object, event: str, _argument: object) -> None:
        nonlocal count
        count += event in {"call", "c_call"}

    sys.setprofile(look)
    try:
        ANSWERS[answer](session, document, text.rindex(before) + len(before))
    except RenameRefusedError:
        pass
    finally:
        sys.setprofile(None)
    return count


@pytest.mark.parametrize("answer", ANSWERS)
@pytest.mark.parametrize("shape", SHAPES)
def test_twice_the_document_takes_twice_the_calls(shape: str, answer: str, tmp_path: Path) -> None:
    calls(shape, answer, 2, tmp_path)
    one, two, four = (calls(shape, answer, _SIZE * factor, tmp_path) for factor in (1, 2, 4))
    assert two - one < 2000 or four - two < _MOST_GROWTH * (two - one), (one, two, four)
