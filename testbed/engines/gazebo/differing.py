"""The kinds of differences between two simulations, and their tolerances."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from testbed.engines.gazebo.results import Numbers

Vector = NDArray[np.float64]

AT_REST = 1e-8
"""How far poses at rest may be apart, in m and in components of quaternions and directions."""
MOVED = 1e-5
"""How far apart motions may be, as a share of the motion."""
LEAST = 1e-9
"""Motions and masses below it, in m, rad and kg, are rounding."""


@dataclass(frozen=True, slots=True)
class Difference:
    """Something that one file has otherwise in the engine; `what` names the kind of it, `where` the part."""

    what: str
    where: str = ""
    values: str = ""

    def __str__(self) -> str:
        """In a line."""
        return " ".join(part for part in (self.what, self.where, self.values) if part)


@dataclass(frozen=True, slots=True)
class Tolerances:
    """How exact an engine is; Bullet in Debian has single precision, and moves joints that are stiff, not ideal."""

    at_rest: float = AT_REST
    moved: float | None = MOVED
    """None where motions are not compared."""


def short(name: str) -> str:
    """The name of a part without that of the model that it is in."""
    return name.partition("::")[2] or name


def apart(one: Vector, other: Vector) -> float:
    """The largest difference of two arrays; infinity where they have other shapes."""
    return float(np.max(np.abs(one - other), initial=0.0)) if one.shape == other.shape else np.inf


def pose_apart(one: Numbers, other: Numbers) -> tuple[float, float]:
    """How far positions are apart in m, and orientations in rad."""
    along = float(np.linalg.norm(np.subtract(one[:3], other[:3])))
    first, second = np.array(one[3:]), np.array(other[3:])
    chord = min(np.linalg.norm(first - second), np.linalg.norm(first + second))
    return along, 4.0 * float(np.arcsin(min(1.0, chord / 2.0)))
