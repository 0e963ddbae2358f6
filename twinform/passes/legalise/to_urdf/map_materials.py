"""A URDF material is one colour, one texture and a name."""

from typing import ClassVar

from twinform.diagnostics.rules import to_urdf as rules
from twinform.ir import Element, GazeboExtension, Link, Material, Model, Visual
from twinform.passes.legalise.marks import mark_made
from twinform.passes.legalise.nodes import text_piece, unique_name
from twinform.passes.legalise.to_urdf.base import ToUrdfPass
from twinform.passes.legalise.to_urdf.keeper import Keeper
from twinform.passes.legalise.to_urdf.map_geometry import package_uri
from twinform.passes.legalise.urdf_color import urdf_color
from twinform.schemas import format_value

"""Red, green, blue and alpha."""


class MapMaterials(ToUrdfPass):
    """Say colours and albedo maps as URDF does.

    Changes: 1. the diffuse colour, or the ambient one where that is all there is, becomes the colour; both are carried
    unless they are equal, as URDF's one colour means both; a part beyond 0 or 1 is cut off there; 2. the albedo map
    becomes the texture; 3. each such material gets a name, LINK_VISUAL_material, because URDF asks for one; 4. a
    material of Gazebo Classic that all visuals of a link share is its `<material>` tag too.
    Never touches: the other parts of a material, which the last pass carries.
    Diagnostics: in the ledger `colours` and `sdf-only`.
    """

    name: ClassVar[str] = "map-materials"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model with materials of URDF."""
        names: set[str] = set()
        links = tuple(_map_link(link, names, keeper) for link in model.links)
        tags = tuple(tag for link in model.links for tag in _script_tag(link))
        return model.model_copy(update={"links": links, "extensions": (*model.extensions, *tags)})


def _map_link(link: Link, names: set[str], keeper: Keeper) -> Link:
    if not any(visual.material for visual in link.visuals):
        return link
    return link.model_copy(update={"visuals": tuple(_map_visual(one, link, names, keeper) for one in link.visuals)})


def _map_visual(visual: Visual, link: Link, names: set[str], keeper: Keeper) -> Visual:
    material = visual.material
    if material is None:
        return visual
    update: dict[str, object] = {}
    color = material.diffuse or material.ambient
    if color is not None:
        update |= {"color": urdf_color(color), "diffuse": None, "ambient": None}
        visual = _keep_colours(visual, material, keeper)
    if material.albedo_map is not None:
        uri, lost = package_uri(material.albedo_map)
        update |= {"texture": uri, "albedo_map": None}
        if lost:
            message = f"the albedo map of visual {visual.name!r} is called {material.albedo_map!r}"
            pieces = [text_piece("albedo_map", material.albedo_map, "material/pbr/metal")]
            visual = keeper.keep(visual, pieces, rules.SDF_ONLY, message, material.location)
    if not update:
        return visual
    update["name"] = unique_name(f"{link.name}_{visual.name}_material", names)
    names.add(str(update["name"]))
    made = mark_made(material.model_copy(update=update), "name")
    return visual.model_copy(update={"material": made})


def _keep_colours(visual: Visual, material: Material, keeper: Keeper) -> Visual:
    """Carry the colours where they say more than one colour does."""
    if material.diffuse == material.ambient and material.diffuse == urdf_color(material.diffuse or ()):
        return visual
    written = (("ambient", material.ambient), ("diffuse", material.diffuse))
    pieces = [text_piece(name, format_value(color), "material") for name, color in written if color is not None]
    message = f"the colours of visual {visual.name!r} are {' and '.join(p.element.name for p in pieces if p.element)}"
    return keeper.keep(visual, pieces, rules.COLOURS, message, material.location)


def _script_tag(link: Link) -> list[GazeboExtension]:
    scripts = {
        visual.material.script.name if visual.material and visual.material.script else None for visual in link.visuals
    }
    name = scripts.pop() if len(scripts) == 1 else None
    if name is None or not name.startswith("Gazebo/"):
        return []
    return [GazeboExtension(reference=link.name, content=(Element(name="material", text=name),), source=link.source)]
