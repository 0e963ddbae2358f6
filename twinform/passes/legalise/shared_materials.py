"""Materials that visuals of a URDF share by name, written into each visual of SDF, and the way back."""

from collections import Counter
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import ClassVar, NamedTuple

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.diagnostics.rules import GAZEBO_MATERIAL, STALE_CARRIER
from twinform.ir import Color, Element, Link, Material, Model, Opaque, Visual, count_parts, replace_fields
from twinform.passes.carriers.annotations import annotation, find_annotation, is_annotation, without_annotation
from twinform.passes.carriers.carriers import Keeper, is_carrier, pack, to_element, unpack
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import MATERIAL, SHARED_MATERIAL, material_name, seen_by_gazebo
from twinform.schemas import Context, element_xml, reader, table


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


Look = tuple[Color | None, str | None]
"""The color and the texture of a material."""


class RestoreMaterials(ModelPass):
    """Name materials as URDF named them, and define those again that the robot defined.

    Changes: 1. a material has the name in an annotation on its visual; 2. what the robot defined is what most
    visuals by its name look like now, and these only name it; 3. so do visuals that took it from another one.
    Never touches: the appearance of a visual. One that differs from what its name means keeps a name of its own.
    Diagnostics: `stale-carrier` for these.
    """

    name: ClassVar[str] = "restore-materials"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with materials of its URDF file."""
        visuals = [one for link in model.links for visual in link.visuals if (one := _read_annotation(visual))]
        shared = _find_shared(model, visuals)
        if sink.has_errors or not (visuals or shared):
            return model
        defined = {**_own_looks(visuals, shared), **{name: _look_of(material) for name, material in shared.items()}}
        links = tuple(_restore_in_link(link, defined, shared, sink) for link in model.links)
        kept = tuple(
            part for part in model.opaque if not is_annotation(part, SHARED_MATERIAL) and _carried(part) is None
        )
        materials = (*model.materials, *shared.values())
        return model.copy(links=links, materials=materials, opaque=kept)


class _Annotated(NamedTuple):
    """A visual, and its annotation on the material.

    `defined` is where the material is defined, if that is not the default for its name.
    """

    visual: Visual
    name: str
    defined: str | None
    is_unnamed: bool


def _read_annotation(visual: Visual) -> _Annotated | None:
    found = find_annotation(visual, MATERIAL)
    if found is None:
        return None
    return _Annotated(visual, found.text or "", found.get("defined"), found.get("unnamed") == "true")


def _find_shared(model: Model, visuals: list[_Annotated]) -> dict[str, Material]:
    """The materials of the robot: with the look of most of their visuals, or as they were carried."""
    names = {part.element.text or "" for part in model.opaque if part.element and is_annotation(part, SHARED_MATERIAL)}
    counts: dict[str, Counter[Look]] = {name: Counter() for name in names}
    for one in visuals:
        if one.name in counts and one.defined != "here":
            counts[one.name][_look(one.visual)] += 1
    found: dict[str, Material] = {}
    for part in model.opaque:
        whole = _carried(part)
        if whole is not None:
            found[whole.name or ""] = whole
        elif part.element is not None and is_annotation(part, SHARED_MATERIAL) and counts[part.element.text or ""]:
            name = part.element.text or ""
            # Somebody may have repainted some visuals in SDF. What the robot defines is what most
            # of them look like; the others keep a color of their own.
            color, texture = counts[name].most_common(1)[0][0]
            if color or texture:
                found[name] = Material.unchecked(name=name, color=color, texture=texture)
    return found


def _carried(part: Opaque) -> Material | None:
    """The material in a carrier of URDF."""
    pieces = unpack(part) if is_carrier(part, "urdf") else ()
    element = pieces[0].element if len(pieces) == 1 else None
    return _read_material(element) if element is not None and element.name == "material" else None


def _read_material(element: Element) -> Material | None:
    """The material that an element defines; None where the element is invalid."""
    sink = DiagnosticSink()
    context = Context(sink, "", "urdf", table("urdf").newest)
    data = reader("urdf", context.version).read(element_xml(element), context, "material", Material)
    return Material.unchecked(**data) if element.get("name") and not sink.has_errors else None


def _own_looks(visuals: list[_Annotated], shared: Mapping[str, Material]) -> dict[str, Look]:
    """The looks of materials that a visual defines itself, by name; the first visual counts."""
    found: dict[str, Look] = {}
    for one in visuals:
        if _is_own(one, shared):
            found.setdefault(one.name, _look(one.visual))
    return found


def _is_own(one: _Annotated, shared: Mapping[str, Material]) -> bool:
    """Whether the visual itself defines its material, as `shared-materials` annotates it."""
    if one.defined is not None:
        return one.defined == "here"
    definition = shared.get(one.name)
    return definition is None or not (definition.color or definition.texture)


def _look(visual: Visual) -> Look:
    return _look_of(visual.material) if visual.material else (None, None)


def _look_of(material: Material) -> Look:
    return material.color, material.texture


def _restore_in_link(
    link: Link, defined: Mapping[str, Look], shared: Mapping[str, Material], sink: DiagnosticSink
) -> Link:
    return replace_fields(
        link, visuals=tuple(_restore_in_visual(visual, defined, shared, sink) for visual in link.visuals)
    )


def _restore_in_visual(
    visual: Visual, defined: Mapping[str, Look], shared: Mapping[str, Material], sink: DiagnosticSink
) -> Visual:
    one = _read_annotation(visual)
    if one is None:
        return visual
    name, own = one.name, _is_own(one, shared)
    bare = without_annotation(visual, MATERIAL)
    material = visual.material
    if material is not None and one.is_unnamed:
        return bare.copy(material=material.copy(name=None))
    if material is None and defined.get(name, (None, None)) == (None, None) and not own:
        return bare.copy(material=Material.unchecked(name=name))  # which nobody defines
    if material is not None and own:
        return bare.copy(material=material.copy(name=name))
    if material is not None and _look_of(material) == defined.get(name, (None, None)):
        named = material.copy(name=name, color=None, texture=None)
        return bare.copy(material=named)
    why = "has none" if material is None else "is another one"
    message = f"visual {visual.name!r} had the material {name!r}, and {why} now"
    sink.report(STALE_CARRIER, message, visual.location, found=name)
    return bare
