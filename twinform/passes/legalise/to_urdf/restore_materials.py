"""Reverse conversion of materials: restoring how the URDF source wrote them."""

from collections import Counter
from collections.abc import Mapping
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules.to_urdf import STALE_CARRIER
from twinform.ir import Color, Element, Link, Material, Model, Opaque, Visual
from twinform.passes.carriers.annotations import find_annotation, is_annotation, without_annotation
from twinform.passes.carriers.carriers import is_carrier, unpack
from twinform.passes.carriers.material_annotations import MATERIAL, SHARED_MATERIAL
from twinform.passes.framework.base import ModelPass
from twinform.schemas import Context, element_xml, reader, table

Look = tuple[Color | None, str | None]
"""The color and the texture of a material."""


class RestoreMaterials(ModelPass):
    """Name materials as URDF named them, and define those again that the robot defined.

    Changes: 1. a material has the name in an annotation on its visual; 2. what the robot defined is what most
    visuals by its name look like now, and these only name it; 3. so do visuals that took it from another one.
    Never touches: the look of a visual. One that differs from what its name means keeps a name of its own.
    Diagnostics: `stale-carrier` for these.
    """

    name: ClassVar[str] = "restore-materials"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with materials of its URDF file."""
        visuals = [visual for link in model.links for visual in link.visuals if find_annotation(visual, MATERIAL)]
        shared = _shared(model, visuals)
        if sink.has_errors or not (visuals or shared):
            return model
        defined = {**_own(visuals, shared), **{name: _look_of(material) for name, material in shared.items()}}
        links = tuple(_link(link, defined, shared, sink) for link in model.links)
        kept = tuple(
            part for part in model.opaque if not is_annotation(part, SHARED_MATERIAL) and _carried(part) is None
        )
        materials = (*model.materials, *shared.values())
        return model.model_copy(update={"links": links, "materials": materials, "opaque": kept})


def _shared(model: Model, visuals: list[Visual]) -> dict[str, Material]:
    """What the robot defines: what most of its visuals look like, or what was carried whole."""
    names = {part.element.text or "" for part in model.opaque if part.element and is_annotation(part, SHARED_MATERIAL)}
    looks: dict[str, Counter[Look]] = {name: Counter() for name in names}
    for visual in visuals:
        name = _name(visual)
        if name in looks and _says(visual) != "here":
            looks[name][_look(visual)] += 1
    found: dict[str, Material] = {}
    for part in model.opaque:
        whole = _carried(part)
        if whole is not None:
            found[whole.name or ""] = whole
        elif part.element is not None and is_annotation(part, SHARED_MATERIAL) and looks[part.element.text or ""]:
            name = part.element.text or ""
            color, texture = looks[name].most_common(1)[0][0]
            if color or texture:
                found[name] = Material(name=name, color=color, texture=texture)
    return found


def _carried(part: Opaque) -> Material | None:
    """The material in a carrier of URDF."""
    pieces = unpack(part) if is_carrier(part, "urdf") else ()
    element = pieces[0].element if len(pieces) == 1 else None
    return _material(element) if element is not None and element.name == "material" else None


def _material(element: Element) -> Material | None:
    """The material that an element defines; None where it was edited into nonsense."""
    sink = DiagnosticSink()
    context = Context(sink, "", "urdf", table("urdf").newest)
    data = reader("urdf", context.version).read(element_xml(element), context, "material")
    return Material.model_validate(data) if element.get("name") and not sink.has_errors else None


def _own(visuals: list[Visual], shared: Mapping[str, Material]) -> dict[str, Look]:
    """What the first visual with a material of its own says of it, for those that only name it."""
    found: dict[str, Look] = {}
    for visual in visuals:
        if _is_own(visual, shared):
            found.setdefault(_name(visual), _look(visual))
    return found


def _name(visual: Visual) -> str:
    found = find_annotation(visual, MATERIAL)
    return (found.text or "") if found else ""


def _says(visual: Visual) -> str | None:
    """Where an annotation says that the material is defined, if that is not where its name makes one expect."""
    found = find_annotation(visual, MATERIAL)
    return found.get("defined") if found else None


def _is_unnamed(visual: Visual) -> bool:
    found = find_annotation(visual, MATERIAL)
    return found is not None and found.get("unnamed") == "true"


def _is_own(visual: Visual, shared: Mapping[str, Material]) -> bool:
    """Whether the visual itself defines its material, as `shared-materials` annotates it."""
    says = _says(visual)
    if says is not None:
        return says == "here"
    definition = shared.get(_name(visual))
    return definition is None or not (definition.color or definition.texture)


def _look(visual: Visual) -> Look:
    return _look_of(visual.material) if visual.material else (None, None)


def _look_of(material: Material) -> Look:
    return material.color, material.texture


def _link(link: Link, defined: Mapping[str, Look], shared: Mapping[str, Material], sink: DiagnosticSink) -> Link:
    if not any(find_annotation(visual, MATERIAL) for visual in link.visuals):
        return link
    visuals = tuple(_visual(visual, defined, shared, sink) for visual in link.visuals)
    return link.model_copy(update={"visuals": visuals})


def _visual(
    visual: Visual, defined: Mapping[str, Look], shared: Mapping[str, Material], sink: DiagnosticSink
) -> Visual:
    if find_annotation(visual, MATERIAL) is None:
        return visual
    name, own = _name(visual), _is_own(visual, shared)
    bare = without_annotation(visual, MATERIAL)
    material = visual.material
    if material is not None and _is_unnamed(visual):
        return bare.model_copy(update={"material": material.model_copy(update={"name": None})})
    if material is None and defined.get(name, (None, None)) == (None, None) and not own:
        return bare.model_copy(update={"material": Material(name=name)})  # which nobody defines
    if material is not None and own:
        return bare.model_copy(update={"material": material.model_copy(update={"name": name})})
    if material is not None and _look_of(material) == defined.get(name, (None, None)):
        named = material.model_copy(update={"name": name, "color": None, "texture": None})
        return bare.model_copy(update={"material": named})
    why = "has none" if material is None else "looks another way"
    message = f"visual {visual.name!r} had the material {name!r}, and {why} now"
    sink.report(STALE_CARRIER, message, visual.location, found=name)
    return bare
