"""Marks of masses: boxes that have the inertia of a link, and balls at centers of mass."""

import math
from collections.abc import Iterator

from twinform.ir import Vector3
from twinform.ir.principal_moments import principal_axes
from twinform.ir.solids import Solid
from twinform.ir.transform import Transform
from twinform.view.figure import Figure, Handle, Rgb, placed
from twinform.view.shown_names import shortened

_INERTIA: Rgb = (60, 140, 230)
_TOO_LARGE: Rgb = (220, 40, 40)
_CENTER: Rgb = (20, 60, 160)
_SHARE = 0.03
"""The radius of the ball of the heaviest link, as a share of the whole robot."""


def inertias(figure: Figure) -> Iterator[Handle]:
    """Boxes that have the mass and the inertia of the links, filled evenly.

    One that is larger than the whole robot, as of an inertia in a wrong unit, would hide it: it is cut, in red wire.
    """
    for link in figure.scene.links:
        found = inertia_box(link.mass) if link.mass else None
        if found is not None:
            lengths, pose = found
            largest = max(lengths)
            shown = min(1.0, figure.size / largest) if largest else 1.0
            sides = " x ".join(f"{each:.3g}" for each in lengths)
            cut = "" if shown == 1.0 else "larger than the whole robot: drawn smaller"
            box = figure.api.add_box(
                f"{figure.node_name(link.name)}/inertia",
                _INERTIA if shown == 1.0 else _TOO_LARGE,
                tuple(each * shown for each in lengths),
                opacity=0.35,
                wireframe=shown < 1.0,
                **placed(pose),
            )
            yield figure.called(box, f"inertia of {shortened(link.name)}", f"a box of {sides} m", cut)


def inertia_box(solid: Solid) -> tuple[Vector3, Transform] | None:
    """The sides in meters, and the place in the link, of the box of even density with this mass and inertia.

    The moments of a box of sides a, b, c are m (b^2 + c^2) / 12 and so on, so a^2 = 6 (Iyy + Izz - Ixx) / m; a side
    whose square would be negative, as of no real body, is zero. None where it is not finite.
    """
    if not all(map(math.isfinite, (*solid.inertia, *solid.center))):
        return None
    moments, axes = principal_axes(solid.inertia)
    total = sum(moments)
    a, b, c = (math.sqrt(max(0.0, 6 * (total - 2 * each) / solid.mass)) for each in moments)
    (x1, x2, x3), (y1, y2, y3) = axes[0], axes[1]
    z1, z2, z3 = x2 * y3 - x3 * y2, x3 * y1 - x1 * y3, x1 * y2 - x2 * y1
    pose = Transform(solid.center, (x1, y1, z1, x2, y2, z2, x3, y3, z3))
    return ((a, b, c), pose) if all(map(math.isfinite, (a, b, c))) else None


def centers(figure: Figure) -> Iterator[Handle]:
    """A ball at each center of mass, whose volume grows with the mass."""
    weights = [link.mass.mass for link in figure.scene.links if link.mass]
    for link in figure.scene.links:
        if link.mass and all(map(math.isfinite, link.mass.center)):
            radius = figure.size * _SHARE * max(0.15, (link.mass.mass / max(weights)) ** (1 / 3))
            name = f"{figure.node_name(link.name)}/center"
            ball = figure.api.add_icosphere(name, radius, color=_CENTER, position=link.mass.center)
            yield figure.called(ball, f"center of mass of {shortened(link.name)}", f"{link.mass.mass:g} kg")
