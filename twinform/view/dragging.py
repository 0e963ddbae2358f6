"""Moves joints with the mouse: the joint above a part follows the point at which the part was grabbed."""

import math
from collections.abc import Callable
from dataclasses import field
from typing import Any

from twinform.compiler.kinematics import Degree, Positions
from twinform.compiler.scene import SceneJoint
from twinform.dataclass import dataclass
from twinform.ir import Vector3
from twinform.ir.transform import Transform, across, cross, dot, minus
from twinform.view.figure import Figure

MODIFIER = "shift"
"""The key to hold: without it the mouse turns the camera."""


@dataclass(slots=True)
class Drag:
    """A joint that is being moved: its axis, and the point where the part was grabbed, in the frame of the scene."""

    joint: SceneJoint
    axis: Vector3
    center: Vector3
    grip: Vector3
    position: float

    def position_at(self, pointer: Vector3) -> float:
        """Return the position in rad or m that brings the grip nearest to a point, at most half a turn away."""
        if self.joint.degrees[0].slides:
            return self.position + dot(self.axis, minus(pointer, self.grip))
        start, end = (across(self.axis, minus(each, self.center)) for each in (self.grip, pointer))
        # The angle is taken about the axis as it was when the drag began: computing it anew from
        # each message would lag behind what the browser shows, and the joint would swing.
        return self.position + math.atan2(dot(self.axis, cross(start, end)), dot(start, end))


def drag_of(figure: Figure, link: str, grip: Vector3, positions: Positions) -> Drag | None:
    """Return a drag of the nearest joint above a link that has one axis of its own; None if there is none."""
    kinematics = figure.kinematics
    while link in kinematics.hung:
        joint = kinematics.hung[link]
        if len(joint.degrees) == 1 and joint.degrees[0].leader is None:
            moved = _find_motion(figure, joint.parent)
            axis, center = moved.rotate(joint.degrees[0].axis), moved.apply(joint.frame.translation)
            return Drag(joint, axis, center, grip, kinematics.position(joint.name, 0, positions))
        link = joint.parent
    return None


def _find_motion(figure: Figure, link: str) -> Transform:
    """Return how a link has moved from its frame with all joints at zero."""
    pose = figure.poses.get(link)
    return pose.compose(figure.from_world(link)) if pose else Transform()


@dataclass(slots=True)
class Dragging:
    """The drags of one figure; `move` moves a joint to a position, within its limits."""

    figure: Figure
    positions: Positions
    move: Callable[[SceneJoint, Degree, float], None]
    _drag: Drag | None = field(default=None, init=False)

    def listen(self, handle: Any, link: str) -> None:
        """Move the joint above a link when a part of the link is dragged."""

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
        """Return a point of the page in the frame of the figure, which may stand beside another one."""
        x, y, z = (float(each) for each in self.figure.base.position)
        return minus(point, (x, y, z))
