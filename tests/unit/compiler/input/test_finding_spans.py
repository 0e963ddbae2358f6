"""The piece of a text that a finding is about."""

import pytest

from twinform.compiler.input.finding_spans import FindingSpans
from twinform.diagnostics import Location

ROBOT = """<?xml version="1.0"?>
<robot name="r">
  <!-- ü --> <link name="a"/>
  <joint name="j"
         type='hinge'>
    <parent link="a"/><child link="b"/>
  </joint>
</robot>
"""

# libxml2 gives an element the line on which its start tag ends
CASES = [
    (2, "/robot", '<robot name="r">', (2, 1)),
    (3, "/robot/link[@name='a']", '<link name="a"/>', (3, 14)),
    (5, "/robot/joint[@name='j']/@type", "type='hinge'", (5, 10)),
    (6, "/robot/joint[@name='j']/child/@link", 'link="b"', (6, 30)),
    (6, "/robot/joint[@name='j']/child/@other", '<child link="b"/>', (6, 23)),
    (5, "/robot/joint[1]", "<joint name=\"j\"\n         type='hinge'>", (4, 3)),
]


@pytest.mark.parametrize(("line", "path", "piece", "place"), CASES)
def test_the_piece_that_is_meant(line: int, path: str, piece: str, place: tuple[int, int]) -> None:
    found = FindingSpans.of(ROBOT.encode())
    assert found is not None
    span = found.span(Location("r.urdf", line, path))
    assert span is not None
    assert (span.of(found.text), found.lines.place(span.start)) == (piece, place)


@pytest.mark.parametrize("path", ["/robot/link[@name='z']", "/sdf", "/", "somewhere"])
def test_what_leads_nowhere_has_no_piece(path: str) -> None:
    found = FindingSpans.of(ROBOT.encode())
    assert found is not None
    assert found.span(Location("r.urdf", 1, path)) is None


@pytest.mark.parametrize("data", [b"", b"<robot>", b"<!DOCTYPE robot []><robot/>", b"<robot name='\xfc'/>"])
def test_a_text_that_is_not_well_formed_has_none(data: bytes) -> None:
    assert FindingSpans.of(data) is None
