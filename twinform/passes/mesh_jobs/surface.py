"""Opens untrusted mesh files, and gives their meshes as named parts in meters, and as one surface of triangles.

`trimesh` opens them; files that would make it slow, or have it read other files, are refused.
"""

import io
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import field
from typing import Any, NamedTuple, cast
from urllib.parse import unquote

from lxml import etree

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern
from twinform.passes.mesh_jobs.job import MeshJob
from twinform.passes.mesh_jobs.libraries import Array, np, trimesh
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError
from twinform.passes.mesh_jobs.mesh_writing import turn_z_up
from twinform.passes.mesh_jobs.mujoco_meshes import KIND, scene_of_msh
from twinform.passes.mesh_jobs.obj_polygons import split_polygons
from twinform.schemas import XmlElement

MOST_TRIANGLES = 5_000_000


class UnusableMeshError(RefusedMeshError):
    """Why nothing can be made of a mesh that could be read."""


class TriangleSurface(NamedTuple):
    """Triangles as arrays: points as rows of x, y, z in meters, and for each triangle three indices of points."""

    points: Array
    faces: Array

    @property
    def triangles(self) -> Array:
        """The corners of each triangle."""
        return self.points[self.faces]

    @property
    def diagonal(self) -> float:
        """The length of the diagonal of the bounding box."""
        return float(np.linalg.norm(np.ptp(self.points[np.unique(self.faces)], axis=0)))


def parts_of(job: MeshJob, *, appearance: bool = False, finite: bool = True) -> list[tuple[str, Any]]:
    """The meshes that the shape of a job uses, by name, in meters and in their places."""
    as_mujoco = bool(job.options.get("as_mujoco"))
    scene: Any = scene_of(job.content, job.kind, companions=job.companions, appearance=appearance, as_mujoco=as_mujoco)
    if job.options.get("hull_of_points"):
        scene = _hull_of_points(scene)
    _require_triangles(scene, finite=finite)
    parts = _select_submesh(
        _place_parts(scene), cast("str | None", job.options["submesh"]), center=bool(job.options["center"])
    )
    meter = _unit_in_meters(parts) if job.kind == "dae" else 1.0
    if meter != 1.0:
        for _, part in parts:
            part.apply_scale(meter)
    return turn_z_up(parts) if job.kind in {"glb", "gltf"} and job.options["gltf_up"] == "y" else parts


def _hull_of_points(scene: Any) -> Any:
    """A scene of the convex hull of the points of a file, if these are all that it has.

    Raises:
        UnusableMeshError: the points are in a plane, or are no finite numbers.
    """
    parts = [*scene.geometry.values()]
    if len(parts) != 1 or not isinstance(parts[0], trimesh.PointCloud):
        return scene
    try:
        return trimesh.Scene(parts[0].convex_hull)
    except ImportError:
        raise
    except Exception as error:  # scipy raises an error of its own
        raise UnusableMeshError("it has no triangles, and its points have no convex hull") from error


def _require_triangles(scene: Any, *, finite: bool) -> None:
    """Refuse a scene without triangles; coordinates may be infinite or NaN where not `finite`.

    Raises:
        UnusableMeshError: it has no triangles, too many, or coordinates that are no numbers.
    """
    meshes = [each for each in scene.geometry.values() if len(getattr(each, "faces", ()))]
    if not meshes:
        raise UnusableMeshError("it has no triangles")
    uses = len(scene.graph.nodes_geometry)
    # Checked before the parts are copied to their places: a part may be placed any number of times.
    if (
        uses * max(len(each.faces) for each in meshes)
        > MOST_TRIANGLES
        < sum(len(each[1].faces) for each in _used_meshes(scene))
    ):
        raise UnusableMeshError(f"it has more than {MOST_TRIANGLES:,} triangles")
    for each in meshes:
        if finite and not np.isfinite(each.vertices[each.faces.ravel()]).all():
            raise UnusableMeshError("it has coordinates that are no finite numbers")


def _used_meshes(scene: Any) -> list[tuple[str, Any]]:
    """The meshes of a scene, each as often as it is placed."""
    nodes = (scene.graph[node][1] for node in scene.graph.nodes_geometry)
    return [(name, scene.geometry[name]) for name in nodes if len(getattr(scene.geometry[name], "faces", ()))]


def _place_parts(scene: Any) -> list[tuple[str, Any]]:
    """Copies of the meshes of a scene at the places where it puts them, without lines and points."""
    found: list[tuple[str, Any]] = []
    for node in scene.graph.nodes_geometry:
        at, name = scene.graph[node]
        if len(getattr(scene.geometry[name], "faces", ())):
            part = scene.geometry[name].copy()
            if not np.array_equal(at, np.eye(4)):
                part.apply_transform(at)
            found.append((str(name), part))
    return found


