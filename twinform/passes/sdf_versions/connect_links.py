"""Joints between links instead of frames, as before SDF 1.8."""

from functools import partial
from typing import ClassVar

from twinform.diagnostics import rules
from twinform.diagnostics.rules import DANGLING_FRAME
from twinform.ir import Document, Joint, Model, Opaque, World, count_parts, rewrite
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.passes.shared.joint_ends import describe_ends, report_self_joint, resolve_ends
from twinform.passes.shared.nodes import pose_piece

_SINCE = (1, 8)
_FRAMES = (1, 7)
"""Since this version there are frames; what a joint is at is theirs to say."""
_UNKNOWN = MODEL
"""What a frame moves with where all links are in includes that were not read."""


class ConnectLinks(VersionPass):
    """Let every joint connect the links that the frames at its ends move with.

    Changes: a parent or child that is a frame or a model. The joint stays where it is.
    Never touches: an end that only the file of an include knows.
    Diagnostics: `self-joint` where both ends move with one link; in the ledger `other-words`.
    """

    name: ClassVar[str] = "connect-links"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with joints between links."""
        document = rewrite(document, Model, partial(_in_model, keeper, self.number >= _FRAMES))
        return rewrite(document, World, partial(_in_world, keeper, self.number >= _FRAMES))


def _in_model(keeper: VersionKeeper, frames: bool, model: Model) -> Model:
    links = {WORLD, *(link.name for link in model.links)}
    if all(joint.parent in links and joint.child in links for joint in model.joints):
        return model
    return model.copy(joints=_connect(model, links, keeper, frames=frames))


def _in_world(keeper: VersionKeeper, frames: bool, world: World) -> World:
    if not world.joints:
        return world
    return world.copy(joints=_connect(world, {WORLD}, keeper, frames=frames))


def _connect(holder: Model | World, links: set[str], keeper: VersionKeeper, *, frames: bool) -> tuple[Joint, ...]:
    graph = FrameGraph(holder)
    if holder.includes:  # names that only their files know may be links
        ends = {end for joint in holder.joints for end in (joint.parent, joint.child) if end}
        links |= {end for end in ends if not graph.knows(end)}
    return tuple(_resolve(joint, links, graph, keeper, frames=frames) for joint in holder.joints)


def _resolve(joint: Joint, links: set[str], graph: FrameGraph, keeper: VersionKeeper, *, frames: bool) -> Joint:
    resolved, pieces = resolve_ends(joint, links, graph)
    if not pieces:
        return joint
    # From 1.7 on, frames exist and the reader of the include finds the link; before that nobody
    # can.
    if _UNKNOWN in (resolved.parent, resolved.child):
        if frames:
            return joint
        end = joint.parent if resolved.parent == _UNKNOWN else joint.child
        message = f"joint {joint.name!r} is at {end!r}, which moves with no link that is known"
        raise FrameError(DANGLING_FRAME, message, joint.location, end or "")
    # Two frames of one link: libsdformat refuses a joint that connects a link to itself.
    if resolved.parent == resolved.child:
        report_self_joint(joint, resolved, keeper.sink)
        return joint
    message = describe_ends(joint, pieces)
    gone: tuple[str, ...] = ()
    weight = len(pieces)
    # A joint is posed in its child. Another child means other numbers for the same place.
    if resolved.pose is not joint.pose:
        gone = ("pose",) if joint.pose is None else ()
        pieces = [*pieces, *_pose_pieces(joint)]
        weight += count_parts(joint.pose) if joint.pose else 0
    condition = VersionCondition(since=_SINCE, without=gone)
    return keeper.keep(resolved, pieces, condition, rules.OTHER_WORDS, message, joint.location, weight)


def _pose_pieces(joint: Joint) -> list[Opaque]:
    return [pose_piece(joint.pose)] if joint.pose else []
