"""Converting frames to massless links on fixed joints."""

from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Frame, Joint, Link, Model, Pose, count_parts
from twinform.ir.frames import MODEL, FrameGraph
from twinform.passes.carriers.annotations import SYNTHESIZED, annotate_synthesized, is_synthesized, without_annotation
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.nodes import reserve_name
from twinform.passes.shared.poses import FRAME, POSE, pose_attributes


class TurnFramesIntoLinks(ToUrdfPass):
    """Make every frame a link without mass, fixed to the link that the frame moves with.

    Changes: 1. the link has the frame's name, the joint that name and `_joint`; 2. a model without any link gets one,
    called like the model, because URDF needs a root.
    Diagnostics: in the ledger `frame-made-link`, but not for a frame that `place-free-links` writes as one again.
    """

    name: ClassVar[str] = "turn-frames-into-links"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model without frames."""
        if model.links and not model.frames:
            return model
        taken = {node.name for node in (*model.links, *model.joints, *model.frames)}
        if not model.links:
            model = model.copy(links=(annotate_synthesized(Link.unchecked(name=reserve_name(model.name, taken))),))
        graph = FrameGraph(model)
        links, joints = list(model.links), list(model.joints)
        floating = {joint.name for joint in model.joints if joint.type == "floating"} if keeper.carriers else set[str]()
        for frame in model.frames:
            joint = reserve_name(f"{frame.name}_joint", taken)
            body = graph.body(frame.name, kind="frame")
            links.append(_make_link(frame, body, keeper))
            # a synthesized one stands for a nested model, and PlaceFreeLinks writes that of a floating joint as a frame
            if not is_synthesized(frame) and frame.name not in floating:
                message = f"frame {frame.name!r} becomes a link without mass"
                keeper.account(rules.FRAME_MADE_LINK, message, frame.location, count_parts(frame))
            made = Joint.unchecked(name=joint, type="fixed", parent=body, child=frame.name, source=frame.source)
            joints.append(annotate_synthesized(made))
        return model.copy(links=tuple(links), joints=tuple(joints), frames=())


def _make_link(frame: Frame, body: str, keeper: UrdfKeeper) -> Link:
    pose = frame.pose or Pose.unchecked()
    if not pose.relative_to:
        pose = pose.copy(relative_to=frame.attached_to or MODEL)
    link = Link.unchecked(name=frame.name, pose=pose, source=frame.source, opaque=frame.opaque)
    if is_synthesized(frame):
        return keeper.annotate(
            without_annotation(link, SYNTHESIZED), FRAME, attributes={"attached_to": None}, always=True
        )
    holder = frame.attached_to or MODEL
    link = keeper.annotate(link, FRAME, attributes={"attached_to": None if holder == body else holder}, always=True)
    return keeper.annotate(link, POSE, attributes=pose_attributes(frame.pose)) if pose_attributes(frame.pose) else link
