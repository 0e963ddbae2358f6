"""Draws the thumbnail of a model, seen from the front, the right and above, without a GPU.

Triangles are drawn without perspective: samples of each go into a depth buffer, and Pillow makes the PNG.
"""

import importlib
import io
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Literal, NamedTuple

from twinform.compiler.packaging.collecting import Collection
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

_PIXELS = 512
"""Pixels along each side of the picture."""
_FINER = 2
"""The number of samples along each side of a pixel, which are averaged."""
_MARGIN = 0.06
_BEHIND = (245, 246, 248)
_AMBIENT, _LIGHT = 0.45, 0.55
_FORWARD, _UP = (-0.75, 0.5, -0.43), (0.0, 0.0, 1.0)
"""The direction in which the camera looks; x is the front of the model."""
_TO_LAMP = (0.6, -0.35, 0.72)
_MOST_SAMPLES = 2**20
"""The number of points that are worked on at once, which bounds the memory."""
_MOST_DRAWN = 2**24
"""The most points of a picture, sixteen for each visible one: triangles that all cover it would take forever."""
_LEVELS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024, 1536, 2048)
"""The numbers of steps in which a triangle is sampled, along it and across."""

_Array = Any
"""A `numpy.ndarray`."""


class UndrawableError(ValueError):
    """The reason why some triangles cannot be drawn."""


class Faces(NamedTuple):
    """Triangles of one color: an array of n triangles by 3 corners by 3 coordinates."""

    points: _Array
    color: tuple[float, float, float]


def picture(faces: Sequence[Faces]) -> bytes:
    """Draw triangles as a PNG that shows all of them.

    Raises:
        ImportError: the extra is not installed.
        UndrawableError: the triangles hide each other many times.
    """
    # Gazebo's own thumbnails need Gazebo and a GPU, and light rendering libraries need OpenGL. A
    # picture of 512 pixels needs a depth buffer: triangles are sampled as finely as the pixels, and
    # numpy sorts the samples. The same model gives the same bytes.
    numpy: Any = importlib.import_module("numpy")
    image: Any = importlib.import_module("PIL.Image")
    side = _PIXELS * _FINER
    corners = _project(numpy, numpy.concatenate([each.points for each in faces]), side)
    colors = numpy.concatenate([_shade(numpy, each) for each in faces])
    depth = numpy.full(side * side, -numpy.inf)
    canvas = numpy.tile(numpy.array(_BEHIND, dtype=numpy.uint8), (side * side, 1))
    for points, which in _samples(numpy, corners):
        column, row = (numpy.clip(points[:, axis].astype(int), 0, side - 1) for axis in (0, 1))
        place = row * side + column
        nearest = numpy.lexsort((points[:, 2], place))
        last = numpy.append(place[nearest][1:] != place[nearest][:-1], True)
        front = nearest[last]
        front = front[points[front, 2] > depth[place[front]]]
        depth[place[front]] = points[front, 2]
        canvas[place[front]] = colors[which[front]]
    shown = image.fromarray(canvas.reshape(side, side, 3)).resize((_PIXELS, _PIXELS), image.Resampling.BOX)
    out = io.BytesIO()
    shown.save(out, "PNG", optimize=True)
    return out.getvalue()


def _project(numpy: Any, points: _Array, side: int) -> _Array:
    """Project the corners to columns, rows and nearness, so that all are in the picture."""
    forward = numpy.array(_FORWARD) / numpy.linalg.norm(_FORWARD)
    right = numpy.cross(forward, _UP)
    right = right / numpy.linalg.norm(right)
    axes = numpy.stack([right, -numpy.cross(right, forward), -forward])
    seen = points @ axes.T
    least, most = seen.min(axis=(0, 1)), seen.max(axis=(0, 1))
    extent = max(float((most - least)[:2].max()), 1e-12)
    return (seen - (least + most) / 2) * (side * (1 - 2 * _MARGIN) / extent) + (side / 2, side / 2, 0)


def _shade(numpy: Any, faces: Faces) -> _Array:
    """Return the shaded color of each triangle as bytes; both sides are lit equally."""
    normals = numpy.cross(faces.points[:, 1] - faces.points[:, 0], faces.points[:, 2] - faces.points[:, 0])
    lengths = numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-300)
    lamp = numpy.array(_TO_LAMP) / numpy.linalg.norm(_TO_LAMP)
    lit = _AMBIENT + _LIGHT * numpy.abs(normals @ lamp) / lengths
    return numpy.clip(255 * lit[:, None] * numpy.clip(faces.color, 0, 1), 0, 255).astype(numpy.uint8)


