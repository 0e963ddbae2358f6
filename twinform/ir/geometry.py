"""Shapes. Lengths are in metres, in the frame of the visual or collision that holds them."""

from typing import Annotated, Literal

from pydantic import Field

from twinform.ir.node import Node, Vector3

Vector2 = tuple[float, float]


class Box(Node):
    """A box about the origin; `size` is its full extent along x, y, z."""

    kind: Literal["box"] = "box"
    size: Vector3 | None = None


class Cylinder(Node):
    """A cylinder about the origin with its axis along z."""

    kind: Literal["cylinder"] = "cylinder"
    radius: float | None = None
    length: float | None = None


class Sphere(Node):
    """A sphere about the origin."""

    kind: Literal["sphere"] = "sphere"
    radius: float | None = None


class Capsule(Node):
    """A cylinder along z with half spheres on both ends; `length` is the cylinder's alone."""

    kind: Literal["capsule"] = "capsule"
    radius: float | None = None
    length: float | None = None


class Cone(Node):
    """A cone along z, its base at -length/2 and its tip at +length/2."""

    kind: Literal["cone"] = "cone"
    radius: float | None = None
    length: float | None = None


class Ellipsoid(Node):
    """An ellipsoid about the origin with these semi-axes along x, y, z."""

    kind: Literal["ellipsoid"] = "ellipsoid"
    radii: Vector3 | None = None


class Plane(Node):
    """A plane through the origin; `size` is the extent that is drawn."""

    kind: Literal["plane"] = "plane"
    normal: Vector3 | None = None
    size: Vector2 | None = None


class Mesh(Node):
    """A mesh file, scaled along x, y, z. `submesh` names one part of the file."""

    kind: Literal["mesh"] = "mesh"
    uri: str | None = None
    scale: Vector3 | None = None


class Empty(Node):
    """No shape, said explicitly."""

    kind: Literal["empty"] = "empty"


class Heightmap(Node):
    """A terrain; its parameters stay as they are written."""

    kind: Literal["heightmap"] = "heightmap"
    uri: str | None = None


class Image(Node):
    """An image that is extruded into boxes; its parameters stay as they are written."""

    kind: Literal["image"] = "image"
    uri: str | None = None


class Polyline(Node):
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
