"""Leave out elements of URDF that are there a second time where readers read one."""

from functools import cache, partial
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.diagnostics.rules import REPEATED_ELEMENT
from twinform.ir import Document, Format, Inertial, Joint, Link, Node, Opaque, replace_fields, rewrite
from twinform.ir.visual import Collision, Material, Visual
from twinform.passes.framework.pass_base import Pass
from twinform.schemas import Fact, table

_HOLDERS: dict[type[Node], tuple[str, ...]] = {
    Link: ("link",),
    Inertial: ("link", "inertial"),
    Visual: ("link", "visual"),
    Collision: ("link", "collision"),
    Material: ("material",),
    Joint: ("joint",),
}
"""By class of node the path to its row in the facts table, which says what elements may stand once."""


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
        for kind, way in _HOLDERS.items():
            document = rewrite(document, kind, lambda node, way=way: _remove_repeats(node, _single_elements(way), sink))
        return document


@cache
def _single_elements(way: tuple[str, ...]) -> dict[str, tuple[str, ...]]:
    """For each element that may stand once in an element of URDF, the fields of the IR that hold its values."""
    definition, *steps = way
    holder = table("urdf").definitions[definition]
    for step in steps:
        holder = next(row for row in holder.children if row.name == step)
    single = (row for row in holder.children if not row.repeats and row.dialect is None)
    return {row.name: tuple(_fields_of(row)) for row in single}


def _fields_of(row: Fact) -> list[str]:
    if row.place == ".":
        return [inner.place for inner in row.rows if inner.place]
    return [row.place] if row.place else []


def _remove_repeats(node: Node, fields: dict[str, tuple[str, ...]], sink: DiagnosticSink) -> Node:
    """The node without elements that repeat an earlier one."""
    kept: list[Opaque] = []
    seen = {name for name, places in fields.items() if any(map(partial(_has_value, node), places))}
    for part in node.opaque:
        name = part.element.name if part.element and not part.at else None
        if name in seen:
            message = f"a second <{name}> is left out: readers take the first"
            # Where an element may stand once, urdfdom (`FirstChildElement`) takes the first, so
            # that leaving out the second changes no robot.
            sink.account(Fate.DROPPED, REPEATED_ELEMENT, message, part.location if part.source else node.location)
            continue
        kept.append(part)
        if name in fields:
            seen.add(name)
    return replace_fields(node, opaque=tuple(kept)) if len(kept) < len(node.opaque) else node


def _has_value(node: Node, place: str) -> bool:
    value: object = node
    for step in place.split("."):
        value = getattr(value, step) if value is not None else None
    return value is not None
