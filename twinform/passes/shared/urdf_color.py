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


def seen_by_gazebo(color: Color, texture: str | None) -> str:
    """How Gazebo shows a material of URDF; empty where it is as it is written."""
    # it divides all by 0.8 and cuts off at 1, and reads no textures: parser_urdf.cc, CreateVisual
    brighter = "brighter, as it divides colors by 0.8" if any(0 < part < 1 for part in color[:3]) else ""
    bare = "without its texture" if texture is not None else ""
    return " and ".join(filter(None, (bare, brighter)))
