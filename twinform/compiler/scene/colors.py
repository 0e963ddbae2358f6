"""The color that a visual is drawn in."""

from twinform.ir import Color, Material
from twinform.passes.appearance.classic_materials import classic_materials


def color_of(material: Material | None) -> Color | None:
    """Red, green, blue and alpha from 0 to 1, as written or of a script of Gazebo Classic; None where none is said."""
    if material is None:
        return None
    of_script = classic_materials().get(material.script.name or "") if material.script else None
    return material.color or material.diffuse or (of_script.diffuse if of_script else None) or material.ambient
