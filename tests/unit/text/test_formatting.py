"""What the formatter makes of a text, and what it leaves: one case for each."""

import pytest

from twinform.text import SourceText, UnplacedError
from twinform.text.formatting import FormatOptions, format_text

CASES = {
    "one element a line": (
        "<a><b><c x='1'/></b><d>1 0 0</d></a>",
        "<a>\n  <b>\n    <c x='1'/>\n  </b>\n  <d>1 0 0</d>\n</a>\n",
    ),
    "two blank lines at most": ("<a>\n\n\n\n\n<b/>\n\n<c/>\n \n</a>", "<a>\n\n\n  <b/>\n\n  <c/>\n\n</a>\n"),
    "a comment at the end of a line stays there": (
        "<a>  <!-- a -->\n<b/>   <!-- b --> <!-- too -->\n<!-- c --><c/><!-- end --></a>",
        "<a>  <!-- a -->\n  <b/>   <!-- b --> <!-- too -->\n  <!-- c -->\n  <c/><!-- end -->\n</a>\n",
    ),
    "an element of comments alone": (
        "<a><b> <!-- b --> </b><c><!-- c --></c><d>\n<!-- d --></d></a>",
        "<a>\n  <b> <!-- b --> </b>\n  <c><!-- c --></c>\n  <d>\n    <!-- d -->\n  </d>\n</a>\n",
    ),
    "a comment around the root": (
        "<!-- license --><a/><!-- end --><!-- of file -->",
        "<!-- license -->\n<a/><!-- end --><!-- of file -->\n",
    ),
    "the lines of a comment move with it": (
        "<a>\n    <!-- one\n         two\n  three\n\n    <b/> -->\n    <b/>\n</a>",
        "<a>\n  <!-- one\n       two\n  three\n\n  <b/> -->\n  <b/>\n</a>\n",
    ),
    "a declaration and instructions": (
        '<?xml version="1.0"?><?pi  x?><a><?pi?></a>',
        '<?xml version="1.0"?>\n<?pi  x?>\n<a>\n  <?pi?>\n</a>\n',
    ),
    "text beside elements": ("<a>one <b/>\n   <c  x='1'/></a>", "<a>one <b/>\n   <c  x='1'/></a>\n"),
    "text beside a comment": ("<a><m>1.0  <!-- kg -->\n</m></a>", "<a>\n  <m>1.0  <!-- kg -->\n</m>\n</a>\n"),
    "a text of several lines": (
        "<a>\n    <arg>one\n    two\n  </arg>\n</a>",
        "<a>\n  <arg>one\n    two\n  </arg>\n</a>\n",
    ),
    "numbers of several lines move with their element": (
        "<a>\n      <pose>\n        0   0 0\n        0.5 0 0\n      </pose>\n</a>",
        "<a>\n  <pose>\n    0   0 0\n    0.5 0 0\n  </pose>\n</a>\n",
    ),
    "but not in a plugin, which may read them": (
        "<plugin>\n      <pose>\n        0 0 0\n      </pose>\n</plugin>",
        "<plugin>\n  <pose>\n        0 0 0\n      </pose>\n</plugin>\n",
    ),
    "space that is preserved": (
        "<a xml:space = 'preserve'> <b/>  <c/></a>",
        "<a xml:space='preserve'> <b/>  <c/></a>\n",
    ),
    "a section": ("<a><b><![CDATA[ <x/> ]]></b></a>", "<a>\n  <b><![CDATA[ <x/> ]]></b>\n</a>\n"),
    "blanks alone": ("<a><b>  </b><c>\n\n</c><d></d ></a>", "<a>\n  <b>  </b>\n  <c>\n\n  </c>\n  <d></d>\n</a>\n"),
    "entities and quotes": ("<a x = '\"&lt;>'>&#32;&amp;</a>", "<a x='\"&lt;>'>&#32;&amp;</a>\n"),
    "one blank before an attribute": ("<a  x='1  2'\t y='' ><b  /></a  >", "<a x='1  2' y=''>\n  <b />\n</a>\n"),
    "a tag of several lines": (
        "<a>\n<b   x='1' y='2'\n  z='3'\n     w='4' /></a>",
        "<a>\n  <b x='1' y='2'\n     z='3'\n     w='4' />\n</a>\n",
    ),
    "attributes below the name": (
        "<a\n      x='1'   y='2'\n   z='3'\n  >\n</a>",
        "<a\n  x='1'   y='2'\n  z='3'\n>\n</a>\n",
    ),
    "a triangle of numbers": (
        "<a>\n      <i xx='1'  xy='0' xz='0'\n                 yy='1' yz='0'\n                        zz='1'/>\n</a>",
        "<a>\n  <i xx='1'  xy='0' xz='0'\n             yy='1' yz='0'\n                    zz='1'/>\n</a>\n",
    ),
    "columns of neighbors": (
        "<a>\n<parent link='x'   y='1'/>\n<!-- -->\n<child  link='xyz' y='2'/>\n<child  link='z'/>\n</a>",
        "<a>\n  <parent link='x'   y='1'/>\n  <!-- -->\n  <child  link='xyz' y='2'/>\n  <child  link='z'/>\n</a>\n",
    ),
    "blanks that are no columns": (
        "<a>\n<parent link='x'/>\n<child   link='y'/>\n<mass  value='1'/>\n</a>",
        "<a>\n  <parent link='x'/>\n  <child link='y'/>\n  <mass value='1'/>\n</a>\n",
    ),
    "ends of lines are those of the file": (
        "<a>\r\n\t<b/> \r\n\r\n</a>\r\n\r\n",
        "<a>\r\n  <b/>\r\n\r\n</a>\r\n",
    ),
    "old ends of lines": ("<a>\r<b/></a>", "<a>\r  <b/>\r</a>\r"),
    "xacro is text like any other": (
        '<robot xmlns:xacro="x"><xacro:if value="${x  >  1}"><link name="${p}l"/></xacro:if></robot>',
        '<robot xmlns:xacro="x">\n  <xacro:if value="${x  >  1}">\n    <link name="${p}l"/>\n  </xacro:if>\n</robot>\n',
    ),
}

