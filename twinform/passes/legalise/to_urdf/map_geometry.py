"""Converting geometry to the shapes of URDF, and carrying the others."""

from collections.abc import Mapping
from typing import ClassVar, TypeVar

from twinform.diagnostics import rules
from twinform.ir import (
    Collision,
    Empty,
    Geometry,
    Link,
    Mesh,
    Model,
    Node,
    Visual,
    census_of,
    count_parts,
    replace_fields,
)
from twinform.ir.defaults import SIZES, filled
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.legalise.to_urdf.remainder import urdf_fields
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.mesh_jobs.mesh_files import NoMeshError
from twinform.passes.shared.document_uris import GAZEBO, MESH_SCHEME, package_uri, scheme_of
from twinform.passes.shared.nodes import piece
from twinform.passes.shared.replaced_shapes import REPLACED, ShapeReplacer, map_touched, with_ends
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
    """Keep the shapes that URDF has, with all their sizes, and replace the others.

    Changes: 1. a size that is not written is SDF's default; 2. `model://` becomes `package://`; 3. a capsule, which
    URDF lacks before 1.1, becomes the cylinder between its ends, which `add-capsule-ends` adds; 4. an ellipsoid, cone
    or polyline becomes a mesh beside the result, at most `shape_error` off; 5. a visual or collision with any other
    shape, or where no file can be written, leaves the link, whole, into a carrier.
    Never touches: masses and inertias.
    Diagnostics: `replaced-shape` for each mesh, `unsayable-shape`; in the ledger these and `sdf-only`.
    """

    name: ClassVar[str] = "map-geometry"
    urdf_version: UrdfVersion = "1.0"
    shape_error: float | None = None
    mesh_prefix: str | None = None
    side_files: bool = True

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with shapes of URDF alone."""
        sayable = frozenset(urdf_fields(self.urdf_version, "geometry")["shape"] or ())
        target = f"URDF {self.urdf_version}"
        replacer = ShapeReplacer(
            keeper,
            target,
            lambda kind: kind not in sayable,
            self.shape_error,
            self.mesh_prefix,
            self.side_files,
        )
        links = tuple(_map_link(link, sayable, keeper, replacer) for link in model.links)
        return replace_fields(model, links=links)


def _map_link(link: Link, sayable: Sayable, keeper: UrdfKeeper, replacer: ShapeReplacer) -> Link:
    # A shape in a carrier is carried after the link's frame has moved onto its joint, so that its
    # pose means the same place as in SDF.
    link = _map_shapes(link, "collisions", "collision", link.collisions, sayable, keeper, replacer)
    return _map_shapes(link, "visuals", "visual", link.visuals, sayable, keeper, replacer)


def _map_shapes(
    link: Link,
    field: str,
    tag: str,
    shapes: tuple[AnyShaped, ...],
    sayable: Sayable,
    keeper: UrdfKeeper,
    replacer: ShapeReplacer,
) -> Link:
    kept: list[AnyShaped] = []
    taken = 0
    for shape in shapes:
        one, hint = _replaced(shape, link.name, replacer)
        if _is_expressible(one.geometry, sayable) or (
            keeper.back and (one.geometry is None or one.geometry.shape is None)
        ):
            kept.append(_map_shape(one, keeper))
            continue
        kind = one.geometry.shape.kind if one.geometry and one.geometry.shape else "no shape"
        what = _UNSAYABLE.get(kind, f"is a {kind}, which URDF does not have")
        message = f"{tag} {one.name!r} of link {link.name!r} {what}"
        keeper.sink.report(rules.UNSAYABLE_SHAPE, message, one.location, found=kind, help=hint)
        weight = count_parts(one)
        place = len(kept) + taken
        taken += 1
        about = (("index", str(place)),) if place < len(shapes) - 1 else ()
        link = keeper.keep(link, [piece(one, tag)], rules.UNSAYABLE_SHAPE, message, one.location, weight, about)
    return replace_fields(link, **{field: tuple(kept)})


def _replaced(one: AnyShaped, link: str, replacer: ShapeReplacer) -> tuple[AnyShaped, str | None]:
    """The part with a shape that URDF has, or the part itself and what to do."""
    shape = one.geometry.shape if one.geometry else None
    if isinstance(shape, Mesh):
        kind = "stl" if (shape.uri or "").lower().endswith(".obj") else "obj"
        return one, f"--passes 'convert-meshes{{to={kind}}}' writes the part to a file of its own"
    if isinstance(shape, Empty):
        return one, None
    try:
        return replacer.replace(one, link), None
    except NoMeshError as error:
        return one, str(error)


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


class AddCapsuleEnds(ToUrdfPass):
    """Put a sphere at each end of a cylinder that a capsule became.

    Changes: 1. visuals and collisions with such a cylinder; the spheres come behind it, with its material; 2. a contact
    sensor that names such a collision names the spheres too.
    Never touches: other cylinders.
    Diagnostics: none; `map-geometry` has accounted for the capsule.
    """

    name: ClassVar[str] = "add-capsule-ends"

    # Near the end: what all collisions of a link share is in <gazebo> by now, and what only some
    # have is carried once. Before `name-shapes-for-gazebo`, which counts all shapes.
    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with whole capsules."""
        if not census_of(model) & REPLACED:
            return model
        links: list[Link] = []
        ends: dict[str | None, Mapping[str, tuple[str, ...]]] = {}
        for link in model.links:
            visuals, _ = with_ends(link.visuals, annotated=keeper.carriers)
            collisions, ends[link.name] = with_ends(link.collisions, annotated=keeper.carriers)
            links.append(replace_fields(link, visuals=visuals, collisions=collisions))
        extensions = tuple(map_touched(each, ends.get(each.reference, {})) for each in model.extensions)
        return replace_fields(model, links=tuple(links), extensions=extensions)
