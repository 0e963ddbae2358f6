"""Convert Gazebo Classic materials of visuals to the materials of newer Gazebo, and their colors by name."""

import math
import tomllib
from functools import cache
from importlib.resources import files
from typing import ClassVar

from pydantic import Field

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import PBR_TOO_OLD, TEXTURED_SCRIPT, UNKNOWN_SCRIPT
from twinform.ir import (
    Color,
    Document,
    Element,
    Format,
    GazeboExtension,
    Link,
    Material,
    Opaque,
    replace_fields,
    rewrite,
)
from twinform.passes.carriers.carriers import to_element
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name
from twinform.schemas import format_value, parse_version, versions_of

_DATA = "data/classic_materials.toml"
# OGRE's default for an ambient or diffuse color that a material script does not set.
_WHITE = (1.0, 1.0, 1.0)


@dataclass(frozen=True, slots=True)
class ClassicMaterial:
    """The colors of a material; `shininess` is the exponent of the highlight, `textures` are file names."""

    ambient: Color
    diffuse: Color
    specular: Color | None
    emissive: Color | None
    shininess: float | None
    textures: tuple[str, ...]


@cache
def classic_materials() -> dict[str, ClassicMaterial]:
    """The materials of Gazebo Classic that have colors or images, by name."""
    text = files("twinform.passes.appearance").joinpath(_DATA).read_text(encoding="utf-8")
    rows: dict[str, dict[str, list[float] | list[str] | float]] = tomllib.loads(text)
    return {name: _read_material(row) for name, row in rows.items() if row}


def _read_material(row: dict[str, list[float] | list[str] | float]) -> ClassicMaterial:
    shininess, textures = row.get("shininess"), row.get("textures")
    return ClassicMaterial(
        ambient=_opaque_color(row.get("ambient")) or (*_WHITE, 1.0),
        diffuse=_opaque_color(row.get("diffuse")) or (*_WHITE, 1.0),
        specular=_opaque_color(row.get("specular")),
        emissive=_opaque_color(row.get("emissive")),
        shininess=float(shininess) if isinstance(shininess, int | float) else None,
        textures=tuple(map(str, textures)) if isinstance(textures, list) else (),
    )


def _opaque_color(value: object) -> Color | None:
    """Red, green, blue, and an alpha of one."""
    if not isinstance(value, list):
        return None
    parts: list[object] = value  # pyright: ignore[reportUnknownVariableType] - TOML promises no more than a list
    return (*(float(str(part)) for part in parts), 1.0)


_PBR = "pbr/metal"
_PBR_SINCE = (1, 6)


