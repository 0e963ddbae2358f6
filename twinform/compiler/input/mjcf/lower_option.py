"""Settings of MJCF as those of a world of SDF: gravity, wind, magnetic field and time step."""

from typing import NamedTuple

from twinform.compiler.input.mjcf.number_lists import Numbers
from twinform.compiler.input.mjcf.pieces import Piece
from twinform.ir import Element, Opaque
from twinform.ir.node import Vector3
from twinform.schemas import format_value

_GRAVITY: Numbers = (0.0, 0.0, -9.81)
_MAGNETIC: Numbers = (0.0, -0.5, 0.0)
_TIME_STEP = 0.002
"""What MuJoCo takes where a file says nothing; SDF would take other numbers."""


class WorldSettings(NamedTuple):
    """What a world of SDF says of the settings of a file."""

    gravity: Vector3
    opaque: tuple[Opaque, ...]


def lower_option(options: tuple[Piece, ...]) -> WorldSettings:
    """Take what SDF has of all `<option>` elements; of two values the later one counts."""
    gravity, magnetic = _last(options, "gravity") or _GRAVITY, _last(options, "magnetic") or _MAGNETIC
    step = (_last(options, "timestep") or (_TIME_STEP,))[0]
    wind = _last(options, "wind")
    x, y, z = gravity
    physics = Element.unchecked(
        name="physics",
        attributes=(("type", "ignored"),),
        children=(_text("max_step_size", step),),
    )
    made = [physics, _text("magnetic_field", magnetic)]
    if any(wind):
        made.append(Element.unchecked(name="wind", children=(_text("linear_velocity", wind),)))
    where = options[-1].source if options else None
    return WorldSettings((x, y, z), tuple(Opaque.unchecked(element=each, source=where) for each in made))


def _last(options: tuple[Piece, ...], attribute: str) -> Numbers:
    found = [each.numbers(attribute) for each in options if each.has(attribute)]
    return found[-1] if found else ()


def _text(name: str, value: object) -> Element:
    return Element.unchecked(name=name, text=format_value(value))
