"""What a reader answers: what it prints, and what it keeps of the robot."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Kept:
    """The links, joints and masses (in kg, by link) that a reader has after reading, by its own names for them.

    Some put links together that are fixed to each other: what they have then is a body, with the mass of all of them.
    `shapes` counts what is left of visuals and collisions, where the reader tells.
    """

    links: tuple[str, ...] = ()
    joints: tuple[str, ...] = ()
    masses: Mapping[str, float] = field(default_factory=dict[str, float])
    shapes: int | None = None

    @property
    def mass(self) -> float:
        """All of it together."""
        return sum(self.masses.values())


@dataclass(frozen=True, slots=True)
class Answer:
    """What a reader returns or reports about a file that it takes, as text, and what it keeps, where it tells."""

    output: str = ""
    kept: Kept | None = None


def kept(
    links: Iterable[str], joints: Iterable[str], masses: Iterable[tuple[str, float]], shapes: int | None = None
) -> Kept:
    """What a reader keeps; masses to nine digits, which is less than any of them keeps."""
    return Kept(tuple(map(str, links)), tuple(map(str, joints)), {str(k): float(f"{v:.9g}") for k, v in masses}, shapes)
