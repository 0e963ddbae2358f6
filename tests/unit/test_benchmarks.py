"""The robots that are timed."""

from pathlib import Path

import pytest

import twinform
from testbed import robots
from testbed.oracles import urdfdom


@pytest.mark.parametrize("links", [1, 2, 40])
def test_generated_robots_are_without_a_fault(links: int, tmp_path: Path):
    path = tmp_path / "robot.urdf"
    path.write_text(robots.urdf(links))
    checked = twinform.check(path)
    assert checked.diagnostics == ()
    assert checked.document is not None
    assert len(checked.document.models[0].links) == links
    assert not urdfdom.available() or urdfdom.complaints(path) == ()


def test_generated_robots_have_the_elements_that_the_page_mentions():
    elements = [robots.urdf(links).count("<") - robots.urdf(links).count("</") for links in (100, 101)]
    assert elements[1] - elements[0] == robots.ELEMENTS_PER_LINK
