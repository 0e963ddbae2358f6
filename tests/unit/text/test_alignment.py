"""Elements with a new name keep what is in them: comments, layout and the spelling of numbers."""

import pytest
from lxml import etree

from tests.tree_changes import PARSER
from twinform.text import SourceText, merge, patch

TEXT = """<sensor>
  <ray> <!-- as in the data sheet -->
    <range><min>0.10</min></range>
    <noise>
      <!-- measured -->
      <mean>0.0</mean>
    </noise>
  </ray>
  <plugin/>
</sensor>
"""


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("ray>", "lidar>"),
        ("<min>0.10</min>", "<least>0.10</least>"),
        ("<plugin/>", "<system/>"),
    ],
)
def test_a_renamed_element_is_renamed_in_the_text(old: str, new: str) -> None:
    before, after = (etree.fromstring(text.encode(), PARSER) for text in (TEXT, TEXT.replace(old, new)))
    made = patch(SourceText.of(TEXT.encode()), before, after).text
    assert made == TEXT.replace(old, new)


def test_what_is_merged_keeps_how_it_was_spelled() -> None:
    own, before = (etree.fromstring(text.encode(), PARSER) for text in (TEXT, TEXT.replace("0.10", "0.1")))
    after = etree.fromstring(TEXT.replace("ray>", "lidar>").replace("0.10", "0.1").encode(), PARSER)
    merged = merge(before, after, own, same=True)
    assert merged.conflicts == ()
    assert patch(SourceText.of(TEXT.encode()), own, merged.tree).text == TEXT.replace("ray>", "lidar>")


def test_another_element_in_its_place_is_another_element() -> None:
    other = TEXT.replace("<plugin/>", "<plugin><a>1</a><b>2</b></plugin>")
    new = TEXT.replace("<plugin/>", "<system><c>3</c><d>4</d></system>")
    before, after = (etree.fromstring(text.encode(), PARSER) for text in (other, new))
    made = patch(SourceText.of(other.encode()), before, after).text
    assert "<plugin>" not in made
    assert "<c>3</c>" in made
