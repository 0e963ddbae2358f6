"""robot_state_publisher publishes the frames of a package's URDF, and they are those of our frame graph."""

from pathlib import Path

import pytest

from testbed.ros2 import robot_state_publisher as publisher
from testbed.ros2.frames import differences
from testbed.ros2.packages import make


@pytest.mark.skipif(not publisher.available(), reason=publisher.MISSING)
def test_the_frames_of_ros_are_those_of_the_frame_graph(tmp_path: Path):
    urdf = make("arm_description", tmp_path).folder / "urdf/arm_description.urdf"
    assert list(differences(urdf, tmp_path)) == []
