"""Opens untrusted mesh files with `trimesh`, and refuses those that would make it slow or have it read other files."""

import io
import json
from collections.abc import Iterable, Mapping
from dataclasses import field
from typing import Any, NamedTuple, cast
from urllib.parse import unquote

from lxml import etree

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern
from twinform.passes.mesh_jobs.libraries import trimesh
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError
from twinform.schemas import XmlElement

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
) -> Scene:
    """Read a mesh file into a scene, with its materials if `appearance`; no other files are read than `companions`.

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
    if kind in {"glb", "gltf"}:
        _require_few_nodes(content)
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
