"""Opening untrusted mesh files with `trimesh`."""

import io
import json
import re
from collections.abc import Iterable, Mapping
from typing import Any, cast
from urllib.parse import unquote

from twinform.passes.mesh_jobs.geometry.collada_nodes import require_few_parts
from twinform.passes.mesh_jobs.geometry.libraries import trimesh
from twinform.passes.mesh_jobs.mesh_files import RefusedMeshError

_MOST_CORNERS = 1000
# The reader cuts a face into triangles one by one, and a line may continue in the next.
_LONG_FACE = re.compile(rb"(?m)^[ \t]*f(?:(?:[ \t]|\\\r?\n)+[^ \t\r\n\\]+){%d}" % (_MOST_CORNERS + 1))
# Of a glTF scene, and of faces of one material in an OBJ file: the reader makes a mesh or a node
# for each.
_MOST_PIECES = 10_000
_GLB_SIZE, _GLB_HEADER = 12, 20
"""Where a GLB file says how long its JSON is, and where that begins."""

Scene = Any
"""A `trimesh.Scene`."""


def scene_of(
    content: bytes,
    kind: str,
    *,
    companions: Mapping[str, bytes] | None = None,
    appearance: bool = False,
) -> Scene:
    """The scene in the bytes of a file; with `appearance` also its materials. Only these `companions` are read besides.

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
        require_few_parts(content)
    if kind == "obj":
        _require_plain(content)
    if kind in {"glb", "gltf"}:
        _require_few_nodes(content)
    resolver = _Companions(companions) if companions else None  # without one nothing is read but these bytes
    return trimesh.load_scene(
        io.BytesIO(content), file_type=kind, resolver=resolver, skip_materials=not appearance, process=False
    )


def _require_plain(content: bytes) -> None:
    """Raise where an OBJ file has faces or pieces that take the reader long."""
    if _LONG_FACE.search(content):
        raise RefusedMeshError(f"it has a face with more than {_MOST_CORNERS:,} corners")
    if content.count(b"usemtl") > _MOST_PIECES:
        raise RefusedMeshError(f"it changes its material more than {_MOST_PIECES:,} times")


def _require_few_nodes(content: bytes) -> None:
    """Raise where a glTF file has more nodes than are read; whatever is no JSON is left to the reader."""
    start = _GLB_HEADER if content.startswith(b"glTF") else 0
    size = int.from_bytes(content[_GLB_SIZE : _GLB_SIZE + 4], "little") if start else len(content)
    try:
        found = json.loads(content[start : start + size])
    except (ValueError, RecursionError):
        return
    nodes = cast("dict[str, object]", found).get("nodes") if isinstance(found, dict) else None
    if isinstance(nodes, list) and len(cast("list[object]", nodes)) > _MOST_PIECES:
        raise RefusedMeshError(f"it has more than {_MOST_PIECES:,} nodes")


class _Companions:
    """Files that a mesh names, for `trimesh`: they are in memory, and there are no others."""

    def __init__(self, files: Mapping[str, bytes]) -> None:
        self._files = files

    def get(self, name: str) -> bytes:
        """The bytes of one; raises KeyError where it is not there."""
        return self._files[name] if name in self._files else self._files[unquote(name)]

    __getitem__ = get

    def keys(self) -> Iterable[str]:
        """The names of all."""
        return self._files.keys()
