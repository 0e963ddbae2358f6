"""Masked texts have the places of the texts that they stand for."""

import pytest

from twinform.text import masked


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("<a><!-- b -- c --></a>", "<a><!--        --></a>"),
        ("<!--\r\n--\n-->", "<!--\r\n  \n-->"),
        ("\n<?xml version='0.0'?>\n<a/>", f"\n{' ' * 21}\n<a/>"),
        ("<a><![CDATA[<!-- -- -->]]></a>", "<a><![CDATA[<!-- -- -->]]></a>"),
        ("<a b='1'/>", "<a b='1'/>"),
        ("<!-- open", "<!-- open"),
    ],
)
def test_declarations_and_comments_are_blank(text: str, expected: str) -> None:
    assert masked(text) == expected
