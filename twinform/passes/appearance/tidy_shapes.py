"""Keep to the shapes that every reader of URDF knows: boxes, cylinders, spheres and meshes."""

import math
from collections.abc import Iterator
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.diagnostics.rules import REPLACED_SHAPE
from twinform.ir import Document, Format, Link, replace_fields, rewrite
from twinform.ir.defaults import sizes
from twinform.ir.geometry import Box, Capsule, Cylinder, Mesh, Sphere
from twinform.ir.visual import Collision, Visual
from twinform.passes.carriers.annotations import without_annotation
from twinform.passes.framework.pass_base import Pass
from twinform.passes.shared.replaced_shapes import CAPSULE, AnyPart, ends_of_capsule, middle_of_capsule

_KNOWN = (Box, Cylinder, Sphere, Mesh)


class TidyShapes(Pass):
    """Make capsules of shapes that every reader of URDF knows, and leave out what is no shape.

    Changes visuals and collisions of URDF:

    1. a capsule becomes a cylinder and two spheres, which are the same together;
    2. one without a geometry, with an empty one, or with a shape that is not of URDF (`<plane>`, `<ellipsoid>`) goes;
    3. one with a size that is zero, negative or no number goes: nothing can be seen of it or touch it;
    4. what stands in a geometry beside its shape goes.

    Never touches: SDF, masses and inertias.
    Diagnostics: `replaced-shape` for each; what goes has an entry of the ledger, *dropped*.
    """

    name = "tidy-shapes"
    example: ClassVar[str] = "tidy-shapes"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with tidy shapes."""
        if document.format is not Format.URDF:
            return document
        return rewrite(document, Link, lambda link: _tidy_link(link, sink))


def _tidy_link(link: Link, sink: DiagnosticSink) -> Link:
    visuals, collisions = _tidy_shapes(link, link.visuals, sink), _tidy_shapes(link, link.collisions, sink)
    return replace_fields(link, visuals=visuals, collisions=collisions)


def _tidy_shapes(link: Link, parts: tuple[AnyPart, ...], sink: DiagnosticSink) -> tuple[AnyPart, ...]:
    names = {part.name for part in parts if part.name}
    return tuple(made for part in parts for made in _tidy_shape(link, part, names, sink))


def _tidy_shape(link: Link, part: AnyPart, names: set[str], sink: DiagnosticSink) -> Iterator[AnyPart]:
    kind = type(part).__name__.lower()
    geometry = part.geometry
    shape = None if geometry is None else geometry.shape
    if geometry is None or not isinstance(shape, (*_KNOWN, Capsule)):
        _drop(part, f"a {kind} of link {link.name!r} has no shape that URDF knows", sink)
    elif not isinstance(shape, Mesh) and not all(size > 0 and math.isfinite(size) for size in sizes(shape)):
        _drop(part, f"a {kind} of link {link.name!r} has a size that is not above 0", sink)
    elif isinstance(shape, Capsule):
        message = f"a capsule of link {link.name!r} becomes a cylinder and two spheres"
        sink.report(REPLACED_SHAPE, message, part.location)
        middle = middle_of_capsule(part, shape)
        yield without_annotation(middle, CAPSULE)
        yield from ends_of_capsule(middle, names)
    elif geometry.opaque:
        message = f"what is beside the shape of a {kind} of link {link.name!r} is left out"
        sink.report(REPLACED_SHAPE, message, part.location)
        sink.account(Fate.DROPPED, REPLACED_SHAPE, message, part.location)
        yield replace_fields(part, geometry=geometry.copy(opaque=()))
    else:
        yield part


def _drop(part: Visual | Collision, message: str, sink: DiagnosticSink) -> None:
    sink.report(REPLACED_SHAPE, f"{message}: it is left out", part.location)
    sink.account(Fate.DROPPED, REPLACED_SHAPE, message, part.location)
