"""Shapes. Lengths are in meters, in the frame of the visual or collision that holds them."""

from typing import TYPE_CHECKING, Annotated, Any, Literal

from twinform.ir.node import Node, Vector3
from twinform.ir.record import Constraint, fields_of, record

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, SerializerFunctionWrapHandler
    from pydantic_core import CoreSchema

Vector2 = tuple[float, float]


@record
class ShapeNode(Node):
    """What all shapes share: their kind is always written out, because it is what tells them apart.

    Each declares it, `kind`, as a field with one value.
    """

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: "GetCoreSchemaHandler") -> "CoreSchema":
        from pydantic_core import core_schema  # noqa: PLC0415 - only Pydantic calls this

        schema = handler(source)
        # `exclude_defaults` would leave the kind out, which the discriminator needs.
        schema["serialization"] = core_schema.wrap_serializer_function_ser_schema(_with_kind)
        return schema


def _with_kind(shape: ShapeNode, serialize: "SerializerFunctionWrapHandler") -> dict[str, object]:
    return {"kind": fields_of(type(shape))["kind"].default, **serialize(shape)}


@record
class Box(ShapeNode):
    """A box about the origin.

    Attributes:
        kind: `box`.
        size: the full extent along x, y, z; m.
    """

    kind: Literal["box"] = "box"
    size: Vector3 | None = None


@record
class Cylinder(ShapeNode):
    """A cylinder about the origin with its axis along z.

    Attributes:
        kind: `cylinder`.
        radius: m.
        length: from end to end; m.
    """

    kind: Literal["cylinder"] = "cylinder"
    radius: float | None = None
    length: float | None = None


@record
class Sphere(ShapeNode):
    """A sphere about the origin.

    Attributes:
        kind: `sphere`.
        radius: m.
    """

    kind: Literal["sphere"] = "sphere"
    radius: float | None = None


@record
class Capsule(ShapeNode):
    """A cylinder along z with half spheres on both ends, about the origin.

    Attributes:
        kind: `capsule`.
        radius: of the cylinder and of the half spheres; m.
        length: of the cylinder alone; m.
    """

    kind: Literal["capsule"] = "capsule"
    radius: float | None = None
    length: float | None = None


@record
class Cone(ShapeNode):
    """A cone along z, its base at -length/2 and its tip at +length/2.

    Attributes:
        kind: `cone`.
        radius: of the base; m.
        length: from base to tip; m.
    """

    kind: Literal["cone"] = "cone"
    radius: float | None = None
    length: float | None = None


@record
class Ellipsoid(ShapeNode):
    """An ellipsoid about the origin.

    Attributes:
        kind: `ellipsoid`.
        radii: the semi-axes along x, y, z; m.
    """

    kind: Literal["ellipsoid"] = "ellipsoid"
    radii: Vector3 | None = None


@record
class Plane(ShapeNode):
    """A plane through the origin.

    Attributes:
        kind: `plane`.
        normal: the direction that it faces, in the frame of the shape; without a unit, of any length.
        size: the extent that is drawn, along x and y of the plane; m. What collides has no end.
    """

    kind: Literal["plane"] = "plane"
    normal: Vector3 | None = None
    size: Vector2 | None = None


@record
class Mesh(ShapeNode):
    """A mesh file. Which part of it is meant, `<submesh>`, stays in `opaque`.

    Attributes:
        kind: `mesh`.
        uri: the file, as it is written.
        scale: the factors along x, y, z of the file's own frame.
    """

    kind: Literal["mesh"] = "mesh"
    uri: str | None = None
    scale: Vector3 | None = None


@record
class Empty(ShapeNode):
    """No shape, written explicitly.

    Attributes:
        kind: `empty`.
    """

    kind: Literal["empty"] = "empty"


@record
class Heightmap(ShapeNode):
    """A terrain; its parameters stay as they are written.

    Attributes:
        kind: `heightmap`.
        uri: the image or elevation file, as it is written.
    """

    kind: Literal["heightmap"] = "heightmap"
    uri: str | None = None


@record
class Image(ShapeNode):
    """An image that is extruded into boxes; its parameters stay as they are written.

    Attributes:
        kind: `image`.
        uri: the image, as it is written.
    """

    kind: Literal["image"] = "image"
    uri: str | None = None


@record
class Polyline(ShapeNode):
    """An extruded outline; its points stay as they are written.

    Attributes:
        kind: `polyline`.
        height: along z; m.
    """

    kind: Literal["polyline"] = "polyline"
    height: float | None = None


Shape = Annotated[
    Box | Cylinder | Sphere | Capsule | Cone | Ellipsoid | Plane | Mesh | Empty | Heightmap | Image | Polyline,
    Constraint(discriminator="kind"),
]


@record
class Geometry(Node):
    """The one shape of a visual or collision.

    Attributes:
        shape: the shape, in the frame of the visual or collision; `None` where nothing was written.
    """

    shape: Shape | None = None
