"""Names that a conversion gives to materials, and annotations on what only SDF or only URDF has of them.

<tf:colors ambient="0.1 0.1 0.1 1" of="1 0 0 1"/>   in a visual of URDF: SDF's other color, while `of` is this one's
<tf:scripts>file://a.material</tf:scripts>          in a visual of URDF: where the material of its link's tag is
<tf:material>rubber</tf:material>                   in a visual of SDF: the name that URDF has for its material
<tf:shared-material>rubber</tf:shared-material>     in a model of SDF: the robot defines this material
<tf:look>ambient script</tf:look>                   in a link of SDF: what URDF sets for all its visuals in a `<gazebo>`
"""

from collections.abc import Iterable

from twinform.ir import Link, Visual
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
