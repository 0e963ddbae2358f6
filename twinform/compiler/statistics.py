"""Statistics of models: counts, sizes, masses, and what a model costs a simulator, with passes that make it cheaper.

A confined process counts the triangles of meshes; without the libraries that it needs, only their sizes are known.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import NamedTuple, cast

from twinform.compiler.input.loading import LoadResult
from twinform.compiler.resolve_uris import LocalAssets, SearchPath, UriError
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.ir import (
    Collision,
    Document,
    Format,
    Frame,
    Include,
    Joint,
    Light,
    Link,
    Material,
    Mesh,
    Model,
    Plugin,
    Sensor,
    Visual,
    walk,
)
from twinform.ir.defaults import MASS
from twinform.ir.frames import WORLD, FrameError, FrameGraph
from twinform.ir.groups import Groups
from twinform.ir.scopes import scoped_models
from twinform.passes import NO_ASSETS, Assets, Pipeline
from twinform.passes.mesh_jobs.job import MeshJob
from twinform.passes.mesh_jobs.mesh_files import READ, RefusedMeshError, content_of, install_readers, kind_of
from twinform.passes.meshes.limit_sensors import sensor_cost, sensors_in


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
        return _MeshFile(size, problem=f"{result.message} is not installed; run: {install_readers()}")
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


_FREEDOMS = {
    "fixed": 0, "revolute": 1, "continuous": 1, "prismatic": 1, "screw": 1, "universal": 2, "revolute2": 2,
    "piston": 2, "planar": 3, "ball": 3, "spherical": 3, "floating": 6, "gearbox": -1,
}  # fmt: skip
"""Degrees of freedom by type of joint; a gearbox takes one away from the joints that it couples."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelStatistics:
    """What a model and those nested in it are made of.

    `dof` are the ways in which its joints move by themselves: those that mimic others do not count, nor does a base
    that floats; each of the `loops` takes away as many as its geometry does. `depth` is the most joints between a
    root and a link. `mass` is in kg; in it are `masses_assumed`, links of SDF without one, which weigh 1 kg, and not in
    it `masses_unknown`, links whose mass is to be computed from shapes that nothing can be computed from. Shapes,
    sensors and plugins are counted by kind, type and file name.
    """

    name: str
    static: bool
    links: int
    joints: dict[str, int]
    dof: int
    loops: int
    depth: int
    mass: float
    masses_assumed: int
    masses_unknown: int
    visuals: dict[str, int]
    collisions: dict[str, int]
    meshes: tuple[MeshCost, ...]
    sensors: dict[str, int]
    plugins: dict[str, int]
    lights: int
    frames: int
    models: int
    includes: int
    cost: Cost


def _measure_model(model: Model, usual: float | None, meshes: tuple[MeshCost, ...]) -> ModelStatistics:
    """Count what a model is made of; automatic inertias were computed before, where that is possible.

    `usual` is the mass of a link without one.
    """
    nodes = list(walk(model))
    links = [node for node in nodes if isinstance(node, Link)]
    joints = [node for node in nodes if isinstance(node, Joint)]
    depth, loops = _measure_tree(model)
    masses = [_mass(link) for link in links]
    unknown = sum(link.inertial is not None and bool(link.inertial.auto) and _mass(link) is None for link in links)
    assumed = sum(mass is None for mass in masses) - unknown
    return ModelStatistics(
        name=model.name,
        static=bool(model.static),
        links=len(links),
        joints=_count_by_name(joint.type for joint in joints),
        dof=sum(map(_count_freedom, joints)),
        loops=loops,
        depth=depth,
        mass=sum(mass for mass in masses if mass is not None) + assumed * (usual or 0.0),
        masses_assumed=assumed if usual else 0,
        masses_unknown=unknown,
        visuals=_count_by_name(_kind(node) for node in nodes if isinstance(node, Visual)),
        collisions=_count_by_name(_kind(node) for node in nodes if isinstance(node, Collision)),
        meshes=meshes,
        sensors=_count_by_name(node.type or "without type" for node in nodes if isinstance(node, Sensor)),
        plugins=_count_by_name(node.filename or "without file" for node in nodes if isinstance(node, Plugin)),
        lights=sum(isinstance(node, Light) for node in nodes),
        frames=sum(isinstance(node, Frame) for node in nodes),
        models=sum(isinstance(node, Model) for node in nodes) - 1,
        includes=sum(isinstance(node, Include) for node in nodes),
        cost=cost_of(model, meshes),
    )


def _mass(link: Link) -> float | None:
    return link.inertial.mass if link.inertial else None


