"""Colors of URDF materials: alpha, and the range that urdfdom accepts."""

from twinform.ir import Color

_WITH_ALPHA = 4


def urdf_color(color: Color) -> Color:
    """With alpha, and each part from 0 to 1, outside of which urdfdom refuses it."""
    clamped = tuple(min(1.0, max(0.0, part)) for part in color)
    return with_alpha(color if clamped == color else clamped)


def with_alpha(color: Color) -> Color:
    """Red, green, blue and alpha, which is 1 where it is not written."""
    return color if len(color) == _WITH_ALPHA else (*color, 1.0)