def _samples(numpy: Any, corners: _Array) -> Iterator[tuple[_Array, _Array]]:
    """Yield points of the triangles, at least one for each pixel that they cover, and the triangle of each point.

    The points lie in rows along the longest side, as many rows as the triangle is high, so that long and thin
    triangles, which are many, have few points. Triangles with similar numbers of points are sampled together.
    """
    sides = numpy.linalg.norm((numpy.roll(corners, -1, axis=1) - corners)[:, :, :2], axis=2)
    first = sides.argmax(axis=1)
    each = numpy.arange(len(corners))
    a, b, c = (corners[each, (first + step) % 3] for step in range(3))
    length = sides[each, first]
    doubled = numpy.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    height = doubled / numpy.maximum(length, 1e-12)
    levels = numpy.array(_LEVELS)
    along, across = (numpy.searchsorted(levels, 1.25 * extent) for extent in (length, height))
    if int(((levels[along] + 1) * (levels[across] + 1)).sum()) > _MOST_DRAWN:
        raise UndrawableError("too many triangles lie behind each other")
    for group in numpy.unique(along * len(_LEVELS) + across):
        which = numpy.flatnonzero(along * len(_LEVELS) + across == group)
        columns, rows = levels[group // len(_LEVELS)], levels[group % len(_LEVELS)]
        grid = numpy.meshgrid(numpy.linspace(0, 1, columns + 1), numpy.linspace(0, 1, rows + 1))
        s, t = (values.ravel() for values in grid)
        weights = numpy.stack([(1 - t) * (1 - s), (1 - t) * s, t], axis=1)
        at_once = max(1, _MOST_SAMPLES // len(weights))
        for start in range(0, len(which), at_once):
            some = which[start : start + at_once]
            points = numpy.einsum("sc,ctx->tsx", weights, numpy.stack([a[some], b[some], c[some]])).reshape(-1, 3)
            yield points, numpy.repeat(some, len(weights))


_GREY = (0.72, 0.72, 0.75)
_MOST_FACES = 1_000_000


def thumbnail(document: Document, collection: Collection, sink: DiagnosticSink) -> bytes | None:
    """Draw the model of a document as PNG; None, with a finding, where there is nothing to draw."""
    if not document.models:
        return None
    model = document.models[0]
    try:
        with staging_folder(temporary_folder()) as folder:
            faces = _limited(_faces(model, Meshes(_Collected(collection, folder))))
        if faces:
            return picture(faces)
        why = "nothing of it can be drawn"
    except ImportError as error:
        from twinform.installation import install_command  # noqa: PLC0415 - most have what they need

        why = f"{error.name} is not installed; run: {install_command('thumbnails')}"
    except (FrameError, UndrawableError) as error:
        why = str(error)
    sink.report(NO_THUMBNAIL, f"model {model.name!r} has no thumbnail: {why}", model.location, found=model.name)
    return None


def _limited(faces: Iterator[Faces]) -> list[Faces]:
    """Return the triangles, if there are not too many: a mesh may be shown many times."""
    found, count = list[Faces](), 0
    for each in faces:
        found.append(each)
        count += len(each.points)
        if count > _MOST_FACES:
            raise UndrawableError("there are too many triangles")
    return found


class _Collected:
    """The files of a package by their URIs: at their original places, or in a folder if a pass has made them."""

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

    def xml(self, path: Path, largest: int) -> bytes:
        del largest
        raise AssetError(UNRESOLVED_URI, f"{path.name!r} is not in the package")

    def holder(self, folder: Path, kind: Literal["package", "model"]) -> str | None:
        del folder, kind
        return None

    def address(self, file: Path) -> str | None:
        del file
        return None


def _faces(model: Model, meshes: Meshes) -> Iterator[Faces]:
    """Yield the triangles of all visuals in the frame of the model; meshes that cannot be read are left out."""
    graph = FrameGraph(model)
    for name, link in scoped_links(model):
        for visual in link.visuals:
            shape = visual.geometry.shape if visual.geometry else None
            made = _triangles(shape, meshes) if shape else None
            points = (
                _place_triangles(made, graph.resolve(visual.pose, name, MODEL, base="model"))
                if made is not None
                else ()
            )
            if len(points):
                yield Faces(points, _color(visual.material))


def _triangles(shape: Shape, meshes: Meshes) -> Any:
    """Return the surface of a shape as a `trimesh.Trimesh`; None where it has none, or is a plane."""
    if isinstance(shape, Mesh):
        try:
            return _surface_of_mesh(meshes.triangles(shape))
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


def _surface_of_mesh(found: MeshTriangles) -> Any:
    numpy: Any = importlib.import_module("numpy")
    points = numpy.frombuffer(found.points, numpy.float64).reshape(-1, 3)
    faces = numpy.frombuffer(found.faces, numpy.int64).reshape(-1, 3)
    return _Surface(points, faces)


def _place_triangles(triangles: Any, at: Transform) -> Any:
    """Return the corners of the triangles in the frame of the model: an array of n by 3 by 3 finite numbers."""
    numpy: Any = importlib.import_module("numpy")
    turn = numpy.array(at.rotation).reshape(3, 3)
    placed = (triangles.vertices @ turn.T + numpy.array(at.translation))[triangles.faces]
    return placed[numpy.isfinite(placed).all(axis=(1, 2))]


def _color(material: Material | None) -> tuple[float, float, float]:
    color = (material.diffuse or material.color or material.ambient) if material else None
    return (color[0], color[1], color[2]) if color else _GREY
