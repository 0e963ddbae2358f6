"""Geoms of a body as collisions and visuals of a link.

A geom whose `contype` and `conaffinity` are both zero touches nothing and is a visual. Any other one is a collision,
and a visual of the same name too if it is shown: in one of the groups 0 to 2, which MuJoCo's viewer shows, and not
wholly transparent. In a body that has visuals of its own in group 1 or 2, what touches in group 0 is not shown: so
MuJoCo sorts the shapes of a URDF, and many models do.
"""

from typing import NamedTuple

from twinform.compiler.input.mjcf.assets import AssetTable
from twinform.compiler.input.mjcf.contact_masks import Bits, ContactMasks
from twinform.compiler.input.mjcf.geom_solids import GeomSolids
from twinform.compiler.input.mjcf.lower_materials import is_invisible, lower_material
from twinform.compiler.input.mjcf.lower_shapes import PlacedShape, lower_shape
from twinform.compiler.input.mjcf.names import name_mark
from twinform.compiler.input.mjcf.pieces import Piece, pose_of
from twinform.compiler.input.mjcf.remainders import RemainderKeeper, holder
from twinform.ir import Collision, Element, Geometry, Opaque, Pose, Surface, Visual
from twinform.passes.carriers.annotations import SAME_GEOM, annotation
from twinform.passes.legalise.to_mjcf.fitted_geoms import fitted_mark
from twinform.passes.legalise.to_mjcf.friction import (
    TORSIONAL_CONDIM,
    USUAL_CONDIM,
    USUAL_FRICTION,
    torsional_part,
)
from twinform.passes.legalise.to_mjcf.writing_context import safe_name
from twinform.passes.shared.nodes import reserve_name

_SHOWN = 3
"""Groups from this one on are not shown by MuJoCo's viewer."""


class LinkShapes(NamedTuple):
    """The shapes of a link, what of its geoms has no shape in SDF, and the bits of those that are collisions."""

    collisions: tuple[Collision, ...] = ()
    visuals: tuple[Visual, ...] = ()
    rest: tuple[Opaque, ...] = ()
    bits: tuple[Bits, ...] = ()


class _Named(NamedTuple):
    """A geom with the name and the shape that it has in SDF."""

    geom: Piece
    name: str
    placed: PlacedShape
    touches: bool

    @property
    def marks(self) -> tuple[Opaque, ...]:
        """The annotations of a name that was made or changed, and of a shape that is fitted to a mesh."""
        marks, mesh = name_mark(self.geom.name, self.name), self.placed.mesh
        return marks if mesh is None else (*marks, fitted_mark(self.placed.shape, mesh))

    @property
    def pose(self) -> Pose | None:
        """Where the shape is in the link."""
        return pose_of(self.geom.transform().compose(self.placed.at), source=self.geom.source)

    @property
    def geometry(self) -> Geometry:
        """The shape."""
        return Geometry.unchecked(shape=self.placed.shape, source=self.geom.source)


