"""Leave out elements of URDF that are there a second time where readers read one."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.diagnostics.rules.structure import REPEATED_ELEMENT
from twinform.ir import Document, Format, Inertial, Joint, Link, Node, Opaque, replace_fields, rewrite
from twinform.ir.visual import Collision, Material, Visual
from twinform.passes.framework.base import Pass

_SINGLE: dict[type[Node], frozenset[str]] = {
    Link: frozenset({"inertial"}),
    Inertial: frozenset({"origin", "mass", "inertia"}),
    Visual: frozenset({"origin", "geometry", "material"}),
    Collision: frozenset({"origin", "geometry"}),
    Material: frozenset({"color", "texture"}),
    Joint: frozenset({
        "origin", "parent", "child", "axis", "limit", "dynamics", "mimic", "safety_controller", "calibration",
    }),
}  # fmt: skip
_FIELDS = {"origin": "pose", "texture": "texture", "parent": "parent", "child": "child"}
"""The fields of elements that are called otherwise."""


class DropRepeats(Pass):
    """Leave out what is there twice: readers take the first, MuJoCo refuses the file.

    Changes URDF: a second `<material>`, `<origin>`, `<geometry>`, `<limit>` and so on, beside one in its place, goes.

    Never touches: the first of them, elements of which there may be several, and SDF.
    Diagnostics: none of its own, as `repeated-element` is found when the file is read; each has an entry of the ledger,
    *dropped*.
    """

    name = "drop-repeats"
    example: ClassVar[str] = "drop-repeats"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document without repeated elements."""
        if document.format is not Format.URDF:
            return document
        for kind, names in _SINGLE.items():
            document = rewrite(document, kind, lambda node, names=names: _thinned(node, names, sink))
        return document


def _thinned(node: Node, names: frozenset[str], sink: DiagnosticSink) -> Node:
    kept = tuple(part for part in node.opaque if not _is_repeated(node, part, names))
    for part in node.opaque:
        if part not in kept and part.element is not None:
            message = f"a second <{part.element.name}> is left out: readers take the first"
            sink.account(Fate.DROPPED, REPEATED_ELEMENT, message, part.location if part.source else node.location)
    return replace_fields(node, opaque=kept)


def _is_repeated(node: Node, part: Opaque, names: frozenset[str]) -> bool:
    element = part.element
    if element is None or part.at or element.name not in names:
        return False
    return getattr(node, _FIELDS.get(element.name, element.name), True) is not None
