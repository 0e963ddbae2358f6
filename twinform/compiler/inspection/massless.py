"""Moving links without mass: what joints move and has no `<inertial>` anywhere."""

from twinform.diagnostics import DiagnosticSink, Severity
from twinform.diagnostics.rules import MISSING_INERTIAL
from twinform.ir import Document, Format
from twinform.passes.carriers.annotations import find_annotation, is_synthesized
from twinform.passes.carriers.joint_chains import PART
from twinform.passes.shared.moving_bodies import moving_bodies, neighbors

_HELP = "write one, or compute it from the shapes: --passes fill-inertia{density=...}"


def report_massless(document: Document, sink: DiagnosticSink) -> None:
    """Report what moves without mass. In SDF it has one kilogram, and that is an info."""
    if document.format is Format.SDF:
        for link in (link for body in moving_bodies(document) for link in body if link.inertial is None):
            # In SDF the default is often meant. In URDF, Gazebo drops such a link.
            message = f"link {link.name!r} moves but has no <inertial>; simulators take 1 kg and 1 kg m^2"
            sink.report(
                MISSING_INERTIAL, message, link.location, expected="<inertial>", help=_HELP, severity=Severity.INFO
            )
        return
    for each in neighbors(document):
        if any(link.inertial for link in each.child):
            continue
        moved = next(link for link in each.child if link.name == each.joint.child)
        if is_synthesized(moved) or find_annotation(moved, PART):  # synthesized for a joint that URDF does not have
            continue
        others = tuple(link.location for link in each.child if link is not moved)
        joined = f", nor has any of the {len(others)} fixed to it" if others else ""
        message = f"joint {each.joint.name!r} moves link {moved.name!r}, which has no <inertial>{joined}"
        sink.report(MISSING_INERTIAL, message, moved.location, expected="<inertial>", help=_HELP, related=others)
