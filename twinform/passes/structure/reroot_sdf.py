"""Rerooting of SDF models: parents and children of joints are exchanged, and nothing moves."""

from twinform.ir import Format, Frame, Joint, Model, Pose
from twinform.ir.defaults import direction
from twinform.passes.structure.reversal import opposite, swapped_sensors, with_axis


def reroot_sdf(model: Model, way: list[Joint]) -> Model:
    """The model with another root; `way` has the joints from it up to the old one.

    The canonical link stays: the model's frame, and all that is attached to it, moves with the same body as before.
    """
    made = {joint.name: _reversed(joint) for joint in way}
    children = {joint.name: joint.child or "" for joint in way}
    joints = tuple(made.get(joint.name, joint) for joint in model.joints)
    frames = tuple(_reattached(frame, children) for frame in model.frames)
    return model.copy(joints=joints, frames=frames)


def _reversed(joint: Joint) -> Joint:
    """Return the joint with parent and child exchanged. Its frame stays where it is, and moves with the new child."""
    pose = joint.pose or Pose()
    base = pose.relative_to or joint.child
    pose = pose.copy(relative_to=None if base == joint.parent else base)
    update = {
        "parent": joint.child,
        "child": joint.parent,
        "pose": None if pose == Pose() else pose,
        "axis": with_axis(joint, opposite(direction(joint.axis, Format.SDF))),
        "sensors": swapped_sensors(joint),
    }
    return joint.copy(**update)


def _reattached(frame: Frame, children: dict[str, str]) -> Frame:
    """A frame that moved with a joint's frame moves with the same link as before."""
    joint = frame.attached_to or ""
    if joint not in children:
        return frame
    pose = frame.pose or Pose()
    if not pose.relative_to:
        pose = pose.copy(relative_to=joint)
    return frame.copy(attached_to=children[joint], pose=pose)
