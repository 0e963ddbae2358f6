"""Markup: what is no markup is escaped."""

import pytest

from twinform.report.markup import Markup, breakable, element, join, plain


def test_text_is_escaped_and_markup_is_not() -> None:
    assert element("p", "<b>", Markup("<i>x</i>"), None) == "<p>&lt;b&gt;<i>x</i></p>"


def test_attributes_are_quoted_and_named_as_in_html() -> None:
    made = element("a", "x", class_="one", aria_label='"<', open=True, hidden=False, id=None)
    assert made == '<a class="one" aria-label="&quot;&lt;" open>x</a>'


def test_elements_without_an_end_have_none() -> None:
    assert element("img", alt="") == '<img alt="">'
    assert element("rect", width=1) == '<rect width="1"></rect>'


@pytest.mark.parametrize("text", ["\u202e", "\x1b[31m", "\x00"])
def test_what_is_not_printable_is_written_out(text: str) -> None:
    assert plain(text).isprintable()


def test_lines_stay_lines() -> None:
    assert plain("a\n\tb") == "a\n\tb"


def test_joined_parts_are_escaped_with_what_is_between() -> None:
    assert join(("<", None, Markup("<br>")), " & ") == "&lt; &amp; <br>"


def test_names_can_be_broken_behind_their_words_and_nowhere_else() -> None:
    assert breakable("package://a_b/left::wheel.dae") == "package://<wbr>a_<wbr>b/<wbr>left::<wbr>wheel.<wbr>dae"
    assert breakable("<b>") == "&lt;b&gt;"
    assert breakable("") == ""
