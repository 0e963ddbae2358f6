"""Verifies visuals and collisions: whether there is a shape, and whether it has a size."""

from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir.geometry import Geometry, Plane
from twinform.ir.link import Link
from twinform.ir.visual import Collision, Visual

_ROUND = ("radius", "length")
_SIZES = {
    "box": ("size",),
    "sphere": ("radius",),
    "ellipsoid": ("radii",),
    "mesh": ("scale",),
    **dict.fromkeys(("cylinder", "capsule", "cone"), _ROUND),
}


def verify_shapes(link: Link, sink: DiagnosticSink, *, geometry_is_required: bool) -> None:
    """Report shapes that are missing or without extent.

    Where the schema requires `<geometry>`, its absence is reported already.
    """
    for shape in link.visuals:
        _verify_shape("visual", shape, link, sink, required=geometry_is_required)
    for shape in link.collisions:
        _verify_shape("collision", shape, link, sink, required=geometry_is_required)


def _verify_shape(kind: str, shape: Visual | Collision, link: Link, sink: DiagnosticSink, *, required: bool) -> None:
    geometry = shape.geometry
    if geometry is not None and geometry.shape is not None:
        _verify_sizes(geometry, kind, link, sink)
    elif _is_empty(shape, required=required):
        message = f"a {kind} of link {link.name!r} has no shape"
        sink.report(rules.MISSING_SHAPE, message, shape.location, expected="<geometry> with a shape in it")


def _is_empty(shape: Visual | Collision, *, required: bool) -> bool:
    """Whether no shape is written, not even one that the schema does not know."""
    if shape.geometry is not None:
        return not any(part.element for part in shape.geometry.opaque)
    empty = [part.element for part in shape.opaque if part.element and part.element.name == "geometry"]
    return not empty[0].children if empty else not required


def _verify_sizes(geometry: Geometry, kind: str, link: Link, sink: DiagnosticSink) -> None:
    shape = geometry.shape
    if shape is None:
        return
    if isinstance(shape, Plane):
        if shape.normal is not None and not any(shape.normal):
            _flat(f"the normal of a plane of link {link.name!r} has length zero", shape.location, sink)
        return
    for name in _SIZES.get(shape.kind, ()):
        value: float | tuple[float, ...] | None = getattr(shape, name)
        if value is not None and (0.0 in value if isinstance(value, tuple) else value == 0.0):
            message = f"the {name} of a {kind} of link {link.name!r}, a {shape.kind}, is zero"
            _flat(message, shape.location, sink)


def _flat(message: str, where: Location, sink: DiagnosticSink) -> None:
    sink.report(rules.ZERO_SIZE, message, where, found="0")
