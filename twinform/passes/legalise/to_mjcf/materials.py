"""Colors, materials and textures of visuals."""

from collections.abc import Collection
from pathlib import PurePosixPath

from twinform.diagnostics import Location, rules
from twinform.ir import Collision, Element, Visual
from twinform.ir.geometry import Mesh
from twinform.passes.legalise.to_mjcf.assets import file_path, find_file
from twinform.passes.legalise.to_mjcf.elements import Value, attribute_text, make_element
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements
from twinform.passes.legalise.to_mjcf.looks import Look, has_look, look
from twinform.passes.legalise.to_mjcf.mesh_colors import Several, color_of
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext

_IMAGES = frozenset({".png", ".ktx"})
"""The images that MuJoCo reads."""
_OF_COLORS = frozenset({"rgb", "rgba"})
"""The roles of images with the colors of a material."""
_KEPT = "kept material"
"""The kind of the materials in the files of a context that have the name which they were read with."""


def with_known_material(context: MjcfContext, element: Element) -> Element:
    """A geom or site without the name of a material that has gone with a visual, or with another model."""
    name = element.get("material")
    if name is None or name in context.materials or name in context.names.get("material", ()):
        return element
    return element.copy(attributes=tuple(pair for pair in element.attributes if pair[0] != "material"))


def is_kept_material(context: MjcfContext, name: str | None) -> bool:
    """Whether a material of the file is one that visuals were read with, and has the name that it had then."""
    return (_KEPT, name) in context.files


def look_of(context: MjcfContext, body: Body, visual: Visual, twin: Collision | None = None) -> list[tuple[str, Value]]:
    """The attributes of the geom of a visual that say how it looks: `rgba`, or the name of a material in `asset`.

    `twin` is the collision that is the same geom, and keeps what it was read with.
    """
    found = look(visual)
    kept = next((each for each in kept_elements(twin or visual) if each.name == "geom" and each.get("material")), None)
    if kept is not None and context.is_of_mjcf and not has_look(visual):
        return []
    name = (kept.get("material") if kept is not None else None) or ""
    if kept is not None and _has_image(context, name, found):
        return _of_kept_material(context, name, visual, found, has_own=kept.get("rgba") is not None)
    textures = _textures(context, visual, found)
    if kept is not None:
        return [("material", _material(context, body, visual, _as_shiny(found), textures))]
    if not found.material and not textures:
        return [("rgba", found.rgba or _color_of_file(context, visual))]
    return [("material", _material(context, body, visual, found, textures))]


def _has_image(context: MjcfContext, name: str, found: Look) -> bool:
    """Whether a material has the image of a look, which was edited otherwise.

    It is the image that it was read with, if the model keeps it, or else that of the first visual with this material.
    """
    image = next((uri for role, uri in found.images if role == "rgb"), "")
    material = context.kept_asset("material", name)
    if material is None:
        return context.files.setdefault(("kept image", name), image) == image
    layer = next((each for each in material.children if each.get("role") in _OF_COLORS), material)
    texture = context.kept_asset("texture", layer.get("texture") or "")
    is_plain = texture is not None and texture.get("type") in {"2d", None}
    return image == ((texture.get("file") if texture is not None and is_plain else None) or "")


def _as_shiny(found: Look) -> Look:
    """A look that says how it shines: without a word MuJoCo's materials do, and those of SDF do not."""
    is_said = any(key == "specular" for key, _ in found.material)
    return found if is_said else found._replace(material=(*found.material, ("specular", 0.0)))


def _color_of_file(context: MjcfContext, visual: Visual) -> tuple[float, ...] | None:
    """The color that the mesh of a visual gives itself, where the visual has none and MuJoCo would read none."""
    shape = visual.geometry.shape if visual.geometry else None
    if visual.material is not None or context.is_of_mjcf or not isinstance(shape, Mesh):
        return None
    uri = (shape.uri or "").strip()
    if uri not in context.colors_of_files:
        path = find_file(context, uri)
        context.colors_of_files[uri] = None if path is None else color_of(context.assets.readable, path)
    color = context.colors_of_files[uri]
    if isinstance(color, Several):
        message = f"mesh {uri!r} of visual {visual.name!r} has several colors or an image, which MuJoCo does not read"
        context.approximate(rules.NOT_IN_MJCF, message, visual.location, 0)
        context.sink.report(rules.NOT_IN_MJCF, message, visual.location, found=uri)
        return None
    return color


