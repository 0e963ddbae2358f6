"""Drake's own joints of URDF (`<drake:joint>`): read as joints like others, and written as such again."""

from dataclasses import replace
from typing import ClassVar

from lxml import etree

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Axis, Element, Format, Joint, Model, Opaque, Pose
from twinform.ir.defaults import direction
from twinform.ir.foreign_joints import ForeignJoint, foreign_joints, usual_word
from twinform.ir.frames import MODEL, WORLD
from twinform.ir.node import Vector3
from twinform.passes.carriers.annotations import came_from, find_annotation, with_annotation, without_annotation
from twinform.passes.carriers.carriers import to_element
from twinform.passes.framework.pass_base import ModelPass
from twinform.schemas import Context, clark_name, element_xml, format_value, parse_value, reader, table

DRAKE = "drake"
"""The annotation on a joint of SDF that URDF has in a `<drake:joint>`."""
DRAKE_TYPES = frozenset({"ball", "planar", "screw", "universal"})
PITCH = "drake:screw_thread_pitch"
"""The element with the pitch of a screw; m per turn."""
# `detail_urdf_parser.cc`, ParseJoint: the axis is not used; `UniversalJoint` turns about x of the
# frame, then about y.
UNIVERSAL_AXES: tuple[Vector3, Vector3] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


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


class ReadDrakeJoints(ModelPass):
    """Make joints of Drake's `<drake:joint>`.

    Changes: 1. a ball, screw, universal or planar joint is one of SDF and of URDF, annotated as Drake's; 2. a universal
    joint turns about x and then about y of its frame, whatever axis it has: Drake reads none.
    Never touches: any other element or joint.
    Diagnostics: `joint-type-unsupported` for `curvilinear` and for types that Drake lacks; what reading a joint finds.
    """

    name: ClassVar[str] = "read-drake-joints"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with joints like others."""
        found = [each for each in foreign_joints(model) if each.form is None]
        if not found or sink.has_errors:
            return model
        annotated = self.carriers and not came_from(model, Format.SDF)
        joints = [joint for each in found if (joint := _read_joint(each, model, sink)) is not None]
        made = [with_annotation(joint, DRAKE) if annotated else joint for joint in joints]
        held = {joint.child: joint.name for joint in made}
        links = (
            link.copy(pose=Pose.unchecked(relative_to=held[link.name])) if link.name in held else link
            for link in model.links
        )
        parts = {id(each.part) for each in found}
        opaque = tuple(part for part in model.opaque if id(part) not in parts)
        return model.copy(links=tuple(links), joints=(*model.joints, *made), opaque=opaque)


def _read_joint(foreign: ForeignJoint, model: Model, sink: DiagnosticSink) -> Joint | None:
    """The joint that an element describes; None for one that is reported."""
    kind, element, where = foreign.joint.type, foreign.part.element, foreign.joint.location
    if element is None or kind not in DRAKE_TYPES:
        message = f"joint {foreign.joint.name!r} is {kind!r}, which SDF has no joint for"
        sink.report(rules.JOINT_TYPE_UNSUPPORTED, message, where.at("@type"), found=kind)
        return None
    # A planar joint of Drake has three dampings, which are no number of URDF.
    aside = [each for each in element.children if kind == "planar" and each.name == "dynamics"]
    joint = _read_as_urdf(element, tuple(each for each in element.children if each not in aside), foreign, sink)
    if joint is None:
        return None
    outside = joint.parent == WORLD and all(link.name != WORLD for link in model.links)
    pose = (joint.pose or Pose.unchecked()).copy(relative_to=MODEL if outside else joint.parent)
    joint = joint.copy(type=kind, pose=pose, opaque=(*joint.opaque, *(Opaque.unchecked(element=e) for e in aside)))
    if kind == "screw":
        return _as_screw(joint, sink)
    return _as_universal(joint, sink) if kind == "universal" else joint


def _read_as_urdf(
    element: Element, children: tuple[Element, ...], foreign: ForeignJoint, sink: DiagnosticSink
) -> Joint | None:
    xml = etree.SubElement(etree.Element("robot", {"name": ""}), "joint", {**dict(element.attributes), "type": "fixed"})
    for child in children:
        element_xml(child, xml)
    found = DiagnosticSink(file=sink.file, strict=sink.strict)
    context = Context(found, found.file, "urdf", table("urdf").newest, declared=False)
    data = reader("urdf", context.version).read(xml, context, "joint", Joint, foreign.joint.source)
    where = foreign.joint.location
    for each in found.diagnostics:
        if each.is_error:
            inside = each.location.path.partition("/joint")[2].partition("]")[2]
            sink.extend([replace(each, location=where._replace(path=where.path + inside))])
    return None if found.has_errors else Joint.unchecked(**data)


def _as_screw(joint: Joint, sink: DiagnosticSink) -> Joint | None:
    pitch = next((part for part in joint.opaque if part.element and usual_word(part.element) == PITCH), None)
    text = (pitch and pitch.element and pitch.element.get("value")) or ""
    try:
        value = parse_value("double", text, "urdf")
    except ValueError:
        message = f"screw joint {joint.name!r} has no <{PITCH}> with a number"
        sink.report(rules.MISSING_PART, message, joint.location, expected=f"<{PITCH} value='...'>")
        return None
    axis = (joint.axis or Axis.unchecked()).copy(xyz=direction(joint.axis, Format.URDF))
    opaque = tuple(part for part in joint.opaque if part is not pitch)
    return joint.copy(axis=axis, screw_thread_pitch=value, opaque=opaque)


def _as_universal(joint: Joint, sink: DiagnosticSink) -> Joint:
    axis = joint.axis or Axis.unchecked()
    if axis.xyz is not None:
        message = f"Drake turns universal joint {joint.name!r} about x and y, whatever its axis is"
        sink.account(Fate.DROPPED, rules.URDF_ONLY, message, joint.location.at("axis"), 2)
    first, second = (axis.copy(xyz=xyz, opaque=()) for xyz in UNIVERSAL_AXES)
    return joint.copy(axis=first, axis2=second)


class WriteDrakeJoints(ModelPass):
    """Write joints that were `<drake:joint>` as such.

    Changes: an annotated joint of a type that Drake has is an element of the robot.
    Never touches: one with another type by now.
    Diagnostics: none.
    """

    name: ClassVar[str] = "write-drake-joints"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with the elements of Drake."""
        own = [joint for joint in model.joints if find_annotation(joint, DRAKE) and joint.type in DRAKE_TYPES]
        if not own or sink.has_errors:
            return model
        elements = (Opaque.unchecked(element=drake_element(joint), source=joint.source) for joint in own)
        names = {joint.name for joint in own}
        joints = tuple(joint for joint in model.joints if joint.name not in names)
        return model.copy(joints=joints, opaque=(*model.opaque, *elements))
