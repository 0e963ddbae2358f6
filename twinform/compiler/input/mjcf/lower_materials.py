"""Colors and textures of geoms as materials of SDF: their colors, and the image of a texture as an albedo map."""

from twinform.compiler.input.mjcf.assets import AssetTable
from twinform.compiler.input.mjcf.number_lists import Numbers
from twinform.compiler.input.mjcf.pieces import Piece
from twinform.ir import Material
from twinform.passes.legalise.to_mjcf.looks import seen_material

_WHITE: Numbers = (1.0, 1.0, 1.0, 1.0)


def lower_material(geom: Piece, assets: AssetTable) -> Material | None:
    """Return how a geom looks; None where neither it nor an asset says so. The color of the geom beats its material."""
    asset = assets.find("material", geom.peek("material"))
    if asset is None:
        seen = seen_material(geom.numbers("rgba"), None, None, None)
        return seen and seen.copy(source=geom.source)
    own = geom.peek_numbers("rgba")  # that the geom says it and not its material, stays with the geom
    rgba = asset.peek_numbers("rgba")
    if not own:
        asset.take("rgba")
    seen = seen_material(own, rgba, asset.number("specular"), asset.number("emission"))
    return seen and seen.copy(albedo_map=_texture(asset, assets), source=geom.source)


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
