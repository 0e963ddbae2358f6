"""The passes as a whole."""

from pathlib import Path

import pytest
from lxml import etree

from testbed.oracles import urdfdom
from twinform.passes.legalise.to_urdf.sequence import to_urdf

from .models import EVERYTHING, LINK, arm, convert


def test_the_pipeline_has_every_pass_once() -> None:
    names = [each.name for each in to_urdf()]
    assert len(set(names)) == len(names)


@pytest.mark.skipif(not urdfdom.available(), reason=urdfdom.MISSING)
@pytest.mark.parametrize("text", [LINK, EVERYTHING, arm("prismatic"), LINK + "<link name='b'/>"])
def test_urdfdom_reads_what_is_written(text: str, tmp_path: Path) -> None:
    file = tmp_path / "robot.urdf"
    file.write_bytes(etree.tostring(convert(text)))
    assert urdfdom.complaints(file) == ()
