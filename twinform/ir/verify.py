"""Whether a document makes sense beyond its schema: names, references, trees."""

from collections.abc import Callable, Iterable

from twinform.diagnostics import Location, Notes, Severity
from twinform.diagnostics.rules import model as rules
from twinform.ir.document import Document, Format
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.joint import Axis, Joint, Limit
from twinform.ir.model import Model
from twinform.ir.node import Node
from twinform.ir.world import World

_REFERRED_TO = frozenset({"link", "joint", "model", "frame"})
_MOVES = frozenset({"revolute", "continuous", "prismatic", "planar", "screw"})
_BEFORE_FRAMES = frozenset({"1.2", "1.3", "1.4", "1.5", "1.6"})
"""Versions in which links and joints were no frames yet: two of one name were bad style only."""
_NEEDS_LIMIT = frozenset({"revolute", "prismatic"})


def verify(document: Document, notes: Notes) -> None:
    """Report what is wrong with a document, in the order of its parts."""
    if document.format is Format.URDF:
        for model in document.models:
            _verify_robot(model, notes, optional=document.version == "1.2")
        return
    shared = Severity.WARNING if document.version in _BEFORE_FRAMES else Severity.ERROR
    for world in document.worlds:
        _verify_world(world, shared, notes)
    for model in (*document.models, *(model for world in document.worlds for model in world.models)):
        before = len(notes.diagnostics)
        _verify_sdf_model(model, shared, notes)
        if document.version not in _BEFORE_FRAMES and len(notes.diagnostics) == before:
            _verify_frames(model, notes)


def _verify_robot(model: Model, notes: Notes, *, optional: bool) -> None:
    """The rules of URDF, which describes one tree; `optional` says whether limits may lack effort and velocity."""
    for kind, nodes in (("link", model.links), ("joint", model.joints)):
        _report_names(kind, nodes, notes)
    _report_materials(model, notes)
    links = {link.name for link in model.links}
    joints = {joint.name for joint in model.joints}
    for joint in model.joints:
        _verify_joint(joint, links, notes)
        _verify_mimic(joint, joints, notes)
        if joint.type in _NEEDS_LIMIT and (joint.axis is None or joint.axis.limit is None):
            message = f"{joint.type} joint {joint.name!r} has no <limit>"
            notes.report(rules.MISSING_LIMIT, message, joint.location, expected="<limit>")
        elif joint.axis and joint.axis.limit and not optional:
            _verify_limit(joint, joint.axis.limit, notes)
    _verify_tree(model, links, notes)
    known = links | joints
    for extension in model.extensions:
        if extension.reference and extension.reference not in known:
            where = extension.location.at("@reference")
            message = f"<gazebo> refers to {extension.reference!r}, which is neither a link nor a joint"
            notes.report(rules.UNKNOWN_REFERENCE, message, where, found=extension.reference)


def _verify_tree(model: Model, links: set[str], notes: Notes) -> None:
    if not links:
        notes.report(rules.NO_LINKS, f"robot {model.name!r} has no link", model.location, expected="<link>")
        return
    parents: dict[str, Joint] = {}
    for joint in model.joints:
        if joint.child is None or joint.child not in links:
            continue
        if joint.child in parents:
            first = parents[joint.child]
            message = f"link {joint.child!r} is the child of joint {first.name!r} and of joint {joint.name!r}"
            notes.report(rules.TWO_PARENTS, message, joint.location, related=(first.location,))
        parents.setdefault(joint.child, joint)
    roots = list({link.name: link for link in model.links if link.name not in parents}.values())
    if len(roots) > 1:
        names = ", ".join(repr(link.name) for link in roots[:5])
        message = f"robot {model.name!r} has {len(roots)} root links: {names}{', ...' if len(roots) > 5 else ''}"
        notes.report(
            rules.SEVERAL_ROOTS, message, roots[1].location, related=tuple(link.location for link in roots[2:5])
        )
    for joint in _circles(parents):
        message = f"joint {joint.name!r} closes a circle of joints through link {joint.child!r}"
        notes.report(rules.KINEMATIC_LOOP, message, joint.location)


def _circles(parents: dict[str, Joint]) -> list[Joint]:
    """One joint of each circle; every link is walked over once."""
    settled: set[str] = set()
    found: list[Joint] = []
    for start in parents:
        path: dict[str, Joint] = {}
        link = start
        while link in parents and link not in settled and link not in path:
            path[link] = parents[link]
            link = parents[link].parent or ""
        if link in path:
            found.append(path[link])
        settled.update(path)
    return found


def _verify_joint(joint: Joint, links: set[str], notes: Notes) -> None:
    for end, name in (("parent", joint.parent), ("child", joint.child)):
        if name is not None and name not in links:
            message = f"joint {joint.name!r} has the {end} {name!r}, which is no link"
            notes.report(rules.DANGLING_LINK, message, joint.location.at(end), found=name)
    _verify_joint_itself(joint, notes)


def _verify_joint_itself(joint: Joint, notes: Notes) -> None:
    if joint.parent is not None and joint.parent == joint.child:
        message = f"joint {joint.name!r} connects {joint.parent!r} to itself"
        notes.report(rules.SELF_JOINT, message, joint.location, found=joint.parent)
    for name, axis in (("axis", joint.axis), ("axis2", joint.axis2)):
        if axis is not None:
            _verify_axis(joint, axis, joint.location.at(name), notes)


def _verify_axis(joint: Joint, axis: Axis, where: Location, notes: Notes) -> None:
    if joint.type in _MOVES and axis.xyz is not None and not any(axis.xyz):
        notes.report(rules.ZERO_AXIS, f"the axis of joint {joint.name!r} has length zero", where, found="0 0 0")
    limit = axis.limit
    if limit is None or limit.lower is None or limit.upper is None or joint.type == "continuous":
        return
    if limit.lower > limit.upper:
        message = f"joint {joint.name!r} has the lower limit {limit.lower:g} above the upper limit {limit.upper:g}"
        notes.report(rules.LOWER_ABOVE_UPPER, message, limit.location, found=f"{limit.lower:g}")


