"""What a comparison of two robots found."""

from dataclasses import dataclass
from enum import StrEnum

from twinform.diagnostics import NOWHERE, Location

TOLERANCE = 1e-9
"""The share of a value, or of a meter or radian where it is smaller than that, up to which a difference is rounding."""


class DifferenceSeverity(StrEnum):
    """How much it counts that something differs.

    A `difference` makes two robots different to every reader, and what is `carried` to some: a carrier or `<gazebo>`
    says it, which others skip. A `note` is on the same thing, written in another way.
    """

    DIFFERENCE = "difference"
    CARRIED = "carried"
    NOTE = "note"


@dataclass(frozen=True, slots=True)
class Side:
    """The value in one file, as text in SI units, or None where it has none; and where."""

    text: str | None = None
    location: Location = NOWHERE


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """One thing in which two robots differ, or in which they are described in different ways.

    `model` names the robot where several are compared, and is empty otherwise. `group` is `world`, `file`, `model`,
    `link`, `joint`, `frame` or `kinematics`, and `name` that of the world, link, joint or frame; `aspect` is the path
    to the value from there.
    `reader` is the one that alone sees, or does not see, what is carried: `gazebo` or `twinform`, empty for all else.
    `absolute` is by how much the values differ, in `unit`, and `relative` its share of the larger one; both are None
    for what is no number.
    """

    severity: DifferenceSeverity
    model: str = ""
    group: str
    name: str
    aspect: str
    message: str
    a: Side = Side()
    b: Side = Side()
    absolute: float | None = None
    relative: float | None = None
    unit: str = ""
    reader: str = ""


@dataclass(frozen=True, slots=True)
class ComparisonOptions:
    """How robots are compared: which share of a value counts as rounding, and whether carriers count as written.

    Without `carriers` the question is what others read, and what only carriers say is a difference of its own kind.
    """

    tolerance: float = TOLERANCE
    carriers: bool = False


USUAL = ComparisonOptions()


@dataclass(frozen=True, slots=True)
class Comparison:
    """Two files and how the robots in them differ, in the order worlds, model, links, joints, frames, kinematics."""

    a: str
    b: str
    tolerance: float
    items: tuple[Difference, ...] = ()

    @property
    def same(self) -> bool:
        """Whether both files describe the same robot, to every reader."""
        return not self.counted

    @property
    def counted(self) -> tuple[Difference, ...]:
        """What makes the robots different, to every reader or to some."""
        return (*self.differences, *self.carried)

    @property
    def differences(self) -> tuple[Difference, ...]:
        """What makes the robots different to every reader."""
        return self._of(DifferenceSeverity.DIFFERENCE)

    @property
    def carried(self) -> tuple[Difference, ...]:
        """What makes the robots different to some readers: only a carrier or `<gazebo>` says it."""
        return self._of(DifferenceSeverity.CARRIED)

    @property
    def notes(self) -> tuple[Difference, ...]:
        """What is written in different ways, and is the same."""
        return self._of(DifferenceSeverity.NOTE)

    def _of(self, severity: DifferenceSeverity) -> tuple[Difference, ...]:
        return tuple(item for item in self.items if item.severity is severity)
