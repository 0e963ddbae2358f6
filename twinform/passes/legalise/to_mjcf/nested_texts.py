"""Carriers of nested models that an edit has put into a document of MJCF, where all links are bodies of one tree.

Each has the text of a frame: where the model is, what else it has, and which bodies, joints and sites are its parts. A
frame that an edit has put on a link between the joints of one body has a text too.
"""

from collections.abc import Iterable, Iterator
from typing import TypeVar

from twinform.ir import Frame, Joint, Link, Opaque, World
from twinform.ir.frames import MODEL
from twinform.ir.scopes import SCOPE
from twinform.passes.carriers.annotations import annotation, find_annotation
from twinform.passes.carriers.mjcf_texts import PART
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext
from twinform.passes.legalise.to_mjcf.written_file import WrittenFile
from twinform.passes.shared.poses import NESTED

AnyPart = TypeVar("AnyPart", Link, Joint, Frame)


def nested_frames(context: MjcfContext, file: WrittenFile) -> Iterator[tuple[Frame, Frame]]:
    """Yield the frames that stand for nested models, each as it is carried and as it is in the flattened model."""
    tops = {each.name for each in context.holder.models} if isinstance(context.holder, World) else set[str]()
    for frame in file.flat.frames:
        if find_annotation(frame, NESTED) is None or frame.name in tops:
            continue
        notes = (*frame.opaque, *_parts(frame.name + SCOPE, context, file))
        around = f"{frame.name.partition(SCOPE)[0]}{SCOPE}" if tops else ""
        yield _placed(frame, file).copy(name=frame.name.removeprefix(around), opaque=notes), frame


def frames_between(file: WrittenFile) -> Iterator[tuple[Frame, Frame]]:
    """Yield the frames that move with a link between the joints of one body, which has no site for them.

    Each is as it is carried, and as it is in the flattened model.
    """
    if not file.hidden:
        return
    for frame in file.flat.frames:
        if frame.name not in file.context.written_sites and file.graph.body(frame.name, kind="frame") in file.hidden:
            yield _placed(frame, file).copy(name=frame.name.rpartition(SCOPE)[2]), frame


def _placed(frame: Frame, file: WrittenFile) -> Frame:
    """A frame posed in the link that it moves with."""
    graph = file.graph
    body = graph.body(frame.name, kind="frame")
    if not graph.knows(body) or body == MODEL:
        return frame
    return frame.copy(attached_to=body, pose=graph.pose(frame.name, body, kind="frame", base="link").to_pose())


def _parts(scope: str, context: MjcfContext, file: WrittenFile) -> Iterator[Opaque]:
    """Yield annotations on what is in a nested model and in no other one in that."""
    flat, written = file.flat, context.written_joints
    for link in _inside(flat.links, scope):
        context.unnamed.discard(("body", context.written_bodies.get(link.name, "")))
        yield _part("link", link.name, scope, context.written_bodies.get(link.name))
    for joint in _inside(flat.joints, scope):
        names = written.get(joint.name, ())
        context.unnamed.difference_update(("joint", each) for each in names)
        yield _part("joint", joint.name, scope, names[-1] if names else None, _body(joint, context))
    for frame in _inside(flat.frames, scope):
        if frame.name in context.written_sites:
            yield _part("frame", frame.name, scope, context.written_sites[frame.name])


def _part(kind: str, name: str, scope: str, written: str | None, holds: str | None = None) -> Opaque:
    attributes = {"kind": kind, "name": name.removeprefix(scope), "as": written, "holds": None if written else holds}
    return annotation(PART, attributes=attributes)


def _body(joint: Joint, context: MjcfContext) -> str | None:
    return context.written_bodies.get(joint.child or "")


def _inside(parts: Iterable[AnyPart], scope: str) -> Iterator[AnyPart]:
    """Yield the parts whose names begin with a scope, and have no other one behind that."""
    return (each for each in parts if each.name.startswith(scope) and SCOPE not in each.name.removeprefix(scope))
