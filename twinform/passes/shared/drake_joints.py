"""What Drake's `<drake:joint>` can say of a joint, and a joint as that element."""

from twinform.ir import Axis, Element, Joint, Opaque
from twinform.ir.node import Vector3
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.carriers import to_element
from twinform.schemas import format_value, usual_namespace

DRAKE = "drake"
"""The annotation on a joint of SDF that URDF has in a `<drake:joint>`."""
DRAKE_TYPES = frozenset({"ball", "planar", "screw", "universal"})
PITCH = "drake:screw_thread_pitch"
"""The element with the pitch of a screw; m per turn."""
# `detail_urdf_parser.cc`, ParseJoint: the axis is not used; `UniversalJoint` turns about x of the
# frame, then about y.
UNIVERSAL_AXES: tuple[Vector3, Vector3] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


def clark_name(word: str) -> str:
    """The name of an element in Clark notation, for one with a usual prefix."""
    prefix, _, local = word.rpartition(":")
    return f"{{{usual_namespace(prefix)}}}{local}" if prefix else local


def fit_for_drake(joint: Joint) -> Joint | None:
    """A joint of SDF that was Drake's, with what URDF can say of it; None where Drake could not say it."""
    if find_annotation(joint, DRAKE) is None or joint.type not in DRAKE_TYPES:
        return None
    if joint.type == "universal":
        return _fit_universal(joint)
    if joint.type != "screw":
        return joint
    if joint.screw_thread_pitch is None or joint.thread_pitch is not None or joint.axis2 is not None:
        return None
    pitch = Element.unchecked(name=clark_name(PITCH), attributes=(("value", format_value(joint.screw_thread_pitch)),))
    return joint.copy(screw_thread_pitch=None, opaque=(*joint.opaque, Opaque.unchecked(element=pitch)))


def _fit_universal(joint: Joint) -> Joint | None:
    axes = (joint.axis or Axis.unchecked(), joint.axis2 or Axis.unchecked())
    bare = [axis.copy(xyz=None) for axis in axes]
    plain = bare[0].mimic is None and bare[0].limit is None and not bare[0].opaque
    if tuple(axis.xyz for axis in axes) != UNIVERSAL_AXES or bare[0] != bare[1] or not plain:
        return None
    return joint.copy(axis=None if bare[0] == Axis.unchecked() else bare[0], axis2=None)


def drake_element(joint: Joint) -> Element:
    """The `<drake:joint>` of a joint of URDF."""
    return to_element(without_annotation(joint, DRAKE), "joint", "urdf").copy(name=clark_name("drake:joint"))
