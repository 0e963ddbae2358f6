"""Reverse conversion of materials: restoring how the URDF source wrote them."""

from collections import Counter
from collections.abc import Mapping
from typing import ClassVar, NamedTuple

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Color, Element, Link, Material, Model, Opaque, Visual, replace_fields
from twinform.passes.carriers.annotations import find_annotation, is_annotation, without_annotation
from twinform.passes.carriers.carriers import is_carrier, unpack
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import MATERIAL, SHARED_MATERIAL
from twinform.schemas import Context, element_xml, reader, table

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
