"""Moves joints with the mouse: the joint that a part hangs from follows the point that it was taken at."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from twinform.compiler.scene import Degree, Positions, SceneJoint
from twinform.ir import Vector3
from twinform.ir.transform import Transform, across, cross, dot, minus
from twinform.view.figure import Figure

MODIFIER = "shift"
"""The key to hold: without it the mouse turns the camera."""


@dataclass(slots=True)
class Drag:
    """A joint that is moved: its axis and where the part was taken, in the frame of the scene."""

    joint: SceneJoint
    axis: Vector3
    center: Vector3
    grip: Vector3
    position: float

    def position_at(self, pointer: Vector3) -> float:
        """Where the joint is, in rad or m, with the grip as near to a point as it comes, up to half a turn away."""
        if self.joint.degrees[0].slides:
            return self.position + dot(self.axis, minus(pointer, self.grip))
        start, end = (across(self.axis, minus(each, self.center)) for each in (self.grip, pointer))
        # The angle is taken about the axis as it was when the drag began: computing it anew from
        # each message would lag behind what the browser shows, and the joint would swing.
        return self.position + math.atan2(dot(self.axis, cross(start, end)), dot(start, end))


def drag_of(figure: Figure, link: str, grip: Vector3, positions: Positions) -> Drag | None:
    """What moves when a link is taken at a point: the nearest joint above it that has one axis of its own."""
    kinematics = figure.kinematics
    while link in kinematics.hung:
        joint = kinematics.hung[link]
        if len(joint.degrees) == 1 and joint.degrees[0].leader is None:
            moved = _motion(figure, joint.parent)
            axis, center = moved.rotate(joint.degrees[0].axis), moved.apply(joint.frame.translation)
            return Drag(joint, axis, center, grip, kinematics.position(joint.name, 0, positions))
        link = joint.parent
    return None


def _motion(figure: Figure, link: str) -> Transform:
    """How a link has moved from where it is with all joints at zero."""
    pose = figure.poses.get(link)
    return pose.compose(figure.from_world(link)) if pose else Transform()


@dataclass(slots=True)
class Dragging:
    """The drags of one figure; `move` puts a joint to a position, and gives the one that it may have."""

    figure: Figure
    positions: Positions
    move: Callable[[SceneJoint, Degree, float], None]
    _drag: Drag | None = field(default=None, init=False)

    def listen(self, handle: Any, link: str) -> None:
        """Move what a link hangs from when its part is dragged."""

        # Without the key, a drag turns the camera: a robot often fills the picture, and then there
        # would be nowhere to take it.
        @handle.on_drag("left", modifier=MODIFIER)
        async def _(event: Any) -> None:  # async: else updates may come before the start
            if event.phase == "start":
                self._drag = drag_of(self.figure, link, self._in_figure(event.start_position), self.positions)
            if self._drag is not None:
                drag = self._drag
                self.move(drag.joint, drag.joint.degrees[0], drag.position_at(self._in_figure(event.end_position)))
            if event.phase == "end":
                self._drag = None

    def _in_figure(self, point: Vector3) -> Vector3:
        """A point of the page in the frame of the figure, which may stand beside another one."""
        x, y, z = (float(each) for each in self.figure.base.position)
        return minus(point, (x, y, z))
