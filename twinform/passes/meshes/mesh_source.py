"""The mesh files that the shapes of a document name, also those that an earlier pass has made."""

import re
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import NamedTuple

from twinform.diagnostics import HEAD, DiagnosticSink, rules
from twinform.passes.analyses.mesh_solids import MeshError
from twinform.passes.framework.asset_access import AssetError, Assets
from twinform.passes.mesh_jobs.formats import MARK
from twinform.passes.mesh_jobs.mesh_files import READ, RefusedMeshError, content_of, kind_of
from twinform.passes.meshes.companions import companions_of

KINDS = frozenset({*READ, "gltf"})


class MeshSource(NamedTuple):
    """A mesh file: what it is called without its suffix, its format, and what it names itself."""

    stem: str
    kind: str
    content: bytes
    companions: dict[str, bytes]
    missing: tuple[str, ...] = ()

    def is_made(self, ending: re.Pattern[str]) -> bool:
        """Whether a pass has made it and named it so: it would lose more with each run."""
        return bool(ending.search(self.stem)) and MARK.encode() in self.content[:HEAD]


@dataclass(frozen=True, slots=True)
class MeshSources:
    """The mesh files of a document, each read once; `prefix` is what URIs of made files begin with."""

    assets: Assets
    sink: DiagnosticSink
    prefix: str = ""
    _known: dict[str, MeshSource] = field(default_factory=dict[str, MeshSource])

    def find(self, uri: str) -> MeshSource:
        """The file of a URI.

        Raises:
            MeshError: it is not there, or is nothing that can be read.
        """
        if uri not in self._known:
            self._known[uri] = self._find_made(uri) or self._on_disk(uri)
        return self._known[uri]

    def _find_made(self, uri: str) -> MeshSource | None:
        """A file that a pass before this one has made, and nobody has written yet."""
        made = {each.path: each.data for each in self.sink.side_files}
        path = next((path for path in made if uri == path or uri.endswith(f"/{path}")), None)
        if path is None:
            return None
        beside = PurePosixPath(path).parent
        near = {PurePosixPath(each): data for each, data in made.items() if PurePosixPath(each).is_relative_to(beside)}
        others = {str(each.relative_to(beside)): data for each, data in near.items() if str(each) != path}
        return MeshSource(PurePosixPath(path).stem, kind_of(Path(path)), made[path], others)

    def _on_disk(self, uri: str) -> MeshSource:
        try:
            path = self.assets.find(uri)
        except AssetError as error:
            raise MeshError(rules.KEPT_MESH, error.message, error.help) from error
        kind = kind_of(path)
        if kind not in KINDS:
            message = f"the mesh {uri!r} is in no format that is read here: {', '.join(sorted(KINDS))}"
            raise MeshError(rules.UNREADABLE_MESH, message)
        content = _content(path, uri)
        companions, missing = companions_of(path, kind, content, self.assets.readable)
        return MeshSource(path.stem, kind, content, companions, missing)


def _content(path: Path, uri: str) -> bytes:
    """The bytes of a file.

    Raises:
        MeshError: it cannot be read, or is too large.
    """
    try:
        return content_of(path)
    except RefusedMeshError as error:
        raise MeshError(rules.UNREADABLE_MESH, f"the mesh {uri!r} cannot be used: {error}") from error
    except OSError as error:
        raise MeshError(rules.UNREADABLE_MESH, f"the mesh {uri!r} cannot be read: {error.strerror}") from error
