"""Leave out shapes without an extent, with which physics engines end."""

from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.diagnostics.rules import DROPPED_FLAT_SHAPE
from twinform.ir import Collision, Document, Link, Visual, replace_fields, rewrite
from twinform.passes.framework.pass_base import Pass
from twinform.passes.shared.link_shapes import is_flat

Part = TypeVar("Part", Visual, Collision)


class DropFlatShapes(Pass):
    """Leave out visuals and collisions that have no extent: nothing can be seen of them or touch them.

    Changes visuals and collisions with a box, sphere, cylinder, capsule, cone or ellipsoid of which a size is zero,
    negative or no number: they go, in URDF and in SDF.

    Never touches: meshes and planes, links, masses and inertias.
    Diagnostics: `dropped-flat-shape` for each, which has an entry of the ledger, *dropped*.
    """

    name = "drop-flat-shapes"
    example: ClassVar[str] = "drop-flat-shapes"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document without flat shapes."""

        def drop(link: Link) -> Link:
            visuals, collisions = _remove_flat(link, link.visuals, sink), _remove_flat(link, link.collisions, sink)
            return replace_fields(link, visuals=visuals, collisions=collisions)

        return rewrite(document, Link, drop)


def _remove_flat(link: Link, parts: tuple[Part, ...], sink: DiagnosticSink) -> tuple[Part, ...]:
    for part in filter(is_flat, parts):
        kind = type(part).__name__.lower()
        name = f" {part.name!r}" if part.name else ""
        message = f"{kind}{name} of link {link.name!r} has a size that is not above 0: it is left out"
        sink.report(DROPPED_FLAT_SHAPE, message, part.location)
        sink.account(Fate.DROPPED, DROPPED_FLAT_SHAPE, message, part.location)
    return tuple(part for part in parts if not is_flat(part))