def _select_submesh(parts: list[tuple[str, Any]], submesh: str | None, *, center: bool) -> list[tuple[str, Any]]:
    """The parts of a file that have the name of a submesh, moved to the origin if `center`; all parts if it is None.

    Raises:
        UnusableMeshError: there is no part of this name.
    """
    if submesh is None:
        return parts
    found = [(name, part) for name, part in parts if name == submesh]
    if not found:
        known = ", ".join(sorted({name for name, _ in parts})[:6])
        raise UnusableMeshError(f"it has no submesh {submesh!r}, it has {known}")
    if center:
        middle = np.mean(
            [np.min([p.bounds[0] for _, p in found], axis=0), np.max([p.bounds[1] for _, p in found], axis=0)], axis=0
        )
        for _, part in found:
            part.apply_translation(-middle)
    return found


def _unit_in_meters(parts: Sequence[tuple[str, Any]]) -> float:
    """The unit of a COLLADA file in meters, which its reader leaves in the metadata of the meshes."""
    words = next((str(part.metadata["units"]) for _, part in parts if part.metadata.get("units")), "meters")
    try:
        factor = float(words.partition("*")[0]) if "*" in words else 1.0
    except ValueError:
        factor = math.nan
    if not (math.isfinite(factor) and factor > 0):
        raise UnusableMeshError(f"its unit is {words!r}")
    return factor


def join_parts(parts: list[tuple[str, Any]]) -> TriangleSurface:
    """All triangles of some meshes as one surface, with equal points merged and triangles without area left out.

    Raises:
        UnusableMeshError: nothing is left.
    """
    triangles = np.concatenate([np.asarray(part.vertices, dtype=float)[part.faces] for _, part in parts])
    surface = merge_points(triangles)
    if not len(surface.faces) or not surface.diagonal > 0:
        raise UnusableMeshError("its triangles have no area")
    return surface


def merge_points(triangles: Array) -> TriangleSurface:
    """A surface of triangles given by corners; triangles of which two corners are one point are left out."""
    points, index = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    faces = index.reshape(-1, 3)
    apart = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return TriangleSurface(points, faces[apart])


def scale_surface(surface: TriangleSurface, scale: Any) -> TriangleSurface:
    """A surface scaled along x, y and z; its triangles still face outward where the scale mirrors it.

    Raises:
        UnusableMeshError: nothing is left of it.
    """
    factors = np.asarray(scale, dtype=float)
    if not np.isfinite(factors).all() or not factors.all():
        raise UnusableMeshError("its scale is zero or no number")
    faces = surface.faces if np.prod(factors) > 0 else surface.faces[:, ::-1]
    return TriangleSurface(surface.points * factors, faces)


_MOST_CORNERS = 1000
# The reader cuts a face into triangles one by one, and a line may continue in the next.
_LONG_FACE = lazy_pattern(rb"(?m)^[ \t]*f(?:(?:[ \t]|\\\r?\n)+[^ \t\r\n\\]+){%d}" % (_MOST_CORNERS + 1))
# Of a glTF scene, and of faces of one material in an OBJ file: the reader makes a mesh or a node
# for each.
_MOST_PIECES = 10_000
_GLB_SIZE, _GLB_HEADER = 12, 20
"""Where a GLB file says how long its JSON is, and where its JSON begins."""
_MOST_PARTS = 5_000
_LEAST_BYTES, _MOST_TIMES = 2**24, 8
"""The placed parts of a COLLADA file may have this many bytes, or that many times the size of the file."""
_DEEPEST = 200
_INSTANCES = ("instance_geometry", "instance_controller")
Scene = Any
"""A `trimesh.Scene`."""


def scene_of(
    content: bytes,
    kind: str,
    *,
    companions: Mapping[str, bytes] | None = None,
    appearance: bool = False,
    as_mujoco: bool = False,
) -> Scene:
    """Read a mesh file into a scene, with its materials if `appearance`; no other files are read than `companions`.

    With `as_mujoco`, the polygons of an OBJ file become the triangles that MuJoCo makes of them.

    Raises:
        RefusedMeshError: it declares a document type, or would be far larger than its file.
        Exception: what the reader of the format raises.
    """
    if kind == "dae" and b"\0" in content:
        raise RefusedMeshError("it is not in UTF-8")  # where the next line would not see what it looks for
    # pycollada parses with lxml's defaults, which resolve entities, and with `huge_tree`.
    if kind == "dae" and b"<!" in content.replace(b"<!--", b"").replace(b"<![CDATA[", b""):
        raise RefusedMeshError("it declares a document type, which may name other files")
    if kind == "dae":
        _require_few_parts(content)
    if kind == "obj":
        _require_plain_obj(content)
        content = split_polygons(content) if as_mujoco else content
    if kind in {"glb", "gltf"}:
        _require_few_nodes(content)
    if kind == KIND:
        return scene_of_msh(content)
    resolver = _Companions(companions) if companions else None  # without one nothing is read but these bytes
    return trimesh.load_scene(
        io.BytesIO(content), file_type=kind, resolver=resolver, skip_materials=not appearance, process=False
    )


