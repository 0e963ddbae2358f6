"""Moves joints of SDF that URDF cannot have into `<gazebo>` elements: those that close loops, and gearboxes."""

from collections.abc import Mapping, Sequence
from functools import partial

from twinform.diagnostics import Fate, rules
from twinform.ir import Element, GazeboExtension, Joint, Model, Opaque, Pose, rewrite
from twinform.ir.foreign_joints import usual_word
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import EXTENSION, without_annotation
from twinform.passes.carriers.carriers import carry, to_element
from twinform.passes.legalise.to_urdf_pass import UrdfKeeper
from twinform.passes.shared.loop_elements import write_loop


def cut_joints(
    model: Model, kept: Sequence[Joint], cut: Sequence[Joint], parent_joint: Mapping[str, Joint], keeper: UrdfKeeper
) -> Model:
    """The model with the joints in `cut` moved into `<gazebo>` elements, or those that they came from.

    `parent_joint` is the joint of the tree that holds a link, which decides the frame of that link in URDF and so the
    pose of a cut joint. Poses relative to a cut joint become relative to the model.
    """
    graph = FrameGraph(model)
    extensions = list(model.extensions)
    elements: list[Opaque] = []

    def place(joint: Joint, link: str) -> Transform:
        base, kind = keeper.frame_of(link, parent_joint.get(link)) if link != WORLD else (WORLD, "world")
        return graph.pose(joint.name, base, kind="joint", base=kind)

    for joint in cut:
        placed = place(joint, joint.child or "")
        element = write_loop(joint, place(joint, joint.parent or WORLD), placed)
        if element is not None:
            elements.append(Opaque.unchecked(element=element, source=joint.source))
            _account_for_name(joint, element, keeper)
            continue
        # libsdformat copies what stands in <gazebo> of the robot into the model, so Gazebo still
        # closes the loop.
        blob = to_element(without_annotation(joint, EXTENSION).copy(pose=placed.to_pose()), "joint", "sdf")
        extensions.append(GazeboExtension.unchecked(content=(blob,), source=joint.source))
    model = carry(model.copy(joints=tuple(kept), extensions=tuple(extensions)), elements, "urdf")
    names = frozenset(joint.name for joint in cut)
    return rewrite(model, Pose, partial(_repose_from_cut, graph, names))


def _account_for_name(joint: Joint, element: Element, keeper: UrdfKeeper) -> None:
    if element.get("name") is None:
        message = f"<{usual_word(element)}> has no name, and its joint {joint.name!r} has one in SDF"
        keeper.sink.account(Fate.DROPPED, rules.CUT_LOOP, message, joint.location.at("@name"))


def _repose_from_cut(graph: FrameGraph, names: frozenset[str], pose: Pose) -> Pose:
    """A pose relative to a cut joint, in the frame of the model."""
    joint = pose.relative_to
    if joint not in names:
        return pose
    return graph.pose(joint, MODEL, kind="joint", base="model").compose(Transform.from_pose(pose)).to_pose(MODEL)
