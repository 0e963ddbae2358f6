"""Converting materials to URDF: one color, one texture and a name."""

from typing import ClassVar

from twinform.diagnostics import Fate, rules
from twinform.ir import Element, GazeboExtension, Link, Material, Model, Visual
from twinform.passes.legalise.changed_names import (
    COLORS,
    SCRIPTS,
    material_name,
    seen_by_gazebo,
    urdf_color,
    with_alpha,
)
from twinform.passes.legalise.to_urdf.map_geometry import urdf_uri
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.document_uris import TEXTURE_SCHEME
from twinform.passes.shared.gazebo_tags import SCRIPT_URI
from twinform.passes.shared.nodes import reserve_name
from twinform.schemas import format_value


class MapMaterials(ToUrdfPass):
    """Say colors and albedo maps as URDF does.

    Changes: 1. the diffuse color, or the ambient one where that is all there is, becomes the color; both are carried
    unless they are equal, as URDF's one color means both; a part beyond 0 or 1 is cut off there; 2. the albedo map
    becomes the texture; 3. each such material gets a name, LINK_VISUAL_material, because URDF asks for one; 4. a
    material of Gazebo Classic that all visuals of a link share is its `<material>` tag too.
    Never touches: the other parts of a material, which the last pass carries.
    Diagnostics: in the ledger `colors`, `gazebo-material` and `sdf-only`.
    """

    name: ClassVar[str] = "map-materials"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with materials of URDF."""
        names: set[str] = set()
        links = tuple(_map_link(link, names, keeper) for link in model.links)
        tags = {link.name: tag for link in links if (tag := _script_tag(link, keeper)) is not None}
        links = tuple(_set_by_tag(link, keeper) if link.name in tags else link for link in links)
        return model.copy(links=links, extensions=(*model.extensions, *tags.values()))


def _map_link(link: Link, names: set[str], keeper: UrdfKeeper) -> Link:
    if not any(visual.material for visual in link.visuals):
        return link
    return link.copy(visuals=tuple(_map_visual(one, link, names, keeper) for one in link.visuals))


def _map_visual(visual: Visual, link: Link, names: set[str], keeper: UrdfKeeper) -> Visual:
    material = visual.material
    if material is None:
        return visual
    update: dict[str, object] = {}
    color = material.diffuse or material.ambient
    if color is not None:
        update |= {"color": urdf_color(color), "diffuse": None, "ambient": None}
        visual = _keep_colors(visual, material, keeper)
    if material.albedo_map is not None:
        visual, uri = urdf_uri(visual, TEXTURE_SCHEME, material.albedo_map, keeper)
        update |= {"texture": uri, "albedo_map": None}
    if not update:
        return visual
    _note_gazebo(visual, material, keeper)
    update["name"] = reserve_name(material_name(link, visual), names)
    return visual.copy(material=material.copy(**update))


def _keep_colors(visual: Visual, material: Material, keeper: UrdfKeeper) -> Visual:
    """The visual with an annotation on its colors, if one color cannot express them."""
    written = {"ambient": material.ambient, "diffuse": material.diffuse}
    color = urdf_color(material.diffuse or material.ambient or ())
    others = {
        name: format_value(value) if value else ""
        for name, value in written.items()
        if not value or with_alpha(value) != color
    }
    if not others:
        return visual
    message = f"visual {visual.name!r} has more colors than a URDF material can have"
    keeper.account(rules.COLOURS, message, material.location, sum(1 for name in others if written[name]))
    return keeper.annotate(visual, COLORS, attributes={**others, "of": format_value(color)}, always=True)


def _note_gazebo(visual: Visual, material: Material, keeper: UrdfKeeper) -> None:
    """Enter into the ledger that Gazebo shows the material of the URDF otherwise."""
    # A <material> in <gazebo> would give Gazebo the SDF's color. A color that somebody edits in the
    # URDF would then count for RViz and not for Gazebo: one fact would stand twice in the file.
    if what := seen_by_gazebo(urdf_color(material.diffuse or material.ambient or ()), material.albedo_map):
        message = f"Gazebo shows visual {visual.name!r} {what} when it reads URDF"
        keeper.sink.account(Fate.APPROXIMATED, rules.GAZEBO_MATERIAL, message, material.location, weight=0)


def _script_tag(link: Link, keeper: UrdfKeeper) -> GazeboExtension | None:
    """The `<gazebo>` element for a link whose visuals share a material of Gazebo Classic."""
    scripts = {
        visual.material.script.name if visual.material and visual.material.script else None for visual in link.visuals
    }
    name = scripts.pop() if len(scripts) == 1 else None
    if name is None or not (name.startswith("Gazebo/") or keeper.back):
        return None
    return GazeboExtension.unchecked(
        reference=link.name, content=(Element.unchecked(name="material", text=name),), source=link.source
    )


def _set_by_tag(link: Link, keeper: UrdfKeeper) -> Link:
    """The link without the materials that a tag sets, but with annotations on their files."""
    visuals: list[Visual] = []
    for visual in link.visuals:
        material, script = visual.material, visual.material.script if visual.material else None
        bare = material.copy(script=None) if material else None
        one = visual.copy(material=None if bare == Material.unchecked() else bare)
        if script and script.uris:
            message = f"<material> for link {link.name!r} does not name the files of the material of {visual.name!r}"
            keeper.account(rules.SDF_ONLY, message, script.location, len(script.uris))
        if script and script.uris != (SCRIPT_URI,):
            one = keeper.annotate(one, SCRIPTS, text="\n".join(script.uris), always=True)
        visuals.append(one)
    return link.copy(visuals=tuple(visuals))
