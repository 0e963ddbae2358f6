"""Where elements, attributes and texts stand in a text."""

import pytest
from lxml import etree

from twinform.text import LineColumn, Lines, UnplacedError, spans

ROBOT = """<?xml version="1.0"?>
<robot name="ü">  <!-- ☃ -->
  <link
      name = 'a>b'   />
  <x:y xmlns:x="urn:x">  text &amp; <![CDATA[<more>]]> <!-- a --> rest </x:y>
</robot>
"""


def test_elements_are_where_they_stand() -> None:
    root = spans(ROBOT)
    link, other = root.children
    assert link.whole.of(ROBOT) == "<link\n      name = 'a>b'   />"
    assert (link.content, link.end_tag) == (None, None)
    assert other.start_tag.of(ROBOT) == '<x:y xmlns:x="urn:x">'
    assert other.end_tag is not None
    assert other.end_tag.of(ROBOT) == "</x:y>"
    assert [each.name.of(ROBOT) for each in root.walk()] == ["robot", "link", "x:y"]


def test_attributes_are_where_they_stand() -> None:
    root = spans(ROBOT)
    (name,) = root.children[0].own_attributes
    assert (name.whole.of(ROBOT), name.value.of(ROBOT)) == ("name = 'a>b'", "a>b")
    assert root.children[1].own_attributes == []
    assert root.children[1].attributes["xmlns:x"].value.of(ROBOT) == "urn:x"


def test_texts_are_between_children_and_comments() -> None:
    root = spans(ROBOT)
    assert [run.of(ROBOT) for run in root.children[1].texts()] == ["  text &amp; <![CDATA[<more>]]> ", " rest "]
    assert [aside.of(ROBOT) for aside in root.asides] == ["<!-- ☃ -->"]


def test_places_count_from_one() -> None:
    lines = Lines(ROBOT)
    assert lines.place(ROBOT.index("name = ")) == LineColumn(4, 7)
    assert lines.place(0) == LineColumn(1, 1)
    assert [Lines("a\r\nb\rc\nd").place(offset).line for offset in (0, 3, 5, 7)] == [1, 2, 3, 4]


@pytest.mark.parametrize(
    "text", ["", "<a>", "<a><b></a>", "<a b=1/>", "<!DOCTYPE a []><a/>", "<a/><b/>", "<a>\x00</a>"]
)
def test_what_is_not_well_formed_has_no_places(text: str) -> None:
    with pytest.raises(UnplacedError):
        spans(text)


def test_lines_are_those_of_libxml2() -> None:
    lines = Lines(ROBOT)
    starts = [lines.place(each.whole.start).line for each in spans(ROBOT).walk()]
    assert starts == [2, 3, 5]
    assert etree.fromstring(ROBOT.encode()).sourceline == starts[0]
