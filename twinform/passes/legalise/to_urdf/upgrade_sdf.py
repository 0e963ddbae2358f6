"""Older versions of SDF say frames in other words."""

from typing import ClassVar

from twinform.ir import Axis, Joint, Model, Pose
from twinform.ir.frames import MODEL
from twinform.passes.legalise.nodes import map_poses
from twinform.passes.legalise.to_urdf.base import ToUrdfPass
from twinform.passes.legalise.to_urdf.keeper import Keeper
from twinform.schemas import Version

_RELATIVE_TO = (1, 7)
"""Since this version a pose and an axis name their frame; before, they had `frame` and `use_parent_model_frame`."""
_JOINT_AXES = (1, 5)
"""Since this version an axis is in the joint frame by default; before, it was always in the model frame."""


class UpgradeSdf(ToUrdfPass):
    """Say frames as SDF has said them since 1.7.

    Changes, in files of older versions: 1. `frame` of a pose is its `relative_to` too; 2. an axis is expressed in
    `__model__` where `use_parent_model_frame` is true, and always before 1.5.
    Never touches: what these words stand in, so that the older words are still there for the way back.
    """

    name: ClassVar[str] = "upgrade-sdf"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model in the words of 1.7."""
        if keeper.version >= _RELATIVE_TO:
            return model
        return _upgrade(model, keeper.version)


def _upgrade(model: Model, version: Version) -> Model:
    own = model.pose
    changed = map_poses(model, _name_frame)
    update = {
        "pose": own,
        "joints": tuple(_upgrade_joint(joint, version) for joint in changed.joints),
        "models": tuple(_upgrade_axes(nested, version) for nested in changed.models),
    }
    return changed.model_copy(update=update)


def _upgrade_axes(model: Model, version: Version) -> Model:
    joints = tuple(_upgrade_joint(joint, version) for joint in model.joints)
    return model.model_copy(
        update={"joints": joints, "models": tuple(_upgrade_axes(nested, version) for nested in model.models)}
    )


def _name_frame(pose: Pose) -> Pose:
    frame = next((part.attribute[1] for part in pose.opaque if part.attribute and part.attribute[0] == "frame"), "")
    return pose.model_copy(update={"relative_to": frame}) if frame and pose.relative_to is None else pose


def _upgrade_joint(joint: Joint, version: Version) -> Joint:
    update = {
        name: _upgrade_axis(axis, version) for name, axis in (("axis", joint.axis), ("axis2", joint.axis2)) if axis
    }
    return (
        joint.model_copy(update=update) if any(update[name] is not getattr(joint, name) for name in update) else joint
    )


def _upgrade_axis(axis: Axis, version: Version) -> Axis:
    if axis.expressed_in is not None or (version >= _JOINT_AXES and not axis.use_parent_model_frame):
        return axis
    return axis.model_copy(update={"expressed_in": MODEL})
