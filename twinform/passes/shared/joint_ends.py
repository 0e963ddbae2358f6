"""Joints that connect frames, converted to joints between links."""

from collections.abc import Container

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Joint, Opaque, Pose
from twinform.ir.frames import FrameGraph
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.shared.nodes import text_piece
from twinform.passes.shared.pose_notation import pose_attributes

ENDS = "ends"
"""The annotation on a joint that connected frames: `<tf:ends parent="mount" child="flange"/>`."""


def resolve_ends(joint: Joint, links: Container[str], graph: FrameGraph) -> tuple[Joint, list[Opaque]]:
    """The joint between the links that its ends move with, and the replaced ends as carrier pieces.

    The joint stays in place: where its child changes, its pose names the frame that it was relative to.

    Raises:
        FrameError: an end is not known.
    """
    changed: dict[str, object] = {}
    pieces: list[Opaque] = []
    for end, name in (("parent", joint.parent), ("child", joint.child)):
        if name is None or name in links:
            continue
        body = graph.body(name, source=joint.source)
        if body != name:
            changed[end] = body
            pieces.append(text_piece(end, name))
    # A joint without a frame is posed in its child, which changes to another link here.
    if "child" in changed and not (joint.pose and joint.pose.relative_to):
        changed["pose"] = (joint.pose or Pose.unchecked()).copy(relative_to=joint.child)
    return (joint.copy(**changed) if changed else joint), pieces


def joint_pose_attributes(joint: Joint) -> dict[str, str | None]:
    """The attributes of the annotation on the pose of a joint whose ends may have been resolved."""
    attributes = pose_attributes(joint.pose)
    ends = find_annotation(joint, ENDS)
    if ends is not None and attributes.get("relative_to") == ends.get("child"):
        attributes.pop("relative_to", None)  # the default, once the child is back
    return attributes


def report_self_joint(joint: Joint, resolved: Joint, sink: DiagnosticSink) -> None:
    """Report a joint whose ends move with one link."""
    message = f"both ends of joint {joint.name!r} move with link {resolved.child!r}"
    sink.report(rules.SELF_JOINT, message, joint.location, found=joint.child)


def named_ends(pieces: list[Opaque]) -> str:
    """The names of the replaced ends, for a message."""
    return " and ".join(repr(piece.element.text) for piece in pieces if piece.element)
