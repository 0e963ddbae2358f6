"""robot_state_publisher publishes the frames of a package's URDF, and they are those of our frame graph."""

import math
from pathlib import Path

import pytest

import twinform
from tests.ros2 import robot_state_publisher as publisher
from tests.ros2.packages import make
from twinform.ir import Format, Joint, Model, Pose
from twinform.ir.defaults import direction, multiplier
from twinform.ir.frames import FrameGraph
from twinform.ir.transform import Transform

_FIXED = {"fixed", "floating", "planar"}


@pytest.mark.skipif(not publisher.available(), reason=publisher.MISSING)
def test_the_frames_of_ros_are_those_of_the_frame_graph(tmp_path: Path):
    urdf = make("arm_description", tmp_path).folder / "urdf/arm_description.urdf"
    model = twinform.load(urdf).models[0]
    positions = _positions(model)
    found = publisher.frames(urdf.read_text(encoding="utf-8"), positions, len(model.joints), tmp_path)
    assert {name: above for name, (above, _, _) in found.items()} == {each.child: each.parent for each in model.joints}
    graph = FrameGraph(model)
    for joint in model.joints:
        assert joint.child
        _, at, turned = found[joint.child]
        expected = _placed(graph, joint, positions.get(joint.name, 0.0))
        assert at == pytest.approx(expected.translation, abs=1e-9)
        w, *xyz = turned
        same = abs(sum(a * b for a, b in zip((*xyz, w), expected.quaternion(), strict=True)))
        assert same == pytest.approx(1.0, abs=1e-9)


def _positions(model: Model) -> dict[str, float]:
    """A position for each joint that moves, within its limits; those that mimic follow."""
    found: dict[str, float] = {}
    for number, joint in enumerate(model.joints):
        if joint.type not in _FIXED:
            limit = joint.axis.limit if joint.axis else None
            lower, upper = (limit.lower or 0.0, limit.upper or 0.0) if limit else (-1.0, 1.0)
            found[joint.name] = lower + (upper - lower) * (0.3 + 0.05 * number)
    for joint in model.joints:
        mimic = joint.axis.mimic if joint.axis else None
        if mimic and mimic.joint:
            found[joint.name] = multiplier(mimic) * found[mimic.joint] + (mimic.offset or 0.0)
    return found


def _placed(graph: FrameGraph, joint: Joint, position: float) -> Transform:
    """Where the child of a joint is in its parent, with the joint at a position."""
    assert joint.parent
    assert joint.child
    rest = graph.pose(joint.child, joint.parent)
    axis = direction(joint.axis, Format.URDF)
    length = math.hypot(*axis)
    x, y, z = (each / length for each in axis)
    if joint.type == "prismatic":
        return rest.compose(Transform((x * position, y * position, z * position)))
    s = math.sin(position / 2)
    turned = Pose(quat_xyzw=(s * x, s * y, s * z, math.cos(position / 2)))
    return rest.compose(Transform.from_pose(turned))