class GeomLowering(NamedTuple):
    """What is needed to lower the geoms of a file."""

    assets: AssetTable
    masks: ContactMasks
    keeper: RemainderKeeper
    solids: GeomSolids

    def lower(self, body: Piece, link: str) -> LinkShapes:
        """Build the shapes of a body; the masses of its geoms are taken by now."""
        geoms = tuple(body.all_of("geom"))
        hides = any(not Bits.of(each).touches and _group(each) in {1, 2} for each in geoms)
        names = {each.name for each in geoms if each.name and safe_name(each.name) == each.name}
        numbers = dict[str, int]()
        collisions: list[Collision] = []
        visuals: list[Visual] = []
        rest: list[Element] = []
        bits: list[Bits] = []
        for geom in geoms:
            placed = lower_shape(geom, self.assets) or self._fitted(geom)
            if placed is None:
                why = f"SDF has no such shape ({geom.peek('type') or 'sphere'} without a file or size)"
                rest.append(self.keeper.whole(geom, why=why))
                continue
            touches = (own := Bits.of(geom)).touches
            unnamed = f"{link}_{'collision' if touches else 'visual'}"
            written = geom.take("name") or ""
            name = written if written in names else reserve_name(safe_name(written or unnamed), names, numbers)
            one = _Named(geom, name, placed, touches)
            is_shown = not touches or self._is_shown(geom, hides=hides)
            if is_shown:
                visuals.append(self._visual(one))
            if touches:
                bits.append(own)
                collisions.append(self._collision(one))
        kept = (holder(*rest),) if rest else ()
        return LinkShapes(tuple(collisions), tuple(visuals), kept, tuple(bits))

    def _fitted(self, geom: Piece) -> PlacedShape | None:
        found = self.solids.fitted(geom)
        if found is not None:
            geom.take("type")
            geom.take("size")  # MuJoCo does not look at it
        return found

    def _is_shown(self, geom: Piece, *, hides: bool) -> bool:
        group = _group(geom)
        if group >= _SHOWN or (hides and group == 0):
            return False
        return not is_invisible(geom, self.assets)

    def _visual(self, one: _Named) -> Visual:
        """Return the visual of a geom; of one that touches too, the collision holds the remainder."""
        self._report_bright(one.geom)
        material, pose = lower_material(one.geom, self.assets), one.pose  # before what is left of the geom
        if one.touches:
            rest = (annotation(SAME_GEOM),)
        else:
            one.geom.take("contype")
            one.geom.take("conaffinity")
            rest = self._rest(one.geom)
        return Visual.unchecked(
            name=one.name,
            pose=pose,
            geometry=one.geometry,
            material=material,
            opaque=(*one.marks, *rest),
            source=one.geom.source,
        )

    def _report_bright(self, geom: Piece) -> None:
        """Enter a color beyond white, or below black, into the ledger: MuJoCo takes it, and SDF has none."""
        colored = geom if geom.has("rgba") else self.assets.find("material", geom.peek("material"))
        if colored is not None and not all(0.0 <= each <= 1.0 for each in colored.peek_numbers("rgba") or ()):
            message = f"the color {colored.peek('rgba')} is cut to what SDF has, 0 to 1"
            self.keeper.approximate(message, colored.location.at("@rgba"))

    def _collision(self, one: _Named) -> Collision:
        return Collision.unchecked(
            name=one.name,
            pose=one.pose,
            geometry=one.geometry,
            surface=_surface(one.geom, self.masks.take(one.geom)),
            opaque=(*one.marks, *self._rest(one.geom)),
            source=one.geom.source,
        )

    def _rest(self, geom: Piece) -> tuple[Opaque, ...]:
        if geom.peek("group") == "0":
            geom.take("group")
        return self.keeper.rest(geom)


def _group(geom: Piece) -> int:
    return int(geom.peek("group") or "0")


def _surface(geom: Piece, mask: int | None) -> Surface | None:
    """Return the friction and the mask; rolling friction stays with the geom, and what its `condim` leaves out."""
    mu, *lengths = (*geom.numbers("friction"), *USUAL_FRICTION[len(geom.numbers("friction")) :])
    condim = int(geom.peek("condim") or USUAL_CONDIM)
    turns = condim >= TORSIONAL_CONDIM and lengths[0] > 0.0
    if condim == TORSIONAL_CONDIM and turns:
        geom.take("condim")
    if lengths[1] != USUAL_FRICTION[2] or (not turns and lengths[0] != USUAL_FRICTION[1]):
        geom.leave("friction")
    opaque = (torsional_part(lengths[0]),) if turns else ()
    if mask is not None:
        opaque += (Opaque.unchecked(at="contact", element=Element.unchecked(name="collide_bitmask", text=str(mask))),)
    sliding = None if mu == USUAL_FRICTION[0] else mu
    if sliding is None and not opaque:
        return None
    return Surface.unchecked(mu=sliding, mu2=sliding, opaque=opaque, source=geom.source)
