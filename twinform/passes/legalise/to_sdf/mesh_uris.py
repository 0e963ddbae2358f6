"""URIs of meshes and textures for Gazebo: `package://` to `model://`."""

from typing import ClassVar, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Collision, Format, Link, Mesh, Model, Visual, replace_fields
from twinform.passes.carriers.annotations import came_from, find_annotation, with_annotation, without_annotation
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.shared.document_uris import GAZEBO, MESH_SCHEME, ROS, TEXTURE_SCHEME, model_uri, scheme_of

Shape = TypeVar("Shape", Visual, Collision)


class MeshUris(ModelPass):
    """Write `package://` as `model://`, which Gazebo looks up in its own resource path.

    Changes: 1. URIs of meshes; 2. URIs of textures. What was `model://` in URDF is annotated, and what was
    `package://` in SDF, by its annotation, stays so.
    Never touches: files, relative paths and other schemes.
    Diagnostics: none.
    """

    name: ClassVar[str] = "mesh-uris"
    carriers: bool = True
    rewrites: bool = True
    """Whether URIs are changed, and not only annotated, as for MJCF: files are looked up as the URDF names them."""

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with URIs that Gazebo resolves."""
        annotations = self.carriers and not came_from(model, Format.SDF)
        writer = _UriWriter(sink, annotations, self.rewrites)
        return model.copy(links=tuple(map(writer.link, model.links)))


@dataclass(frozen=True, slots=True)
class _UriWriter:
    """One run over the links: whether the scheme of a URI is annotated, and whether it is rewritten."""

    sink: DiagnosticSink
    annotations: bool
    rewrites: bool

    def link(self, link: Link) -> Link:
        visuals, collisions = tuple(map(self._visual, link.visuals)), tuple(map(self._shape, link.collisions))
        return replace_fields(link, visuals=visuals, collisions=collisions)

    def _visual(self, visual: Visual) -> Visual:
        visual = self._shape(visual)
        material = visual.material
        if material is None or material.albedo_map is None:
            return visual
        visual, uri = self._uri(visual, TEXTURE_SCHEME, material.albedo_map)
        if uri == material.albedo_map:
            return visual
        return visual.copy(material=material.copy(albedo_map=uri))

    def _shape(self, shape: Shape) -> Shape:
        geometry = shape.geometry
        mesh = geometry.shape if geometry else None
        if geometry is None or not isinstance(mesh, Mesh) or mesh.uri is None:
            return shape
        shape, uri = self._uri(shape, MESH_SCHEME, mesh.uri)
        if uri == mesh.uri:
            return shape
        return shape.copy(geometry=geometry.copy(shape=mesh.copy(uri=uri)))

    def _uri(self, shape: Shape, kind: str, written: str) -> tuple[Shape, str]:
        """The URI for Gazebo, and the shape with what has to be known for the reverse conversion."""
        if scheme_of(written) not in {ROS, GAZEBO}:
            return without_annotation(shape, kind), written
        annotation = find_annotation(shape, kind)
        if annotation is not None:
            stays = annotation.get("scheme") == scheme_of(written) == ROS
            if not (stays or self.rewrites):
                return shape, written
            return without_annotation(shape, kind), written if stays else model_uri(written)[0]
        uri, lost = model_uri(written)
        if not lost:
            return shape, uri
        shape = with_annotation(shape, kind, attributes={"scheme": GAZEBO}) if self.annotations else shape
        return shape, uri if self.rewrites else written