class Materials(Pass):
    """Turn material scripts of Gazebo Classic into colors, and colors into those of PBR.

    Changes, on links whose name matches `links`:

    1. with `scripts`, in SDF, a `<script>` that names a material of Classic: the colors of it are written instead, but
       for those that the visual sets itself;
    2. with `scripts`, in URDF, the tag `<material>Gazebo/Red</material>` of a `<gazebo>` element, which becomes a
       `<visual>` with the colors; the materials of URDF itself stay, ROS shows them;
    3. with `pbr`, materials that have a color and no `<pbr>`: they get its `metalness` and `roughness`; where that is
       not given, it comes from the script's highlight: sqrt(2 / (shininess + 2)).

    Never touches: materials of URDF, textures, and scripts of others.
    Diagnostics: `unknown-script` for scripts whose colors are not known, which stay, and `textured-script` for those
    that have an image as well, which newer Gazebo does not bring, and `pbr-too-old` for SDF before 1.6.
    """

    name = "materials"
    example: ClassVar[str] = "materials{pbr=true roughness=0.7}"

    scripts: bool = Field(default=True, description="Whether scripts become colors.")
    pbr: bool = Field(default=False, description="Whether colors become PBR materials.")
    metalness: float = Field(default=0.0, ge=0, le=1, description="From 0, paint, to 1, bare metal.")
    roughness: float | None = Field(default=None, ge=0, le=1, description="From 0, a mirror, to 1.")
    links: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only links"))

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with other materials."""
        if self.pbr and not _has_pbr(document):
            message = f"SDF {document.version} has no PBR, so the colors stay as they are"
            sink.report(PBR_TOO_OLD, message, document.location, found=document.version, expected="1.6 or newer")
            return self.model_copy(update={"pbr": False}).run(document, sink)

        if document.format is Format.URDF:
            return rewrite(document, GazeboExtension, lambda extension: self._convert_extension(extension, sink))
        return rewrite(document, Link, lambda link: self._convert_link(link, sink))

    def _is_selected(self, link: str | None) -> bool:
        return link is not None and matches(link, self.links)

    def _convert_link(self, link: Link, sink: DiagnosticSink) -> Link:
        if not self._is_selected(link.name):
            return link
        return rewrite(link, Material, lambda material: self._convert_material(material, sink))

    def _convert_material(self, material: Material, sink: DiagnosticSink) -> Material:
        script, found = material.script, None
        if self.scripts and script is not None and script.name:
            found = _find_classic_material(script.name, script.location, sink)
            if found:
                material = _add_colors(material, found)
        return self._add_pbr(material, found) if self.pbr else material

    def _add_pbr(self, material: Material, script: ClassicMaterial | None) -> Material:
        """The material with metalness and roughness, if it has a color and no PBR."""
        color = material.diffuse or material.ambient
        # A workflow of the author stays as it is, and a material without any color gets none from
        # here.
        if color is None or material.albedo_map or any(_is_pbr(part) for part in material.opaque):
            return material
        numbers = {"metalness": self.metalness, "roughness": self._roughness(script)}
        parts = (
            Opaque(at=_PBR, element=Element(name=name, text=format_value(value)))
            for name, value in numbers.items()
            if value is not None
        )
        return material.copy(opaque=(*material.opaque, *parts))

    def _roughness(self, script: ClassicMaterial | None) -> float | None:
        """B. Karis 2013, Specular BRDF reference: the roughness of Blinn and Phong's highlight with this exponent."""
        if self.roughness is not None or script is None or script.shininess is None:
            return self.roughness
        return min(1.0, math.sqrt(2 / (script.shininess + 2)))

    def _convert_extension(self, extension: GazeboExtension, sink: DiagnosticSink) -> GazeboExtension:
        """A `<gazebo>` element of URDF with the colors of the script that it names."""
        if not self.scripts or not self._is_selected(extension.reference):
            return extension
        return replace_fields(
            extension, content=tuple(self._convert_tag(element, sink) for element in extension.content)
        )

    def _convert_tag(self, element: Element, sink: DiagnosticSink) -> Element:
        name = (element.get("value") or element.text or "").strip()
        if element.name != "material" or element.children or not name:
            return element
        found = _find_classic_material(name, element.location, sink)
        if found is None:
            return element
        material = _add_colors(Material(), found)
        made = to_element(self._add_pbr(material, found) if self.pbr else material, "material", "sdf")
        return Element(name="visual", children=(made,), source=element.source)


def _has_pbr(document: Document) -> bool:
    """Whether the version of the document has PBR; `<gazebo>` elements of URDF are of the newest version."""
    version = document.version
    if document.format is not Format.SDF or version is None or version not in versions_of("sdf"):
        return True
    return parse_version(version) >= _PBR_SINCE


def _find_classic_material(name: str, where: Location, sink: DiagnosticSink) -> ClassicMaterial | None:
    """The colors of a script; reports a script without known colors, or with images."""
    found = classic_materials().get(name)
    if found is None:
        message = f"the colors of the material script {name!r} are not known; it is kept"
        sink.report(UNKNOWN_SCRIPT, message, where, found=name)
    elif found.textures:
        message = f"the material script {name!r} becomes its colors, without its image {', '.join(found.textures)}"
        sink.report(TEXTURED_SCRIPT, message, where, found=name)
    return found


def _add_colors(material: Material, found: ClassicMaterial) -> Material:
    """The material with the colors of a script, where it has none itself."""
    return material.copy(
        script=None,
        ambient=material.ambient or found.ambient,
        diffuse=material.diffuse or found.diffuse,
        specular=material.specular or found.specular,
        emissive=material.emissive or found.emissive,
    )


def _is_pbr(part: Opaque) -> bool:
    return part.at.startswith("pbr") or (part.element is not None and part.element.name == "pbr")
