"""Frames of older SDF files in the words of a newer version, so that files of both can be one."""

from typing import TypeVar

from twinform.ir import Axis, Document, Joint, Model, Pose, World
from twinform.ir.frames import MODEL
from twinform.passes.legalise.nodes import map_poses
from twinform.schemas import Version, parse_version, table

_RELATIVE_TO = (1, 7)
"""Since this version a pose and an axis name their frame; before, they had `frame` and `use_parent_model_frame`."""
_JOINT_AXES = (1, 5)
"""Since this version an axis is in the joint frame by default; before, it was always in the model frame."""

Holder = TypeVar("Holder", Model, World)


def newest(*versions: str | None) -> str | None:
    """The newest of some versions; None where none of them is one."""
    known = [version for version in versions if version in table("sdf").versions]
    return max(known, key=parse_version, default=versions[0])


def upgrade_document(document: Document, version: str | None) -> Document:
    """The document in the words of a version that is not older than its own."""
    known = table("sdf").versions
    if document.version == version or document.version not in known or version not in known:
        return document
    old, new = parse_version(document.version), parse_version(version)
    update = {
        "models": tuple(upgrade(model, old, new) for model in document.models),
        "worlds": tuple(_world(world, old, new) for world in document.worlds),
        "version": version,
    }
    return document.model_copy(update=update)


def _world(world: World, old: Version, new: Version) -> World:
    models = tuple(upgrade(model, old, new) for model in world.models)
    bare = world.model_copy(update={"models": ()})
    return _poses(bare, old, new).model_copy(update={"models": models})


def upgrade(model: Model, old: Version, new: Version) -> Model:
    """A model of one version in the words of another."""
    nested = tuple(upgrade(each, old, new) for each in model.models)
    joints = tuple(_joint(joint, old, new) for joint in model.joints)
    bare = model.model_copy(update={"models": (), "joints": joints})
    return _poses(bare, old, new).model_copy(update={"models": nested})


def _poses(holder: Holder, old: Version, new: Version) -> Holder:
    return map_poses(holder, _name_frame) if old < _RELATIVE_TO <= new else holder


def _name_frame(pose: Pose) -> Pose:
    frame = next((part.attribute[1] for part in pose.opaque if part.attribute and part.attribute[0] == "frame"), None)
    if frame is None:
        return pose
    others = tuple(part for part in pose.opaque if not (part.attribute and part.attribute[0] == "frame"))
    return pose.model_copy(update={"relative_to": pose.relative_to or frame or None, "opaque": others})


def _joint(joint: Joint, old: Version, new: Version) -> Joint:
    update = {
        name: _axis(axis, old, new) for name, axis in (("axis", joint.axis), ("axis2", joint.axis2)) if axis is not None
    }
    return joint.model_copy(update=update) if update else joint


def _axis(axis: Axis, old: Version, new: Version) -> Axis:
    in_model = old < _JOINT_AXES or bool(axis.use_parent_model_frame)
    if old < _RELATIVE_TO <= new:
        expressed = axis.expressed_in or (MODEL if in_model else None)
        return axis.model_copy(update={"expressed_in": expressed, "use_parent_model_frame": None})
    if old < _JOINT_AXES <= new and axis.use_parent_model_frame is None:
        return axis.model_copy(update={"use_parent_model_frame": True})
    return axis
