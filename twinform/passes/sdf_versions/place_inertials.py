"""Poses of inertials in the link frame, as since SDF 1.8."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Document, Link, Model, rewrite
from twinform.ir.frames import FrameGraph
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass


class PlaceInertials(VersionPass):
    """Pose inertials in their links.

    Changes: 1. a pose that names another frame, as 1.7 alone has it, is moved; 2. an empty name, which means nothing,
    goes.
    Diagnostics: in the ledger `other-words` as approximated.
    """

    name: ClassVar[str] = "place-inertials"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with inertials in their links."""
        return rewrite(document, Model, lambda model: _place_all(model, keeper))


def _place_all(model: Model, keeper: VersionKeeper) -> Model:
    poses = [link.inertial.pose for link in model.links if link.inertial and link.inertial.pose]
    if all(pose.relative_to is None for pose in poses):
        return model
    graph = FrameGraph(model)
    return model.copy(links=tuple(_place(link, graph, keeper.sink) for link in model.links))


def _place(link: Link, graph: FrameGraph, sink: DiagnosticSink) -> Link:
    inertial = link.inertial
    pose = inertial.pose if inertial else None
    if inertial is None or pose is None or pose.relative_to is None:
        return link
    placed = pose.copy(relative_to=None)
    # An empty name is written by exporters and means the link, as everywhere before 1.8.
    if pose.relative_to:
        placed = graph.resolve(pose, link.name, link.name).to_pose()
        message = f"the inertial of link {link.name!r} is posed relative to {pose.relative_to!r}"
        sink.account(Fate.APPROXIMATED, rules.OTHER_WORDS, message, pose.location)
    return link.copy(inertial=inertial.copy(pose=placed))
