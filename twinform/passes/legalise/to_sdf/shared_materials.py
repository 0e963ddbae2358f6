"""Inlining the named materials of URDF into visuals."""

from collections.abc import Iterable
from functools import lru_cache
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.diagnostics.rules import GAZEBO_MATERIAL
from twinform.ir import Link, Material, Model, Opaque, Visual, count_parts
from twinform.passes.carriers.annotations import annotation
from twinform.passes.carriers.carriers import Keeper, pack, to_element
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import MATERIAL, SHARED_MATERIAL, material_name, seen_by_gazebo


class SharedMaterials(ModelPass):
    """Write the color and texture of a URDF material into every visual that uses it.

    Changes: 1. a color becomes `diffuse` and `ambient`; 2. a texture becomes the albedo map of a PBR material; 3. a
    visual that only names a material takes what is defined for the name, by the robot or else by the first visual that
    has more. The name is an annotation on the visual, and which materials the robot defines are annotations on the
    model; only a definition that no visual uses as it stands is carried whole.
    Never touches: the appearance that a `<gazebo>` element sets.
    Diagnostics: `gazebo-material`, once; ledger entries under `material-name`, and under `gazebo-conflict` where Gazebo
    takes the one color of a `<gazebo>` in place of both.
    """

    name: ClassVar[str] = "shared-materials"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without shared materials."""
        materials = [visual.material for link in model.links for visual in link.visuals if visual.material]
        shared = {material.name: material for material in model.materials}
        defined: dict[str, Material] = {}
        for material in (*model.materials, *materials):
            # The first definition counts, in document order, the shared ones before those of
            # visuals: so does urdfdom.
            if material.name and (material.color or material.texture):
                defined.setdefault(material.name, material)
        for material in model.materials:
            self._account(material, count_parts(material), sink)
        links = tuple(self._link(link, shared, defined, sink) for link in model.links)
        _note_gazebo((*model.materials, *materials), sink)
        named = {each.name for each in materials if not (each.color or each.texture)}
        annotations = tuple(_definition(material, named) for material in model.materials) if self.carriers else ()
        return model.copy(links=links, materials=(), opaque=(*model.opaque, *annotations))

    def _link(
        self, link: Link, shared: dict[str | None, Material], defined: dict[str, Material], sink: DiagnosticSink
    ) -> Link:
        if not any(visual.material for visual in link.visuals):
            return link
        visuals = tuple(self._visual(one, link, shared, defined, sink) for one in link.visuals)
        return link.copy(visuals=visuals)

    def _visual(
        self,
        visual: Visual,
        link: Link,
        shared: dict[str | None, Material],
        defined: dict[str, Material],
        sink: DiagnosticSink,
    ) -> Visual:
        material = visual.material
        if material is None or not (material.name is not None or material.color or material.texture):
            return visual
        source = material
        if not (material.color or material.texture):
            source = defined.get(material.name or "", material)
        if source.color and (material.ambient is None) != (material.diffuse is None):  # parser_urdf.cc, CreateVisual
            message = f"where Gazebo reads the URDF, visual {visual.name!r} has the color of <gazebo> alone"
            sink.account(Fate.APPROXIMATED, rules.GAZEBO_CONFLICT, message, visual.location, weight=0)
        update: dict[str, object] = {"material": _sdf_material(material, source)}
        own = material.color is not None or material.texture is not None
        if not (own and material.name == material_name(link, visual)):
            if material.name is not None:
                self._account(material, 1, sink)
            if self.carriers:
                update["opaque"] = (*visual.opaque, _name(material, shared))
        return visual.copy(**update)

    def _account(self, material: Material, weight: int, sink: DiagnosticSink) -> None:
        named = f"SDF has no name for the material {material.name!r}"
        message = named if material.name else "SDF has no shared materials"
        Keeper(sink, self.carriers).account(rules.MATERIAL_NAME, message, material.location, weight)


def _note_gazebo(materials: Iterable[Material], sink: DiagnosticSink) -> None:
    """Report the first material that Gazebo shows in another way when it reads the URDF."""
    for material in materials:
        if what := seen_by_gazebo(material.color or (), material.texture):
            # Once for a robot, and without an entry in the ledger: nothing is lost or approximated
            # here.
            message = f"in SDF materials are as they are written; where Gazebo reads the URDF, it shows this one {what}"
            sink.report(GAZEBO_MATERIAL, message, material.location)
            return


def _name(material: Material, shared: dict[str | None, Material]) -> Opaque:
    """The annotation with the name, and where the material is defined if that is not the usual place."""
    if material.name is None:
        return annotation(MATERIAL, attributes={"unnamed": "true"})
    own = material.color is not None or material.texture is not None
    definition = shared.get(material.name)
    usual = definition is None or not (definition.color or definition.texture)
    return _name_annotation(material.name, None if own == usual else "here" if own else "elsewhere")


@lru_cache(maxsize=256)
def _name_annotation(name: str, defined: str | None) -> Opaque:
    """Most robots say the same few names again and again."""
    return annotation(MATERIAL, name, {"defined": defined})


def _definition(material: Material, named: set[str | None]) -> Opaque:
    """The annotation of a material that the robot defines; with all its content, where no visual has that."""
    plain = not material.opaque and (material.color or material.texture)
    if plain and material.name in named:
        return annotation(SHARED_MATERIAL, material.name)
    (whole,) = pack([Opaque.unchecked(element=to_element(material, "material", "urdf"))], "urdf")
    return whole


def _sdf_material(material: Material, source: Material) -> Material:
    """The appearance of `source`, where the material has nothing in SDF's own syntax."""
    return material.copy(
        name=None,
        color=None,
        texture=None,
        # Diffuse and ambient alike: what is in the file is what is shown. libsdformat divides the
        # color by 0.8 and clamps it (parser_urdf.cc, CreateVisual), which brightens it and cannot
        # be undone above 0.8.
        ambient=material.ambient or source.color,
        diffuse=material.diffuse or source.color,
        # libsdformat reads no textures of URDF and writes a black material instead.
        albedo_map=material.albedo_map or source.texture,
    )
