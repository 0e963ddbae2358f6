"""Finds ranges of hinges in MJCF that are written in radians and read as degrees, as MJCF is without a setting."""

import math
from collections.abc import Iterator

from twinform.compiler.input.mjcf.check_bodies import all_joints
from twinform.compiler.input.mjcf.element_findings import ElementFindings
from twinform.compiler.input.mjcf.number_lists import numbers_of
from twinform.dataclass import dataclass
from twinform.diagnostics import rules
from twinform.schemas import XmlElement

# Two turns in radians, with the digits that people leave out.
_LARGEST = 6.3
_FEW = 3
"""So many hinges, all of which turn by less, are no coincidence."""
_STEP = math.pi / 12
_CLOSE = 0.003
_LEAST = 0.5
"""Fractions of pi that are smaller are like any other number."""


@dataclass(frozen=True, slots=True)
class _Range:
    """The range of a hinge in degrees."""

    joint: XmlElement
    ends: tuple[float, ...]

    @property
    def is_small(self) -> bool:
        return all(abs(end) <= _LARGEST for end in self.ends)

    @property
    def has_fraction_of_pi(self) -> bool:
        return any(abs(end) >= _LEAST and abs(math.remainder(end, _STEP)) < _CLOSE for end in self.ends)

    def __str__(self) -> str:
        return " to ".join(f"{end:.4g}" for end in self.ends)


def check_angles(root: XmlElement, findings: ElementFindings) -> None:
    """Report hinges of a canonical tree, of a file in degrees, whose ranges look like radians."""
    found = list(_ranges(root))
    if len(found) >= _FEW and all(each.is_small for each in found):
        message = f"no hinge turns by more than {_LARGEST} degrees, this one from {found[0]}; are these radians?"
        _report(found[0], message, findings)
        return
    for each in found:
        if each.is_small and each.has_fraction_of_pi:
            _report(each, f"this hinge turns from {each} degrees; are these radians?", findings)


def _report(found: _Range, message: str, findings: ElementFindings) -> None:
    hint = 'say <compiler angle="radian"/>, or write degrees'
    findings.report(rules.RANGE_IN_RADIANS, found.joint, message, "@range", found=str(found), help=hint)


def _ranges(root: XmlElement) -> Iterator[_Range]:
    for joint, kind in all_joints(root):
        ends = numbers_of(joint, "range", count=2)
        if kind == "hinge" and joint.get("limited") == "true" and ends is not None:
            yield _Range(joint, tuple(map(math.degrees, ends)))
