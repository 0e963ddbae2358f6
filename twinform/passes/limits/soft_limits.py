"""The soft limits of joints: URDF's `<safety_controller>`, which SDF has in a carrier."""

import math
from collections.abc import Iterator
from typing import NamedTuple

from twinform.ir import Element, Joint, Opaque
from twinform.passes.carriers.carriers import is_carrier, unpack

_ELEMENT = "safety_controller"


class SoftLimits(NamedTuple):
    """Where a controller begins to brake, in rad or m; None where it is not written."""

    lower: float | None
    upper: float | None

    def __str__(self) -> str:
        """As a message has it."""
        lower, upper = ("open" if end is None else f"{end:g}" for end in self)
        return f"{lower} to {upper}"


def soft_limits(joint: Joint) -> SoftLimits | None:
    """The soft limits of a joint; None where it has none, which a lower and an upper one of zero stand for."""
    for element in _elements(joint):
        lower, upper = (_number(element.get(name)) for name in ("soft_lower_limit", "soft_upper_limit"))
        if lower or upper:
            return SoftLimits(lower, upper)
    return None


def _elements(joint: Joint) -> Iterator[Element]:
    """Every safety controller of a joint, as it stands or in a carrier."""
    parts: list[Opaque] = []
    for part in joint.opaque:
        parts += unpack(part) if is_carrier(part, "urdf") else (part,)
    for part in parts:
        if part.element and part.element.name == _ELEMENT:
            yield part.element


def _number(text: str | None) -> float | None:
    """The number of an attribute; readers skip what is none, and the reader has reported it."""
    try:
        value = float(text) if text is not None else None
    except ValueError:
        return None
    return value if value is not None and math.isfinite(value) else None
