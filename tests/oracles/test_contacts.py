"""What stands for a shape touches what the shape touches, in DART and in Drake."""

from pathlib import Path

import pytest

from reports.same_robot.contacts import Difference, differences
from reports.same_robot.touched_shapes import KINDS
from testbed.engines.gazebo import MISSING
from testbed.engines.gazebo.contacts import can_touch
from twinform.testing import oracles

_BALLS = 20


@pytest.mark.skipif(not can_touch(), reason=MISSING)
def test_dart_feels_the_shape_in_its_urdf(tmp_path: Path) -> None:
    assert_as_said([*differences(_BALLS, 2, tmp_path, ["DART"])])


@pytest.mark.skipif(not oracles.available("drake"), reason="Drake is not installed")
def test_drake_feels_the_shape_in_its_urdf(tmp_path: Path) -> None:
    assert_as_said([*differences(_BALLS, 3, tmp_path, ["Drake"])])


def assert_as_said(found: list[Difference]) -> None:
    assert [each for each in found if not each.fits] == []
    assert [each.kind for each in found] == [kind for kind in KINDS for _ in range(_BALLS)]
    meshes = [each for each in found if each.error]
    assert max(each.missing / each.error for each in meshes) > 0.2  # they are no copies of the shapes
