"""How a conversion names materials, and the marks on what SDF and URDF say of them that the other does not.

<tf:colors ambient="0.1 0.1 0.1 1" of="1 0 0 1"/>   in a visual of URDF: SDF's other color, while `of` is this one's
<tf:scripts>file://a.material</tf:scripts>          in a visual of URDF: where the material of its link's tag is
<tf:material>rubber</tf:material>                   in a visual of SDF: the name that URDF has for its material
<tf:shared-material>rubber</tf:shared-material>     in a model of SDF: the robot defines this material
"""

from twinform.ir import Link, Visual

COLORS = "colors"
SCRIPTS = "scripts"
MATERIAL = "material"
SHARED_MATERIAL = "shared-material"
LOOK = "look"


def material_name(link: Link, visual: Visual) -> str:
    """The name of a material that has none in SDF; URDF asks for one."""
    return f"{link.name}_{visual.name}_material"
