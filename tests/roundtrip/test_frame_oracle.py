"""The frame graph against matrices of numpy that are multiplied from the root down."""

import numpy as np
import numpy.typing as npt
from hypothesis import given

from tests.profile import examples
from twinform.ir import Document, Format, Model, Pose
from twinform.ir.frames import MODEL, FrameGraph
from twinform.testing import strategies

Matrix = npt.NDArray[np.float64]


def _matrix(pose: Pose | None) -> Matrix:
    """The homogeneous matrix of a pose: R = Rz(yaw) Ry(pitch) Rx(roll), as the SDF specification has it."""
    roll, pitch, yaw = (pose.rpy if pose and pose.rpy else None) or (0.0, 0.0, 0.0)
    (cr, sr), (cp, sp), (cy, sy) = ((np.cos(angle), np.sin(angle)) for angle in (roll, pitch, yaw))
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    made = np.eye(4)
    made[:3, :3] = about_z @ about_y @ about_x
    made[:3, 3] = (pose.xyz if pose else None) or (0.0, 0.0, 0.0)
    return made


def _places(model: Model) -> dict[tuple[str, str], Matrix]:
    """Where links, joints and frames are in the model: each after what it is posed in, however they are ordered."""
    bases: dict[tuple[str, str], tuple[str, Pose | None]] = {}
    for link in model.links:
        bases["link", link.name] = (link.pose.relative_to if link.pose else None) or MODEL, link.pose
    for joint in model.joints:
        bases["joint", joint.name] = (joint.pose.relative_to if joint.pose else None) or joint.child or "", joint.pose
    for frame in model.frames:
        base = (frame.pose.relative_to if frame.pose else None) or frame.attached_to or MODEL
        bases["frame", frame.name] = base, frame.pose
    found: dict[tuple[str, str], Matrix] = {("model", MODEL): np.eye(4)}
    names = {name: (kind, name) for kind, name in [*bases, *found]}
    while len(found) <= len(bases):
        for key, (base, pose) in bases.items():
            if key not in found and names[base] in found:
                found[key] = found[names[base]] @ _matrix(pose)
    return found


@examples()
@given(strategies.robots() | strategies.sdf_models())
def test_frames_are_where_numpy_computes_them(document: Document) -> None:
    model = document.models[0]
    graph, root = FrameGraph(model), MODEL
    for (kind, name), matrix in _places(model).items():
        where = graph.pose(name, root, kind=kind, base="model")  # pyright: ignore[reportArgumentType] - they are literals
        for point in ((0.0, 0.0, 0.0), (1.0, 2.0, 3.0)):
            expected = (matrix @ np.array([*point, 1.0]))[:3]
            np.testing.assert_allclose(where.apply(point), expected, rtol=0, atol=1e-9)


@examples(0.3)
@given(strategies.sdf_models(min_links=2))
def test_there_and_back_between_any_two_frames_is_nothing(document: Document) -> None:
    assert document.format is Format.SDF
    model = document.models[0]
    graph = FrameGraph(model)
    for one, other in zip(model.links, model.links[1:], strict=False):
        there, back = graph.pose(one.name, other.name), graph.pose(other.name, one.name)
        np.testing.assert_allclose(there.compose(back).apply((1, 2, 3)), (1, 2, 3), atol=1e-9)
