"""The frames that robot_state_publisher publishes of a URDF, beside those of our frame graph."""

import math
from collections.abc import Iterator
from pathlib import Path

import twinform
from testbed.ros2 import robot_state_publisher as publisher
from twinform.ir import Format, Joint, Model, Pose
from twinform.ir.defaults import direction, multiplier
from twinform.ir.frames import FrameGraph
from twinform.ir.transform import Transform

_FIXED = {"fixed", "planar"}
_UNPUBLISHED = "floating"
_NEAR = 1e-9


def differences(urdf: Path, home: Path) -> Iterator[str]:
    """How the frames differ, with the joints within their limits; frames on floating joints are published by nobody."""
    model = twinform.load(urdf).models[0]
    positions = _positions(model)
    joints = [joint for joint in model.joints if joint.type != _UNPUBLISHED]
    found = publisher.frames(urdf.read_text(encoding="utf-8"), positions, len(joints), home)
    graph = FrameGraph(model)
    for name in found.keys() - {joint.child for joint in joints}:
        yield f"there is a frame {name!r}"
    for joint in joints:
        frame = found.get(joint.child or "")
        if frame is None:
            yield f"there is no frame {joint.child!r}"
        elif frame[0] != joint.parent:
            yield f"{joint.child!r} is in {frame[0]!r}"
        elif _distance(frame, _placed(graph, joint, positions.get(joint.name, 0.0))) > _NEAR:
            yield f"{joint.child!r} is somewhere else"


def _distance(frame: publisher.Frame, expected: Transform) -> float:
    """How far two frames are apart: the larger of the distance in m and of the cosine between their turns, less 1."""
    _, at, (w, *xyz) = frame
    cosine = abs(sum(a * b for a, b in zip((*xyz, w), expected.quaternion(), strict=True)))
    return max(math.dist(at, expected.translation), abs(1 - cosine))


def _positions(model: Model) -> dict[str, float]:
    """A position for each joint that moves, within its limits; those that mimic follow."""
    found: dict[str, float] = {}
    for number, joint in enumerate(model.joints):
        if joint.type not in {*_FIXED, _UNPUBLISHED}:
            limit = joint.axis.limit if joint.axis else None
            lower, upper = (limit.lower or 0.0, limit.upper or 0.0) if limit else (-1.0, 1.0)
            found[joint.name] = lower + (upper - lower) * (0.3 + 0.05 * number)
    for joint in model.joints:
        mimic = joint.axis.mimic if joint.axis else None
        if mimic and mimic.joint and joint.name in found:
            found[joint.name] = multiplier(mimic) * found[mimic.joint] + (mimic.offset or 0.0)
    return found


def _placed(graph: FrameGraph, joint: Joint, position: float) -> Transform:
    """Where the child of a joint is in its parent, with the joint at a position."""
    assert joint.parent
    assert joint.child
    rest = graph.pose(joint.child, joint.parent)
    if not position:
        return rest
    axis = direction(joint.axis, Format.URDF)
    length = math.hypot(*axis)
    x, y, z = (each / length for each in axis)
    if joint.type == "prismatic":
        return rest.compose(Transform((x * position, y * position, z * position)))
    s = math.sin(position / 2)
    turned = Pose(quat_xyzw=(s * x, s * y, s * z, math.cos(position / 2)))
    return rest.compose(Transform.from_pose(turned))
