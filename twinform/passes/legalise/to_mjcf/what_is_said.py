"""Tells which fields of a node a file of MJCF says: by its class, and by what was written for this node."""

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

from twinform.ir import (
    Axis,
    Collision,
    Dynamics,
    Frame,
    Joint,
    Light,
    Limit,
    Link,
    Mimic,
    Node,
    Sensor,
    Surface,
    Visual,
    World,
)
from twinform.ir.defaults import UNLIMITED
from twinform.ir.frames import WORLD
from twinform.passes.carriers.annotations import is_synthesized
from twinform.passes.carriers.joint_chains import TWO_AXES
from twinform.passes.carriers.partial_nodes import EXISTENCE, Left
from twinform.passes.carriers.said_by_mjcf import said_by_mjcf, said_of_limit
from twinform.passes.legalise.to_mjcf.friction import USUAL_SLIDING
from twinform.passes.legalise.to_mjcf.mimics import coupled_joints
from twinform.passes.legalise.to_mjcf.written_file import WrittenFile
from twinform.passes.sdf_versions import sdf_version_read
from twinform.schemas import Version, parse_version

_USUAL_FRICTION: Version = (1, 4)
"""Since this version of SDF a surface without a coefficient of friction has that which MJCF gives it too."""
Fields = frozenset[str] | None
"""The fields that are said; None where nothing is said of a node, not even that it is there."""
_DIRECTED = frozenset({"revolute", "continuous", "prismatic", "universal", "revolute2", "screw"})
"""The types of joints whose axes MJCF says."""
_THERE = frozenset({EXISTENCE})
_PLACED = _THERE | {"pose"}
"""What the readings that a sensor keeps say of it, by the site that they are at."""
_OF_WORLD = _THERE | {"models", "joints", "frames"}
"""What is flattened, or has texts of its own."""


class WhatIsSaid:
    """What one file says of the nodes of a flattened model."""

    def __init__(self, file: WrittenFile) -> None:
        self.file = file
        self._left = file.context.left
        self._by_class: Mapping[type[Node], Callable[[Any], Fields]] = {
            Light: lambda _: _THERE,
            World: lambda _: _OF_WORLD,
            Axis: self._of_axis,
            Limit: self._of_axis,
            Dynamics: self._of_axis,
            Mimic: self._of_axis,
            Joint: self._of_joint,
            Sensor: lambda sensor: _PLACED if id(sensor.source) in file.context.kept_sensors else None,
            Link: lambda link: said_by_mjcf(link) if link.name in file.context.written_bodies else None,
            Frame: lambda frame: said_by_mjcf(frame) if file.has_site(frame) else None,
            Surface: self._of_surface,
            Visual: self._of_shape,
            Collision: self._of_shape,
        }

    def fields(self, node: Node) -> Fields | Left:
        """The fields of a node that the file says, and what its writer left of it."""
        left = self.left_of(node) if self._left and not isinstance(node, World) else None
        if left is None:
            of_class = self._by_class.get(node.__class__, said_by_mjcf)
            return of_class(node)
        if isinstance(left, Sensor):
            return Left(self._in_its_link(node) if isinstance(node, Sensor) else node, _THERE)
        if left == node:
            return None
        return Left(left, said_by_mjcf(left) or frozenset())

    def _in_its_link(self, sensor: Sensor) -> Sensor:
        """A sensor of a file of SDF, posed in its link as its site is: joints and frames may be moved in the file."""
        part, graph, pose = self.file.part, self.file.graph, sensor.pose
        if self.file.context.is_of_mjcf or not isinstance(part, Link | Joint):
            return sensor
        if isinstance(part, Link):
            is_posed = pose is not None and pose.relative_to
            return sensor.copy(pose=graph.resolve(pose, part.name, part.name).to_pose()) if is_posed else sensor
        if part.child is None or not graph.knows(part.child):
            return sensor
        return sensor.copy(pose=graph.resolve(pose, part.name, part.child, kind="joint").to_pose(part.child))

    def left_of(self, node: Node) -> Node | None:
        """What the writer of a node has left of it; flattening makes other objects of some nodes."""
        found = self._left.get(id(node))
        if found is None and node.source is not None:
            return self._left_by_source.get((type(node), id(node.source)))
        return found[1] if found else None

    @cached_property
    def _left_by_source(self) -> dict[tuple[type[Node], int], Node]:
        return {(type(node), id(node.source)): left for node, left in self._left.values() if node.source}

    def _of_shape(self, shape: Visual | Collision) -> Fields:
        return None if self.file.geom_name(shape) is None else said_by_mjcf(shape)

    def _of_surface(self, surface: Surface) -> Fields:
        """The fields that are said of a surface: no usual friction of MJCF where the source has another usual one."""
        said = said_by_mjcf(surface) or frozenset()
        version = parse_version(sdf_version_read(self.file.context.version_read))
        return said - {"mu"} if surface.mu == USUAL_SLIDING and version < _USUAL_FRICTION else said

    def _of_axis(self, node: Axis | Limit | Dynamics | Mimic) -> Fields:
        """The fields that are said of an axis, or of a group of values in one."""
        joint = self.file.part
        if not isinstance(joint, Joint):
            return said_by_mjcf(node)
        if _is_of_no_axis(node, joint):
            return None
        # A loop is held at points, which do not say how it turns there.
        if joint.name in self.file.closing:
            return None
        if isinstance(node, Mimic) and not self._is_equality(node, joint):
            return None
        if isinstance(node, Limit):
            said = said_of_limit(node, joint)
            return said - _without_end(node) if self.file.was_urdf else said
        if isinstance(node, Axis) and joint.type not in _DIRECTED:
            return None if joint.type == "fixed" else frozenset()
        return said_by_mjcf(node)

    def _is_equality(self, mimic: Mimic, joint: Joint) -> bool:
        number = int(joint.axis is None or joint.axis.mimic != mimic)
        return coupled_joints(self.file.context, joint.name, number, mimic.joint or "", mimic.axis) is not None

    def _of_joint(self, joint: Joint) -> Fields:
        if joint.name in self.file.closing:
            return _THERE
        is_bare = joint.type == "fixed" and self.file.is_back  # where a fixed joint itself is means nothing in URDF
        if is_bare or joint.child in self.file.hidden:
            return frozenset({"name", "parent", "pose"})
        return said_by_mjcf(joint) if joint.name in self.file.context.written_joints or _only_holds(joint) else None


def _without_end(limit: Limit) -> frozenset[str]:
    """The ends of a range that are infinite: URDF writes both, and MJCF neither."""
    return frozenset(name for name in ("lower", "upper") if abs(getattr(limit, name) or 0.0) >= UNLIMITED)


def _is_of_no_axis(node: Axis | Limit | Dynamics | Mimic, joint: Joint) -> bool:
    """Whether a node is the second axis of a joint that has one axis, or is in that: nothing is written for it."""
    axis = joint.axis2
    if axis is None or joint.type in TWO_AXES:
        return False
    return any(each is node for each in (axis, axis.limit, axis.dynamics, axis.mimic))


def _only_holds(joint: Joint) -> bool:
    """Whether a joint was made for a static model alone, whose bodies have none."""
    return joint.type == "fixed" and joint.parent == WORLD and is_synthesized(joint)
