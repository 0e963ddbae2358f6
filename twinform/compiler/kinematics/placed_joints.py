"""Joints with their degrees of freedom, placed in the frame of a model or world."""

from dataclasses import dataclass

from twinform.ir import Vector3
from twinform.ir.transform import Transform


@dataclass(frozen=True, slots=True)
class Leader:
    """The position that one follows: `multiplier` (position of `joint` - `reference`) + `offset`."""

    joint: str
    degree: int
    multiplier: float
    offset: float
    reference: float

    def followed(self, position: float) -> float:
        """Where the follower is."""
        return self.multiplier * (position - self.reference) + self.offset


@dataclass(frozen=True, slots=True)
class Degree:
    """One way in which a joint moves: about or along a unit vector.

    `pitch` is how many meters it moves along the vector with each turn, and `lower` and `upper` are infinite where
    there are no limits.
    """

    axis: Vector3
    slides: bool
    lower: float
    upper: float
    pitch: float = 0.0
    leader: Leader | None = None


@dataclass(frozen=True, slots=True)
class PlacedJoint:
    """A joint between two links, or the world, with all joints at zero."""

    name: str
    type: str
    parent: str
    child: str
    frame: Transform
    degrees: tuple[Degree, ...] = ()
