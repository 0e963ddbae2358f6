"""Converting geometry to the shapes of URDF, and carrying the others."""

from typing import ClassVar, TypeVar

from twinform.diagnostics import rules
from twinform.ir import (
    Collision,
    Geometry,
    Link,
    Mesh,
    Model,
    Node,
    Visual,
    count_parts,
    replace_fields,
)
from twinform.ir.defaults import SIZES, filled
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.legalise.to_urdf.remainder import urdf_fields
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.document_uris import GAZEBO, MESH_SCHEME, package_uri, scheme_of
from twinform.passes.shared.nodes import piece
from twinform.request_options import UrdfVersion

Sayable = frozenset[str]
"""The kinds of shapes that a version of URDF has."""
AnyShaped = TypeVar("AnyShaped", Visual, Collision)
_UNSAYABLE = {
    "ellipsoid": "is an ellipsoid, which URDF does not have",
    "empty": "has an empty shape, which URDF does not have",
    "image": "is an image, which URDF does not have",
    "mesh": "is one part of a mesh, which URDF cannot express",
    "no shape": "has no shape, which URDF cannot express",
}
"""Descriptions of shapes in messages, where the kind alone does not fit."""


class MapGeometry(ToUrdfPass):
    """Keep the shapes that URDF has, with all their sizes.

    Changes: 1. a size that is not written is SDF's default; 2. `model://` becomes `package://`; 3. a visual or
    collision with a shape that URDF lacks, which a capsule is before 1.1, leaves the link, whole, into a carrier.
    Diagnostics: `unsayable-shape`; in the ledger `unsayable-shape` and `sdf-only`.
    """

    name: ClassVar[str] = "map-geometry"
    urdf_version: UrdfVersion = "1.0"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with shapes of URDF alone."""
        sayable = frozenset(urdf_fields(self.urdf_version, "geometry")["shape"] or ())
        return replace_fields(model, links=tuple(_map_link(link, sayable, keeper) for link in model.links))


def _map_link(link: Link, sayable: Sayable, keeper: UrdfKeeper) -> Link:
    # A shape in a carrier is carried after the link's frame has moved onto its joint, so that its
    # pose means the same place as in SDF.
    link = _map_shapes(link, "collisions", "collision", link.collisions, sayable, keeper)
    return _map_shapes(link, "visuals", "visual", link.visuals, sayable, keeper)


def _map_shapes(
    link: Link, field: str, tag: str, shapes: tuple[AnyShaped, ...], sayable: Sayable, keeper: UrdfKeeper
) -> Link:
    kept: list[AnyShaped] = []
    taken = 0
    for one in shapes:
        if _is_expressible(one.geometry, sayable) or (
            keeper.back and (one.geometry is None or one.geometry.shape is None)
        ):
            kept.append(_map_shape(one, keeper))
            continue
        kind = one.geometry.shape.kind if one.geometry and one.geometry.shape else "no shape"
        what = _UNSAYABLE.get(kind, f"is a {kind}, which URDF does not have")
        message = f"{tag} {one.name!r} of link {link.name!r} {what}"
        keeper.sink.report(rules.UNSAYABLE_SHAPE, message, one.location, found=kind)
        weight = count_parts(one)
        place = len(kept) + taken
        taken += 1
        about = (("index", str(place)),) if place < len(shapes) - 1 else ()
        link = keeper.keep(link, [piece(one, tag)], rules.UNSAYABLE_SHAPE, message, one.location, weight, about)
    return replace_fields(link, **{field: tuple(kept)})


def _is_expressible(geometry: Geometry | None, sayable: Sayable) -> bool:
    shape = geometry.shape if geometry else None
    if isinstance(shape, Mesh):
        # urdfdom reads the whole file of a mesh.
        return shape.uri is not None and not any(
            part.element and part.element.name == "submesh" for part in shape.opaque
        )
    return shape is not None and shape.kind in sayable


def _map_shape(one: AnyShaped, keeper: UrdfKeeper) -> AnyShaped:
    geometry = one.geometry
    shape = geometry.shape if geometry else None
    if geometry is None or shape is None:
        return one
    if isinstance(shape, Mesh):
        one, uri = urdf_uri(one, MESH_SCHEME, shape.uri or "", keeper)
        made: Node = shape if uri == shape.uri else shape.copy(uri=uri)
    else:
        made = filled(shape, SIZES.get(type(shape), {}))
    return replace_fields(one, geometry=replace_fields(geometry, shape=made))


def urdf_uri(shape: AnyShaped, kind: str, written: str, keeper: UrdfKeeper) -> tuple[AnyShaped, str]:
    """A URI for ROS, and its visual or collision with an annotation if the reverse conversion needs the scheme.

    `kind` is the kind of the annotation. A URI of URDF that had the scheme of Gazebo keeps it.
    """
    annotation = find_annotation(shape, kind)
    shape = without_annotation(shape, kind)
    if annotation is not None and annotation.get("scheme") == scheme_of(written) == GAZEBO:
        return shape, written
    # Gazebo looks up `model://` in its resource path and ROS `package://` in its own; both name a
    # folder and a path in it.
    uri, lost = package_uri(written)
    if lost:
        keeper.account(rules.SDF_ONLY, f"{written!r} has the scheme that model:// becomes", shape.location, 1)
        shape = keeper.annotate(shape, kind, attributes={"scheme": scheme_of(written)})
    return shape, uri
