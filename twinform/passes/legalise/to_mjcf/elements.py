"""Elements of MJCF: attributes from numbers and back, positions and quaternions from transforms.

Numbers are written so that they read back as the same double. Orientations are always quaternions, w x y z.
"""

from collections.abc import Iterable

from twinform.diagnostics import Source
from twinform.ir import Element
from twinform.ir.transform import Transform, rounded, rounded_number
from twinform.schemas import format_value
from twinform.schemas.value_types import format_numbers

Value = str | float | bool | tuple[float, ...] | None
"""What an attribute may be made of; one that is None is not written."""
Attributes = Iterable[tuple[str, Value]]
ENDLESS = 200.0
"""The size in m that a plane without an end has in SDF, where it only matters for what is seen."""
GRID = 1.0
"""The distance in m of the lines that are drawn on a plane."""
_UNTURNED = (1.0, 0.0, 0.0, 0.0)
"""The quaternion of no rotation."""


def make_element(
    name: str, attributes: Attributes = (), children: Iterable[Element] = (), source: Source | None = None
) -> Element:
    """Return an element; `source` is where the part was read that it is written for."""
    # Half of all values are texts, and a call for each of them takes longer.
    written = [
        (key, value if isinstance(value, str) else attribute_text(value))
        for key, value in attributes
        if value is not None
    ]
    return Element.unchecked(name=name, attributes=tuple(written), children=tuple(children), source=source)


def attribute_text(value: str | float | bool | tuple[float, ...]) -> str:
    """The text of a value."""
    if isinstance(value, tuple):
        return format_numbers(value)
    return value if isinstance(value, str) else format_value(value)


def numbers_in(text: str | None) -> tuple[float, ...]:
    """The numbers of a text; none where there is no text."""
    return tuple(map(float, (text or "").split()))


def placement(transform: Transform) -> list[tuple[str, Value]]:
    """`pos` and `quat` of a transform; what is zero or no rotation is left out."""
    found: list[tuple[str, Value]] = []
    if any(place := position(transform)):
        found.append(("pos", place))
    if (turn := orientation(transform)) != _UNTURNED:
        found.append(("quat", turn))
    return found


def position(transform: Transform) -> tuple[float, float, float]:
    """The translation, without the noise of computing it."""
    return rounded(transform.translation) if transform.notation is None else transform.translation


def orientation(transform: Transform) -> tuple[float, float, float, float]:
    """The rotation as a unit quaternion w x y z, with w at least 0."""
    if transform.is_unturned:
        return _UNTURNED
    x, y, z, w = transform.quaternion()
    written = transform.notation.quat_xyzw if transform.notation else None
    if written is not None and written[3] < 0:  # both mean one rotation, and the one that was read stays
        x, y, z, w = (-each if w > 0 else each for each in (x, y, z, w))
    elif w < 0:
        x, y, z, w = -x, -y, -z, -w
    return (rounded_number(w), rounded_number(x), rounded_number(y), rounded_number(z))
