"""What frames are attached to in SDF, where a site of MJCF is only in a body: links, joints, frames and models.

A note says it, and counts while that still moves with the same link.
"""

from twinform.compiler.input.mjcf.carried_texts import report_stale
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Frame, Model, Pose
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.mjcf_texts import ATTACHED


def attach_frames(model: Model, sink: DiagnosticSink, *, is_world: bool) -> Model:
    """The model, or world, whose frames are attached to what they were, where that moves with the same link."""
    graph = FrameGraph(_with_still_frames(model) if is_world else model)
    return model.copy(frames=tuple(_attached(each, graph, sink) for each in model.frames))


def _attached(frame: Frame, graph: FrameGraph, sink: DiagnosticSink) -> Frame:
    found = find_annotation(frame, ATTACHED)
    if found is None:
        return frame
    frame = without_annotation(frame, ATTACHED)
    to = found.get("to") or None
    if to is not None and not graph.knows(to):
        message = f"there is no frame {to!r} any more, to which {frame.name!r} was attached"
        report_stale(sink, message, frame.source)
        return frame
    body = graph.body(to or MODEL, kind="frame" if to else "model")
    if body != frame.attached_to and not (body == WORLD and frame.attached_to is None):
        report_stale(sink, f"frame {frame.name!r} does not move with {to or MODEL!r} any more", frame.source)
        return frame
    pose = frame.pose or Pose.unchecked()
    base = pose.relative_to or frame.attached_to or MODEL
    return frame.copy(attached_to=to, pose=pose.copy(relative_to=base))


def _with_still_frames(world: Model) -> Model:
    """A world as a model whose own frames stand still: those of a model move with its first link."""
    return world.copy(frames=tuple(each.copy(attached_to=each.attached_to or WORLD) for each in world.frames))
