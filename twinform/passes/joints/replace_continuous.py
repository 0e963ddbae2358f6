"""Replace continuous joints of SDF by revolute ones, which the engines of Gazebo support."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import REPLACED_CONTINUOUS
from twinform.ir import Axis, Document, Format, Joint, Limit, rewrite
from twinform.passes.framework.pass_base import Pass


class ReplaceContinuous(Pass):
    """Make `continuous` joints of SDF `revolute` ones without an end.

    Changes documents of SDF:

    1. the type of each continuous joint, in worlds and nested models too;
    2. `lower` and `upper` of such a joint, which mean nothing before and would mean something now, are taken out.

    Never touches: effort, velocity and dynamics, nor URDF, whose continuous joints are revolute in SDF anyway.
    Diagnostics: `replaced-continuous` for each joint.
    """

    name = "replace-continuous"
    example: ClassVar[str] = "replace-continuous"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document without continuous joints."""
        if document.format is not Format.SDF:
            return document
        return rewrite(document, Joint, lambda joint: _make_revolute(joint, sink))


def _make_revolute(joint: Joint, sink: DiagnosticSink) -> Joint:
    if joint.type != "continuous":
        return joint
    message = f"joint {joint.name!r} was continuous and is revolute, without limits"
    sink.report(REPLACED_CONTINUOUS, message, joint.location.at("@type"), found=joint.name)
    # No engine of Gazebo has `continuous` (DART makes such a joint a fixed one), and Drake turns
    # it. An SDF file may be meant for either, so nothing is changed unless this pass is asked for.
    return joint.copy(type="revolute", axis=_remove_range(joint.axis))


def _remove_range(axis: Axis | None) -> Axis | None:
    if axis is None or axis.limit is None:
        return axis
    limit = axis.limit.copy(lower=None, upper=None)
    return axis.copy(limit=None if limit == Limit() else limit)
