"""What a model costs a simulator: mesh files, shapes, sensors; and which passes would make it cheaper.

A confined process counts the triangles of meshes; without the libraries that it needs, only their sizes are known.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import NamedTuple, cast

from twinform.compiler.search.resolve_uris import SearchPath, UriError
from twinform.ir import Collision, Material, Mesh, Model, Plugin, Visual, walk
from twinform.passes.mesh_jobs.job import MeshJob
from twinform.passes.mesh_jobs.mesh_files import EXTRA, READ, RefusedMeshError, content_of, kind_of
from twinform.passes.shared.sensor_costs import sensor_cost, sensors_in


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshCost:
    """A mesh file of a model: how often it is used in visuals and collisions, and the cost of one use.

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
    """The mesh files that a document names, which was read from the file `beside`; each is read once."""

    search: SearchPath
    beside: Path
    look: bool = True
    _known: dict[Path, _MeshFile] = field(default_factory=dict[Path, _MeshFile])

    def costs(self, model: Model) -> tuple[MeshCost, ...]:
        """Return the costs of the mesh files of a model, sorted by URI."""
        drawn, touched = _count_uses(model, Visual), _count_uses(model, Collision)
        return tuple(self._measure(uri, drawn[uri], touched[uri]) for uri in sorted({*drawn, *touched}))

    def _measure(self, uri: str, visuals: int, collisions: int) -> MeshCost:
        found = self._look_up(uri) if self.look else _MeshFile()
        return MeshCost(uri=uri, visuals=visuals, collisions=collisions, **found._asdict())

    def _look_up(self, uri: str) -> _MeshFile:
        try:
            path = self.search.find(uri, self.beside)
        except UriError as error:
            return _MeshFile(problem=error.message)
        if path not in self._known:
            self._known[path] = _read_mesh(path)
        return self._known[path]


def _count_uses(model: Model, kind: type[Visual] | type[Collision]) -> Mapping[str, int]:
    return Counter(_find_meshes(model, kind))


def _find_meshes(model: Model, kind: type[Visual] | type[Collision]) -> Iterator[str]:
    for node in walk(model):
        if isinstance(node, kind) and node.geometry and isinstance(node.geometry.shape, Mesh):
            yield (node.geometry.shape.uri or "").strip()


def _read_mesh(path: Path) -> _MeshFile:
    try:
        size = path.stat().st_size
        if not path.is_file():
            return _MeshFile(problem="it is no file")
        if kind_of(path) not in READ:
            return _MeshFile(size, problem=f"triangles are counted in {', '.join(sorted(READ))}")
        return _count_triangles(path, size)
    except OSError as error:
        return _MeshFile(problem=f"it cannot be read: {error.strerror}")


def _count_triangles(path: Path, size: int) -> _MeshFile:
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


@dataclass(frozen=True, slots=True, kw_only=True)
class CostAdvice:
    """A pipeline that lowers the cost of a category, and why it is worth a try."""

    category: str
    reason: str
    passes: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Cost:
    """Numbers that the time of a simulation depends on.

    `drawn_triangles` and `touched_triangles` are those of meshes in visuals and collisions, as often as they are used;
    `textures` are files. Sensors without an update rate, `rates_assumed`, count as if they worked at 1000 Hz, with
    every step of the physics.
    """

    drawn_triangles: int
    textures: int
    collision_shapes: int
    touched_triangles: int
    pixels_per_second: float
    rays_per_second: float
    rates_assumed: int
    plugins: int
    advice: tuple[CostAdvice, ...] = field(default=())


class _Threshold(NamedTuple):
    category: str
    field: str
    most: float
    unit: str
    passes: str


# Above these a cost is worth a look: rules of thumb, for one robot on one machine in real time.
_ADVICE = (
    _Threshold("collision", "touched_triangles", 1_000, "triangles", "simplify-collisions"),
    _Threshold("rendering", "drawn_triangles", 100_000, "triangles", "decimate-visuals"),
    _Threshold("sensors", "pixels_per_second", 1e7, "pixels a second", "limit-sensors{max-rate=15 max-pixels=307200}"),
    _Threshold("sensors", "rays_per_second", 1e6, "rays a second", "limit-sensors{rays-per-second=1000000}"),
)


def cost_of(model: Model, meshes: Sequence[MeshCost]) -> Cost:
    """Return the cost of a model, with advice on how to lower it."""
    nodes = list(walk(model))
    sensors = [cost for cost in map(sensor_cost, sensors_in(model)) if cost.pixels or cost.rays]
    textures = {
        each for node in nodes if isinstance(node, Material) for each in (node.texture, node.albedo_map) if each
    }
    cost = Cost(
        drawn_triangles=sum(mesh.visuals * (mesh.triangles or 0) for mesh in meshes),
        textures=len(textures),
        collision_shapes=sum(isinstance(node, Collision) for node in nodes),
        touched_triangles=sum(mesh.collisions * (mesh.triangles or 0) for mesh in meshes),
        pixels_per_second=sum(each.pixels_per_second for each in sensors),
        rays_per_second=sum(each.rays_per_second for each in sensors),
        rates_assumed=sum(each.assumed for each in sensors),
        plugins=sum(isinstance(node, Plugin) for node in nodes),
    )
    return replace(cost, advice=tuple(_advise(cost)))


def _advise(cost: Cost) -> Iterator[CostAdvice]:
    for row in _ADVICE:
        number: float = getattr(cost, row.field)
        if number > row.most:
            yield CostAdvice(category=row.category, reason=f"{number:,.0f} {row.unit}", passes=row.passes)
