"""Moving joints outside the kinematic tree into `<gazebo>` elements as SDF joints."""

from collections.abc import Mapping, Sequence
from functools import partial

from twinform.ir import GazeboExtension, Joint, Model, Pose, rewrite
from twinform.ir.frames import MODEL, FrameGraph
from twinform.ir.transform import Transform
from twinform.passes.carriers.carriers import to_element
from twinform.passes.legalise.to_urdf.to_urdf_pass import UrdfKeeper


def cut_joints(
    model: Model, kept: Sequence[Joint], cut: Sequence[Joint], parent_joint: Mapping[str, Joint], keeper: UrdfKeeper
) -> Model:
    """The model with only the joints that are kept, and each of the others in a `<gazebo>` element.

    `parent_joint` has the joint of the tree that holds a link: the pose of what is cut is in the frame that this link
    has in URDF. Poses relative to a joint that is cut become relative to the model.
    """
    graph = FrameGraph(model)
    extensions = list(model.extensions)
    for joint in cut:
        child = joint.child or ""
        base, kind = keeper.frame_of(child, parent_joint.get(child))
        placed = graph.pose(joint.name, base, kind="joint", base=kind)
        # libsdformat copies what stands in <gazebo> of the robot into the model, so Gazebo still
        # closes the loop.
        blob = to_element(joint.copy(pose=placed.to_pose()), "joint", "sdf")
        extensions.append(GazeboExtension(content=(blob,), source=joint.source))
    model = model.copy(joints=tuple(kept), extensions=tuple(extensions))
    names = frozenset(joint.name for joint in cut)
    return rewrite(model, Pose, partial(_without_cut, graph, names))


def _without_cut(graph: FrameGraph, names: frozenset[str], pose: Pose) -> Pose:
    """A pose relative to a joint that was cut, in the frame of the model: either of its links may be posed by it."""
    joint = pose.relative_to
    if joint not in names:
        return pose
    return graph.pose(joint, MODEL, kind="joint", base="model").compose(Transform.from_pose(pose)).to_pose(MODEL)