def _of_kept_material(
    context: MjcfContext, name: str, visual: Visual, found: Look, *, has_own: bool
) -> list[tuple[str, Value]]:
    """The color of a geom that keeps the material which it was read with, where it has not that of the material.

    The asset gets what visuals say of it, but for the color of a geom that had its own; what else it had is added where
    models keep it, with its images.
    """
    key, assets = (_KEPT, name), context.sections["asset"]
    if key not in context.files:
        context.names.setdefault("material", set()).add(name)
        images = _textures(context, visual, found) if context.kept_asset("material", name) is None else []
        context.files[key] = str(len(assets))
        context.add("asset", _asset([("name", name), *_as_shiny(found).material], images))
    if has_own:
        return [("rgba", found.rgba)]
    color = ("kept color", name)
    if color not in context.files:
        context.files[color] = attribute_text(found.rgba or ())
        place = int(context.files[key] or 0)
        first, *others = assets[place].attributes
        own = make_element("material", [("rgba", found.rgba)]).attributes
        assets[place] = assets[place].copy(attributes=(first, *own, *others))
    return [] if context.files[color] == attribute_text(found.rgba or ()) else [("rgba", found.rgba)]


def _material(
    context: MjcfContext, body: Body, visual: Visual, found: Look, textures: list[tuple[str, str]]
) -> str | None:
    """The name of the material of a look; visuals that look alike share one."""
    key = ("material", found.rgba, found.material, tuple(textures))
    if key not in context.files:
        # What is kept of a file that was written here was put into it by somebody, and is about no visual.
        kept = context.materials if context.is_of_mjcf else context.colors
        context.names.setdefault("material", set()).update(kept)
        name = context.name_in(body, "material", visual.name or "material", visual.location)
        asset = _asset([("name", name), ("rgba", found.rgba), *found.material], textures)
        context.add("asset", asset.copy(source=visual.source))
        context.files[key] = name
    return context.files[key]


def _asset(attributes: list[tuple[str, Value]], textures: list[tuple[str, str]]) -> Element:
    """A material with its textures: one of colors alone is an attribute, and all others are layers."""
    if len(textures) == 1 and textures[0][0] == "rgb":
        return make_element("material", [*attributes, ("texture", textures[0][1])])
    layers = [make_element("layer", [("role", role), ("texture", texture)]) for role, texture in textures]
    return make_element("material", attributes, layers)


def _textures(context: MjcfContext, visual: Visual, found: Look) -> list[tuple[str, str]]:
    """The roles and names of the textures of a look; images that MuJoCo cannot read are reported."""
    made: list[tuple[str, str]] = []
    for role, uri in found.images:
        if PurePosixPath(uri).suffix.lower() not in _IMAGES:
            help_ = "save it as PNG"
            message = f"image {uri!r} of visual {visual.name!r} is no PNG, and MuJoCo reads no other images"
            context.sink.report(rules.UNREADABLE_IMAGE, message, visual.location, found=uri, help=help_)
        elif (name := _texture(context, uri, visual.location)) is not None:
            made.append((role, name))
    return made


def _texture(context: MjcfContext, uri: str, where: Location) -> str | None:
    """The name of the texture of an image, which is made once for each file."""
    key = ("texture", uri)
    if key not in context.files:
        file = file_path(context, uri, where)
        name: str | None = PurePosixPath(file).stem or "texture"
        if not _is_kept_texture(context, name, {uri, file}):
            name = context.name("texture", name, where, context.kept_names("texture"))
            context.add("asset", make_element("texture", [("name", name), ("type", "2d"), ("file", file)]))
        context.files[key] = name
    return context.files[key]


def _is_kept_texture(context: MjcfContext, name: str, files: Collection[str]) -> bool:
    """Whether a texture that is kept has this name, and is the same image."""
    kept = context.kept_asset("texture", name)
    return kept is not None and kept.get("type") == "2d" and kept.get("file") in files
