"""The directions in the plane of a planar joint."""

import pytest

from twinform.ir.motion import plane_across
from twinform.ir.node import Vector3


@pytest.mark.parametrize(
    ("normal", "first", "second"),
    [
        # of Drake and MuJoCo, who read a URDF with this axis
        ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
        ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)),
        ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, -1.0)),
        ((0.0, 3.0, 4.0), (1.0, 0.0, 0.0), (0.0, 0.8, -0.6)),
        ((0.6, 0.0, 0.8), (0.8, 0.0, -0.6), (0.0, 1.0, 0.0)),
        ((0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0)),
    ],
)
def test_the_directions_in_a_plane_are_x_and_y_after_the_shortest_turn(
    normal: Vector3, first: Vector3, second: Vector3
) -> None:
    found = plane_across(normal)
    assert found[0] == pytest.approx(first)
    assert found[1] == pytest.approx(second)
