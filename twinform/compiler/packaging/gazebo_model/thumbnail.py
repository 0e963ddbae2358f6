"""Draws the thumbnail of a model: its visuals from the front, from the right and from above, without any GPU."""

import importlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal, NamedTuple

from twinform.compiler.packaging.collecting import Collection
from twinform.compiler.packaging.gazebo_model.drawing import Faces, UndrawableError, picture
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import NO_THUMBNAIL, UNRESOLVED_URI
from twinform.file_access import Readable
from twinform.ir import Box, Capsule, Cone, Cylinder, Document, Ellipsoid, Material, Mesh, Model, Shape, Sphere
from twinform.ir.defaults import sizes
from twinform.ir.frames import MODEL, FrameError, FrameGraph
from twinform.ir.scopes import scoped_links
from twinform.ir.transform import Transform
from twinform.passes.framework.assets import AssetError
from twinform.passes.shared.mesh_solids import MeshError, Meshes, MeshTriangles
from twinform.storage.staging import staging_folder, temporary_folder

_GREY = (0.72, 0.72, 0.75)
_MOST_FACES = 1_000_000


def thumbnail(document: Document, collection: Collection, sink: DiagnosticSink) -> bytes | None:
    """A picture of a document's model as PNG; None, and a note, where there is nothing to be drawn."""
    if not document.models:
        return None
    model = document.models[0]
    try:
        with staging_folder(temporary_folder()) as folder:
            faces = _few(_faces(model, Meshes(_Collected(collection, folder))))
        if faces:
            return picture(faces)
        why = "nothing of it can be drawn"
    except ImportError as error:
        why = f"{error.name} is not installed: pip install 'twinform[thumbnails]'"
    except (FrameError, UndrawableError) as error:
        why = str(error)
    sink.report(NO_THUMBNAIL, f"model {model.name!r} has no thumbnail: {why}", model.location, found=model.name)
    return None


def _few(faces: Iterator[Faces]) -> list[Faces]:
    """All of them, as long as they are not too many: a mesh may be shown many times."""
    found, count = list[Faces](), 0
    for each in faces:
        found.append(each)
        count += len(each.points)
        if count > _MOST_FACES:
            raise UndrawableError("there are too many triangles")
    return found


class _Collected:
    """The files of a package by their URIs in it: where they still lie, or in a folder if a pass has made them."""

    folder: Path | None = None

    def __init__(self, collection: Collection, folder: Path) -> None:
        self._collection, self._folder = collection, folder
        self._places = {collection.layout.uri(path, "model"): path for path in collection.files}

    @property
    def readable(self) -> Readable:
        return Readable(tuple({os.path.realpath(path.parent) for path in self._collection.sources.values()}))

    def find(self, uri: str) -> Path:
        place = self._places.get(uri.strip())
        if place is None:
            raise AssetError(UNRESOLVED_URI, f"{uri!r} is not in the package")
        if place in self._collection.sources:
            return self._collection.sources[place]
        content = self._collection.files[place]
        if isinstance(content, Path):
            return content
        path = self._folder / place.replace("/", "_")
        path.write_bytes(content)
        return path

    def holder(self, folder: Path, kind: Literal["package", "model"]) -> str | None:
        del folder, kind
        return None

    def address(self, file: Path) -> str | None:
        del file
        return None


def _faces(model: Model, meshes: Meshes) -> Iterator[Faces]:
    """The triangles of all visuals, in the frame of the model; meshes that cannot be read are left out."""
    graph = FrameGraph(model)
    for name, link in scoped_links(model):
        for visual in link.visuals:
            shape = visual.geometry.shape if visual.geometry else None
            made = _triangles(shape, meshes) if shape else None
            points = _placed(made, graph.resolve(visual.pose, name, MODEL, base="model")) if made is not None else ()
            if len(points):
                yield Faces(points, _color(visual.material))


def _triangles(shape: Shape, meshes: Meshes) -> Any:
    """The surface of a shape as a `trimesh.Trimesh`; None where it has none, or is a plane."""
    if isinstance(shape, Mesh):
        try:
            return _of_file(meshes.triangles(shape))
        except MeshError:
            return None
    creation: Any = importlib.import_module("trimesh.creation")
    match shape:
        case Box():
            return creation.box(extents=sizes(shape))
        case Sphere():
            return creation.icosphere(subdivisions=3, radius=sizes(shape)[0])
        case Cylinder() | Capsule() | Cone():
            radius, length = sizes(shape)
            make = {"cylinder": creation.cylinder, "capsule": creation.capsule, "cone": creation.cone}[shape.kind]
            made = make(radius=radius, height=length)
            if shape.kind != "cylinder":  # which alone is made about its middle
                made.apply_translation((0, 0, -made.bounds.mean(axis=0)[2]))
            return made
        case Ellipsoid():
            made = creation.icosphere(subdivisions=3, radius=1.0)
            made.vertices = made.vertices * sizes(shape)
            return made
        case _:
            return None


class _Surface(NamedTuple):
    """Points and triangles as `trimesh.Trimesh` has them."""

    vertices: Any
    faces: Any


def _of_file(found: MeshTriangles) -> Any:
    numpy: Any = importlib.import_module("numpy")
    points = numpy.frombuffer(found.points, numpy.float64).reshape(-1, 3)
    faces = numpy.frombuffer(found.faces, numpy.int64).reshape(-1, 3)
    return _Surface(points, faces)


def _placed(triangles: Any, at: Transform) -> Any:
    """The corners of each triangle in the frame of the model: an array of n by 3 by 3 numbers, all of them finite."""
    numpy: Any = importlib.import_module("numpy")
    turn = numpy.array(at.rotation).reshape(3, 3)
    placed = (triangles.vertices @ turn.T + numpy.array(at.translation))[triangles.faces]
    return placed[numpy.isfinite(placed).all(axis=(1, 2))]


def _color(material: Material | None) -> tuple[float, float, float]:
    color = (material.diffuse or material.color or material.ambient) if material else None
    return (color[0], color[1], color[2]) if color else _GREY
