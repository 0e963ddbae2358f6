"""Reading Drake's own joints of URDF, which connect links like others."""

from dataclasses import replace
from typing import ClassVar

from lxml import etree

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Axis, Element, Format, Joint, Model, Opaque, Pose
from twinform.ir.defaults import direction
from twinform.ir.foreign_joints import ForeignJoint, foreign_joints, usual_word
from twinform.ir.frames import MODEL, WORLD
from twinform.passes.carriers.annotations import came_from, with_annotation
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.shared.drake_joints import DRAKE, DRAKE_TYPES, PITCH, UNIVERSAL_AXES
from twinform.schemas import Context, element_xml, parse_value, reader, table


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
