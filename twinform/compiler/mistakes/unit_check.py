"""Masses and inertias against shapes, with so much room that only other units are outside of it."""

from collections.abc import Iterable

from twinform.compiler.mistakes.mesh_checks import MeshFiles
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Format, Inertial, Link, Mesh, Model, Vector3
from twinform.ir.bounds import Bounds, placed_bounds
from twinform.ir.defaults import MOMENT
from twinform.ir.solids import FELT
from twinform.passes.inertia.physical_consistency import PlausibilityCheck, Room
from twinform.passes.shared.link_shapes import PlacedShape, ShapePlaces

# Far beyond what the pass `check-inertia` allows, which is for people who ask: shapes are drawn by
# eye, a dummy of a motor has the mass of all of it, and an inertia is rounded up to keep a
# simulation stable.
_DENSITIES = (0.0, 200000.0)
"""The least and greatest density, kg/m^3: gold has 19,300, boxes of test worlds 120,000, and a dummy none."""
_WEIGHS = 1.0
"""A body below this mass, kg, may be a point with any density."""
_ROOM = Room(sizes=3.0, meters=0.5, most=1000.0, least=1e-4, felt=FELT)


class _UnitCheck(PlausibilityCheck):
    """Compares a link with its shapes, of meshes with those of which all points are known."""

    files: MeshFiles

    def check_density(self, link: Link, inertial: Inertial, shapes: Iterable[PlacedShape]) -> None:
        """Report a density of a body that weighs something."""
        if (inertial.mass or 0.0) >= _WEIGHS:
            super().check_density(link, inertial, shapes)

    def bounds_of(self, one: PlacedShape) -> Bounds | None:
        """The box around a shape in the link frame; None where it is not known."""
        if not isinstance(one.shape, Mesh):
            return super().bounds_of(one)
        box = self.files.box(one.shape.uri or "")
        scale = one.shape.scale or (1.0, 1.0, 1.0)
        return placed_bounds(_scaled(box, scale), one.at) if box else None


def _scaled(box: Bounds, scale: Vector3) -> Bounds:
    corners = [
        sorted((low * factor, high * factor)) for low, high, factor in zip(box.least, box.greatest, scale, strict=True)
    ]
    (a, b), (c, d), (e, f) = corners
    return Bounds((a, c, e), (b, d, f))


def report_mass(
    link: Link, inertial: Inertial, of: tuple[Model, Format], files: MeshFiles, sink: DiagnosticSink
) -> None:
    """Report a mass or inertia that the shapes of its link are far from; `of` is the model and the format."""
    model, format_ = of
    check = _UnitCheck(ShapePlaces(model), None, _DENSITIES, MOMENT[format_], sink, _ROOM)
    check.files = files
    check.link(link, inertial)
