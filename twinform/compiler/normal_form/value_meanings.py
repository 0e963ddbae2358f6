"""The values of a normal form: what an attribute, a text or a pose means, however it is spelled."""

import math

from twinform.compiler.compare.compared_values import Flag, Numbers, PoseValue, Text, Value, gaps, typed_value
from twinform.ir import Pose
from twinform.ir.transform import Transform
from twinform.schemas import Fact, XmlElement, format_value, parse_value

TOLERANCE = 1e-9
"""The share of a number, or of a meter or radian of a pose, up to which a difference is rounding."""
_LEAST = 1e-6
"""Numbers are measured against this at least: what rounding leaves of zero is zero, and the smallest inertia is not."""
_QUATERNION = 7
NOWHERE_ELSE = PoseValue(Transform())
"""The pose that is none."""


def same(one: Value, other: Value) -> bool:
    """Whether two values are equal but for rounding."""
    if one == other:
        return True
    if isinstance(one, Numbers) and isinstance(other, Numbers):
        return _same_numbers(one.values, other.values)
    return not any(gap.exceeds(TOLERANCE) for gap in gaps(one, other))


def _same_numbers(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    """Whether the numbers are equal, measured against the largest of them."""
    if len(one) != len(other):
        return False
    scale = max((abs(number) for number in (*one, *other) if math.isfinite(number)), default=0.0)
    return all(
        a == b or abs(a - b) <= TOLERANCE * max(_LEAST, scale) or (math.isnan(a) and math.isnan(b))
        for a, b in zip(one, other, strict=True)
    )


def value_of(text: str, row: Fact, format: str) -> Value:
    """The value of a text, by its type."""
    return typed_value(row.type, text, format) or Text(text)


def parsed_value(parsed: object) -> Value:
    """A value that has been read already."""
    if isinstance(parsed, bool):
        return Flag(parsed)
    if isinstance(parsed, str):
        return Text(parsed)
    return Numbers(tuple(map(float, format_value(parsed).split())))


def literally(text: str) -> Value:
    """A text of unknown meaning: with single blanks."""
    return Text(" ".join(text.split()))


def urdf_pose(element: XmlElement) -> Transform | None:
    """Where an `<origin>` is; None where that is no pose."""
    try:
        xyz, rpy, quaternion = (_numbers(element.get(name)) for name in ("xyz", "rpy", "quat_xyzw"))
        return Transform.from_pose(Pose.model_validate({"xyz": xyz, "rpy": rpy, "quat_xyzw": quaternion}))
    except ValueError:
        return None


def sdf_pose(element: XmlElement) -> Transform | None:
    """Where a `<pose>` is; None where that is no pose."""
    try:
        numbers = _numbers(element.text) or (0.0,) * (_QUATERNION - 1)
        degrees = parse_value("bool", element.get("degrees") or "false")
        turned = "quat_xyzw" if len(numbers) == _QUATERNION else "rpy"
        pose = {"xyz": numbers[:3], turned: numbers[3:], "degrees": degrees}
        return Transform.from_pose(Pose.model_validate(pose))
    except ValueError:
        return None


def _numbers(text: str | None) -> tuple[float, ...] | None:
    return tuple(map(float, text.split())) if text and text.strip() else None
