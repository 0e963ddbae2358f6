"""Mass, center of mass and inertia of bodies: as they are written, or as MuJoCo computes them from geoms."""

from collections.abc import Callable, Sequence
from itertools import combinations
from typing import NamedTuple, Self

from twinform.compiler.input.mjcf.number_lists import Numbers
from twinform.compiler.input.mjcf.pieces import Piece, pose_of
from twinform.compiler.input.mjcf.remainders import RemainderKeeper, holder
from twinform.dataclass import dataclass
from twinform.diagnostics import rules
from twinform.ir import Inertia, Inertial, Link, Opaque
from twinform.ir.solids import (
    ELEMENTS,
    Solid,
    Symmetric,
    combined,
    placed,
    principal_axes,
    turned,
    with_mass,
)
from twinform.ir.transform import Matrix3, Transform, rounded
from twinform.passes.carriers.annotations import with_annotation, without_annotation
from twinform.passes.carriers.token_mass import TOKEN, UNSAID, moments, restore_inertial, says_zero

DENSITY = 1000.0
"""In kg/m^3, of a geom that says nothing about its mass."""
LEAST = 1e-15
"""In kg or kg m^2: what is less counts as nothing in MuJoCo."""

_NOISE = 1e-14
"""Products of inertia below this share of the moments are none."""

SolidOf = Callable[[Piece, float], Solid | None]
"""Fills the shape of a geom, in its own frame, with a density in kg/m^3; None for a shape without an inside."""
_APPLIED = ("angle", "autolimits", "coordinate", "eulerseq")
"""Settings that say how the file is written, and not what: canonical files are all written in one way."""
_NAMES = ("inertiafromgeom", "inertiagrouprange", "balanceinertia", "boundmass", "boundinertia", "settotalmass")


@dataclass(frozen=True, slots=True)
class MassSettings:
    """How the masses of bodies come about.

    Attributes:
        from_geoms: whether geoms count: `auto` for bodies without `<inertial>`, `true` for all, `false` for none.
        groups: the groups of geoms that count, first and last.
        balances: whether impossible moments become three equal ones.
        least_mass: the least mass of a body; kg.
        least_inertia: the least principal moment of a body; kg m^2.
        total: the mass of all bodies together; kg, and none of it where it is not positive.
    """

    from_geoms: str = "auto"
    groups: tuple[int, int] = (0, 5)
    balances: bool = False
    least_mass: float = 0.0
    least_inertia: float = 0.0
    total: float = -1.0

    @classmethod
    def of(cls, compilers: tuple[Piece, ...]) -> Self:
        """Take the settings of all `<compiler>` elements of a file; of two values the later one counts."""
        values: dict[str, str] = {}
        for each in compilers:
            for name in _APPLIED:
                each.take(name)
            for name in _NAMES:
                value = each.take(name)
                if value is not None:
                    values[name] = value
        groups = [int(float(word)) for word in values.get("inertiagrouprange", "0 5").split()]
        return cls(
            values.get("inertiafromgeom", "auto"),
            (groups[0], groups[-1]),
            values.get("balanceinertia") == "true",
            float(values.get("boundmass", "0")),
            float(values.get("boundinertia", "0")),
            float(values.get("settotalmass", "-1")),
        )


class WrittenInertia(NamedTuple):
    """A mass with its inertia in the frame that the file has for it.

    `is_written` is whether the file has these numbers, so that they need not be written in the frame of the body.
    """

    solid: Solid
    frame: Transform
    is_written: bool
    piece: Piece


def body_inertia(body: Piece, settings: MassSettings, solid_of: SolidOf) -> WrittenInertia:
    """Return the mass of a body before all masses are scaled, and take what it comes from."""
    written = body.find("inertial")
    if written is not None and settings.from_geoms != "true":
        found = _written(written)
    else:
        counted = () if settings.from_geoms == "false" else _solids(body, settings, solid_of)
        solid = combined([each for each in counted if each.mass > LEAST])
        found = WrittenInertia(_without_noise(solid), Transform(), is_written=False, piece=body)
    return found._replace(solid=_corrected(found.solid, settings))


def _without_noise(solid: Solid) -> Solid:
    """Return a solid with zeros for what only the rounding of sums has left beside numbers of its size."""
    xx, yy, zz, *products = solid.inertia
    least = _NOISE * (xx + yy + zz)
    xy, xz, yz = (0.0 if abs(each) < least else each for each in products)
    x, y, z = rounded(solid.center)
    return Solid(solid.mass, (x, y, z), (xx, yy, zz, xy, xz, yz))


def _written(piece: Piece) -> WrittenInertia:
    piece.is_settled = True
    at = piece.transform()
    mass = piece.number("mass") or 0.0
    full, diagonal = piece.numbers("fullinertia"), piece.numbers("diaginertia")
    xx, yy, zz, xy, xz, yz = full or (*diagonal, *[0.0] * (6 - len(diagonal)))
    return WrittenInertia(Solid(mass, (0.0, 0.0, 0.0), (xx, yy, zz, xy, xz, yz)), at, is_written=True, piece=piece)


