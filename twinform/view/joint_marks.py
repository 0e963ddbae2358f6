"""Marks of joints: axes, limits, and the skeleton that they make of a robot."""

import importlib
import math
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from twinform.compiler.scene import Degree, SceneJoint
from twinform.ir import Vector3
from twinform.ir.motion import plane_across, slide, turn
from twinform.view.figure import Figure, Handle, Rgb
from twinform.view.shown_names import shortened

np: Any = importlib.import_module("numpy")

_AXIS: Rgb = (200, 0, 120)
_LIMIT: Rgb = (240, 150, 200)
_BONE: Rgb = (90, 90, 100)
_STEPS = 24
_SHARE = 0.08
"""The length of arrows and the radius of arcs, as a share of the whole robot."""


def joint_axes(figure: Figure) -> Iterator[Handle]:
    """An arrow for each axis, in the frame of the link that the joint moves."""
    length = figure.size * _SHARE
    for number, joint in enumerate(figure.scene.joints):
        into = figure.from_world(joint.child)
        start = into.apply(joint.frame.translation)
        arrows = [(start, _plus(start, into.rotate(degree.axis), length)) for degree in joint.degrees]
        if arrows:
            drawn = figure.api.add_arrows(
                f"{figure.node_name(joint.child)}/axes/{number}",
                np.asarray(arrows, dtype=np.float32),
                _AXIS,
                shaft_radius=length * 0.04,
                head_radius=length * 0.1,
                head_length=length * 0.25,
            )
            yield figure.called(drawn, *about(joint))


def about(joint: SceneJoint) -> Iterator[str]:
    """What there is to say of a joint, line by line."""
    yield f"joint {shortened(joint.name)}"
    yield f"{joint.type}, from {shortened(joint.parent)} to {shortened(joint.child)}"
    for degree in joint.degrees:
        unit = "m" if degree.slides else "rad"
        if math.isfinite(degree.lower) or math.isfinite(degree.upper):
            yield f"from {degree.lower:.4g} to {degree.upper:.4g} {unit}"
        if degree.leader:
            yield f"follows {shortened(degree.leader.joint)}"


def joint_limits(figure: Figure) -> Iterator[Handle]:
    """From the lower to the upper limit, in the frame of the link that the joint hangs from: arcs, and lines."""
    length = figure.size * _SHARE
    for number, joint in enumerate(figure.scene.joints):
        into = figure.from_world(joint.parent)
        segments = [piece for degree in joint.degrees for piece in _range(joint, degree, length)]
        if segments:
            points = np.asarray([[into.apply(a), into.apply(b)] for a, b in segments], dtype=np.float32)
            name = f"{figure.node_name(joint.parent)}/limits/{number}"
            drawn = figure.api.add_line_segments(name, points, _LIMIT, thickness=length * 0.05)
            yield figure.called(drawn, *about(joint))


def _range(joint: SceneJoint, degree: Degree, length: float) -> Iterator[tuple[Vector3, Vector3]]:
    if not (math.isfinite(degree.lower) and math.isfinite(degree.upper)) or degree.lower >= degree.upper:
        return
    center = joint.frame.translation
    if degree.slides:
        yield slide(degree.axis, degree.lower).apply(center), slide(degree.axis, degree.upper).apply(center)
        return
    start = _plus(center, plane_across(degree.axis)[0], length)
    span = min(degree.upper - degree.lower, 2 * math.pi)
    angles = [degree.lower + span * step / _STEPS for step in range(_STEPS + 1)]
    arc = [turn(degree.axis, angle, center).apply(start) for angle in angles]
    yield center, arc[0]
    yield from pairwise(arc)
    yield arc[-1], center


def skeleton(figure: Figure) -> Iterator[Handle]:
    """A line from each link's frame to those of its joints, and on to the links that these move."""
    thick = figure.size * 0.008
    for number, joint in enumerate(figure.scene.joints):
        into = figure.from_world(joint.parent)
        start = figure.kinematics.at_zero.get(joint.parent)
        points = [start.translation if start else joint.frame.translation, joint.frame.translation]
        if joint.child in figure.kinematics.at_zero and not joint.degrees:
            points.append(figure.kinematics.at_zero[joint.child].translation)
        lines = np.asarray([[into.apply(a), into.apply(b)] for a, b in pairwise(points)])
        name = f"{figure.node_name(joint.parent)}/bones/{number}"
        bone = figure.api.add_line_segments(name, lines.astype(np.float32), _BONE, thickness=thick)
        yield figure.called(bone, shortened(joint.parent))
        ball = f"{figure.node_name(joint.child)}/knuckles/{number}"
        at = figure.from_world(joint.child).apply(joint.frame.translation)
        knuckle = figure.api.add_icosphere(ball, thick * 1.6, color=_AXIS if joint.degrees else _BONE, position=at)
        yield figure.called(knuckle, *about(joint))


def _plus(start: Vector3, direction: Vector3, length: float) -> Vector3:
    return tuple(a + b * length for a, b in zip(start, direction, strict=True))  # type: ignore[return-value]
