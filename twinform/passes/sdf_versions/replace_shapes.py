"""Shapes that a version of SDF or URDF lacks, made of those that it has, and the ways back of capsules and meshes."""

import math
from collections.abc import Iterator, Sequence
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import (
    Capsule,
    Collision,
    Cone,
    Cylinder,
    Document,
    Element,
    Ellipsoid,
    Link,
    Mesh,
    Model,
    Node,
    Opaque,
    Polyline,
    Pose,
    Sphere,
    Visual,
    bits_of,
    replace_fields,
    rewrite,
)
from twinform.ir.defaults import sizes
from twinform.ir.transform import Transform
from twinform.passes.carriers.absorb import CarrierError, absorb
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.carriers import is_carrier, is_ours, unpack
from twinform.passes.carriers.sdf_versions import VersionKeeper
from twinform.passes.framework.assets import AssetError
from twinform.passes.framework.pass_base import AssetPass, Pass
from twinform.passes.mesh_jobs.mesh_files import NoMeshError, RefusedMeshError, content_of
from twinform.passes.sdf_versions.spans import has_shape
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.passes.shared.replaced_shapes import (
    CAPSULE,
    CAPSULE_END,
    REPLACED,
    SHAPE,
    AnyPart,
    ShapeReplacer,
    digest_of,
    end_poses,
    map_sensors,
    map_touched,
    with_ends,
)
from twinform.schemas import versions_of

_HAVING = bits_of(Capsule) | bits_of(Cone) | bits_of(Ellipsoid) | bits_of(Polyline)


class ReplaceShapes(VersionPass):
    """Write shapes that the version lacks by those that it has.

    Changes: 1. a capsule becomes a cylinder and two spheres, or a sphere where it has no length, and a
    contact sensor that names it names all of these; 2. an ellipsoid, cone
    or polyline becomes a mesh beside the result, at most `shape_error` off.
    Never touches: masses and inertias; shapes of which no mesh is made, which a later pass carries.
    Diagnostics: `replaced-shape` for each mesh, `older-version` where none can be written; in the ledger
    `replaced-shape`.
    """

    name: ClassVar[str] = "replace-shapes"
    shape_error: float | None = None
    mesh_prefix: str | None = None
    side_files: bool = True

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with shapes of the version."""
        replacer = ShapeReplacer(
            keeper,
            f"SDF {self.version}",
            lambda kind: not has_shape(self.version, kind),
            self.shape_error,
            self.mesh_prefix,
            self.side_files,
        )

        def change(link: Link) -> Link:
            visuals, _ = with_ends(_replace_parts(link.visuals, link.name, replacer), annotated=self.carriers)
            parts = _replace_parts(link.collisions, link.name, replacer)
            collisions, names = with_ends(parts, annotated=self.carriers)
            return map_sensors(replace_fields(link, visuals=visuals, collisions=collisions), names)

        return rewrite(document, Link, change, having=_HAVING)


def _replace_parts(parts: tuple[AnyPart, ...], link: str, replacer: ShapeReplacer) -> list[AnyPart]:
    made: list[AnyPart] = []
    for part in parts:
        try:
            made.append(replacer.replace(part, link))
        except NoMeshError as error:
            message = f"{replacer.target} has no shape for {type(part).__name__.lower()} {part.name!r} of link {link!r}"
            replacer.keeper.sink.report(rules.OLDER_VERSION, message, part.location, help=str(error))
            made.append(part)
    return made


_SAME = 1e-9
"""How far ends may be from where they were put, in parts of the size and the distance of a capsule."""


class FoldCapsules(Pass):
    """Make one capsule of the primitives that stand for one.

    Changes: a cylinder annotated as the middle of a capsule, with the two spheres behind it that are annotated as its
    ends, becomes a capsule, and so does a sphere that was one without a length.
    Never touches: primitives that make no capsule any more. What stands in the file counts, and they lose their
    annotations.
    Diagnostics: `stale-carrier` for these.
    """

    name: ClassVar[str] = "fold-capsules"

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with capsules."""
        return fold_capsules(document, sink)


def fold_capsules(document: Document, sink: DiagnosticSink) -> Document:
    """The document with a capsule in place of its parts, where these still make one."""
    return rewrite(document, Model, lambda model: _fold_model(model, sink), having=REPLACED)


def _fold_model(model: Model, sink: DiagnosticSink) -> Model:
    links: list[Link] = []
    gone: dict[str | None, dict[str, tuple[()]]] = {}
    for link in model.links:
        visuals, collisions = tuple(_fold_parts(link.visuals, sink)), tuple(_fold_parts(link.collisions, sink))
        if len(collisions) < len(link.collisions):
            kept = {each.name for each in collisions}
            gone[link.name] = {each.name or "": () for each in link.collisions if each.name not in kept}
        folded = replace_fields(link, visuals=visuals, collisions=collisions)
        links.append(map_sensors(folded, gone.get(link.name, {})))
    # A contact sensor names the capsule, which has the name of its middle. A link that is fixed there may have it.
    there = {each.name for link in links for each in link.collisions}
    beside = {name: () for names in gone.values() for name in names if name not in there}
    extensions = tuple(map_touched(each, {**beside, **gone.get(each.reference, {})}) for each in model.extensions)
    return replace_fields(model, links=tuple(links), extensions=extensions)


