"""Texts of a graph: names that fit and do nothing, limits of joints, and how one follows another."""

import math
from collections.abc import Iterator

from twinform.diagnostics.reporters import printable
from twinform.ir import Axis, Format, Joint, Mimic
from twinform.ir.defaults import UNLIMITED, multiplier, with_range
from twinform.ir.motion import WITH_TWO_AXES

_LONGEST = 60
_BEGINNING = 40
_SLIDES = frozenset({"prismatic"})
_WITH_LIMITS = frozenset({"revolute", "prismatic", "screw"}) | WITH_TWO_AXES


def shortened(name: str) -> str:
    """A name as it is shown: without what a terminal or browser would obey, and without the middle of a long one."""
    if len(name) > _LONGEST:
        name = f"{name[:_BEGINNING]}\N{HORIZONTAL ELLIPSIS}{name[_BEGINNING + 1 - _LONGEST :]}"
    return printable(name)


def limits_of(joint: Joint, format: Format) -> tuple[str, ...]:
    """The range of each axis that has one."""
    if joint.type not in _WITH_LIMITS:
        return ()
    axes = (joint.axis, joint.axis2) if joint.type in WITH_TWO_AXES else (joint.axis,)
    unit = "m" if joint.type in _SLIDES else "rad"
    return tuple(text for axis in axes if axis for text in _range(axis, unit, format))


def _range(axis: Axis, unit: str, format: Format) -> Iterator[str]:
    if axis.limit is None:
        return
    limit = with_range(axis.limit, format)
    lower, upper = limit.lower or 0.0, limit.upper or 0.0
    bounds = [_number(lower) if lower > -UNLIMITED else "", _number(upper) if upper < UNLIMITED else ""]
    if all(bounds):
        yield f"{bounds[0]} to {bounds[1]} {unit}"
    elif any(bounds):
        yield f"from {bounds[0]} {unit}" if bounds[0] else f"up to {bounds[1]} {unit}"


def following(mimic: Mimic) -> str:
    """How a joint follows another, where it is not one to one."""
    parts = ((multiplier(mimic), 1.0, "multiplier"), (mimic.offset, 0.0, "offset"), (mimic.reference, 0.0, "reference"))
    return ", ".join(f"{word} {_number(value)}" for value, usual, word in parts if value not in {None, usual})


def _number(value: float | None) -> str:
    return f"{value:.4g}" if value is not None and math.isfinite(value) else str(value)
