"""What Gazebo's physics has of a file: links, joints, and where they are over time."""

from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from typing import Self

Numbers = tuple[float, ...]


class Outcome(StrEnum):
    """How it ended."""

    DONE = "done"
    REFUSED = "refused by libsdformat"
    CRASHED = "crashed"
    HUNG = "did not come to an end"


@dataclass(frozen=True, slots=True)
class Console:
    """What was written to the terminal, line by line, without colors and places in the engine's source."""

    errors: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()
    other: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Link:
    """A link, by its name with the names of its models before it; only DART tells its inertia.

    The mass is in kg, the center of mass in m in the frame of the link, the moments (xx, yy, zz, xy, xz, yz) in kg m^2
    about the center of mass, along the axes of the link.
    """

    name: str
    mass: float | None = None
    center: Numbers = ()
    moments: Numbers = ()


@dataclass(frozen=True, slots=True)
class InsideJoint:
    """A joint as DART has it, with a number for each degree of freedom; in SI units and radians.

    A screw is how the child moves at unit rate: its angular velocity and the velocity of its origin, along the axes of
    the world.
    """

    kind: str
    screws: tuple[Numbers, ...]
    lower: Numbers
    upper: Numbers
    effort: Numbers
    velocity: Numbers
    damping: Numbers
    friction: Numbers
    stiffness: Numbers
    rest: Numbers


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint: its type in SDF, and its degrees of freedom in the engine, None where it did not come to be there."""

    name: str
    kind: str
    parent: str
    child: str
    freedom: int | None = None
    inside: InsideJoint | None = None


@dataclass(frozen=True, slots=True)
class LinkState:
    """Where a link frame is in the world, a position in m and a quaternion (w, x, y, z), and how it moves.

    The velocity is that of its origin in m/s, then the angular velocity in rad/s, both along the axes of the world.
    """

    pose: Numbers
    velocity: Numbers


@dataclass(frozen=True, slots=True)
class Moment:
    """The state of all links and joints at a time in s, by name; a joint has a number for each degree of freedom."""

    time: float
    links: dict[str, LinkState]
    positions: dict[str, Numbers]
    rates: dict[str, Numbers]


@dataclass(frozen=True)
class Simulation:
    """What became of a file in an engine; where it crashed, `stage` is the call, and there is nothing else.

    `errors` are those of libsdformat, `left_out` the parts that the engine was not given.
    """

    outcome: Outcome
    stage: str
    console: Console
    errors: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    moments: tuple[Moment, ...] = ()

    @property
    def done(self) -> bool:
        """Whether it was loaded and survived its steps."""
        return self.outcome is Outcome.DONE

    @cached_property
    def joint(self) -> dict[str, Joint]:
        """The joints by name."""
        return {each.name: each for each in self.joints}

    @cached_property
    def link(self) -> dict[str, Link]:
        """The links by name."""
        return {each.name: each for each in self.links}

    def required(self) -> Self:
        """Itself, if it came to its end.

        Raises:
            RuntimeError: it did not.
        """
        if not self.done:
            raise RuntimeError(f"{self.outcome} at {self.stage}: {'; '.join(self.errors + self.console.errors)}")
        return self
