"""Geoms whose primitive MuJoCo fits to a mesh: in SDF the shape has its own size, and `<tf:fitted>` beside it.

    <collision name="palm"> ... <tf:fitted type="box" size="0.1 0.2 0.3" pos="0 0 0.05"/> ... </collision>

It holds the type and the size that were fitted, and where the frame of the mesh file is in that of the shape. A shape
that is still of this size is fitted to the mesh again; one that was edited has the size that it has.
"""

import math

from twinform.ir import Element, Node, Opaque
from twinform.ir.defaults import sizes
from twinform.ir.geometry import Box, Capsule, Cylinder, Shape
from twinform.ir.node import Vector3
from twinform.ir.pose import Pose
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import FITTED, annotation, find_annotation
from twinform.passes.legalise.to_mjcf.elements import attribute_text, numbers_in, placement

_TOLERANCE = 1e-9
_OF_MESHES = frozenset({"mesh", "fitscale"})


def geom_size(shape: Shape) -> tuple[float, ...]:
    """The sizes as MJCF has them: half of those of a box, and of the length of a cylinder or capsule."""
    found = sizes(shape)
    match shape:
        case Box():
            return tuple([length / 2 for length in found])
        case Cylinder() | Capsule():
            return (found[0], found[1] / 2)
        case _:
            return found


def fitted_mark(shape: Shape, mesh: Transform) -> Opaque:
    """The annotation of a shape that was fitted to a mesh, whose frame is there in that of the shape."""
    attributes = {"type": shape.kind, "size": attribute_text(geom_size(shape))}
    for name, value in placement(mesh):
        attributes[name] = attribute_text(value or "")
    return annotation(FITTED, attributes=attributes)


def fitted_mesh(part: Node, shape: Shape, asset: Element | None) -> Transform | None:
    """The frame of the mesh to which the shape of a visual or collision is fitted; None where it is not, or no more.

    `asset` is what is kept of that mesh; without it there is nothing to fit to.
    """
    mark = find_annotation(part, FITTED)
    if asset is None or mark is None or mark.get("type") != shape.kind:
        return None
    fitted, size = numbers_in(mark.get("size")), geom_size(shape)
    if len(fitted) != len(size) or not all(
        math.isclose(one, other, rel_tol=_TOLERANCE) for one, other in zip(fitted, size, strict=True)
    ):
        return None
    x, y, z = numbers_in(mark.get("pos")) or (0.0, 0.0, 0.0)
    w, i, j, k = numbers_in(mark.get("quat")) or (1.0, 0.0, 0.0, 0.0)
    file = Transform.from_pose(Pose.unchecked(xyz=(x, y, z), quat_xyzw=(i, j, k, w)))
    a, b, c = numbers_in(asset.get("scale")) or (1.0, 1.0, 1.0)
    return file.compose(mesh_reference(asset, (a, b, c)))


def mesh_reference(asset: Element, scale: Vector3) -> Transform:
    """Where the frame of a mesh is in that of its scaled file: at the reference pose that its asset keeps."""
    x, y, z = numbers_in(asset.get("refpos")) or (0.0, 0.0, 0.0)
    w, i, j, k = numbers_in(asset.get("refquat")) or (1.0, 0.0, 0.0, 0.0)
    a, b, c = scale
    return Transform.from_pose(Pose.unchecked(xyz=(a * x, b * y, c * z), quat_xyzw=(i, j, k, w)))


def without_mesh(geom: Element) -> Element:
    """A geom of a size of its own without what it was fitted to, since MuJoCo would fit it again."""
    return geom.copy(attributes=tuple(pair for pair in geom.attributes if pair[0] not in _OF_MESHES))
