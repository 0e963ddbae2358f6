"""The mesh files that the shapes of a document name, with the files that these name: materials, textures, buffers.

The author of a mesh may be a stranger, and what it names is copied into results. So only images, materials and buffers
are taken, where the document may read them, and only up to a limit.
"""

import re
from dataclasses import field
from pathlib import Path, PurePosixPath
from typing import NamedTuple
from urllib.parse import unquote

from twinform.dataclass import dataclass
from twinform.diagnostics import HEAD, DiagnosticSink, rules
from twinform.file_access import Readable
from twinform.passes.framework.assets import AssetError, Assets
from twinform.passes.mesh_jobs.mesh_files import MARK, READ, RefusedMeshError, content_of, kind_of
from twinform.passes.mesh_references import FORMATS
from twinform.passes.shared.mesh_solids import MeshError

KINDS = frozenset({*READ, "gltf"})
_IMAGES = frozenset({".png", ".jpg", ".jpeg", ".tga", ".bmp", ".tif", ".tiff", ".webp"})
_OTHERS = frozenset({".mtl", ".bin"})
_NAMING = frozenset({"dae", "gltf", "mtl", "obj"})
_MOST_BYTES = 2**27
_MOST = 256


class MeshSource(NamedTuple):
    """A mesh file: its name without the suffix, its format, its content, and the files that it names."""

    stem: str
    kind: str
    content: bytes
    companions: dict[str, bytes]
    missing: tuple[str, ...] = ()

    def is_made(self, ending: re.Pattern[str]) -> bool:
        """Whether an earlier run of a pass has made it, so that another run would only lose more."""
        return bool(ending.search(self.stem)) and MARK.encode() in self.content[:HEAD]


@dataclass(frozen=True, slots=True)
class MeshSources:
    """The mesh files of a document, each read once; `prefix` is what URIs of made files begin with."""

    assets: Assets
    sink: DiagnosticSink
    prefix: str = ""
    _known: dict[str, MeshSource] = field(default_factory=dict[str, MeshSource])

    def find(self, uri: str) -> MeshSource:
        """The mesh file of a URI.

        Raises:
            MeshError: the file is not there or cannot be read.
        """
        if uri not in self._known:
            self._known[uri] = self._find_in_memory(uri) or self._find_on_disk(uri)
        return self._known[uri]

    def _find_in_memory(self, uri: str) -> MeshSource | None:
        """A file that an earlier pass has made and that is not written yet."""
        made = {each.path: each.data for each in self.sink.side_files}
        path = next((path for path in made if uri == path or uri.endswith(f"/{path}")), None)
        if path is None:
            return None
        beside = PurePosixPath(path).parent
        near = {PurePosixPath(each): data for each, data in made.items() if PurePosixPath(each).is_relative_to(beside)}
        others = {str(each.relative_to(beside)): data for each, data in near.items() if str(each) != path}
        return MeshSource(PurePosixPath(path).stem, kind_of(Path(path)), made[path], others)

    def _find_on_disk(self, uri: str) -> MeshSource:
        try:
            path = self.assets.find(uri)
        except AssetError as error:
            raise MeshError(rules.KEPT_MESH, error.message, error.help) from error
        kind = kind_of(path)
        if kind not in KINDS:
            message = f"the mesh {uri!r} is in no format that is read here: {', '.join(sorted(KINDS))}"
            raise MeshError(rules.UNREADABLE_MESH, message)
        content = _read_mesh(path, uri)
        companions, missing = companions_of(path, kind, content, self.assets.readable)
        return MeshSource(path.stem, kind, content, companions, missing)


def _read_mesh(path: Path, uri: str) -> bytes:
    """The bytes of a mesh file.

    Raises:
        MeshError: it cannot be read, or is too large.
    """
    try:
        return content_of(path)
    except RefusedMeshError as error:
        raise MeshError(rules.UNREADABLE_MESH, f"the mesh {uri!r} cannot be used: {error}") from error
    except OSError as error:
        raise MeshError(rules.UNREADABLE_MESH, f"the mesh {uri!r} cannot be read: {error.strerror}") from error


class Companions(NamedTuple):
    """Contents of files by the names that the mesh has for them, and the names of files that cannot be read."""

    files: dict[str, bytes]
    missing: tuple[str, ...]


def companions_of(path: Path, kind: str, content: bytes, readable: Readable | None = None) -> Companions:
    """Read the files that a mesh file names, of those that are `readable`; by default those that belong to the mesh."""
    readable = readable or Readable.of(path)
    files, missing, left = dict[str, bytes](), list[str](), _MOST_BYTES
    todo = _names_in(kind, content)[:_MOST]
    for name in todo:
        if name in files or name in missing:
            continue
        data = _read_companion(path, name, left, readable) if len(files) < _MOST else None
        if data is None:
            missing.append(name)
            continue
        files[name], left = data, left - len(data)
        if name.lower().endswith(".mtl"):
            todo += _names_in("mtl", data)[:_MOST]
    return Companions(files, tuple(missing))


def _names_in(kind: str, content: bytes) -> list[str]:
    """The names of files in a file of a format."""
    try:
        names = FORMATS[kind].references(content) if kind in _NAMING else []
    except ValueError:
        return []  # the reader will say what is wrong
    return [name for name in names if kind != "dae" or Path(name).suffix.lower() in _IMAGES]


def _read_companion(mesh: Path, name: str, most: int, readable: Readable) -> bytes | None:
    """The content of a file that a mesh names; None where it may not or cannot be read."""
    relative = Path(unquote(name.removeprefix("file://").replace("\\", "/")))
    if relative.is_absolute() or relative.suffix.lower() not in _IMAGES | _OTHERS or "\0" in name:
        return None
    try:
        data = readable.read(mesh.parent / relative, most)
    except OSError:
        return None
    return data if len(data) <= most else None