def _solids(body: Piece, settings: MassSettings, solid_of: SolidOf) -> Sequence[Solid]:
    """Return the geoms that count, in the frame of the body; the mass of a geom beats its density."""
    found: list[Solid] = []
    first, last = settings.groups
    for geom in body.all_of("geom"):
        if not first <= int(geom.peek("group") or "0") <= last:
            continue
        # They stay with the geom, whose mass the link has from now on.
        mass = next(iter(geom.peek_numbers("mass")), None)
        density = next(iter(geom.peek_numbers("density")), DENSITY)
        # A mesh that has no mass need not be there.
        solid = solid_of(geom, density) if mass is None and density else None
        if mass is not None:
            filled = solid_of(geom, DENSITY) if mass else None
            solid = with_mass(filled, mass) if filled is not None and filled.mass else None
        if solid is not None:
            found.append(placed(solid, geom.transform()))
    return found


def _corrected(solid: Solid, settings: MassSettings) -> Solid:
    """Return the solid with impossible moments balanced, and what is below the least values raised to them."""
    mass = max(solid.mass, settings.least_mass)
    inertia = solid.inertia
    if settings.balances or settings.least_inertia:
        inertia = _corrected_moments(inertia, settings)
    return Solid(mass, solid.center, inertia)


def _corrected_moments(inertia: Symmetric, settings: MassSettings) -> Symmetric:
    moments, axes = principal_axes(inertia)
    changed: Numbers = tuple(max(each, settings.least_inertia) for each in moments)
    whole = sum(changed)
    if settings.balances and any(a + b < whole - a - b for a, b in combinations(changed, 2)):
        changed = (whole / 3, whole / 3, whole / 3)
    if changed == moments:
        return inertia
    (a, b, c), (u, v, w) = changed, axes
    columns: Matrix3 = (u[0], v[0], w[0], u[1], v[1], w[1], u[2], v[2], w[2])
    return turned((a, b, c, 0.0, 0.0, 0.0), Transform(rotation=columns))


def scale_of(settings: MassSettings, masses: Sequence[float]) -> float:
    """Return the factor that gives all bodies together the mass that the file sets for them."""
    whole = sum(masses)
    return settings.total / whole if settings.total > 0 and whole > 0 else 1.0


def inertial_of(found: WrittenInertia, scale: float, keeper: RemainderKeeper) -> tuple[Inertial, tuple[Opaque, ...]]:
    """Return the inertial of a link, and what the link keeps of it beside.

    A link that has no mass in MJCF gets a token, as SDF would give it 1 kg; where MJCF says that it is zero, or is too
    little to count, the inertial says so. Moments without a mass, which resist turning, are those of the link.
    """
    solid, piece = found.solid, found.piece
    if scale != 1.0:
        solid = with_mass(solid, solid.mass * scale)
    if solid.mass <= LEAST:
        called = f"body {piece.name!r}" if piece.name else "this body"
        message = f"{called} has no mass; SDF needs one, which is {TOKEN.mass:g} kg"
        keeper.approximate(message, piece.location, rules.TINY_MASS)
        if found.is_written and solid.mass == 0.0:
            return _of_no_mass(_inertial(found, solid, keeper.rest(piece))), ()
        kept = (holder(keeper.whole(piece)),) if found.is_written else ()
        return with_annotation(TOKEN, UNSAID, "inertial"), kept
    return _inertial(found, solid, keeper.rest(piece) if found.is_written else ()), ()


def _of_no_mass(inertial: Inertial) -> Inertial:
    """Return the inertial with a token of the mass that MJCF says is zero, and of the inertia if that is zero too."""
    words, made = "zero-mass", inertial.copy(mass=TOKEN.mass)
    if not any(moments(inertial)):
        words, made = f"{words} zero-inertia", made.copy(inertia=TOKEN.inertia)
    return with_annotation(made, UNSAID, words)


def _inertial(found: WrittenInertia, solid: Solid, rest: tuple[Opaque, ...]) -> Inertial:
    at = found.frame if found.is_written else Transform(translation=solid.center)
    inertia = Inertia.unchecked(**dict(zip(ELEMENTS, solid.inertia, strict=True)))
    pose = pose_of(at, source=found.piece.source)
    return Inertial.unchecked(pose=pose, mass=solid.mass, inertia=inertia, opaque=rest, source=found.piece.source)


def with_zeros(link: Link, *, is_told: bool) -> Link:
    """Return the link with the mass of zero that the file has, unless a carrier tells what the source had."""
    inertial = link.inertial
    if inertial is None or not says_zero(inertial):
        return link
    return link.copy(inertial=without_annotation(inertial, UNSAID) if is_told else restore_inertial(inertial))
