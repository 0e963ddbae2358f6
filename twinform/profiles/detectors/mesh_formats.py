"""Mesh files in formats that not every consumer reads."""

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import COLLADA_MESH
from twinform.ir import Mesh, walk
from twinform.profiles.subject import ProfiledFile


def find_mesh_formats(subject: ProfiledFile, sink: DiagnosticSink) -> None:
    """Report every mesh that is COLLADA, and whether the file is there: only then something can be done about it."""
    for node in walk(subject.document) if subject.document else ():
        uri = node.uri or "" if isinstance(node, Mesh) else ""
        # A missing mesh is a finding of `check`, whoever reads the model. The format matters only
        # where the file is there, because only then can it be converted.
        if uri.lower().endswith(".dae"):
            absent = "" if subject.has_file(uri) else ", and not there"
            sink.report(COLLADA_MESH, f"mesh {uri!r} is COLLADA{absent}", node.location, found=uri)
