"""Shapes. Lengths are in meters, in the frame of the visual or collision that holds them."""

from typing import Annotated, Literal

from pydantic import Field, SerializerFunctionWrapHandler, model_serializer

from twinform.ir.node import Node, Vector3

Vector2 = tuple[float, float]


class ShapeNode(Node):
    """What all shapes share: their kind is always written out, because it is what tells them apart.

    Each declares it, `kind`, as a field with one value.
    """

    @model_serializer(mode="wrap")
    def _with_kind(self, serialize: SerializerFunctionWrapHandler) -> dict[str, object]:
        return {"kind": type(self).model_fields["kind"].default, **serialize(self)}


class Box(ShapeNode):
    """A box about the origin; `size` is its full extent along x, y, z."""

    kind: Literal["box"] = "box"
    size: Vector3 | None = None


class Cylinder(ShapeNode):
    """A cylinder about the origin with its axis along z."""

    kind: Literal["cylinder"] = "cylinder"
    radius: float | None = None
    length: float | None = None


class Sphere(ShapeNode):
    """A sphere about the origin."""

    kind: Literal["sphere"] = "sphere"
    radius: float | None = None


class Capsule(ShapeNode):
    """A cylinder along z with half spheres on both ends; `length` is the cylinder's alone."""

    kind: Literal["capsule"] = "capsule"
    radius: float | None = None
    length: float | None = None


class Cone(ShapeNode):
    """A cone along z, its base at -length/2 and its tip at +length/2."""

    kind: Literal["cone"] = "cone"
    radius: float | None = None
    length: float | None = None


class Ellipsoid(ShapeNode):
    """An ellipsoid about the origin with these semi-axes along x, y, z."""

    kind: Literal["ellipsoid"] = "ellipsoid"
    radii: Vector3 | None = None


class Plane(ShapeNode):
    """A plane through the origin; `size` is the extent that is drawn."""

    kind: Literal["plane"] = "plane"
    normal: Vector3 | None = None
    size: Vector2 | None = None


class Mesh(ShapeNode):
    """A mesh file, scaled along x, y, z. `submesh` names one part of the file."""

    kind: Literal["mesh"] = "mesh"
    uri: str | None = None
    scale: Vector3 | None = None


class Empty(ShapeNode):
    """No shape, written explicitly."""

    kind: Literal["empty"] = "empty"


class Heightmap(ShapeNode):
    """A terrain; its parameters stay as they are written."""

    kind: Literal["heightmap"] = "heightmap"
    uri: str | None = None


class Image(ShapeNode):
    """An image that is extruded into boxes; its parameters stay as they are written."""

    kind: Literal["image"] = "image"
    uri: str | None = None


class Polyline(ShapeNode):
    """An extruded outline; its points stay as they are written."""

    kind: Literal["polyline"] = "polyline"
    height: float | None = None


Shape = Annotated[
    Box | Cylinder | Sphere | Capsule | Cone | Ellipsoid | Plane | Mesh | Empty | Heightmap | Image | Polyline,
    Field(discriminator="kind"),
]


class Geometry(Node):
    """The one shape of a visual or collision."""

    shape: Shape | None = None
