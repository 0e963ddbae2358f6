"""Documents follow what is typed, whatever units the editor counts in."""

from hypothesis import given
from hypothesis import strategies as st
from lsprotocol import types

from twinform.server.documents import Documents
from twinform.server.locations import Positions

ENCODINGS = st.sampled_from(list(types.PositionEncodingKind))
TEXTS = st.text(alphabet="ab\n\r\u2028\x85é🤖<", max_size=30)


@given(TEXTS, ENCODINGS, st.data())
def test_a_position_leads_to_its_offset_and_back(
    text: str, encoding: types.PositionEncodingKind, data: st.DataObject
) -> None:
    positions = Positions.of(text, encoding)
    offset = data.draw(st.integers(0, len(text)))
    back = positions.offset(positions.position(offset))
    inside_line_end = text[offset - 1 : offset + 1] == "\r\n"
    assert back == (offset - 1 if inside_line_end else offset)


@given(TEXTS, ENCODINGS, st.lists(st.tuples(st.integers(0, 40), st.integers(0, 40), TEXTS), max_size=5))
def test_changes_are_made_where_the_editor_makes_them(
    text: str, encoding: types.PositionEncodingKind, changes: list[tuple[int, int, str]]
) -> None:
    documents = Documents()
    documents.encoding = encoding
    documents.follow("file:///a.urdf", text, 1, "urdf")
    for one, other, new in changes:
        start, end = sorted((min(one, len(text)), min(other, len(text))))
        start, end = (each - (text[each - 1 : each + 1] == "\r\n") for each in (start, end))
        positions = Positions.of(text, encoding)
        where = types.Range(positions.position(start), positions.position(end))
        documents.change("file:///a.urdf", [types.TextDocumentContentChangePartial(where, new)], 2)
        text = text[:start] + new + text[end:]
        found = documents.get("file:///a.urdf")
        assert found is not None
        assert found.text == text


@given(TEXTS, ENCODINGS, st.integers(0, 50), st.integers(0, 50))
def test_positions_outside_of_the_text_are_its_edge(
    text: str, encoding: types.PositionEncodingKind, line: int, column: int
) -> None:
    assert 0 <= Positions.of(text, encoding).offset(types.Position(line, column)) <= len(text)


def test_the_last_good_state_is_kept_while_the_text_is_broken() -> None:
    documents = Documents()
    documents.follow("file:///a.urdf", '<robot name="a"><link name="b"/></robot>', 1, "urdf")
    good = documents.get("file:///a.urdf")
    assert good is not None
    assert good.tree.whole
    for number, new in enumerate(("<l", "i", "n")):
        where = types.Range(types.Position(0, 16 + number), types.Position(0, 16 + number))
        documents.change("file:///a.urdf", [types.TextDocumentContentChangePartial(where, new)], number + 2)
    now = documents.get("file:///a.urdf")
    assert now is not None
    assert not now.tree.whole
    assert documents.last_good(now) is good
