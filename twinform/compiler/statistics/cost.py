"""What a model costs a simulator, by category, and which passes would make it cheaper."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from twinform.compiler.statistics.mesh_costs import MeshCost
from twinform.ir import Collision, Material, Model, Plugin, walk
from twinform.passes.analyses.sensor_costs import sensor_cost, sensors_in


@dataclass(frozen=True, slots=True, kw_only=True)
class CostAdvice:
    """A pipeline that lowers the cost of a category, and why it is worth a try."""

    category: str
    reason: str
    passes: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Cost:
    """Numbers that the time of a simulation grows with.

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
    """What a model costs, with what there is to do about it."""
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
    return replace(cost, advice=tuple(_advice(cost)))


def _advice(cost: Cost) -> Iterator[CostAdvice]:
    for row in _ADVICE:
        number: float = getattr(cost, row.field)
        if number > row.most:
            yield CostAdvice(category=row.category, reason=f"{number:,.0f} {row.unit}", passes=row.passes)
