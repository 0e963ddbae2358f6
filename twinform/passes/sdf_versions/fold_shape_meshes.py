"""Reverse conversion of shapes for which a mesh stands: an ellipsoid, cone or polyline becomes that again."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Collision, Document, Element, Link, Mesh, Opaque, Visual, rewrite
from twinform.passes.carriers.absorb import CarrierError, absorb
from twinform.passes.carriers.annotations import without_annotation
from twinform.passes.carriers.carriers import is_carrier, unpack
from twinform.passes.framework.assets import AssetError
from twinform.passes.framework.pass_base import AssetPass
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError, content_of
from twinform.passes.sdf_versions.spans import has_shape
from twinform.passes.shared.replaced_shapes import REPLACED, SHAPE, AnyPart, digest_of
from twinform.schemas import versions_of


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