def _fold_parts(parts: Sequence[AnyPart], sink: DiagnosticSink) -> Iterator[AnyPart]:
    """Yield parts in their order, with a capsule for each middle that has its ends behind it."""
    place = 0
    while place < len(parts):
        part = parts[place]
        ends = parts[place + 1 : place + 3] if find_annotation(part, CAPSULE) is not None else ()
        capsule = _capsule(part, ends)
        place += 1 if capsule is None or isinstance(_shape(part), Sphere) else 3
        if capsule is None and find_annotation(part, CAPSULE) is not None:
            kind = type(part).__name__.lower()
            message = f"{kind} {part.name!r} and the two behind it are no capsule any more: they are read as they stand"
            sink.account(Fate.DROPPED, rules.STALE_CARRIER, message, part.location, 1)
            sink.report(rules.STALE_CARRIER, message, part.location, found=part.name or "")
        yield without_annotation(part, CAPSULE, CAPSULE_END) if capsule is None else capsule


def _capsule(middle: AnyPart, ends: Sequence[AnyPart]) -> AnyPart | None:
    """The capsule that a part is, with its ends or alone; None where they make none."""
    shape = _shape(middle)
    bare = without_annotation(middle, CAPSULE)
    if bare is middle or middle.geometry is None or not isinstance(shape, Cylinder | Sphere):
        return None
    radius, length = sizes(shape) if isinstance(shape, Cylinder) else (*sizes(shape), 0.0)
    if length:
        poses = end_poses(middle.pose, length)
        size = abs(radius) + abs(length)
        if len(ends) != 2 or not all(_is_end(*pair, bare, radius, size) for pair in zip(ends, poses, strict=True)):
            return None
    made = Capsule.unchecked(radius=radius, length=length, source=shape.source, opaque=shape.opaque)
    return bare.copy(geometry=middle.geometry.copy(shape=made))


def _is_end(end: AnyPart, pose: Pose, middle: AnyPart, radius: float, size: float) -> bool:
    """Whether a part is the sphere at an end of a capsule, where it belongs, and like the middle in all else."""
    found, ball = find_annotation(end, CAPSULE_END), _shape(end)
    if found is None or (found.text or None) != end.name or not isinstance(ball, Sphere) or sizes(ball) != (radius,):
        return False
    if (end.pose.relative_to if end.pose else None) != pose.relative_to or _looks(end) != _looks(middle):
        return False
    here, there = Transform.from_pose(end.pose).translation, Transform.from_pose(pose).translation
    return math.dist(here, there) <= _SAME * (size + math.hypot(*there))


def _looks(part: AnyPart) -> AnyPart:
    """What a part says beside its name, place and shape, without our own elements."""
    return part.copy(name="", pose=None, geometry=None, opaque=tuple(each for each in part.opaque if not is_ours(each)))


def _shape(part: Visual | Collision) -> Node | None:
    return part.geometry.shape if part.geometry else None


class FoldShapeMeshes(AssetPass):
    """Put the shape back for which a mesh stands.

    Changes: a mesh that stands for an ellipsoid, cone or polyline becomes that, if `version` of SDF has it.
    Never touches: a mesh that was exchanged, edited or scaled since. What stands in the file counts, and its annotation
    goes.
    Diagnostics: `stale-carrier` for these.
    """

    name: ClassVar[str] = "fold-shape-meshes"
    version: str = versions_of("sdf")[-1]

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with shapes in place of their meshes."""
        return rewrite(document, Link, lambda link: self._fold_link(link, sink), having=REPLACED)

    def _fold_link(self, link: Link, sink: DiagnosticSink) -> Link:
        return link.copy(
            visuals=tuple(self._fold(each, sink) for each in link.visuals),
            collisions=tuple(self._fold(each, sink) for each in link.collisions),
        )

    def _fold(self, part: AnyPart, sink: DiagnosticSink) -> AnyPart:
        found = next((each for each in part.opaque if is_carrier(each, SHAPE)), None)
        if found is None or found.element is None:
            return part
        bare = without_annotation(part, SHAPE)
        made = _restored(bare, found) if self._stands_for_another(bare, found.element) else None
        shape = made.geometry.shape if made and made.geometry else None
        if made is None or shape is None:
            _report(part, sink)
            return bare
        return made if has_shape(self.version, shape.kind) else part

    def _stands_for_another(self, part: Visual | Collision, written: Element) -> bool:
        """Whether a part has the mesh that was written, and as it was written as far as that can be looked up."""
        mesh = part.geometry.shape if part.geometry else None
        name = (mesh.uri or "").rpartition("/")[2] if isinstance(mesh, Mesh) else ""
        if not isinstance(mesh, Mesh) or not name or name != written.get("instead_of") or mesh.opaque:
            return False
        if mesh.scale not in (None, (1.0, 1.0, 1.0)):
            return False
        try:
            return digest_of(content_of(self._assets.find(mesh.uri or ""))) in name
        except (AssetError, OSError, RefusedMeshError):
            return True


def _restored(part: AnyPart, carrier: Opaque) -> AnyPart | None:
    """The part with the geometry in a carrier; None where somebody made that something else."""
    try:
        return absorb(part.copy(geometry=None), unpack(carrier))
    except CarrierError:
        return None


def _report(part: Visual | Collision, sink: DiagnosticSink) -> None:
    kind = type(part).__name__.lower()
    message = (
        f"{kind} {part.name!r} has another mesh, or one that was edited or scaled, by now: it is read as it stands"
    )
    sink.account(Fate.DROPPED, rules.STALE_CARRIER, message, part.location, 1)
    sink.report(rules.STALE_CARRIER, message, part.location, found=part.name or "")