def _verify_limit(joint: Joint, limit: Limit, notes: Notes) -> None:
    missing = [name for name in ("effort", "velocity") if getattr(limit, name) is None]
    if missing:
        message = f"the limit of joint {joint.name!r} has no {' and no '.join(missing)}"
        notes.report(rules.PARTIAL_LIMIT, message, limit.location, expected=f"@{missing[0]}")


def _verify_mimic(joint: Joint, joints: set[str], notes: Notes) -> None:
    mimic = joint.axis.mimic if joint.axis else None
    if mimic is None or (mimic.joint in joints and mimic.joint != joint.name):
        return
    what = "itself" if mimic.joint == joint.name else "which is no joint"
    message = f"joint {joint.name!r} mimics {mimic.joint!r}, {what}"
    notes.report(rules.UNKNOWN_LEADER, message, mimic.location, found=mimic.joint)


def _report_materials(model: Model, notes: Notes) -> None:
    _report_names("material", [material for material in model.materials if material.name], notes)
    defined = {material.name for material in model.materials}
    visuals = [visual for link in model.links for visual in link.visuals if visual.material]
    said = {v.material.name for v in visuals if v.material and (v.material.color or v.material.texture)}
    for visual in visuals:
        material = visual.material
        if material is None or material.color or material.texture or not material.name:
            continue
        if material.name not in defined and material.name not in said:
            message = f"material {material.name!r} is not defined"
            notes.report(rules.UNKNOWN_MATERIAL, message, material.location, found=material.name)


def _verify_sdf_model(model: Model, shared: Severity, notes: Notes) -> None:
    """The rules of SDF, where links, joints, frames and nested models share one scope."""
    kinds = (("link", model.links), ("joint", model.joints), ("frame", model.frames), ("model", model.models))
    _report_scope(kinds, shared, notes)
    for link in model.links:
        for kind, nodes in (("visual", link.visuals), ("collision", link.collisions), ("sensor", link.sensors)):
            _report_names(kind, [node for node in nodes if node.name], notes)
    known = {node.name for _, nodes in kinds for node in nodes}
    joints = {joint.name for joint in model.joints}
    open_scope = bool(model.includes)  # an include adds names that only its file knows
    for joint in model.joints:
        _verify_sdf_joint(joint, lambda name: open_scope or name in known or "::" in name, notes)
        if not open_scope:
            _verify_mimic(joint, joints, notes)
    if not (model.links or model.models or model.includes or model.static):
        message = f"model {model.name!r} has no link"
        notes.report(rules.EMPTY_MODEL, message, model.location, expected="<link>")
    for nested in model.models:
        _verify_sdf_model(nested, shared, notes)


def _verify_frames(model: Model, notes: Notes) -> None:
    """Every frame of the model and those nested in it must lead somewhere; names in includes are in other files."""
    if any(each.includes for each in (model, *model.models)):
        return
    seen: set[tuple[str, str]] = set()
    try:
        graph = FrameGraph(model)
    except FrameError as error:
        error.report(notes)
        return
    for problem in graph.problems():
        if (problem.rule.name, problem.found) not in seen:
            problem.report(notes)
        seen.add((problem.rule.name, problem.found))


def _verify_sdf_joint(joint: Joint, known: Callable[[str], bool], notes: Notes) -> None:
    for end, name in (("parent", joint.parent), ("child", joint.child)):
        if name is None or name == "world" or name.startswith("__") or known(name):
            continue
        message = f"joint {joint.name!r} has the {end} {name!r}, which is no link or frame of the model"
        notes.report(rules.DANGLING_LINK, message, joint.location.at(end), found=name)
    if joint.child == "world":
        notes.report(rules.WORLD_CHILD, f"joint {joint.name!r} has the child 'world'", joint.location.at("child"))
    _verify_joint_itself(joint, notes)


def _verify_world(world: World, shared: Severity, notes: Notes) -> None:
    kinds = (("model", world.models), ("light", world.lights), ("frame", world.frames), ("joint", world.joints))
    _report_scope(kinds, shared, notes)


def _report_scope(kinds: Iterable[tuple[str, Iterable[Node]]], shared: Severity, notes: Notes) -> None:
    owners: dict[str, tuple[str, Node]] = {}
    for kind, nodes in kinds:
        named = [node for node in nodes if getattr(node, "name", None) is not None]
        _report_names(kind, named, notes)
        for node in named:
            name = str(getattr(node, "name", ""))
            if name == "world" or (name.startswith("__") and name.endswith("__")):
                message = f"{kind} {name!r} has a name that SDF keeps for itself"
                notes.report(rules.RESERVED_NAME, message, node.location, found=name, severity=shared)
            other, first = owners.setdefault(name, (kind, node))
            if other != kind:
                message = f"{kind} {name!r} has the name of a {other}"
                notes.report(
                    rules.SHARED_NAME, message, node.location, found=name, related=(first.location,), severity=shared
                )


def _report_names(kind: str, nodes: Iterable[Node], notes: Notes) -> None:
    seen: dict[str, Node] = {}
    for node in nodes:
        name = str(node.__dict__["name"])
        if not name and kind in _REFERRED_TO:
            notes.report(rules.EMPTY_NAME, f"a {kind} has an empty name", node.location)
        if name in seen:
            message = f"{kind} {name!r} is there twice"
            notes.report(rules.DUPLICATE_NAME, message, node.location, found=name, related=(seen[name].location,))
        seen.setdefault(name, node)
