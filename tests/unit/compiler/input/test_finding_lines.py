"""Findings stand at the line of the part, not at that of the node around it."""

import pytest
from lxml import etree

from twinform.compiler.input.finding_lines import PartFinder, line_of_text, with_exact_lines
from twinform.diagnostics import Diagnostic, Location
from twinform.diagnostics.rules import DANGLING_LINK

TREE = etree.fromstring(
    b"""<robot name="r">
<joint name="j">
<parent link="a"/>
<child
  link="b"/></joint>
<joint name="twice"><x/>
<x/></joint>
<joint name="twice">
<x/></joint>
<joint name="it's / [odd]">
<axis/></joint></robot>"""
)


@pytest.mark.parametrize(
    ("line", "path", "exact"),
    [
        (2, "/robot[@name='r']/joint[@name='j']/parent", 3),
        (2, "/robot[@name='r']/joint[@name='j']/parent/@link", 3),
        (2, "/robot/joint[1]/parent", 3),
        (2, "/robot[@name='r']/joint[@name='j']/nothing", 2),
        (9, "/robot[@name='r']/joint[@name='j']/parent", 9),  # beside the line
        (6, "/robot[@name='r']/joint[@name='twice']/x[2]", 7),
        (6, "/robot[@name='r']/joint[@name='twice']/x", 6),  # which?
        (8, "/robot[@name='r']/joint[@name='twice']/x", 9),
        (10, "/robot[@name='r']/joint[@name='it's / [odd]']/axis", 11),
        (1, "/sdf/model", 1),
        (1, "no path", 1),
        (1, "", 1),
    ],
)
def test_a_path_leads_to_a_line_or_leaves_it(line: int, path: str, exact: int) -> None:
    found = Diagnostic(DANGLING_LINK, "m", Location("f", line, path), DANGLING_LINK.severity)
    (placed,) = with_exact_lines([found], TREE, "f")
    assert placed.location == Location("f", exact, path)
    assert list(with_exact_lines([found], TREE, "another")) == [found]


def test_the_line_of_a_text_in_a_part() -> None:
    where = Location("f", 2, "/robot[@name='r']/joint[@name='j']")
    assert line_of_text(PartFinder(TREE), where, "a") == 3
    assert line_of_text(PartFinder(TREE), where, "nowhere") == 0
    assert line_of_text(PartFinder(TREE), Location("f", 2, "/sdf"), "a") == 0
