"""The triangles of shapes: of primitives by their definition, of meshes from their files."""

import importlib
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from twinform.compiler.resolve_uris import LocalAssets, SearchPath
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Box, Capsule, Cone, Cylinder, Ellipsoid, Mesh, Plane, Sphere
from twinform.ir.defaults import sizes
from twinform.ir.geometry import ShapeNode
from twinform.passes import NO_ASSETS
from twinform.passes.meshes.mesh_pass import Workbench
from twinform.passes.meshes.mesh_source import MeshSources
from twinform.passes.shared.mesh_solids import MeshError

np: Any = importlib.import_module("numpy")
trimesh: Any = importlib.import_module("trimesh")
Array = Any
"""A numpy array."""

STAND_IN = 0.1
"""The side in meters of the box that stands for what cannot be drawn."""
_SHARP = 0.6
_ROUND = 3
"""How often the sides of an icosahedron are halved for a sphere."""
_LARGEST_PLANE = 100.0
_SMALLEST, _LARGEST = 1e-9, 1e6


class MeshDrawings:
    """The meshes that the file `beside` names, each read once; `gltf_up` is the axis that is up in a glTF file."""

    def __init__(self, search: SearchPath | None = None, beside: Path | None = None, *, gltf_up: str = "z") -> None:
        assets = LocalAssets(search, beside) if search and beside else NO_ASSETS
        sink = DiagnosticSink()
        self._bench = Workbench(sink, MeshSources(assets, sink), folder="", prefix="")
        self._options = {"gltf_up": gltf_up}
        self._known: dict[tuple[str, object], Mapping[str, bytes] | str] = {}

    def drawing(self, mesh: Mesh) -> Mapping[str, bytes] | str:
        """Return `points`, `faces` and perhaps `colors` of a mesh without its scale, or why it cannot be drawn."""
        uri = (mesh.uri or "").strip()
        if not uri:
            return "it names no mesh"
        key = (uri, mesh.opaque)
        if key not in self._known:
            self._known[key] = self._read(mesh)
        return self._known[key]

    def _read(self, mesh: Mesh) -> Mapping[str, bytes] | str:
        try:
            # A mesh is a file of a stranger: the confined child process hands over arrays of
            # numbers. Textures become colors of vertices there, which needs no second kind of
            # material and is enough to recognize a robot.
            return self._bench.outcome("draw", mesh, self._options).result.files
        except MeshError as error:
            return error.message


@dataclass(frozen=True, slots=True)
class Triangles:
    """Points in meters as rows of x, y, z in the frame of the shape, and three of their indices for each triangle.

    `colors` are rows of four bytes for each point, where the shape has its own. A `problem` says why this is only a
    box that stands for the shape.
    """

    points: Array
    faces: Array
    colors: Array | None = None
    problem: str = ""


def triangles_of(shape: ShapeNode, meshes: MeshDrawings) -> Triangles:
    """Return the triangles of a shape; those of a small box if it cannot be drawn."""
    if isinstance(shape, Mesh):
        return _read_mesh(shape, meshes)
    make = _MAKERS.get(type(shape))
    if make is None:
        return _stand_in(f"a {shape.model_dump()['kind']} is not drawn")
    lengths = (shape.size or (1.0, 1.0)) if isinstance(shape, Plane) else sizes(shape)
    if not all(math.isfinite(each) and _SMALLEST < abs(each) < _LARGEST for each in lengths):
        return _stand_in("its size is zero, or not finite, or beyond what can be drawn")
    made = make(shape, [abs(each) for each in lengths])
    return Triangles(np.asarray(made.vertices, dtype=np.float32), np.asarray(made.faces, dtype=np.uint32))


def _read_mesh(shape: Mesh, meshes: MeshDrawings) -> Triangles:
    found = meshes.drawing(shape)
    if isinstance(found, str):
        return _stand_in(found)
    with np.errstate(over="ignore"):
        scale = np.asarray(shape.scale or (1.0, 1.0, 1.0), dtype=np.float32)
        points = np.frombuffer(found["points"], dtype=np.float32).reshape(-1, 3) * scale
    if not (np.isfinite(scale).all() and scale.all()):
        return _stand_in("its scale is zero or not finite")
    if not np.isfinite(points).all():
        return _stand_in("its points are beyond what can be drawn")
    faces = np.frombuffer(found["faces"], dtype=np.uint32).reshape(-1, 3)
    colors = np.frombuffer(found["colors"], dtype=np.uint8).reshape(-1, 4) if "colors" in found else None
    # A negative scale mirrors the mesh, and with it the winding of its triangles.
    return Triangles(points, faces if scale.prod() > 0 else faces[:, ::-1], colors)


def _stand_in(problem: str) -> Triangles:
    made = trimesh.creation.box((STAND_IN, STAND_IN, STAND_IN))
    return Triangles(np.asarray(made.vertices, np.float32), np.asarray(made.faces, np.uint32), None, problem)


def _make_plane(shape: ShapeNode, x: float, y: float) -> Any:
    """Return a rectangle about the origin, of limited size: planes of worlds are larger."""
    half = min(x, _LARGEST_PLANE) / 2, min(y, _LARGEST_PLANE) / 2
    corners = [(-half[0], -half[1], 0), (half[0], -half[1], 0), (half[0], half[1], 0), (-half[0], half[1], 0)]
    made = trimesh.Trimesh(corners, [(0, 1, 2), (0, 2, 3)], process=False)
    normal = shape.normal if isinstance(shape, Plane) else None
    if normal is not None and any(normal):
        made.apply_transform(trimesh.geometry.align_vectors((0, 0, 1), normal))
    return made


def _center(made: Any) -> Any:
    return made.apply_translation((0, 0, -made.bounds.mean(axis=0)[2]))


def _smooth(made: Any) -> Any:
    """Return the mesh with points of its own for each side of an edge, so that light shows the edge."""
    return trimesh.graph.smooth_shade(made, angle=_SHARP)


_MAKERS: Mapping[type[ShapeNode], Callable[[ShapeNode, Sequence[float]], Any]] = {
    Box: lambda _, size: _smooth(trimesh.creation.box(size)),
    Cylinder: lambda _, size: _smooth(trimesh.creation.cylinder(size[0], size[1], sections=48)),
    # trimesh stands cones and capsules on the origin, or nearly; SDF centers them
    Cone: lambda _, size: _smooth(_center(trimesh.creation.cone(size[0], size[1], sections=48))),
    Capsule: lambda _, size: _center(trimesh.creation.capsule(size[1], size[0], count=(24, 24))),
    Sphere: lambda _, size: trimesh.creation.icosphere(_ROUND, size[0]),
    Ellipsoid: lambda _, size: trimesh.creation.icosphere(_ROUND, 1.0).apply_scale(size),
    Plane: lambda shape, size: _make_plane(shape, *size),
}
