"""The rules of URDF, which describes one tree."""

from collections.abc import Iterable, Iterator
from functools import partial

from twinform.diagnostics import DiagnosticSink, Location, Severity, did_you_mean, rules
from twinform.ir.foreign_joints import ForeignJoint, foreign_joints
from twinform.ir.frames import WORLD
from twinform.ir.joint import Joint
from twinform.ir.model import Model
from twinform.ir.node import Node
from twinform.ir.verify.verify_bodies import verify_inertial, verify_rotation, verify_shapes
from twinform.ir.verify.verify_joints import (
    report_loops,
    report_self_joint,
    verify_joint,
    verify_limits_there,
    verify_mimics,
)
from twinform.ir.verify.verify_names import report_names, report_unprintable
from twinform.ir.versions import Version
from twinform.ir.visual import Material


def verify_robot(model: Model, sink: DiagnosticSink, version: Version) -> None:
    """Report what is wrong with a robot in a version of URDF."""
    if not model.name.strip():
        message = "the robot has an empty name"
        sink.report(rules.EMPTY_NAME, message, model.location, severity=Severity.WARNING)
    report_unprintable("robot", model, sink)
    foreign = tuple(foreign_joints(model))
    named = tuple(each.joint for each in foreign if each.joint.name)
    for kind, nodes in (("link", model.links), ("joint", (*model.joints, *named))):
        report_names(kind, nodes, sink)
    _report_materials(model, sink)
    links = {link.name for link in model.links}
    held = (*model.joints, *(each.joint for each in foreign if each.form is None))
    moved = {joint.child for joint in held}
    for each in foreign:
        _verify_foreign(each, links, moved, sink)
    for joint in model.joints:
        _verify_joint(joint, links, moved, sink)
        verify_rotation(joint.pose, sink)
        verify_limits_there(joint, sink, version)
    verify_mimics(model.joints, sink)
    for link in model.links:
        verify_inertial(link, None, sink)
        verify_shapes(link, sink, geometry_is_required=True)
        for kind, shapes in (("visual", link.visuals), ("collision", link.collisions)):
            for shape in shapes:
                report_unprintable(kind, shape, sink)
                verify_rotation(shape.pose, sink)
    _verify_tree(model, held, links, sink)
    known = links | {joint.name for joint in model.joints}
    for extension in model.extensions:
        if extension.reference and extension.reference not in known:
            where = extension.location.at("@reference")
            message = f"<gazebo> refers to {extension.reference!r}, which is neither a link nor a joint"
            hint = partial(did_you_mean, extension.reference, known)
            sink.report(rules.UNKNOWN_REFERENCE, message, where, found=extension.reference, help=hint)


def _verify_joint(joint: Joint, links: set[str], moved: set[str | None], sink: DiagnosticSink) -> None:
    _report_unknown_link(joint, "parent", joint.parent, links, set(), sink)
    _report_unknown_link(joint, "child", joint.child, links, moved, sink)
    verify_joint(joint, sink)
    for part in joint.opaque:
        if part.element and part.element.name == "dynamics" and not part.element.attributes:
            message = f"<dynamics> of joint {joint.name!r} has neither damping nor friction"
            sink.report(rules.EMPTY_DYNAMICS, message, part.location, expected="damping or friction", refused=True)


def _verify_foreign(foreign: ForeignJoint, links: set[str], moved: set[str | None], sink: DiagnosticSink) -> None:
    joint, form = foreign.joint, foreign.form
    known = links | {WORLD} if foreign.word.startswith("drake:") else links  # Drake has a body of this name
    parent, child = (form.parent.link, form.child.link) if form else ("parent", "child")
    _report_unknown_link(joint, parent, joint.parent, known, set(), sink)
    _report_unknown_link(joint, child, joint.child, known, set() if form else moved, sink)
    report_self_joint(joint, sink)


def _report_unknown_link(
    joint: Joint, end: str, name: str | None, links: set[str], taken: set[str | None], sink: DiagnosticSink
) -> None:
    """Report an end of a joint that is no link; one of the links `taken` is not meant: a link has one parent only."""
    if name is None or name in links:
        return
    whose = f"joint {joint.name!r} has the {end}" if joint.name else f"<{end}> names"
    message = f"{whose} {name!r}, but there is no such link"
    hint = partial(_suggest_link, name, joint, links, taken)
    sink.report(rules.DANGLING_LINK, message, joint.location.at(end), found=name, help=hint)


def _suggest_link(name: str, joint: Joint, links: set[str], taken: set[str | None]) -> str | None:
    return did_you_mean(name, links - taken, but=(joint.parent, joint.child))


def _verify_tree(model: Model, held: Iterable[Joint], links: set[str], sink: DiagnosticSink) -> None:
    if not links:
        sink.report(rules.NO_LINKS, f"robot {model.name!r} has no link", model.location, expected="<link>")
        return
    parents = report_loops([joint for joint in held if joint.child in links], sink)
    roots = list({link.name: link for link in model.links if link.name not in parents}.values())
    if len(roots) > 1:
        names = ", ".join(repr(link.name) for link in roots[:5])
        message = f"robot {model.name!r} has {len(roots)} root links: {names}{', ...' if len(roots) > 5 else ''}"
        related = tuple(link.location for link in roots[2:5])
        sink.report(rules.SEVERAL_ROOTS, message, roots[1].location, related=related)


def _report_materials(model: Model, sink: DiagnosticSink) -> None:
    report_names("material", [material for material in model.materials if material.name], sink)
    for material in model.materials:
        if _is_bare(material):
            message = f"the shared material {material.name!r} has neither a color nor a texture"
            sink.report(rules.BARE_MATERIAL, message, material.location, expected="<color> or <texture>")
    _report_unnamed(model, sink)
    defined = {material.name: material for material in model.materials if material.name}
    used = [visual.material for link in model.links for visual in link.visuals if visual.material]
    for material in used:
        if material.name and not _is_bare(material):
            _report_conflict(material, defined.setdefault(material.name, material), sink)
    for material in used:
        if material.name and _is_bare(material) and material.name not in defined:
            message = f"material {material.name!r} is not defined"
            hint = partial(did_you_mean, material.name, defined)
            sink.report(rules.UNKNOWN_MATERIAL, message, material.location, found=material.name, help=hint)


def _report_unnamed(model: Model, sink: DiagnosticSink) -> None:
    for place in _unnamed(model, model.materials):
        sink.report(rules.UNNAMED_MATERIAL, "a shared material has no name", place, expected="@name")
    for visual in (visual for link in model.links for visual in link.visuals):
        for place in _unnamed(visual, (visual.material,) if visual.material else ()):
            message = "the material of a visual has no name"
            sink.report(rules.UNNAMED_MATERIAL, message, place, expected="@name")


def _unnamed(holder: Node, materials: Iterable[Material]) -> Iterator[Location]:
    """Where materials without a name are; one with nothing in it is an opaque part of what it is in."""
    yield from (material.location for material in materials if material.name is None)
    blank = (part for part in holder.opaque if part.element and part.element.name == "material" and not part.at)
    yield from (part.location for part in blank if part.element and "name" not in dict(part.element.attributes))


def _is_bare(material: Material) -> bool:
    return not (material.color or material.texture)


def _report_conflict(material: Material, first: Material, sink: DiagnosticSink) -> None:
    if (material.color, material.texture) != (first.color, first.texture):
        message = f"material {material.name!r} has another color or texture here than in its first definition"
        related = (first.location,)
        sink.report(rules.CONFLICTING_MATERIAL, message, material.location, found=material.name, related=related)
