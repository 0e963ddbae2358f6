"""What a comparison of two robots found."""

from dataclasses import dataclass
from enum import StrEnum

from twinform.diagnostics import NOWHERE, Location


class Severity(StrEnum):
    """A `difference` makes two robots different; a `note` is on the same thing, written in another way."""

    DIFFERENCE = "difference"
    NOTE = "note"


@dataclass(frozen=True, slots=True)
class Side:
    """The value in one file, as text in SI units, or None where it has none; and where."""

    text: str | None = None
    location: Location = NOWHERE


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """One thing in which two robots differ, or in which they are described in different ways.

    `model` names the robot where several are compared, and is empty otherwise. `group` is `model`, `link`, `joint`,
    `frame` or `kinematics`, and `name` that of the link, joint or frame; `aspect` is the path to the value from there.
    `absolute` is by how much the values differ, in `unit`, and `relative` its share of the larger one; both are None
    for what is no number.
    """

    severity: Severity
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


@dataclass(frozen=True, slots=True)
class Comparison:
    """Two files and how the robots in them differ, in the order model, links, joints, frames, kinematics."""

    a: str
    b: str
    tolerance: float
    items: tuple[Difference, ...] = ()

    @property
    def same(self) -> bool:
        """Whether both files describe the same robot."""
        return not self.differences

    @property
    def differences(self) -> tuple[Difference, ...]:
        """What makes the robots different."""
        return tuple(item for item in self.items if item.severity is Severity.DIFFERENCE)

    @property
    def notes(self) -> tuple[Difference, ...]:
        """What is written in different ways, and is the same."""
        return tuple(item for item in self.items if item.severity is Severity.NOTE)
