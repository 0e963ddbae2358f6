"""Notation of poses in URDF and in versions of SDF, and its annotations."""

import math

from twinform.ir import Element, Pose
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform
from twinform.schemas import format_value


def in_radians(transform: Transform, relative_to: str | None = None) -> Pose:
    """The pose in the notation of URDF and SDF before 1.9: numbers as they were read, but angles in radians."""
    written = transform.notation
    if written is None:
        return transform.to_pose(relative_to)
    rpy = written.rpy
    if written.quat_xyzw is not None:
        rpy = transform.rpy()
    elif written.degrees and rpy is not None:
        rpy = (math.radians(rpy[0]), math.radians(rpy[1]), math.radians(rpy[2]))
    return Pose.unchecked(xyz=written.xyz, rpy=rpy, relative_to=relative_to, source=written.source)


POSE = "pose"
"""The annotation with the frame and notation in which SDF wrote the pose of a part."""


def pose_attributes(written: Pose | None) -> dict[str, str | None]:
    """The attributes of the annotation on a pose; none for the default frame and notation."""
    if written is None:
        return {}
    degrees = None if written.degrees is None else str(written.degrees).lower()
    attributes = {"relative_to": written.relative_to, "degrees": degrees, "rotation_format": written.rotation_format}
    return {name: value for name, value in attributes.items() if value is not None}


def as_annotated(transform: Transform, annotation: Element | None, relative_to: str | None) -> Pose | None:
    """The pose in the notation of an annotation; None for the identity, which need not be written."""
    if annotation is None or not (annotation.get("degrees") or annotation.get("rotation_format")):
        pose = transform.to_pose(relative_to)
        return None if pose == Pose.unchecked() else pose
    degrees, form = annotation.get("degrees"), annotation.get("rotation_format")
    plain = transform.to_pose()
    update: dict[str, object] = {"degrees": None if degrees is None else degrees == "true", "rotation_format": form}
    if form == "quat_xyzw":
        update |= {"rpy": None, "quat_xyzw": transform.quaternion()}
    elif degrees == "true":
        roll, pitch, yaw = transform.rpy()
        update["rpy"] = (math.degrees(roll), math.degrees(pitch), math.degrees(yaw))
    # A pose in SDF is one text of six or seven numbers; with a rotation in another notation it
    # cannot leave the zeros out.
    return plain.copy(**{**update, "xyz": plain.xyz or (0.0, 0.0, 0.0), "relative_to": relative_to})


BODY = "body"
"""The annotation on a link of URDF called `world` that is a link in SDF too, and not the world."""
FRAME = "frame"
"""The annotation on a link that is a frame in SDF, with what it is attached to, if not the joint's parent."""
NESTED = "nested"
"""The annotation on a link that is the frame of a nested model in SDF, with what else that model has."""
LINK = "link"
"""The annotation on a frame of SDF that is a link in URDF, attached to the frame that is its joint."""
OFFSET = "offset"
"""The annotation on a link, fixed joint or model with the pose of its frame in SDF relative to that in URDF."""


def offset_attributes(offset: Transform) -> dict[str, str | None]:
    """The offset as attributes: meters and radians."""
    pose = in_radians(offset)
    return {name: format_value(value) for name in ("xyz", "rpy") if (value := getattr(pose, name)) is not None}


def read_offset(annotation: Element) -> Transform:
    """The offset of an annotation, which may have been edited.

    Raises:
        ValueError: it is not three numbers.
    """
    return Transform.from_pose(Pose.unchecked(xyz=_vector(annotation.get("xyz")), rpy=_vector(annotation.get("rpy"))))


def _vector(text: str | None) -> Vector3:
    if text is None:
        return (0.0, 0.0, 0.0)
    x, y, z = map(float, text.split())
    # The file may have been edited, perhaps maliciously: `nan` would spread to every pose of the link.
    if not all(map(math.isfinite, (x, y, z))):
        raise ValueError(f"{text!r} is not three numbers")
    return (x, y, z)
