"""Shapes of geoms as shapes of SDF, in the frame of the geom: MJCF has half sizes, and meshes are assets."""

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

from twinform.compiler.input.mjcf.assets import AssetTable
from twinform.compiler.input.mjcf.number_lists import Numbers
from twinform.compiler.input.mjcf.pieces import Piece, placed_at
from twinform.ir import Box, Capsule, Cylinder, Element, Ellipsoid, Heightmap, Mesh, Opaque, Plane, Sphere
from twinform.ir.geometry import Shape
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform
from twinform.passes.legalise.to_mjcf.assets import usual_depth
from twinform.passes.legalise.to_mjcf.elements import ENDLESS, GRID
from twinform.schemas import format_value


class PlacedShape(NamedTuple):
    """A shape, and where its own frame is in that of the geom.

    `mesh` is of a primitive that is fitted to a mesh: where the frame of the mesh file is in that of the shape.
    """

    shape: Shape
    at: Transform = Transform()
    mesh: Transform | None = None


def lower_shape(geom: Piece, assets: AssetTable) -> PlacedShape | None:
    """Take the shape of a geom; None for one that SDF lacks, such as a signed distance field or a mesh without file."""
    kind = geom.peek("type") or "sphere"
    if kind == "mesh":
        found = _mesh(geom, assets)
    elif kind == "hfield":
        found = _heightmap(geom, assets)
    elif kind == "plane":
        size = geom.peek_numbers("size")
        found = PlacedShape(_plane(size))
        if all(size) and size[-1:] == (GRID,):  # such a plane is written as it was
            geom.take("size")
    elif kind in _PRIMITIVES and geom.has("size") and not geom.has("mesh"):
        size = geom.numbers("size")
        found = PlacedShape(_PRIMITIVES[kind](size))
        if any(size[_COUNTS[kind] :]):  # numbers that mean nothing stay with the geom
            geom.leave("size")
    else:
        found = None
    if found is not None:
        geom.take("type")
    return found


def _box(size: Numbers) -> Shape:
    x, y, z = (2 * each for each in size[:3])
    return Box.unchecked(size=(x, y, z))


def _ellipsoid(size: Numbers) -> Shape:
    x, y, z = size[:3]
    return Ellipsoid.unchecked(radii=(x, y, z))


_PRIMITIVES: Mapping[str, Callable[[Numbers], Shape]] = {
    "box": _box,
    "sphere": lambda size: Sphere.unchecked(radius=size[0]),
    "cylinder": lambda size: Cylinder.unchecked(radius=size[0], length=2 * size[1]),
    "capsule": lambda size: Capsule.unchecked(radius=size[0], length=2 * size[1]),
    "ellipsoid": _ellipsoid,
}
_COUNTS: Mapping[str, int] = {"box": 3, "sphere": 1, "cylinder": 2, "capsule": 2, "ellipsoid": 3}
"""How many numbers say the size of a shape."""


def _plane(size: Numbers) -> Plane:
    # The third number, the spacing of its grid, stays in the remainder with the others.
    x, y = (2 * each if each > 0 else ENDLESS for each in (*size, 0.0, 0.0)[:2])
    return Plane.unchecked(normal=(0.0, 0.0, 1.0), size=(x, y))


def _mesh(geom: Piece, assets: AssetTable) -> PlacedShape | None:
    asset = assets.find("mesh", geom.peek("mesh"))
    if asset is None:
        return None
    placed = mesh_of(asset)
    if placed is not None:
        for name in ("file", "scale"):
            asset.take(name)
        if asset.has("refpos") or asset.has("refquat"):  # both stay with the asset, and the geom with its name
            return placed
        _take_asset(geom, "mesh", asset)
    return placed


def mesh_of(asset: Piece) -> PlacedShape | None:
    """Return a mesh with its scale, at its reference pose; None where no file has it, or it is turned and bent.

    A vertex v of the file is at scale (R^-1 (v - p)) for the reference pose of p and R.
    """
    file = asset.peek("file")
    scale = asset.peek_numbers("scale") or (1.0, 1.0, 1.0)
    reference = placed_at(asset.peek_numbers("refpos"), asset.peek_numbers("refquat"))
    if file is None or (len(set(scale)) > 1 and not reference.is_unturned):
        return None
    back = reference.inverse()
    x, y, z = (factor * each for factor, each in zip(scale, back.translation, strict=True))
    factors: Vector3 | None = (scale[0], scale[1], scale[2]) if any(each != 1 for each in scale) else None
    at = back if back.is_identity else Transform((x, y, z), back.rotation)
    return PlacedShape(Mesh.unchecked(uri=file, scale=factors, source=asset.source), at)


def _take_asset(geom: Piece, kind: str, asset: Piece) -> None:
    """Take the name of an asset where its file tells it too; another one stays in the remainder."""
    if asset.peek("name") is None:
        geom.take(kind)


def _heightmap(geom: Piece, assets: AssetTable) -> PlacedShape | None:
    asset = assets.find("hfield", geom.peek("hfield"))
    if asset is None or asset.peek("file") is None or not asset.has("size"):
        return None
    file = asset.take("file")
    x, y, top, bottom = asset.numbers("size")
    if bottom and not math.isclose(bottom, usual_depth(top)):
        asset.leave("size")  # how far it reaches below has no place in SDF
    _take_asset(geom, "hfield", asset)
    size = Element.unchecked(name="size", text=format_value((2 * x, 2 * y, top)))
    return PlacedShape(Heightmap.unchecked(uri=file, opaque=(Opaque.unchecked(element=size),), source=asset.source))