def _require_plain_obj(content: bytes) -> None:
    """Raise RefusedMeshError where an OBJ file has faces or materials that take its reader long."""
    if _LONG_FACE.search(content):
        raise RefusedMeshError(f"it has a face with more than {_MOST_CORNERS:,} corners")
    if content.count(b"usemtl") > _MOST_PIECES:
        raise RefusedMeshError(f"it changes its material more than {_MOST_PIECES:,} times")


def _require_few_nodes(content: bytes) -> None:
    """Raise RefusedMeshError where a glTF file has too many nodes; what is not JSON is left to its reader."""
    start = _GLB_HEADER if content.startswith(b"glTF") else 0
    size = int.from_bytes(content[_GLB_SIZE : _GLB_SIZE + 4], "little") if start else len(content)
    try:
        found = json.loads(content[start : start + size])
    except (ValueError, RecursionError):
        return
    nodes = cast("dict[str, object]", found).get("nodes") if isinstance(found, dict) else None
    if isinstance(nodes, list) and len(cast("list[object]", nodes)) > _MOST_PIECES:
        raise RefusedMeshError(f"it has more than {_MOST_PIECES:,} nodes")


def _require_few_parts(content: bytes) -> None:
    """Raise RefusedMeshError where the nodes of a COLLADA file place too much, or one contains itself."""
    # A node may place another one several times, which may do the same: 18 nodes in 2 kB place a
    # triangle 131,072 times. So they are counted before the reader makes any of them.
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, remove_comments=True)
    try:
        root = etree.fromstring(content, parser)
    except etree.XMLSyntaxError:
        return  # the reader says what is wrong, or repairs it
    nodes = _Nodes({str(each.get("id")): each for each in root.iter("{*}node", "{*}geometry") if each.get("id")})
    placed = [nodes.load(node) for scene in root.iter("{*}visual_scene") for node in scene.iterchildren("{*}node")]
    # A limit of time alone would say that it took too long, and not what to change.
    parts, size = sum(each.parts for each in placed), sum(each.size for each in placed)
    if parts > _MOST_PARTS:
        raise RefusedMeshError(f"its nodes place {parts:,} parts, of which {_MOST_PARTS:,} are read at most")
    if size > max(_LEAST_BYTES, _MOST_TIMES * len(content)):
        raise RefusedMeshError(f"its nodes place {size:,} bytes of parts, in a file that has {len(content):,}")


class _Load(NamedTuple):
    """How many parts a node places, and how many bytes they take in the file."""

    parts: int = 0
    size: int = 0


@dataclass(slots=True)
class _Nodes:
    """The nodes and geometries of a COLLADA file by their names; the load of each is added up once."""

    named: dict[str, XmlElement]
    _known: dict[XmlElement, _Load | None] = field(default_factory=dict[XmlElement, _Load | None])

    def load(self, node: XmlElement, depth: int = 0) -> _Load:
        """The load of a node with all nodes inside it, and all that it refers to."""
        if depth > _DEEPEST:
            raise RefusedMeshError(f"its nodes are nested more than {_DEEPEST} deep")
        if node in self._known:
            known = self._known[node]
            if known is None:
                raise RefusedMeshError(f"its node {node.get('id')!r} is a part of itself")
            return known
        self._known[node] = None
        parts = [self._child(child, depth) for child in node.iterchildren("*")]
        self._known[node] = found = _Load(sum(each.parts for each in parts), sum(each.size for each in parts))
        return found

    def _child(self, child: XmlElement, depth: int) -> _Load:
        name = etree.QName(child).localname
        target = self.named.get(str(child.get("url", "")).removeprefix("#"))
        if name == "node":
            return self.load(child, depth + 1)
        if name == "instance_node" and target is not None:
            return self.load(target, depth + 1)
        if name in _INSTANCES:
            return _Load(1, 0 if target is None else sum(len(text) for text in target.itertext()))
        return _Load()


class _Companions:
    """The resolver that `trimesh` asks for files that a mesh names: it has these in memory, and no others."""

    def __init__(self, files: Mapping[str, bytes]) -> None:
        self._files = files

    def get(self, name: str) -> bytes:
        """The bytes of a file; raises KeyError where it is not there."""
        return self._files[name] if name in self._files else self._files[unquote(name)]

    __getitem__ = get

    def keys(self) -> Iterable[str]:
        """The names of all files."""
        return self._files.keys()