def _kind(shaped: Visual | Collision) -> str:
    return shaped.geometry.shape.kind if shaped.geometry and shaped.geometry.shape else "without shape"


def _count_by_name(words: Iterable[str]) -> dict[str, int]:
    """Return how often each word occurs, sorted by word."""
    return dict(sorted(Counter(words).items()))


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldStatistics:
    """The models of a world; `includes` are those that were not read."""

    name: str
    models: tuple[ModelStatistics, ...]
    plugins: tuple[str, ...]
    lights: int
    joints: int
    includes: int


@dataclass(frozen=True, slots=True, kw_only=True)
class FileStatistics:
    """The worlds of a file, and the models outside of them."""

    path: str
    format: Format
    version: str | None
    worlds: tuple[WorldStatistics, ...]
    models: tuple[ModelStatistics, ...]


def measure(loaded: LoadResult, document: Document, search: SearchPath, *, meshes: bool = True) -> FileStatistics:
    """Count what a file holds. `meshes` selects whether to read mesh files, which `search` finds."""
    beside = Path(loaded.path)
    whole = _complete(document, LocalAssets(search, beside) if meshes else NO_ASSETS)
    files = MeshFiles(search, beside, meshes)
    # In MJCF a body without mass is fixed, and weighs nothing.
    usual = None if loaded.is_mjcf else MASS[document.format]

    def counted(models: Iterable[Model]) -> tuple[ModelStatistics, ...]:
        return tuple(_measure_model(model, usual, files.costs(model)) for model in models)

    worlds = tuple(
        WorldStatistics(
            name=world.name,
            models=counted(world.models),
            plugins=tuple(plugin.filename or "" for plugin in world.plugins),
            lights=len(world.lights),
            joints=len(world.joints),
            includes=len(world.includes),
        )
        for world in whole.worlds
    )
    return FileStatistics(
        path=loaded.path,
        format=loaded.format or document.format,
        version=None if loaded.is_mjcf else document.version,
        worlds=worlds,
        models=counted(whole.models),
    )


def _complete(document: Document, assets: Assets) -> Document:
    """Return the document with the content of `<gazebo>` elements, and with inertias that are computed from shapes."""
    sink = DiagnosticSink()
    if document.format is Format.URDF:
        from twinform.passes.legalise.to_sdf.fold_gazebo import FoldGazebo  # noqa: PLC0415 - SDF does not need it

        return Pipeline((FoldGazebo.unchecked(),)).run(document, sink)
    if not any(isinstance(node, Link) and node.inertial and node.inertial.auto for node in walk(document)):
        return document
    from twinform.passes.sdf_versions.write_inertias import WriteInertias  # noqa: PLC0415 - few files have these

    return Pipeline((WriteInertias.unchecked(version="1.10"),)).with_files(assets).run(document, sink)


def _count_freedom(joint: Joint) -> int:
    """Return in how many ways a joint moves by itself: an axis that mimics another joint does not."""
    followed = sum(axis is not None and axis.mimic is not None for axis in (joint.axis, joint.axis2))
    return max(0, _FREEDOMS[joint.type] - followed)


def _measure_tree(model: Model) -> tuple[int, int]:
    """Return the most joints between a root and a link, and how many joints close loops."""
    parents: dict[str, str] = {}
    groups, loops = Groups(), 0
    for parent, child in _find_ends(model):
        if groups.join(parent, child):
            parents.setdefault(child, parent)
        else:
            loops += 1
    return _find_depth(parents), loops


def _find_ends(model: Model) -> Iterator[tuple[str, str]]:
    """Yield the links that each joint connects; a gearbox connects none."""
    graph = FrameGraph(model)
    for scope, inner in scoped_models(model):
        for joint in inner.joints:
            if joint.parent and joint.child and joint.type != "gearbox":
                yield _find_link(joint.parent, scope, graph), _find_link(joint.child, scope, graph)


def _find_link(name: str, scope: str, graph: FrameGraph) -> str:
    """Return the link at the end of a joint; the name as written if it is in an include that was not read."""
    if name == WORLD:
        return name
    try:
        return graph.body(scope + name)
    except FrameError:
        return scope + name


def _find_depth(parents: dict[str, str]) -> int:
    depths: dict[str, int] = {}
    for start in parents:
        path: list[str] = []
        link = start
        while link in parents and link not in depths:
            path.append(link)
            link = parents[link]
        for below in reversed(path):
            depths[below] = depths.get(parents[below], 0) + 1
    return max(depths.values(), default=0)
