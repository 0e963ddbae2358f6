"""How a visual of SDF looks in MJCF: a color, or a material with shine, metal and textures.

A visual with nothing but a color needs no material: its geom has the color itself.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from twinform.ir import Color, Element, Material, Visual
from twinform.passes.legalise.to_mjcf.elements import Value, numbers_in
from twinform.passes.legalise.to_mjcf.said_parts import child_number, untyped

_BRIGHTEST = 128.0
"""The shininess of SDF that is 1 in MJCF, as in OpenGL."""
_BLACK = (0.0, 0.0, 0.0, 1.0)
MAPS: Mapping[str, str] = {
    "albedo_map": "rgb", "normal_map": "normal", "ambient_occlusion_map": "occlusion", "roughness_map": "roughness",
    "metalness_map": "metallic", "emissive_map": "emissive",
}  # fmt: skip
"""The images of SDF's metal-rough materials and their roles in MJCF."""


_WHITE = (1.0, 1.0, 1.0, 1.0)
_SPECULAR = 0.5
"""How bright the reflections of a material of MJCF are that says nothing of them."""
_DIGITS = 6
"""How many digits of a color are compared: programs that save MJCF write no more."""


class Look(NamedTuple):
    """The look of a visual: its color, what a material says beside it, and images by their roles."""

    rgba: tuple[float, ...] | None
    material: tuple[tuple[str, Value], ...]
    images: tuple[tuple[str, str], ...]


def has_look(visual: Visual) -> bool:
    """Whether a visual says how it looks; an empty material says nothing."""
    return visual.material is not None and visual.material != Material.unchecked()


def look(visual: Visual) -> Look:
    """The look of a visual; of a script of Gazebo Classic there is none."""
    material = visual.material
    opacity = 1.0 - child_number(untyped(visual, "transparency"), default=0.0)
    if material is None:
        return Look(None, (), ())
    images = tuple(_images(material))
    return Look(_color(material, opacity, has_image=bool(images)), tuple(_shine(material)), images)


def _color(material: Material, opacity: float, *, has_image: bool) -> tuple[float, ...] | None:
    """The color with its opacity: what is lit is black where only other colors are written, as in Gazebo."""
    color = material.diffuse
    if color is None:
        others = (material.ambient, material.specular, material.emissive)
        if has_image or material.script or not any(others):
            return None if opacity == 1.0 else (1.0, 1.0, 1.0, opacity)
        color = _BLACK
    red, green, blue, *alpha = color
    return (red, green, blue, (alpha[0] if alpha else 1.0) * opacity)


def _shine(material: Material) -> Iterator[tuple[str, Value]]:
    """Yield what a material says beside the color."""
    if material.emissive is not None and any(material.emissive[:3]):
        yield "emission", emission(material)
    if material.specular is not None:
        red, *others = material.specular[:3]
        yield "specular", red if is_plain(material.specular) else (red + sum(others)) / 3
    shininess = untyped(material, "shininess")
    if shininess is not None:
        yield "shininess", min(child_number(shininess, default=0.0) / _BRIGHTEST, 1.0)
    for name, key in (("metalness", "metallic"), ("roughness", "roughness")):
        found = metal(material, name)
        if found is not None:
            yield key, child_number(found, default=0.5)


def emission(material: Material) -> float:
    """How much of its own color a material shines with: MJCF has one factor for all three."""
    emissive, diffuse = material.emissive or _BLACK, material.diffuse or _BLACK
    own = sum(diffuse[:3])
    return sum(emissive[:3]) / own if own else 0.0


def is_plain(color: Color | None) -> bool:
    """Whether a color is a gray, which one number says."""
    return color is None or len(set(color[:3])) == 1


def metal(material: Material, name: str) -> Element | None:
    """An element of the metal-rough part of a material."""
    found = (part.element for part in material.opaque if part.at == "pbr/metal" and part.element)
    return next((each for each in found if each.name == name), None)


def _images(material: Material) -> Iterator[tuple[str, str]]:
    """Yield the roles and URIs of the images of a material."""
    if not material.opaque and material.albedo_map is None:  # as most, and there are six to look for
        return
    for name, role in MAPS.items():
        element = metal(material, name)
        uri = material.albedo_map if name == "albedo_map" else element.text if element is not None else None
        if uri:
            yield role, uri


def seen_material(
    own: Sequence[float], material: Sequence[float] | None, specular: float | None, emission: float | None
) -> Material | None:
    """The colors with which a geom of MJCF is read; None where it shows none.

    `own` is the `rgba` of the geom, which beats that of its material: `material` is None where it has no material.
    """
    if material is None:
        return Material.unchecked(ambient=_clamped(own), diffuse=_clamped(own)) if own else None
    rgba = own or material or _WHITE
    shine = _SPECULAR if specular is None else specular
    return Material.unchecked(
        ambient=_clamped(rgba),
        diffuse=_clamped(rgba),
        specular=_clamped((shine, shine, shine, 1.0)),
        emissive=_clamped((*(emission * each for each in rgba[:3]), 1.0)) if emission else None,
    )


def is_seen(material: Material, geom: Element, asset: Element | None) -> bool:
    """Whether a geom, with the material that it names, is read with this material; its image is a file of its own."""
    rgba = None if asset is None else _numbers(asset, "rgba")
    specular, emission = (next(iter(_numbers(asset, name)), None) for name in ("specular", "emission"))
    seen = seen_material(_numbers(geom, "rgba"), rgba, specular, emission)
    return seen is not None and _rounded(material.copy(albedo_map=None)) == _rounded(seen)


def _numbers(element: Element | None, name: str) -> tuple[float, ...]:
    return numbers_in(None if element is None else element.get(name))


def _clamped(rgba: Sequence[float]) -> Color:
    return tuple(min(1.0, max(0.0, each)) for each in rgba)


def _rounded(material: Material) -> Material:
    colors = ((name, getattr(material, name)) for name in ("ambient", "diffuse", "specular", "emissive"))
    return material.copy(**{name: color and tuple(round(each, _DIGITS) for each in color) for name, color in colors})
