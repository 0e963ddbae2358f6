"""Texts that somebody is typing: no state of them breaks anything, and each request has an answer."""

import asyncio
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lsprotocol import types

from testbed.editor.client import Editor, editor
from tests.profile import DEEP
from tests.unit.server.test_diagnostics import HOSTILE
from twinform.diagnostics import Span
from twinform.server.actions import actions
from twinform.server.checking import no_settings
from twinform.server.closing_tags import closing, linked_names
from twinform.server.code_lens import lenses, resolve_lens
from twinform.server.completion import complete
from twinform.server.document_outline import folds, links, outline
from twinform.server.documents import TextDocument
from twinform.server.hover import hover
from twinform.server.inlay_hints import inlay_hints
from twinform.server.navigation import RenameRefusedError, definitions, prepare, references, rename, search_of
from twinform.server.session import Session

pytestmark = pytest.mark.slow

SESSION = Path(__file__).with_name("session")
FILES = ("arm.urdf", "cart.sdf", "rover.urdf.xacro", "wheel.xacro")


def session_with(name: str, text: str) -> tuple[Session, TextDocument]:
    session = Session(no_settings, lambda _: None)
    uri = (SESSION / name).as_uri()
    return session, session.documents.follow(uri, text, 1, "urdf")


def ask_everything(session: Session, document: TextDocument, offset: int) -> None:
    hover(session, document, offset)
    found = complete(session, document, offset)
    for item in found.items:
        assert isinstance(item.text_edit, types.TextEdit)
        assert document.positions.span(item.text_edit.range).end >= 0
    definitions(session, document, offset)
    references(session, document, offset)
    for ask in (lambda: prepare(document, offset), lambda: rename(session, document, offset, "another")):
        with suppress(RenameRefusedError):
            ask()
    outline(document)
    folds(document)
    links(document, search_of(session, document))
    linked_names(document, offset)
    for typed in (">", "/"):
        for edit in closing(document, offset, typed):
            assert document.positions.span(edit.range).end <= len(document.text)
    inlay_hints(session, document, document.positions.range(Span(0, len(document.text))))
    for lens in lenses(document)[:2]:
        resolve_lens(session, lens)
    where = document.positions.position(offset)
    actions(session, document, types.Range(where, where), None)


@pytest.mark.parametrize("name", FILES)
def test_every_prefix_of_a_file_has_answers_at_its_end(name: str) -> None:
    text = (SESSION / name).read_text(encoding="utf-8")
    for end in range(0, len(text) + 1, 1 if DEEP else 4):
        session, document = session_with(name, text[:end])
        ask_everything(session, document, end)


@pytest.mark.parametrize("name", FILES)
def test_every_file_without_one_piece_has_answers_there(name: str) -> None:
    text = (SESSION / name).read_text(encoding="utf-8")
    for start in range(0, len(text), 7 if DEEP else 35):
        for length in (1, 11):
            session, document = session_with(name, text[:start] + text[start + length :])
            ask_everything(session, document, start)


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_texts_have_answers(name: str) -> None:
    text = HOSTILE[name]
    for end in (0, 1, len(text) // 2, len(text)):
        session, document = session_with("hostile.urdf", text)
        ask_everything(session, document, end)


@given(st.text(alphabet="<>/=\"' \n\r-![]?&;xacro:${}()link🤖é", max_size=60), st.integers(0, 60))
def test_any_text_has_answers_anywhere(text: str, offset: int) -> None:
    for name in ("any.urdf", "any.sdf", "any.xacro"):
        ask_everything(*session_with(name, text), min(offset, len(text)))


def _typed(text: str) -> Iterator[tuple[str, int, int]]:
    """The characters of a text with their lines and columns."""
    line = column = 0
    for character in text:
        yield character, line, column
        line, column = (line + 1, 0) if character == "\n" else (line, column + 1)


def test_a_file_that_is_typed_key_by_key_is_what_was_typed(tmp_path: Path) -> None:
    text = (SESSION / "half.urdf").read_text(encoding="utf-8").replace("half", "ganz")
    text = text.replace('link="\n', 'link="base"/>\n').replace("  <jo\n", "")

    async def steps(one: Editor) -> None:
        uri = one.open(tmp_path / "typed.urdf", "")
        version = 1
        for character, line, column in _typed(text):
            version = one.change(uri, ((line, column, line, column), character))
            if character in '<" ':
                where = types.CompletionParams(types.TextDocumentIdentifier(uri), types.Position(line, column + 1))
                await one.request(types.TEXT_DOCUMENT_COMPLETION, where)
        assert [each.code for each in await one.diagnostics(uri, version)] == []

    async def session() -> None:
        async with editor(tmp_path) as one:
            await steps(one)

    asyncio.run(session())
