"""What engines of Gazebo freeze, leave out or end with, in SDF."""

import math
from collections.abc import Iterator

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import (
    BARE_SCRIPT,
    FLAT_COLLISION,
    LATE_SENSOR,
    MODEL_JOINT_END,
    NARROW_VIEW,
    NESTED_IN_ENGINE,
    RARE_JOINT_TYPE,
    THREADLESS_SCREW,
    UNCERTAIN_INERTIA,
    UNUSABLE_AXIS,
    WEIGHTLESS_MOVER,
)
from twinform.ir import Collision, Document, Format, Inertial, Joint, Link, Material, Model, Sensor, walk
from twinform.ir.defaults import MOMENT
from twinform.ir.solids import written_solid
from twinform.ir.verify.verify_bodies import inertia_matrix
from twinform.passes.analyses.link_shapes import is_flat
from twinform.passes.analyses.moving_bodies import Body, moving_bodies
from twinform.passes.appearance.drop_bare_scripts import is_bare
from twinform.passes.inertia.physical_consistency import is_doubtful
from twinform.passes.limits.order_limits import is_usable
from twinform.profiles.reading.forms import number_in
from twinform.profiles.subject import ProfiledFile

_LATE_SENSORS = frozenset({"air_speed"})
"""What SDF 1.9 has no sensor of."""
# The smallest field of view of a camera in SDF 1.9, as libsdformat 12 has it, in rad.
_NARROW = 0.1
_COMMON = frozenset({"revolute", "fixed"})
"""The types of joints that every engine has."""


def find_engine_faults(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report what some engine of Gazebo does not take; URDF becomes SDF before engines see it."""
    document = subject.document
    # DART aborts the whole simulation with an assertion where a sphere has no radius, limits are
    # the wrong way round or a leaf has no inertia. To somebody whose robot does not appear that is
    # a refusal, and profiles list it as one.
    if document is None or document.format is not Format.SDF:
        return
    for node in walk(document):
        if isinstance(node, Joint):
            _find_in_joint(node, sink)
        elif isinstance(node, Collision) and is_flat(node):
            sink.report(FLAT_COLLISION, f"collision {node.name!r} has no extent", node.location)
        elif isinstance(node, Inertial) and _is_uncertain(node):
            sink.report(UNCERTAIN_INERTIA, "whether a body has the inertia is a matter of rounding", node.location)
        elif isinstance(node, Material) and node.script is not None and is_bare(node.script):
            sink.report(BARE_SCRIPT, "a material script has no name, or no URI", node.script.location)
        elif isinstance(node, Sensor):
            _find_in_sensor(node, sink)
        elif isinstance(node, Model):
            _find_in_model(node, sink)
    for body in _weightless(document):
        link = body[0]
        message = f"link {link.name!r} moves, and has no mass or no inertia with what is fixed to it"
        sink.report(WEIGHTLESS_MOVER, message, link.location)


def _find_in_model(model: Model, sink: DiagnosticSink) -> None:
    for nested in model.models:
        message = f"model {nested.name!r} is in model {model.name!r}"
        sink.report(NESTED_IN_ENGINE, message, nested.location)


def _find_in_sensor(sensor: Sensor, sink: DiagnosticSink) -> None:
    if sensor.type in _LATE_SENSORS:
        sink.report(LATE_SENSOR, f"sensor {sensor.name!r} is of type {sensor.type}", sensor.location)
    for view in _views(sensor):
        if view < _NARROW:
            message = f"a camera of sensor {sensor.name!r} sees {view:g} rad"
            sink.report(NARROW_VIEW, message, sensor.location, found=f"{view:g}", expected=f"at least {_NARROW:g}")


def _views(sensor: Sensor) -> Iterator[float]:
    """How wide each camera sees, in rad."""
    for part in sensor.opaque:
        view = part.element.find("horizontal_fov") if part.element and part.element.name == "camera" else None
        if view is not None and (width := number_in(view.text or "")) is not None:
            yield width


def _find_in_joint(joint: Joint, sink: DiagnosticSink) -> None:
    if joint.type not in _COMMON:
        sink.report(RARE_JOINT_TYPE, f"joint {joint.name!r} is {joint.type}", joint.location.at("@type"))
    if any((end or "").rpartition("::")[2] == "__model__" for end in (joint.parent, joint.child)):
        sink.report(MODEL_JOINT_END, f"joint {joint.name!r} ends at the frame of a model", joint.location)
    for axis in (joint.axis, joint.axis2):
        if axis is not None and joint.type != "fixed" and not is_usable(axis):
            message = f"joint {joint.name!r} has limits, damping or friction that no axis has"
            sink.report(UNUSABLE_AXIS, message, axis.location)
    if joint.type == "screw" and 0.0 in {joint.thread_pitch, joint.screw_thread_pitch}:
        sink.report(THREADLESS_SCREW, f"joint {joint.name!r} is a screw of pitch 0", joint.location)


def _is_uncertain(inertial: Inertial) -> bool:
    """Whether it is by rounding that an engine finds the inertia possible, or not."""
    matrix = inertia_matrix(inertial.inertia, MOMENT[Format.SDF])
    # Two equal moments cost libsdformat's solution of the cubic equation half of its digits, and
    # MuJoCo loses one or two: of inertias next to the bound, one is accepted and the next refused.
    # Computing as they do would hold for one release only, so the whole neighborhood is a finding.
    return not inertial.auto and matrix is not None and all(map(math.isfinite, matrix)) and is_doubtful(matrix)


def _weightless(document: Document) -> Iterator[Body]:
    """Bodies that move and have no mass; or no inertia, where their mass is in one place."""
    for body in moving_bodies(document):
        if any(link.inertial is not None and link.inertial.auto for link in body):
            continue
        solids = [_solid(link) for link in body]
        massive = [mass for mass, _ in solids if mass > 0]
        turns = any(extent > 0 for _, extent in solids)
        # Several point masses that are held apart have an inertia together; a single one has none.
        if not massive or (len(massive) == 1 and not turns):
            yield body


def _solid(link: Link) -> tuple[float, float]:
    """The mass of a link, and its greatest moment."""
    one = written_solid(link.inertial, Format.SDF)
    return one.mass, max((abs(each) for each in one.inertia if math.isfinite(each)), default=0.0)
