"""The one colour that a material has in URDF."""

from twinform.ir import Color

_WITH_ALPHA = 4


def urdf_color(color: Color) -> Color:
    """With alpha, and each part from 0 to 1, outside of which urdfdom refuses it."""
    clamped = tuple(min(1.0, max(0.0, part)) for part in color)
    within = color if clamped == color else clamped
    return within if len(color) == _WITH_ALPHA else (*within, 1.0)
