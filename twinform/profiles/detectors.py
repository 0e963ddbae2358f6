"""Detectors find what is fine in general, but not for some consumer; they run where a profile has a row about it."""

import math
from collections.abc import Callable, Iterator
from dataclasses import field
from typing import NamedTuple

from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, Rule
from twinform.diagnostics.rules import (
    BARE_SCRIPT,
    COLLADA_MESH,
    EARLY_STATIC,
    EMPTY_ATTRIBUTE,
    FLAT_COLLISION,
    LATE_SENSOR,
    LOOSENED_FIXED_JOINT,
    MODEL_JOINT_END,
    NARROW_VIEW,
    NESTED_IN_ENGINE,
    PLUGIN_NOT_IN_RELEASE,
    RARE_JOINT_TYPE,
    RENAMED_COLLISION,
    ROOT_INERTIA,
    THREADLESS_SCREW,
    TINY_NUMBER,
    UNCERTAIN_INERTIA,
    UNSUPPORTED_SENSOR,
    UNTAGGED_SHAPE,
    UNUSABLE_AXIS,
    WEIGHTLESS_MOVER,
)
from twinform.ir import Collision, Document, Element, Format, Inertial, Joint, Link, Material, Mesh, Model, Sensor, walk
from twinform.ir.defaults import MOMENT
from twinform.ir.solids import written_solid
from twinform.ir.verify.verify_bodies import inertia_matrix
from twinform.passes import NO_ASSETS, AssetError, Assets
from twinform.passes.appearance.drop_bare_scripts import is_bare
from twinform.passes.inertia.physical_consistency import is_doubtful
from twinform.passes.joints.order_limits import is_usable
from twinform.passes.legalise.round_tiny_numbers import RoundTinyNumbers, rounded_extension
from twinform.passes.shared.gazebo_tags import NUMBER_TAGS
from twinform.passes.shared.link_shapes import is_flat
from twinform.passes.shared.moving_bodies import Body, moving_bodies
from twinform.passes.structure.tag_shapes import KINDS, find_early_static, seen_shapes, wrongly_tagged
from twinform.profiles.forms import number_in
from twinform.schemas import XmlElement, path_of

_LATE_SENSORS = frozenset({"air_speed"})
"""Types of sensors that SDF 1.9 does not have."""
# The smallest field of view of a camera in SDF 1.9, as libsdformat 12 has it, in rad.
_NARROW = 0.1
_COMMON = frozenset({"revolute", "fixed"})
"""The types of joints that every engine has."""


@dataclass(frozen=True, slots=True)
class ProfiledFile:
    """A file to compare with profiles: its bytes, tree and document if there are any, and what `check` finds in it."""

    path: str
    format: Format | None
    document: Document | None = None
    tree: XmlElement | None = None
    content: bytes | None = field(default=None, repr=False)
    diagnostics: tuple[Diagnostic, ...] = ()
    assets: Assets = field(default=NO_ASSETS, compare=False, repr=False)

    def has_file(self, uri: str) -> bool:
        """Whether a URI leads to a file."""
        try:
            return self.assets.find(uri).is_file()
        except AssetError:
            return False


