"""Rerooting of URDF robots: no link moves, and none loses its name."""

import math
from typing import NamedTuple

from twinform.ir import Format, Joint, Link, Model, Pose
from twinform.ir.defaults import direction
from twinform.ir.frames import FrameGraph
from twinform.ir.transform import Transform
from twinform.passes.structure.gazebo_blocks import blocks
from twinform.passes.structure.reversal import ABOUT_A_POINT, TURNING, opposite, swapped_block, with_axis
from twinform.passes.transforms.pose_notation import in_radians

# Meters by which a link's origin may be beside an axis that goes through it: the rounding of zero.
_ON_AXIS = 1e-12


class _Reversed(NamedTuple):
    """What a joint becomes: with a link beside the axis comes a link on it, and a joint that holds the other one."""

    joint: Joint
    helper: Link | None = None
    holder: Joint | None = None


def reroot_urdf(model: Model, root: str, way: list[Joint]) -> Model:
    """The model with another root; `way` has the joints from it up to the old one."""
    graph = FrameGraph(model)
    made = {joint.name: _reversed(joint, graph.pose(joint.name, joint.parent or "", kind="joint")) for joint in way}
    joints: list[Joint] = []
    for joint in model.joints:
        new = made.get(joint.name)
        joints += [joint] if new is None else [each for each in (new.joint, new.holder) if each is not None]
    carriers = {joint.child: joint.name for joint in joints}
    links = [_posed(link, carriers.get(link.name), root) for link in model.links]
    links += [new.helper for new in made.values() if new.helper is not None]
    names = {joint.name for joint in way}
    extensions = tuple(swapped_block(each) if each.reference in names else each for each in model.extensions)
    changed = model.copy(links=tuple(links), joints=tuple(joints), extensions=extensions)
    return _without_helpers(changed)


def _posed(link: Link, carrier: str | None, root: str) -> Link:
    if link.name == root:
        return link.copy(pose=None)
    if link.pose is not None and link.pose.relative_to == carrier:
        return link
    return link.copy(pose=Pose(relative_to=carrier))


def _reversed(joint: Joint, at: Transform) -> _Reversed:
    """The joint between the same two links, the other way round; `at` is its frame in its old parent."""
    parent, child = joint.parent, joint.child
    axis = direction(joint.axis, Format.URDF)
    back = in_radians(at.inverse(), child)
    if not _is_beside(joint, at):
        update = {"parent": child, "child": parent, "pose": back, "axis": with_axis(joint, opposite(at.rotate(axis)))}
        return _Reversed(joint.copy(**update))
    # In URDF a link's frame is that of its joint, and on the other side of a turning joint that may
    # lie beside the axis. The frame could be moved and the contents with it, but a frame is what
    # other programs know of a link.
    name = helper_name(joint.name)
    update = {"parent": child, "child": name, "pose": Pose(relative_to=child), "axis": with_axis(joint, opposite(axis))}
    turned = joint.copy(**update)
    helper = Link(name=name, pose=Pose(relative_to=joint.name), source=joint.source)
    pose = back.copy(relative_to=name)
    holder = Joint(name=f"{name}_joint", type="fixed", parent=name, child=parent, pose=pose, source=joint.source)
    return _Reversed(turned, helper, holder)


def helper_name(joint: str) -> str:
    """The link on the axis of a joint that was reversed."""
    return f"{joint}_reversed"


def _is_beside(joint: Joint, at: Transform) -> bool:
    """Whether the origin of the old parent, which becomes the child, is not where the joint can have its frame."""
    x, y, z = at.translation
    if joint.type in ABOUT_A_POINT:
        return math.hypot(x, y, z) > _ON_AXIS
    if joint.type not in TURNING:
        return False
    a, b, c = at.rotate(direction(joint.axis, Format.URDF))
    length = math.hypot(a, b, c) or 1.0
    return math.hypot(y * c - z * b, z * a - x * c, x * b - y * a) / length > _ON_AXIS


def _without_helpers(model: Model) -> Model:
    """The model without links on axes that an earlier change of roots has put there, where they do nothing any more."""
    there = blocks(model.extensions)
    for joint in model.joints:
        name = helper_name(joint.name)
        link = next((each for each in model.links if each.name == name), None)
        holder = next((each for each in model.joints if each.child == name and each.name == f"{name}_joint"), None)
        if link is None or holder is None or holder.type != "fixed" or name in there or holder.name in there:
            continue
        below = [each for each in model.joints if each.parent == name]
        if len(below) == 1 and below[0] is joint and _is_bare(link):
            model = _merged(model, joint, holder, link)
    return model


def _is_bare(link: Link) -> bool:
    return not (link.inertial or link.visuals or link.collisions or link.opaque)


def _merged(model: Model, joint: Joint, holder: Joint, link: Link) -> Model:
    """The joint hangs from what the holder hung from, where it is."""
    at = Transform.from_pose(holder.pose).compose(Transform.from_pose(joint.pose))
    moved = joint.copy(parent=holder.parent, pose=in_radians(at, holder.parent))
    joints = tuple(moved if each is joint else each for each in model.joints if each is not holder)
    links = tuple(each for each in model.links if each is not link)
    return model.copy(joints=joints, links=links)
