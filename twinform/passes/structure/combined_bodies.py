"""The mass, center and inertia of one link, and of several links as one body."""

import math
from collections.abc import Sequence

from twinform.diagnostics import DiagnosticSink, Severity
from twinform.diagnostics.rules import INDEFINITE_INERTIA
from twinform.ir import Format, Inertial, Link, Pose
from twinform.ir.frames import FrameGraph
from twinform.ir.solids import Solid, combined, placed, turned, with_tensor, written_solid
from twinform.ir.transform import Transform
from twinform.passes.framework.assets import NO_ASSETS
from twinform.passes.shared.link_shapes import automatic
from twinform.passes.shared.mesh_solids import Meshes

_NO_MESHES = Meshes(NO_ASSETS)
"""By default no inertia is computed from a mesh; `fill-inertia` does that."""


def body_of(link: Link, graph: FrameGraph, format_: Format, meshes: Meshes = _NO_MESHES) -> Solid:
    """The mass, center and inertia of a link in its own frame, with the defaults of the format.

    `meshes` has the mesh files that an automatic inertia is computed from.

    Raises:
        NoSolidError: the inertia is automatic and cannot be computed.
        FrameError: a pose is in an unknown frame.
    """
    inertial = link.inertial
    if inertial is None:
        return written_solid(None, format_)
    if inertial.auto:
        return automatic(link, inertial, link.collisions, graph, meshes)
    return placed(written_solid(inertial, format_), graph.resolve(inertial.pose, link.name, link.name))


def add_guests(link: Link, own: Solid, guests: Sequence[Solid], sink: DiagnosticSink) -> Link:
    """The link with the mass of other solids in its frame; the axes of its inertia stay as they are written.

    A result that overflows is reported as an error.
    """
    heavy = [guest for guest in guests if guest.mass]
    if not heavy:
        return link
    whole = combined([own, *heavy])
    if not all(map(math.isfinite, (whole.mass, *whole.center, *whole.inertia))):
        message = (
            f"the mass and inertia of link {link.name!r} with all that is lumped into it are too large for a double"
        )
        sink.report(INDEFINITE_INERTIA, message, link.location, severity=Severity.ERROR)
        return link
    return link.copy(inertial=write_solid(link.inertial or Inertial.unchecked(), whole))


def write_solid(inertial: Inertial, whole: Solid) -> Inertial:
    """The inertial with the values of a solid in the frame of its link; the axes of the inertia stay as written."""
    written = None if inertial.auto else inertial.pose
    axes = Transform(rotation=Transform.from_pose(written).rotation)
    return inertial.copy(
        auto=None,
        mass=whole.mass,
        pose=_pose_at_center(written, whole),
        inertia=with_tensor(inertial.inertia, turned(whole.inertia, axes.inverse())),
    )


def _pose_at_center(written: Pose | None, whole: Solid) -> Pose:
    """The pose of an inertial with another center of mass, in the frame of the link."""
    pose = written or Pose.unchecked(rpy=(0.0, 0.0, 0.0))
    return pose.copy(xyz=whole.center, relative_to=None)
