"""Chains of URDF joints that represent one multi-axis SDF joint, and their annotations.

The last joint of a chain keeps the name and the child of the one that it stands for and names its type; the joints
above it, and the links between, name the joint whose parts they are:

    <joint name="neck_axis" type="revolute"><tf:part joint="neck"/>
    <link name="neck_axis_link"><tf:part joint="neck"/></link>
    <joint name="neck" type="revolute"><tf:chain type="universal"/>
"""

import math
from collections.abc import Iterable

from twinform.ir import Joint, JointType, Link, Opaque
from twinform.ir.defaults import SCREW_THREAD_PITCH
from twinform.ir.node import Vector3
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.carriers.carriers import NAMESPACE, is_ours

CHAIN = "chain"
"""The annotation on the last joint, with the type of the joint that the chain stands for."""
PART = "part"
"""The annotation on the other joints and on the links, with the name of the last joint."""

CHAINS: dict[JointType, tuple[str, ...]] = {
    "universal": ("axis",),
    "revolute2": ("axis",),
    "ball": ("z", "y"),
    "screw": ("slide",),
}
"""The suffixes of the other joints' names in a chain, in order from the parent."""

BALL_AXES: tuple[Vector3, ...] = ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
"""The axes of the joints of a ball: Rz Ry Rx is the orientation that URDF writes as yaw, pitch and roll."""

PITCHES: tuple[str, ...] = ("screw_thread_pitch", "thread_pitch")
"""The fields and elements that give the pitch of a screw joint."""

TWO_AXES: frozenset[JointType] = frozenset({"universal", "revolute2"})


def chain_type(joint: Joint) -> str | None:
    """The type of the joint that a chain stands for, if this is its last joint."""
    found = find_annotation(joint, CHAIN)
    return found.get("type") if found else None


def part_of(node: Joint | Link) -> str | None:
    """The name of the last joint of the chain, if the node is another part of it."""
    found = find_annotation(node, PART)
    return found.get("joint") if found else None


def metres_per_radian(joint: Joint) -> float | None:
    """The distance in m that a screw joint moves along its axis per radian; None for a pitch of 0 rad/m.

    `screw_thread_pitch` is in m per turn and wins; `thread_pitch` is in rad/m with the sign of a left-handed thread.
    Without either, SDF's default is 1 m per turn: the SDF description of <joint>.
    """
    if joint.screw_thread_pitch is None and joint.thread_pitch is not None:
        return -1.0 / joint.thread_pitch if joint.thread_pitch else None
    pitch = SCREW_THREAD_PITCH if joint.screw_thread_pitch is None else joint.screw_thread_pitch
    return pitch / math.tau


Parts = tuple[Opaque, ...]

_FIRST, _SECOND = (f"{{{NAMESPACE}}}{field}" for field in ("axis", "axis2"))
"""The annotations on the notation of the two axes."""


def split_axes(parts: Iterable[Opaque]) -> tuple[Parts, Parts]:
    """Split the opaque parts of a two-axis joint: those of `axis`, and the rest with `axis2` called `axis`."""
    first: list[Opaque] = []
    rest: list[Opaque] = []
    for part in parts:
        if is_of_axis(_path(part)) or _is_called(part, _FIRST):
            first.append(part)
        else:
            rest.append(_with_name(_with_path(part, _moved(_path(part), "axis2", "axis")), _SECOND, _FIRST))
    return tuple(first), tuple(rest)


def join_axes(first: Iterable[Opaque], rest: Iterable[Opaque]) -> Parts:
    """The opaque parts of a two-axis joint, joined again: the inverse of `split_axes`."""
    joined = [part for part in first if is_of_axis(_path(part)) or _is_called(part, _FIRST)]
    joined += (_with_name(_with_path(part, _moved(_path(part), "axis", "axis2")), _FIRST, _SECOND) for part in rest)
    return tuple(joined)


def is_of_axis(path: str) -> bool:
    """Whether a path leads to the axis or into it."""
    return path == "axis" or path.startswith("axis/")


def _moved(path: str, step: str, to: str) -> str:
    """The path with its first step `step` replaced by `to`; other paths stay."""
    return to + path.removeprefix(step) if path == step or path.startswith(f"{step}/") else path


def _path(part: Opaque) -> str:
    """The path of a part, or of the piece in a carrier."""
    if is_ours(part) and part.element:
        return part.element.get("at") or ""
    return part.at


def _with_path(part: Opaque, path: str) -> Opaque:
    if path == _path(part):
        return part
    if not (is_ours(part) and part.element):
        return part.copy(at=path)
    attributes = tuple((name, path if name == "at" else value) for name, value in part.element.attributes)
    return part.copy(element=part.element.copy(attributes=attributes))


def _is_called(part: Opaque, name: str) -> bool:
    return part.element is not None and part.element.name == name


def _with_name(part: Opaque, name: str, to: str) -> Opaque:
    """The part renamed, if it is an element called `name`."""
    if part.element is None or part.element.name != name:
        return part
    return part.copy(element=part.element.copy(name=to))