def find_engine_faults(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report what some engine of Gazebo does not support, in SDF; URDF becomes SDF before an engine sees it."""
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
    for body in _weightless_bodies(document):
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
    for view in _camera_views(sensor):
        if view < _NARROW:
            message = f"a camera of sensor {sensor.name!r} sees {view:g} rad"
            sink.report(NARROW_VIEW, message, sensor.location, found=f"{view:g}", expected=f"at least {_NARROW:g}")


def _camera_views(sensor: Sensor) -> Iterator[float]:
    """The horizontal field of view of each camera, in rad."""
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
    """Whether rounding decides if an engine finds the inertia possible."""
    matrix = inertia_matrix(inertial.inertia, MOMENT[Format.SDF])
    # Two equal moments cost libsdformat's solution of the cubic equation half of its digits, and
    # MuJoCo loses one or two: of inertias next to the bound, one is accepted and the next refused.
    # Computing as they do would hold for one release only, so the whole neighborhood is a finding.
    return not inertial.auto and matrix is not None and all(map(math.isfinite, matrix)) and is_doubtful(matrix)


def _weightless_bodies(document: Document) -> Iterator[Body]:
    """Bodies that move and have no mass, or a mass in a single point and no inertia."""
    for body in moving_bodies(document):
        if any(link.inertial is not None and link.inertial.auto for link in body):
            continue
        solids = [_mass_and_moment(link) for link in body]
        massive = [mass for mass, _ in solids if mass > 0]
        turns = any(extent > 0 for _, extent in solids)
        # Several point masses that are held apart have an inertia together; a single one has none.
        if not massive or (len(massive) == 1 and not turns):
            yield body


def _mass_and_moment(link: Link) -> tuple[float, float]:
    """The mass of a link, and its greatest moment."""
    one = written_solid(link.inertial, Format.SDF)
    return one.mass, max((abs(each) for each in one.inertia if math.isfinite(each)), default=0.0)


def find_lost_tags(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report tags that Gazebo applies otherwise than the file says, and collisions of sensors that it renames."""
    document = subject.document
    for model in document.models if document is not None and document.format is Format.URDF else ():
        if model.extensions:
            for field in KINDS:
                _find_untagged_shapes(model, field, sink)
            _find_renamed_collisions(model, sink)
            find_early_static(model, sink)


def find_tiny_numbers(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report numbers too small for libsdformat: in SDF, and in what it takes over into its SDF from `<gazebo>`.

    Of tags such as `<mu1>`, on which it ends, the facts about its reading of URDF say so.
    """
    document, found = subject.document, DiagnosticSink()
    if document is not None and document.format is Format.SDF:
        RoundTinyNumbers.unchecked(to=Format.SDF).run(document, found)
    elif document is not None:
        for extension in (each for model in document.models for each in model.extensions):
            content = tuple(each for each in extension.content if each.name not in NUMBER_TAGS)
            rounded_extension(extension.copy(content=content), found)
    for entry in found.entries:
        sink.report(TINY_NUMBER, entry.message.partition(":")[0], entry.location, help="write 0")


def _find_untagged_shapes(model: Model, field: str, sink: DiagnosticSink) -> None:
    for seen, found, name in wrongly_tagged(model, field):
        shape = f"{KINDS[field]} {seen.shape.name!r}" if seen.shape.name else f"a {KINDS[field]} without a name"
        what = f"the tags of {', '.join(map(repr, sorted(found)))}" if found else "none of the tags of its link"
        message = f"{shape} of link {seen.link!r} is {seen.name!r} to Gazebo, which applies {what} to it"
        hint = f"call it {name!r}" if name else None
        sink.report(UNTAGGED_SHAPE, message, seen.shape.location, found=seen.shape.name, help=hint)


def _find_renamed_collisions(model: Model, sink: DiagnosticSink) -> None:
    named = {(seen.link, seen.shape.name): seen.name for seen in seen_shapes(model, "collisions") if seen.shape.name}
    theirs = set(named.values())
    for link, sensor, collision in _contact_collisions(model):
        text = (collision.text or "").strip()
        called = named.get((link, text))
        if called is not None and text not in theirs:
            message = f"contact sensor {sensor.get('name')!r} names collision {text!r}, which is {called!r} to Gazebo"
            sink.report(RENAMED_COLLISION, message, collision.location, found=text, help=f"write {called!r}")


def _contact_collisions(model: Model) -> Iterator[tuple[str, Element, Element]]:
    """The link, the sensor and the `<collision>` element of every contact sensor."""
    for extension in model.extensions:
        for sensor in (each for each in extension.content if each.name == "sensor"):
            contact = sensor.find("contact")
            for collision in contact.children if contact is not None else ():
                if collision.name == "collision":
                    yield extension.reference or "", sensor, collision


def find_empty_attributes(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report attributes of other namespaces without a value; plugins and foreign elements are only copied."""
    waiting = [subject.tree] if subject.tree is not None and subject.tree.tag == "sdf" else []
    while waiting:
        element = waiting.pop()
        for name in (str(name) for name, value in element.attrib.items() if not value):
            # libsdformat prints an error for an empty attribute that it does not know.
            if name.startswith("{"):
                place = Location(line=element.sourceline or 0, path=path_of(element))
                message = f"<{element.tag}> has an attribute {name.partition('}')[2]!r} without a value"
                sink.report(EMPTY_ATTRIBUTE, message, place)
        waiting += filter(_is_read_by_libsdformat, element)


def _is_read_by_libsdformat(element: XmlElement) -> bool:
    return isinstance(element.tag, str) and not element.tag.startswith("{") and element.tag != "plugin"


def find_mesh_formats(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report every COLLADA mesh, and whether the file is there: only then it can be converted."""
    for node in walk(subject.document) if subject.document else ():
        uri = node.uri or "" if isinstance(node, Mesh) else ""
        # A missing mesh is a finding of `check`, whoever reads the model. The format matters only
        # where the file is there, because only then can it be converted.
        if uri.lower().endswith(".dae"):
            absent = "" if subject.has_file(uri) else ", and not there"
            sink.report(COLLADA_MESH, f"mesh {uri!r} is COLLADA{absent}", node.location, found=uri)


def find_classic_parts(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report plugins and sensors of Gazebo Classic."""
    from twinform.profiles.classic_parts import report_classic_parts  # noqa: PLC0415 - it has many tables

    if subject.document is not None:
        report_classic_parts(subject.document, sink)


def find_loosened_joints(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report fixed joints that Gazebo makes revolute."""
    from twinform.profiles.classic_parts import report_loosened_joints  # noqa: PLC0415 - see above

    if subject.document is not None:
        report_loosened_joints(subject.document, sink)


def find_root_inertia(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report a root link of URDF with an inertia."""
    for model in subject.document.models if subject.document and subject.format is Format.URDF else ():
        held = {joint.child for joint in model.joints}
        roots = [link for link in model.links if link.name not in held]
        if len(roots) == 1 and roots[0].inertial is not None:
            message = f"link {roots[0].name!r} is the root and has an inertia"
            sink.report(ROOT_INERTIA, message, roots[0].inertial.location, found=roots[0].name)


class Detector(NamedTuple):
    """A function that looks for something, and the rules that it reports."""

    find: Callable[[ProfiledFile, DiagnosticSink], None]
    rules: tuple[Rule, ...]


DETECTORS = (
    Detector(find_classic_parts, (PLUGIN_NOT_IN_RELEASE, UNSUPPORTED_SENSOR)),
    Detector(find_loosened_joints, (LOOSENED_FIXED_JOINT,)),
    Detector(find_mesh_formats, (COLLADA_MESH,)),
    Detector(find_empty_attributes, (EMPTY_ATTRIBUTE,)),
    Detector(find_tiny_numbers, (TINY_NUMBER,)),
    Detector(find_root_inertia, (ROOT_INERTIA,)),
    Detector(find_lost_tags, (EARLY_STATIC, RENAMED_COLLISION, UNTAGGED_SHAPE)),
    Detector(
        find_engine_faults,
        (
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
        ),
    ),
)
"""All detectors."""
