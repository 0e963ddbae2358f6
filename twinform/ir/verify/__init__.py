"""Whether a document makes sense beyond its schema: names, references, trees, axes, shapes, masses.

What is true of both formats is in `names`, `joints`, `tree`, `shapes` and `inertia`; `urdf` and `sdf` say which of it
is asked of a robot and of a model, and what only they know: materials, scopes, frames, sensors.
"""

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import UNKNOWN_COLLISION, UNKNOWN_GRIPPER_LINK
from twinform.ir.document import Document, Format
from twinform.ir.verify.verify_sdf import verify_sdf
from twinform.ir.verify.verify_urdf import verify_robot
from twinform.ir.versions import version_read

__all__ = ["verify", "verify_again"]

_OF_SDF = (UNKNOWN_COLLISION, UNKNOWN_GRIPPER_LINK)
"""References in the `<gazebo>` elements of URDF that may name what is there only in SDF."""


def verify(document: Document, sink: DiagnosticSink) -> None:
    """Report what is wrong with a document, in the order of its parts."""
    if document.format is Format.SDF:
        verify_sdf(document, sink)
        return
    if document.format is Format.MJCF:  # the schema and what was made it of have been checked
        return
    version = version_read("urdf", document.version)
    for model in document.models:
        verify_robot(model, sink, version)


def verify_again(document: Document, sink: DiagnosticSink) -> None:
    """Report what is wrong with what passes have made: errors, and what cannot be seen in URDF.

    The source as it was written has been reported on already.
    """
    found = DiagnosticSink(file=sink.file, strict=sink.strict)
    verify(document, found)
    # Warnings would be those about the source, phrased differently.
    sink.extend_new(each for each in found.diagnostics if each.is_error or each.rule in _OF_SDF)
