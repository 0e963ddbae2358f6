"""Give materials of URDF names and colors that every reader can tell apart."""

from collections.abc import Iterator
from typing import ClassVar, Literal

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.diagnostics.rules import TIDIED_MATERIAL
from twinform.ir import Document, Format, Material, Model, Visual, replace_fields, rewrite
from twinform.passes.framework.pass_base import Pass
from twinform.passes.shared.nodes import unique_name

_PLAIN = "material"
"""The name, before a number, for materials without a name."""


class TidyMaterials(Pass):
    """Name materials that have no name, and tell those apart that share one.

    Readers of URDF differ about materials: some refuse one without a name, some a name that nothing defines.
    Changes models of URDF:

    1. a material without a name gets one: `material_1`, and so on;
    2. a visual with a material that is nowhere defined before it and that a later visual defines: the color and the
       texture are written here too;
    3. a visual with a material that is defined nowhere loses it, and is shown in the reader's own color, as before;
    4. a visual with another color than what has that name before: its material gets a name of its own;
    5. shared materials: one without a color and a texture goes, and so does the second of a name;
    6. a `<texture>` that names no file goes;
    7. with `textures=drop`, textures go; a material that has nothing else becomes gray.

    Never touches: SDF, and the colors themselves.
    Diagnostics: `tidied-material` for each; what goes has an entry of the ledger, *dropped*.
    """

    name = "tidy-materials"
    example: ClassVar[str] = "tidy-materials{textures=drop}"

    textures: Literal["keep", "drop"] = Field(default="keep", description="Whether the images of materials stay.")

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with tidy materials."""
        if document.format is not Format.URDF:
            return document
        return rewrite(document, Model, lambda model: self._tidy(model, sink))

    def _tidy(self, model: Model, sink: DiagnosticSink) -> Model:
        model = rewrite(model, Material, lambda material: _remove_empty_texture(material, sink))
        if self.textures == "drop":
            model = rewrite(model, Material, lambda material: _remove_texture(material, sink))
        work = _Materials(model, sink)
        shared = tuple(work.shared())
        links = tuple(replace_fields(link, visuals=tuple(map(work.of_visual, link.visuals))) for link in model.links)
        return replace_fields(model, materials=shared, links=links)


def _remove_empty_texture(material: Material, sink: DiagnosticSink) -> Material:
    """The material without textures that name no file, which are kept as opaque parts."""
    kept = tuple(each for each in material.opaque if not (each.element and each.element.name == "texture"))
    if len(kept) == len(material.opaque) and material.texture != "":
        return material
    message = f"material {material.name!r} has a texture without a file: it is left out"
    sink.report(TIDIED_MATERIAL, message, material.location, found=material.name)
    sink.account(Fate.DROPPED, TIDIED_MATERIAL, message, material.location.at("texture"))
    return material.copy(texture=material.texture or None, opaque=kept)


def _remove_texture(material: Material, sink: DiagnosticSink) -> Material:
    if material.texture is None:
        return material
    message = f"the texture {material.texture!r} of material {material.name!r} is left out"
    sink.report(TIDIED_MATERIAL, message, material.location, found=material.texture)
    sink.account(Fate.DROPPED, TIDIED_MATERIAL, message, material.location.at("texture"))
    return material.copy(texture=None, color=material.color or _GRAY)


_GRAY = (0.5, 0.5, 0.5, 1.0)


class _Materials:
    """The materials of a model: the names that are taken, and the first appearance for each name."""

    def __init__(self, model: Model, sink: DiagnosticSink) -> None:
        self.model, self.sink = model, sink
        self.taken = {each.name for each in _all_materials(model) if each.name}
        self.later = {
            each.name: each for each in reversed(list(_all_materials(model))) if each.name and _has_appearance(each)
        }
        self.known: dict[str, Material] = {}

    def shared(self) -> Iterator[Material]:
        """The shared materials that stay."""
        for material in self.model.materials:
            name = material.name or self._name_nameless(material)
            # urdfdom refuses the whole file for a shared material without color and texture, and
            # for two of one name.
            if not _has_appearance(material):
                self._drop(material, f"the shared material {name!r} has no color and no texture")
            elif name in self.known:
                self._drop(material, f"the shared material {name!r} is there twice")
            else:
                self.known[name] = material
                yield replace_fields(material, name=name)

    def of_visual(self, visual: Visual) -> Visual:
        """The visual with a tidy material."""
        return visual if visual.material is None else replace_fields(visual, material=self._tell_apart(visual.material))

    def _tell_apart(self, material: Material) -> Material | None:
        name = material.name or ""
        if not _has_appearance(material):
            return self._resolve_reference(material, name)
        if not name:
            name = self._name_nameless(material)
        elif name in self.known and not _is_compatible(self.known[name], material):
            other = self._take_name(name)
            self._report(material, f"material {name!r} has another color before, and is called {other!r} here")
            name = other
        self.known.setdefault(name, material)
        return replace_fields(material, name=name)

    def _resolve_reference(self, material: Material, name: str) -> Material | None:
        """A material that is only a name, with the appearance that a later one defines; None if none does."""
        if name in self.known:
            return material
        if name not in self.later:
            self._drop(
                material, f"material {name!r} is defined nowhere" if name else "a material has no name and no color"
            )
            return None
        defined = self.later[name]
        self._report(material, f"material {name!r} is defined further down, and here too now")
        self.known[name] = defined
        return material.copy(color=defined.color, texture=defined.texture)

    def _name_nameless(self, material: Material) -> str:
        name = self._take_name(_PLAIN)
        self._report(material, f"a material without a name is called {name!r}")
        return name

    def _take_name(self, stem: str) -> str:
        name = unique_name(stem, self.taken)
        self.taken.add(name)
        return name

    def _report(self, material: Material, message: str) -> None:
        self.sink.report(TIDIED_MATERIAL, message, material.location, found=material.name)

    def _drop(self, material: Material, message: str) -> None:
        self._report(material, f"{message}: it is left out")
        self.sink.account(Fate.DROPPED, TIDIED_MATERIAL, message, material.location)


def _all_materials(model: Model) -> Iterator[Material]:
    yield from model.materials
    for link in model.links:
        yield from (visual.material for visual in link.visuals if visual.material is not None)


def _has_appearance(material: Material) -> bool:
    return material.color is not None or bool(material.texture)


def _is_compatible(one: Material, other: Material) -> bool:
    return (other.color is None or one.color == other.color) and (not other.texture or one.texture == other.texture)
