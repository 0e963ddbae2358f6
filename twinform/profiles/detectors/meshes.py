"""Mesh files in formats that not every consumer reads."""

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules.portability import COLLADA_MESH
from twinform.ir import Mesh, walk
from twinform.profiles.subject import Subject


def find_mesh_formats(subject: Subject, sink: DiagnosticSink) -> None:
    """Report every mesh that is COLLADA."""
    for node in walk(subject.document) if subject.document else ():
        if isinstance(node, Mesh) and (node.uri or "").lower().endswith(".dae"):
            sink.report(COLLADA_MESH, f"mesh {node.uri!r} is COLLADA", node.location, found=node.uri)
