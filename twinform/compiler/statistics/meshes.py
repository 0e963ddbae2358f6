"""The cost of meshes: the bytes of their files, and the triangles that have to be drawn or to be tested for contact.

`trimesh` counts the triangles; without it, only the bytes are known.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.search.uris import SearchPath, UriError
from twinform.ir import Collision, Mesh, Model, Visual, walk
from twinform.passes.analyses.mesh_files import EXTRA, READ, READERS, RefusedMeshError, kind_of, open_scene


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


class _File(NamedTuple):
    bytes: int | None = None
    triangles: int | None = None
    problem: str = ""


@dataclass(slots=True)
class MeshFiles:
    """The mesh files that the document in the file `beside` names; each is read once."""

    search: SearchPath
    beside: Path
    look: bool = True
    _known: dict[Path, _File] = field(default_factory=dict[Path, _File])

    def costs(self, model: Model) -> tuple[MeshCost, ...]:
        """The mesh files of a model, in the order of their URIs."""
        drawn, touched = _uses(model, Visual), _uses(model, Collision)
        return tuple(self._cost(uri, drawn[uri], touched[uri]) for uri in sorted({*drawn, *touched}))

    def _cost(self, uri: str, visuals: int, collisions: int) -> MeshCost:
        found = self._file(uri) if self.look else _File()
        return MeshCost(uri=uri, visuals=visuals, collisions=collisions, **found._asdict())

    def _file(self, uri: str) -> _File:
        try:
            path = self.search.find(uri, self.beside)
        except UriError as error:
            return _File(problem=error.message)
        if path not in self._known:
            self._known[path] = _looked_at(path)
        return self._known[path]


def _uses(model: Model, kind: type[Visual] | type[Collision]) -> Mapping[str, int]:
    return Counter(_meshes(model, kind))


def _meshes(model: Model, kind: type[Visual] | type[Collision]) -> Iterator[str]:
    for node in walk(model):
        if isinstance(node, kind) and node.geometry and isinstance(node.geometry.shape, Mesh):
            yield (node.geometry.shape.uri or "").strip()


def _looked_at(path: Path) -> _File:
    try:
        size = path.stat().st_size
        if not path.is_file():
            return _File(problem="it is no file")
        if kind_of(path) not in READ:
            return _File(size, problem=f"triangles are counted in {', '.join(sorted(READ))}")
        return _counted(path, size)
    except OSError as error:
        return _File(problem=f"it cannot be read: {error.strerror}")


def _counted(path: Path, size: int) -> _File:
    try:
        triangles = _triangles(path)
    except OSError:
        raise
    except RefusedMeshError as error:
        return _File(size, problem=str(error))
    except Exception as error:  # noqa: BLE001 - readers of six formats raise whatever they like
        if isinstance(error, ImportError) and error.name in READERS:
            return _File(size, problem=f"{error.name} is not installed: {EXTRA}")
        return _File(size, problem=f"it cannot be read: {str(error) or type(error).__name__}")
    return _File(size, triangles, "" if triangles else "it has no triangles")


def _triangles(path: Path) -> int:
    """All triangles of a file, those of a part as often as the file places it."""
    scene = open_scene(path, process=False)
    placed = (scene.graph[node][1] for node in scene.graph.nodes_geometry)
    return sum(len(getattr(scene.geometry[name], "faces", ())) for name in placed)
