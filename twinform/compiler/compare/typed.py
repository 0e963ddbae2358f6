"""Texts as values of the kinds that robots are compared by, after the types of the facts tables."""

from twinform.compiler.compare.values import Flag, Numbers, Value, Words
from twinform.schemas import parse_value

NUMBERS = frozenset({"double", "int", "uint", "vector3", "vector2d", "vector2i", "quaternion", "time"})
COLORS = frozenset({"color", "color4"})
_WITH_ALPHA = 4


def typed_value(type: str | None, text: str, format: str = "sdf", unit: str = "") -> Value | None:
    """A text as a truth or as numbers, where its type has such; None where the type is only text.

    What is not of its type is the words that it says.
    """
    if type != "bool" and type not in NUMBERS and type not in COLORS:
        return None
    try:
        parsed = parse_value(type, text, format)
    except ValueError:
        return Words(text)
    if isinstance(parsed, bool):
        return Flag(parsed)
    numbers = tuple(map(float, text.split())) if isinstance(parsed, tuple) else (float(str(parsed)),)
    return Numbers(_with_alpha(numbers) if type in COLORS else numbers, unit)


def _with_alpha(color: tuple[float, ...]) -> tuple[float, ...]:
    return color if len(color) == _WITH_ALPHA else (*color, 1.0)
