"""Settings of a file that decide about masses: those of `<compiler>` in canonical MJCF."""

from typing import Self

from twinform.compiler.input.mjcf.pieces import Piece
from twinform.dataclass import dataclass


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


_APPLIED = ("angle", "autolimits", "coordinate", "eulerseq")
"""Settings that say how the file is written, and not what: canonical files are all written in one way."""
_NAMES = ("inertiafromgeom", "inertiagrouprange", "balanceinertia", "boundmass", "boundinertia", "settotalmass")
