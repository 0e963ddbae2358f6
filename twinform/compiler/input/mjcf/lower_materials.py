"""Colors and textures of geoms as materials of SDF: their colors, and the image of a texture as an albedo map."""

from twinform.compiler.input.mjcf.assets import AssetTable
from twinform.compiler.input.mjcf.number_lists import Numbers
from twinform.compiler.input.mjcf.pieces import Piece
from twinform.ir import Color, Material

_WHITE: Numbers = (1.0, 1.0, 1.0, 1.0)
_SPECULAR = 0.5
"""How bright the reflections of a material of MJCF are that says nothing of them."""


def lower_material(geom: Piece, assets: AssetTable) -> Material | None:
    """Return how a geom looks; None where neither it nor an asset says so. The color of the geom beats its material."""
    asset = assets.find("material", geom.peek("material"))
    if asset is None:
        own = geom.numbers("rgba")
        return None if not own else Material.unchecked(ambient=_color(own), diffuse=_color(own), source=geom.source)
    own = geom.peek_numbers("rgba")  # that the geom says it and not its material, stays with the geom
    rgba = own or asset.peek_numbers("rgba") or _WHITE
    if not own:
        asset.take("rgba")
    specular, emission = asset.number("specular"), asset.number("emission")
    shine = _SPECULAR if specular is None else specular
    return Material.unchecked(
        ambient=_color(rgba),
        diffuse=_color(rgba),
        specular=_grey(shine),
        emissive=_color((*(emission * each for each in rgba[:3]), 1.0)) if emission else None,
        albedo_map=_texture(asset, assets),
        source=geom.source,
    )


def is_invisible(geom: Piece, assets: AssetTable) -> bool:
    """Tell whether a geom is wholly transparent."""
    asset = assets.find("material", geom.peek("material"))
    rgba = geom.peek_numbers("rgba") or (asset.peek_numbers("rgba") if asset else _WHITE)
    return rgba[-1:] == (0.0,) and len(rgba) == len(_WHITE)


def _texture(material: Piece, assets: AssetTable) -> str | None:
    """Return the image of a material; one that MuJoCo makes itself, or one for the sky, stays an asset."""
    layer = next((each for each in material.all_of("layer") if each.peek("role") in {"rgb", "rgba"}), material)
    texture = assets.find("texture", layer.peek("texture"))
    if texture is None or texture.peek("type") not in {"2d", None} or texture.peek("file") is None:
        return None
    return texture.peek("file")


def _color(rgba: Numbers) -> Color:
    return tuple(min(1.0, max(0.0, each)) for each in rgba)


def _grey(part: float) -> Color:
    return _color((part, part, part, 1.0))
