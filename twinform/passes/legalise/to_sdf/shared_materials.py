"""Materials that are named become colours that are written."""

from functools import lru_cache
from typing import ClassVar

from twinform.diagnostics import Fate, Notes
from twinform.diagnostics.rules import to_sdf
from twinform.ir import Color, Element, Link, Material, Model, Opaque, Visual, count_parts
from twinform.passes.legalise.carrier import carry, pack, to_element
from twinform.passes.legalise.model_pass import ModelPass


class SharedMaterials(ModelPass):
    """Write the colour and texture of a URDF material into every visual that uses it.

    Changes: 1. a colour becomes `diffuse` and `ambient`; 2. a texture becomes the albedo map of a PBR material; 3. a
    visual that only names a material takes what is defined for the name, by the robot or else by the first visual that
    says more. The `<material>` elements as they stood are carried, by the visual and by the model.
    Never touches: what a `<gazebo>` element says about the look.
    Diagnostics: none; ledger entries under `material-name`.
    """

    name: ClassVar[str] = "shared-materials"
    carriers: bool = True

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model without shared materials."""
        materials = [visual.material for link in model.links for visual in link.visuals if visual.material]
        defined: dict[str, Material] = {}
        for material in (*model.materials, *materials):
            if material.name and (material.color or material.texture):
                defined.setdefault(material.name, material)
        for material in model.materials:
            self._account(material, count_parts(material), notes)
        shared = [Opaque(element=_element(material)) for material in model.materials]
        links = tuple(self._link(link, defined, notes) for link in model.links)
        model = model.model_copy(update={"links": links, "materials": ()})
        return carry(model, shared, "urdf") if self.carriers else model

    def _link(self, link: Link, defined: dict[str, Material], notes: Notes) -> Link:
        if not any(visual.material for visual in link.visuals):
            return link
        return link.model_copy(update={"visuals": tuple(self._visual(one, defined, notes) for one in link.visuals)})

    def _visual(self, visual: Visual, defined: dict[str, Material], notes: Notes) -> Visual:
        material = visual.material
        if material is None or not (material.name or material.color or material.texture):
            return visual
        source = material
        if not (material.color or material.texture):
            source = defined.get(material.name or "", material)
        look = _sdf_material(material, source)
        if not material.name:
            return visual.model_copy(update={"material": look})
        self._account(material, 1, notes)
        carriers = _carriers(material.name, material.color, material.texture) if self.carriers else ()
        return visual.model_copy(update={"material": look, "opaque": (*visual.opaque, *carriers)})

    def _account(self, material: Material, weight: int, notes: Notes) -> None:
        fate = Fate.CARRIED if self.carriers else Fate.DROPPED
        named = f"SDF has no name for the material {material.name!r}"
        message = named if material.name else "SDF has no shared materials"
        notes.account(fate, to_sdf.MATERIAL_NAME, message, material.location, weight)


@lru_cache(maxsize=256)
def _carriers(name: str | None, color: Color | None, texture: str | None) -> tuple[Opaque, ...]:
    """The material as URDF writes it, in a carrier; most robots say the same few again and again."""
    return pack([Opaque(element=_element(Material(name=name, color=color, texture=texture)))], "urdf")


def _element(material: Material) -> Element:
    return to_element(material.model_copy(update={"opaque": ()}), "material", "urdf")


def _sdf_material(material: Material, source: Material) -> Material:
    """The look of `source`, where the material says nothing in SDF's own words."""
    return material.model_copy(
        update={
            "name": None,
            "color": None,
            "texture": None,
            "ambient": material.ambient or source.color,
            "diffuse": material.diffuse or source.color,
            "albedo_map": material.albedo_map or source.texture,
        }
    )
