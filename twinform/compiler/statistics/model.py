"""The statistics of one model."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from twinform.compiler.statistics.cost import Cost, cost_of
from twinform.compiler.statistics.mesh_costs import MeshCost
from twinform.compiler.statistics.tree_counts import freedom, joints_of, shape
from twinform.ir import Collision, Format, Frame, Include, Light, Link, Model, Plugin, Sensor, Visual, walk
from twinform.ir.defaults import MASS


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


def model_statistics(model: Model, format_: Format, meshes: tuple[MeshCost, ...]) -> ModelStatistics:
    """Count what a model is made of; its automatic inertias have been written out where that can be done."""
    nodes = list(walk(model))
    links = [node for node in nodes if isinstance(node, Link)]
    joints, form = list(joints_of(model)), shape(model)
    masses = [_mass(link) for link in links]
    unknown = sum(link.inertial is not None and bool(link.inertial.auto) and _mass(link) is None for link in links)
    assumed = sum(mass is None for mass in masses) - unknown
    return ModelStatistics(
        name=model.name,
        static=bool(model.static),
        links=len(links),
        joints=_sorted(joint.type for joint in joints),
        dof=sum(map(freedom, joints)),
        loops=form.loops,
        depth=form.depth,
        mass=sum(mass for mass in masses if mass is not None) + assumed * (MASS[format_] or 0.0),
        masses_assumed=assumed if MASS[format_] else 0,
        masses_unknown=unknown,
        visuals=_sorted(_kind(node) for node in nodes if isinstance(node, Visual)),
        collisions=_sorted(_kind(node) for node in nodes if isinstance(node, Collision)),
        meshes=meshes,
        sensors=_sorted(node.type or "without type" for node in nodes if isinstance(node, Sensor)),
        plugins=_sorted(node.filename or "without file" for node in nodes if isinstance(node, Plugin)),
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


def _sorted(words: Iterable[str]) -> dict[str, int]:
    """How often each name is there, by name."""
    return dict(sorted(Counter(words).items()))
