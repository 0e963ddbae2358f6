"""Names that a conversion gives to materials, and annotations on what only SDF or only URDF has of them.

<tf:colors ambient="0.1 0.1 0.1 1" of="1 0 0 1"/>   in a visual of URDF: SDF's other color, while `of` is this one's
<tf:scripts>file://a.material</tf:scripts>          in a visual of URDF: where the material of its link's tag is
<tf:material>rubber</tf:material>                   in a visual of SDF: the name that URDF has for its material
<tf:shared-material>rubber</tf:shared-material>     in a model of SDF: the robot defines this material
<tf:look>ambient script</tf:look>                   in a link of SDF: what URDF sets for all its visuals in a `<gazebo>`
"""

from collections.abc import Iterable

from twinform.ir import Color, Link, Visual
from twinform.ir.node import NOT_CONTENT
from twinform.passes.carriers.annotations import find_annotation, with_annotation, without_annotation

COLORS = "colors"
SCRIPTS = "scripts"
MATERIAL = "material"
SHARED_MATERIAL = "shared-material"
LOOK = "look"


def with_look(link: Link, fields: Iterable[str]) -> Link:
    """The link with an annotation on the material fields that the last extension with any sets in all visuals."""
    names = [field for field in fields if field not in NOT_CONTENT]
    return with_annotation(without_annotation(link, LOOK), LOOK, " ".join(names))


def look_of(link: Link) -> tuple[str, ...]:
    """The fields of materials that one extension sets for all visuals."""
    found = find_annotation(link, LOOK)
    return tuple((found.text or "").split()) if found else ()


def material_name(link: Link, visual: Visual) -> str:
    """The name of a material that has none in SDF; URDF asks for one."""
    return f"{link.name}_{visual.name}_material"


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
