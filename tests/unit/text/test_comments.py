import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.text.comments import Comment, comments


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("<a>\n<!--x-->\n<b>\n<c/>\n</b>\n</a>", [Comment("x", 2, 3, 5)]),
        ("<a>\n<!--x--><b/>\n</a>", [Comment("x", 2, 2, 2)]),
        ("<a>\n<b/> <!--x-->\n<c/></a>", [Comment("x", 2, 2, 2)]),
        ("<a>\n<b\n d='1'\n/> <!--x-->\n</a>", [Comment("x", 4, 2, 4)]),
        ("<a>\n<b>\n<!--x-->\n</b>\n<c/></a>", [Comment("x", 3)]),
        ("<!--x-->\n<a>\n</a>", [Comment("x", 1, 2, 3)]),
        ("<a>\n<!--x-->\n<!--y-->\ntext\n<b/></a>", [Comment("x", 2, 5, 5), Comment("y", 3, 5, 5)]),
        ("<a>\n<!-- x\n--><b c='>' d=\"/>\">\n</b></a>", [Comment(" x\n", 2, 3, 4)]),
        ("<a><![CDATA[<!--x-->]]></a>", []),
        ("<a><?p <!--x--> ?>\r\n<!--y-->\r\n<b/></a>", [Comment("y", 2, 3, 3)]),
        ("<a>\n<!--x -- y-->\n<b/></a>", [Comment("x -- y", 2, 3, 3)]),
        ("<a/>\n<!--x-->", [Comment("x", 2)]),
        ("</a></a><!--x-->", [Comment("x", 1, 1, 1)]),
        ("<a>\n<!-- never closed\n<b/></a>", []),
        ("", []),
    ],
)
def test_a_comment_is_about_the_next_element_or_its_line(text: str, found: list[Comment]) -> None:
    assert comments(text) == found


@given(st.text(alphabet="<>!-/a \n\"'=[?]CDAT"))
def test_any_text_has_some(text: str) -> None:
    for comment in comments(text):
        assert f"<!--{comment.text}-->" in text
        assert 0 <= comment.first <= comment.last <= text.count("\n") + 1


def test_a_text_that_opens_much_and_closes_nothing_takes_no_time() -> None:
    assert comments("<a b='" * 100_000 + "<!--x-->" + "<a " * 100_000 + '"' * 99_999) is not None