SHORTEST = {
    "<mass value='1.500'/>": "<mass value='1.5'/>",
    "<origin xyz='0.0  1e+05 -0.0' rpy='${x} 1.0 1.0'/>": "<origin xyz='0  1e+05 -0' rpy='${x} 1.0 1.0'/>",
    "<pose> 0.10 .5 1e-05 100000.0 0 00</pose>": "<pose> 0.1 .5 1e-5 100000 0 0</pose>",
    "<sdf version='1.10'/>": "<sdf version='1.10'/>",
    "<link name='1.0'/>": "<link name='1.0'/>",
    "<mass>0.10000000000000001</mass>": "<mass>0.1</mass>",
    "<mass>1.0 kg</mass>": "<mass>1.0 kg</mass>",
    "<mass>1e999</mass>": "<mass>1e999</mass>",
}


@pytest.mark.parametrize("name", CASES)
def test_a_text_is_laid_out(name: str) -> None:
    text, expected = CASES[name]
    made = format_text(SourceText(text), FormatOptions())
    assert made.text == expected
    assert format_text(made, FormatOptions()) == made


@pytest.mark.parametrize("text", SHORTEST)
def test_numbers_get_their_shortest_spelling(text: str) -> None:
    assert format_text(SourceText(text), FormatOptions(numbers="shortest")).text == SHORTEST[text] + "\n"
    assert format_text(SourceText(text), FormatOptions()).text == text + "\n"


def test_numbers_of_a_plugin_are_not_known() -> None:
    text = "<plugin>\n  <mass>1.0</mass>\n  <mass value='1.0'/>\n</plugin>\n"
    assert format_text(SourceText(text), FormatOptions(numbers="shortest")).text == text


def test_attributes_get_their_usual_order_in_the_same_places() -> None:
    text = "<joint type='fixed'\n       x='1' name='j'/>"
    made = format_text(SourceText(text), FormatOptions(sort_attributes=True))
    assert made.text == "<joint name='j'\n       type='fixed' x='1'/>\n"
    assert format_text(made, FormatOptions(sort_attributes=True)) == made


def test_tabs() -> None:
    text = "<a>\n <b x='1'\n    y='2'/></a>"
    assert format_text(SourceText(text), FormatOptions("\t")).text == "<a>\n\t<b x='1'\n\t   y='2'/>\n</a>\n"


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "latin-1"])
def test_the_encoding_stays(encoding: str) -> None:
    declared = {"utf-8-sig": "utf-8"}.get(encoding, encoding)
    text = f'<?xml version="1.0" encoding="{declared}"?><a x="ü"/>'
    made = format_text(SourceText.of(text.encode(encoding)), FormatOptions())
    assert made.data == (text.replace("?>", "?>\n") + "\n").encode(encoding)


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [("<a>\n  <ü></b>\n</a>", 2, 8), ("", 1, 1), ("<a/>\n<b/>", 2, 1), ("<a x=1/>", 1, 6), ("<!DOCTYPE a><a/>", 0, 0)],
)
def test_what_is_no_xml_is_refused_with_its_place(text: str, line: int, column: int) -> None:
    with pytest.raises(UnplacedError) as refused:
        format_text(SourceText(text), FormatOptions())
    assert (refused.value.line, refused.value.column) == (line, column)


@pytest.mark.parametrize("unit", ["<!---->", "<b/>", "<b  x='1'/>", "<b>\n1\n</b>", "<b> </b>", "<b\nx='1'/>"])
def test_hostile_repetition_takes_linear_time(unit: str) -> None:
    count = 20_000  # with quadratic time this takes minutes
    assert format_text(SourceText(f"<a>{unit * count}</a>"), FormatOptions()).text.count("<") >= count


def test_deep_elements() -> None:
    depth = 5_000
    assert format_text(SourceText("<a>" * depth + "</a>" * depth), FormatOptions("")).text.count("<") == 2 * depth
