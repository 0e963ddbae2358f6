"""Compute masses and inertias from shapes."""

import math
import sys
from typing import ClassVar, Literal, NamedTuple, Self

from pydantic import Field, model_validator

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import FILLED_INERTIA, UNFILLED_INERTIA
from twinform.diagnostics.wording import plural
from twinform.ir import Document, Format, Inertial, Link, rewrite
from twinform.ir.frames import FrameError
from twinform.ir.solids import Solid, combined, with_mass
from twinform.ir.transform import common_exponent, times_power
from twinform.passes.framework.pass_base import EVERY, AssetPass, matches, with_such_a_name
from twinform.passes.inertia.physical_consistency import has_mass, is_possible
from twinform.passes.shared.link_shapes import Kind, NoSolidError, PlacedShape, ShapePlaces, inertial_of, solid_of
from twinform.passes.shared.mesh_solids import Meshes
from twinform.passes.shared.moving_bodies import movable_models, moving_bodies

_AMOUNTS = ("density", "mass", "total_mass")


class _Filling(NamedTuple):
    """The solid for a link in its frame, whether its mass was written, and the shapes that it is made of."""

    solid: Solid
    keeps_mass: bool
    shapes: tuple[PlacedShape, ...]


class FillInertia(AssetPass):
    """Compute mass, center of mass and inertia of links from their shapes, filled evenly.

    Changes the `<inertial>` of links whose name matches `links`, which are, by `replace`:

    1. `missing`: links without an inertial, or with one that lacks its mass or its inertia;
    2. `impossible`: those, and links whose mass or moments no body can have;
    3. `all`: every link with shapes.

    The shapes are added up in the link frame: box, sphere, cylinder, capsule, ellipsoid and cone in closed form, and
    closed meshes (`pip install 'twinform[meshes]'`) found as `--path` and the variables of ROS and Gazebo say. A
    positive mass that is written stays and the inertia is scaled to it, unless an amount is given together with
    `replace=all`. All other links get their mass from one of `density`, `mass` and `total-mass`; without these, from
    the `<density>` of each SDF collision, or water.

    Never touches: links without shapes, links of static models, and inertias that the simulator computes (`auto`,
    unless `replace=all`). A link of which one shape cannot be used stays as it is. Shapes that overlap count twice.
    Diagnostics: `filled-inertia` for each link that it fills, and `unfilled-inertia` at a shape that it cannot use
    and at a body that moves and is left without a mass.
    """

    name = "fill-inertia"
    example: ClassVar[str] = "fill-inertia{density=2700 shapes=visual},check-inertia"

    links: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only links"))
    shapes: Kind = Field(
        default="collision", description="Which shapes are filled; `either`: visuals of links without collisions."
    )
    replace: Literal["missing", "impossible", "all"] = Field(
        default="missing", description="Which inertias are computed; see above."
    )
    density: float | None = Field(default=None, gt=0, allow_inf_nan=False, description="The density, in kg/m^3.")
    mass: float | None = Field(default=None, gt=0, allow_inf_nan=False, description="The mass of each link, in kg.")
    total_mass: float | None = Field(
        default=None,
        gt=0,
        allow_inf_nan=False,
        description="The mass of all links together that get one, in kg, spread by their volumes.",
    )
    open_meshes: Literal["report", "hull"] = Field(
        default="report", description="What is done with meshes without an inside: `hull` takes their convex hull."
    )

    @model_validator(mode="after")
    def _check_amounts(self) -> Self:
        given = [name.replace("_", "-") for name in _AMOUNTS if getattr(self, name) is not None]
        if len(given) > 1:
            raise ValueError(f"{' and '.join(given)} are given; give one of them")
        return self

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with inertias."""
        fillings = self._compute_fillings(document, sink)
        amounts = [one.solid.mass for one in fillings.values() if not one.keeps_mass]
        exponent = common_exponent(amounts)
        units = math.fsum(times_power(amount, -exponent) for amount in amounts)

        def fill(link: Link) -> Link:
            filling = fillings.get(id(link))
            if not filling:
                return link
            if self.total_mass is not None and not filling.keeps_mass:
                part = times_power(filling.solid.mass, -exponent) * (self.total_mass / units)
                filling = filling._replace(solid=with_mass(filling.solid, part))
            return (
                _set_inertial(link, filling, sink) if _check_solid(link, filling.solid, filling.shapes, sink) else link
            )

        filled = rewrite(document, Link, fill)
        _report_bodies_without_shapes(filled, self.links, sink)
        return filled

    def _compute_fillings(self, document: Document, sink: DiagnosticSink) -> dict[int, _Filling]:
        """The filling of each link, by the identity of the link: equal links are still two."""
        meshes, found = Meshes(self._assets, self.open_meshes == "hull"), dict[int, _Filling]()
        for model in movable_models(document):
            places = ShapePlaces(model)
            for link in model.links:
                if not matches(link.name, self.links) or not self._is_wanted(link.inertial, document.format):
                    continue
                filling = self._compute_filling(link, places, meshes, sink)
                if filling:
                    found[id(link)] = filling
        return found

    def _is_wanted(self, inertial: Inertial | None, format_: Format) -> bool:
        if inertial is None or self.replace == "all":
            return True
        if inertial.auto:
            return False
        if inertial.mass is None or inertial.inertia is None:
            return True
        return self.replace == "impossible" and not is_possible(inertial, format_)

    def _compute_filling(
        self, link: Link, places: ShapePlaces, meshes: Meshes, sink: DiagnosticSink
    ) -> _Filling | None:
        """The filling of a link; None where it has no shape, or one that cannot be used."""
        try:
            shapes = tuple(places.shapes(link, self.shapes))
            whole = combined([solid_of(one, self.density, meshes) for one in shapes])
        except NoSolidError as error:
            message = f"the inertia of link {link.name!r} is not computed: {error}"
            sink.report(UNFILLED_INERTIA, message, error.location, help=error.help)
            return None
        except FrameError as error:
            error.report(sink)
            return None
        if not shapes or not _check_solid(link, whole, shapes, sink):
            return None
        return self._set_mass(link.inertial, whole, shapes)

    def _set_mass(self, inertial: Inertial | None, whole: Solid, shapes: tuple[PlacedShape, ...]) -> _Filling:
        """The solid with its mass, except for its share of a total."""
        overrides = self.replace == "all" and any(getattr(self, name) is not None for name in _AMOUNTS)
        # A mass is mostly weighed or taken from CAD; of an inertia with a placeholder the mass is
        # still worth keeping.
        if inertial is not None and inertial.mass is not None and has_mass(inertial) and not overrides:
            return _Filling(with_mass(whole, inertial.mass), keeps_mass=True, shapes=shapes)
        return _Filling(whole if self.mass is None else with_mass(whole, self.mass), keeps_mass=False, shapes=shapes)


def _check_solid(link: Link, whole: Solid, shapes: tuple[PlacedShape, ...], sink: DiagnosticSink) -> bool:
    """Whether the numbers are those of a body, and report if not: sizes may be zero, or their powers overflow."""
    numbers = (whole.mass, *whole.center, *whole.inertia)
    if all(map(math.isfinite, numbers)) and min(whole.mass, *whole.inertia[:3]) >= sys.float_info.min:
        return True
    names = ", ".join(one.name for one in shapes)
    message = f"the inertia of link {link.name!r} is not computed: no usable volume in {names}"
    sink.report(UNFILLED_INERTIA, message, shapes[0].holder.location, found=f"{whole.mass:g} kg")
    return False


def _set_inertial(link: Link, filling: _Filling, sink: DiagnosticSink) -> Link:
    found = filling.solid
    kept = ", as the file has it" if filling.keeps_mass else ""
    count = plural(len(filling.shapes), "shape")
    message = f"link {link.name!r} got the inertia of {count}, with a mass of {found.mass:.6g} kg{kept}"
    place = link.inertial.location if link.inertial and link.inertial.source else link.location
    sink.report(FILLED_INERTIA, message, place, found=f"{found.mass:.6g} kg")
    return link.copy(inertial=inertial_of(found, link.inertial))


def _report_bodies_without_shapes(document: Document, patterns: tuple[str, ...], sink: DiagnosticSink) -> None:
    """Report moving bodies that have nothing to compute a mass from."""
    for body in moving_bodies(document):
        if any(link.inertial for link in body) or any(link.collisions or link.visuals for link in body):
            continue
        if matches(body[0].name, patterns):
            message = f"link {body[0].name!r} moves and has no shape to compute a mass from"
            sink.report(UNFILLED_INERTIA, message, body[0].location, help="run split-massless to give it a mass")
