"""Closing tags while somebody types, and the two names of an element."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from lsprotocol import types

from twinform.server.closing_tags import closing, linked_names
from twinform.server.documents import TextDocument
from twinform.server.tolerant_tree import parse

CLOSED = {
    '<robot><link name="a">|</robot>': "</link>",
    '<robot><link name="a">|': "</link>",
    "<robot>|": "</robot>",
    '<robot><link name="a">|\n  <link name="b"></link>\n</robot>': "</link>",
    "<link><link>|</link>": "</link>",
    "<robot><xacro:if value='1'>|</robot>": "</xacro:if>",
    "<robot>\n  <link>\n  </|\n</robot>": "link>",
    "<robot><link><visual></|</link></robot>": "visual>",
    "<robot><link></|></robot>": "link",
    "<robot><link><link/></|": "link>",
    "<robot><link></|</link>": "link>",
    "<robot><link></|\n  </link  ></robot>": "link>",
}
LEFT = (
    '<robot><link name="a">|</link></robot>',
    '<robot><link name="a"/>|</robot>',
    "<robot><link></link>|</robot>",
    "<robot><!-- <link>| --></robot>",
    "<robot><!-- a -->|</robot>",
    "<?xml version='1.0'?>|<robot>",
    '<robot><link name="a"/|\n  <joint/></robot>',
    "<robot><link/|</robot>",
    "<robot><link></| <visual/></link></robot>",
    "<robot><link></|link></robot>",
    "<robot></robot></|",
    '<robot><mesh filename="meshes/|"/></robot>',
    '<robot><mesh filename="meshes/|',
    "<robot>1/|</robot>",
    "</|",
    ">|",
    "<robot><![CDATA[ </| ]]></robot>",
    '<robot><link name="a>|"/></robot>',
)


def typed(marked: str) -> tuple[TextDocument, int]:
    offset = marked.index("|")
    return TextDocument(Path("/r.urdf").as_uri(), marked.replace("|", "")), offset


@pytest.mark.parametrize("marked", CLOSED)
def test_a_tag_is_closed_once_it_is_typed(marked: str) -> None:
    document, offset = typed(marked)
    (edit,) = closing(document, offset, document.text[offset - 1])
    assert edit.new_text == CLOSED[marked]
    span = document.positions.span(edit.range)
    assert span.start == offset
    assert span.of(document.text).strip() in {"", "</link>", "</link  >"}


@pytest.mark.parametrize("marked", LEFT)
def test_nothing_is_written_where_nothing_is_open(marked: str) -> None:
    document, offset = typed(marked)
    assert closing(document, offset, document.text[offset - 1]) == []


def test_another_character_than_the_one_that_was_typed_closes_nothing() -> None:
    document, offset = typed("<robot>|")
    assert closing(document, offset, "/") == []
    assert closing(document, 0, ">") == []


LINKED = (
    "<robot><«li|nk» name='a'><visual/></«link»></robot>",
    "<robot><«link» name='a'></«link|»></robot>",
    "<«|robot»><link><link/></link></«robot»>",
    "<«a»><a></a></«|a»>",
)
NOT_LINKED = (
    "<robot><li|nk/></robot>",
    "<robot><li|nk></robot>",
    "<robot><link na|me='a'></link></robot>",
    "<robot><!-- <li|nk></link> --></robot>",
    "<robot>a |b</robot>",
    "|<robot></robot>",
)


@pytest.mark.parametrize("marked", LINKED)
def test_both_names_of_an_element_are_linked(marked: str) -> None:
    document, offset = typed(marked.replace("«", "").replace("»", ""))
    found = linked_names(document, offset)
    assert isinstance(found, types.LinkedEditingRanges)
    pieces = [document.positions.span(each) for each in found.ranges]
    shown = document.text
    for span in reversed(pieces):
        shown = f"{shown[: span.start]}«{span.of(shown)}»{shown[span.end :]}"
    assert shown == marked.replace("|", "")


@pytest.mark.parametrize("marked", NOT_LINKED)
def test_nothing_else_is_linked(marked: str) -> None:
    assert linked_names(*typed(marked)) is None


def type_with_closing_tags(text: str) -> Iterator[tuple[str, str]]:
    """Type a text as people do who let the editor close tags: what is before and behind the cursor after each key."""
    before, behind, at = "", "", 0
    while at < len(text):
        before, at = before + text[at], at + 1
        document = TextDocument(Path("/r.urdf").as_uri(), before + behind)
        for edit in closing(document, len(before), before[-1]):
            behind = behind[document.positions.span(edit.range).end - len(before) :]
            if before[-1] == ">":
                behind = edit.new_text + behind
            else:  # the author sees that the tag is complete
                before, at = before + edit.new_text, text.index(">", at) + 1
        yield before, behind


@pytest.mark.parametrize("name", ["arm.urdf", "cart.sdf", "wheel.xacro"])
def test_a_file_that_is_typed_with_closing_tags_is_well_formed_behind_every_tag(name: str) -> None:
    text = Path(__file__).with_name("session").joinpath(name).read_text(encoding="utf-8")
    states = list(type_with_closing_tags(text))
    assert states[-1] == (text, "")
    whole = [parse(before + behind).whole for before, behind in states if before[-1] == ">" and before[-2] not in "?-"]
    assert len(whole) > 10
    assert all(whole)
