"""The cost of meshes: the bytes of their files, and the triangles that have to be drawn or to be tested for contact.

The confined process for meshes counts the triangles; without the libraries that it needs, only the bytes are known.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple, cast

from twinform.compiler.search.resolve_uris import SearchPath, UriError
from twinform.ir import Collision, Mesh, Model, Visual, walk
from twinform.passes.mesh_jobs.job import MeshJob
from twinform.passes.mesh_jobs.mesh_files import EXTRA, READ, RefusedMeshError, content_of, kind_of


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshCost:
    """One mesh file of a model: how often it is drawn and how often it touches, and what one of it costs.

    `bytes` and `triangles` are None where they are not known; `problem` is the reason.
    """

    uri: str
    visuals: int = 0
    collisions: int = 0
    bytes: int | None = None
    triangles: int | None = None
    problem: str = ""


class _MeshFile(NamedTuple):
    bytes: int | None = None
    triangles: int | None = None
    problem: str = ""


@dataclass(slots=True)
class MeshFiles:
    """The mesh files that the document in the file `beside` names; each is read once."""

    search: SearchPath
    beside: Path
    look: bool = True
    _known: dict[Path, _MeshFile] = field(default_factory=dict[Path, _MeshFile])

    def costs(self, model: Model) -> tuple[MeshCost, ...]:
        """The mesh files of a model, in the order of their URIs."""
        drawn, touched = _uses(model, Visual), _uses(model, Collision)
        return tuple(self._cost(uri, drawn[uri], touched[uri]) for uri in sorted({*drawn, *touched}))

    def _cost(self, uri: str, visuals: int, collisions: int) -> MeshCost:
        found = self._file(uri) if self.look else _MeshFile()
        return MeshCost(uri=uri, visuals=visuals, collisions=collisions, **found._asdict())

    def _file(self, uri: str) -> _MeshFile:
        try:
            path = self.search.find(uri, self.beside)
        except UriError as error:
            return _MeshFile(problem=error.message)
        if path not in self._known:
            self._known[path] = _looked_at(path)
        return self._known[path]


def _uses(model: Model, kind: type[Visual] | type[Collision]) -> Mapping[str, int]:
    return Counter(_meshes(model, kind))


def _meshes(model: Model, kind: type[Visual] | type[Collision]) -> Iterator[str]:
    for node in walk(model):
        if isinstance(node, kind) and node.geometry and isinstance(node.geometry.shape, Mesh):
            yield (node.geometry.shape.uri or "").strip()


def _looked_at(path: Path) -> _MeshFile:
    try:
        size = path.stat().st_size
        if not path.is_file():
            return _MeshFile(problem="it is no file")
        if kind_of(path) not in READ:
            return _MeshFile(size, problem=f"triangles are counted in {', '.join(sorted(READ))}")
        return _counted(path, size)
    except OSError as error:
        return _MeshFile(problem=f"it cannot be read: {error.strerror}")


def _counted(path: Path, size: int) -> _MeshFile:
    from twinform.passes.mesh_jobs.child_process import do  # noqa: PLC0415 - most models have no meshes to read

    try:
        result = do(MeshJob("count", {}, kind_of(path), content_of(path)))
    except RefusedMeshError as error:
        return _MeshFile(size, problem=str(error))
    if result.trouble == "missing":
        return _MeshFile(size, problem=f"{result.message} is not installed: {EXTRA}")
    if result.trouble:
        return _MeshFile(size, problem=result.message)
    triangles = cast("int", result.facts["triangles"])
    return _MeshFile(size, triangles, "" if triangles else "it has no triangles")
