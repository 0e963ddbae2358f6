"""Choose another root link."""

import math
from typing import ClassVar, NamedTuple

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Format, Joint, Link, Model, Pose
from twinform.ir.defaults import direction
from twinform.ir.frames import WORLD, FrameGraph
from twinform.ir.scopes import outer_models
from twinform.ir.transform import Transform
from twinform.passes.shared.poses import in_radians
from twinform.passes.structure.gazebo_blocks import block_content, blocks_by_reference
from twinform.passes.structure.model_edit import EditContext, ModelEdit
from twinform.passes.structure.reversal import (
    ABOUT_A_POINT,
    REVERSIBLE,
    TURNING,
    block_measures_in_sensor,
    measures_in_sensor,
    opposite,
    swap_block,
    turn_axis,
)

# How far, in meters, the origin of a link may be from an axis through it: the rounding of zero.
_ON_AXIS = 1e-12


class Reroot(ModelEdit):
    """Make another link the root; the joints on the path to the old root are reversed exactly.

    Changes: 1. parent and child of the joints between the two roots; 2. their axes, which point the other way, so that
    positions, limits, damping, springs, mimics and calibrations keep their meaning; 3. in URDF their origins; where a
    link's origin is beside the axis on which it now hangs, a link without mass, `JOINT_reversed`, is put on the axis,
    so that no link's frame moves; it goes again when the root comes back; 4. in SDF frames that moved with a reversed
    joint, which are attached to the link that they moved with; 5. sensors of force and torque on these joints count
    from the other side.
    Never touches: where links are in each other, names, masses, shapes, the canonical link of SDF.
    Diagnostics: `unknown-name`; `irreversible-joint` for joints with two axes, planar joints, a joint to the world, and
    one with a sensor that measures in axes of its own.
    """

    name: ClassVar[str] = "reroot"
    example: ClassVar[str] = "reroot{link=imu_link}"

    link: str = Field(min_length=1, description="The link that becomes the root.")

    def edit(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with another root."""
        models = (model for model in outer_models(document) if self.model in (None, model.name))
        links = {link.name for model in models for link in model.links}
        if self.link not in links:
            sink.report(rules.UNKNOWN_NAME, f"no link is called {self.link!r}", document.location, found=self.link)
            return document
        return super().edit(document, sink)

    def edit_model(self, model: Model, place: EditContext) -> Model:
        """The model with another root."""
        if all(link.name != self.link for link in model.links):
            return model
        way = [joint for joint, _ in joints_to_root(model, self.link)]
        if not way or self._report_irreversible(model, way, place):
            return model
        if place.format is Format.URDF:
            return _reroot_urdf(model, self.link, way)
        from twinform.passes.structure.reversal import reroot_sdf  # noqa: PLC0415 - see above

        return reroot_sdf(model, way)

    def _report_irreversible(self, model: Model, way: list[Joint], place: EditContext) -> bool:
        there = blocks_by_reference(model.extensions)
        found = False
        for joint in way:
            why = _find_obstacle(joint)
            if joint.type != "fixed" and block_measures_in_sensor(block_content(there, joint.name)):
                why = "a sensor on it measures in axes of its own"
            if why:
                message = f"joint {joint.name!r} cannot be reversed to make {self.link!r} the root: {why}"
                place.sink.report(rules.IRREVERSIBLE_JOINT, message, joint.location, found=joint.type)
                found = True
        return found


def joints_to_root(model: Model, link: str) -> list[tuple[Joint, str]]:
    """The joints from a link up to its root, each with its parent body; of several joints with one child, the first."""
    graph = FrameGraph(model)
    links = {WORLD, *(each.name for each in model.links)}
    above: dict[str, tuple[Joint, str]] = {}
    for joint in model.joints:
        if joint.type != "gearbox" and joint.parent and joint.child:
            child = joint.child if joint.child in links else graph.body(joint.child)
            parent = joint.parent if joint.parent in links else graph.body(joint.parent)
            above.setdefault(child, (joint, parent))
    way: list[tuple[Joint, str]] = []
    seen = {link}
    while link in above:
        way.append(above[link])
        link = above[link][1]
        if link in seen:
            break
        seen.add(link)
    return way


def _find_obstacle(joint: Joint) -> str:
    if joint.parent == WORLD:
        return "it holds the robot to the world"
    if joint.type not in REVERSIBLE:
        # A chain of two rotations cannot be expressed the other way round by one axis each with the
        # same positions.
        return f"a {joint.type} joint moves in several ways, one after the other"
    if measures_in_sensor(joint):
        return "a sensor on it measures in axes of its own"
    return ""


class _ReversedJoint(NamedTuple):
    """A reversed joint; for a link beside the axis also a helper link on the axis, and a joint that holds the link."""

    joint: Joint
    helper: Link | None = None
    holder: Joint | None = None


def _reroot_urdf(model: Model, root: str, way: list[Joint]) -> Model:
    """The robot with another root; `way` has the joints from the new root up to the old one. No link moves."""
    graph = FrameGraph(model)
    made = {
        joint.name: _reverse_joint(joint, graph.pose(joint.name, joint.parent or "", kind="joint")) for joint in way
    }
    joints: list[Joint] = []
    for joint in model.joints:
        new = made.get(joint.name)
        joints += [joint] if new is None else [each for each in (new.joint, new.holder) if each is not None]
    carriers = {joint.child: joint.name for joint in joints}
    links = [_hang_from(link, carriers.get(link.name), root) for link in model.links]
    links += [new.helper for new in made.values() if new.helper is not None]
    names = {joint.name for joint in way}
    extensions = tuple(swap_block(each) if each.reference in names else each for each in model.extensions)
    changed = model.copy(links=tuple(links), joints=tuple(joints), extensions=extensions)
    return _remove_idle_helpers(changed)


def _hang_from(link: Link, carrier: str | None, root: str) -> Link:
    if link.name == root:
        return link.copy(pose=None)
    if link.pose is not None and link.pose.relative_to == carrier:
        return link
    return link.copy(pose=Pose(relative_to=carrier))


def _reverse_joint(joint: Joint, at: Transform) -> _ReversedJoint:
    """The joint between the same two links in the other direction; `at` is its frame in its old parent."""
    parent, child = joint.parent, joint.child
    axis = direction(joint.axis, Format.URDF)
    back = in_radians(at.inverse(), child)
    if not _is_beside(joint, at):
        update = {"parent": child, "child": parent, "pose": back, "axis": turn_axis(joint, opposite(at.rotate(axis)))}
        return _ReversedJoint(joint.copy(**update))
    # In URDF a link's frame is that of its joint, and on the other side of a turning joint that may
    # lie beside the axis. The frame could be moved and the contents with it, but a frame is what
    # other programs know of a link.
    name = _helper_name(joint.name)
    update = {"parent": child, "child": name, "pose": Pose(relative_to=child), "axis": turn_axis(joint, opposite(axis))}
    turned = joint.copy(**update)
    helper = Link(name=name, pose=Pose(relative_to=joint.name), source=joint.source)
    pose = back.copy(relative_to=name)
    holder = Joint(name=f"{name}_joint", type="fixed", parent=name, child=parent, pose=pose, source=joint.source)
    return _ReversedJoint(turned, helper, holder)


def _helper_name(joint: str) -> str:
    """The name of the helper link on the axis of a reversed joint."""
    return f"{joint}_reversed"


def _is_beside(joint: Joint, at: Transform) -> bool:
    """Whether the origin of the old parent, which becomes the child, is where the joint cannot have its frame."""
    x, y, z = at.translation
    if joint.type in ABOUT_A_POINT:
        return math.hypot(x, y, z) > _ON_AXIS
    if joint.type not in TURNING:
        return False
    a, b, c = at.rotate(direction(joint.axis, Format.URDF))
    length = math.hypot(a, b, c) or 1.0
    return math.hypot(y * c - z * b, z * a - x * c, x * b - y * a) / length > _ON_AXIS


def _remove_idle_helpers(model: Model) -> Model:
    """The model without helper links of an earlier change of roots that are not needed any more."""
    there = blocks_by_reference(model.extensions)
    for joint in model.joints:
        name = _helper_name(joint.name)
        link = next((each for each in model.links if each.name == name), None)
        holder = next((each for each in model.joints if each.child == name and each.name == f"{name}_joint"), None)
        if link is None or holder is None or holder.type != "fixed" or name in there or holder.name in there:
            continue
        below = [each for each in model.joints if each.parent == name]
        if len(below) == 1 and below[0] is joint and _is_bare(link):
            model = _remove_helper(model, joint, holder, link)
    return model


def _is_bare(link: Link) -> bool:
    return not (link.inertial or link.visuals or link.collisions or link.opaque)


def _remove_helper(model: Model, joint: Joint, holder: Joint, link: Link) -> Model:
    """The model without a helper link: the joint hangs directly from the parent of the holder."""
    at = Transform.from_pose(holder.pose).compose(Transform.from_pose(joint.pose))
    moved = joint.copy(parent=holder.parent, pose=in_radians(at, holder.parent))
    joints = tuple(moved if each is joint else each for each in model.joints if each is not holder)
    links = tuple(each for each in model.links if each is not link)
    return model.copy(joints=joints, links=links)
