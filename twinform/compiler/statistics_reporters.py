"""Reports statistics as text and as JSON."""

import json as jsonlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict

from twinform.compiler.statistics import Cost, FileStatistics, MeshCost, ModelStatistics, WorldStatistics
from twinform.diagnostics.wording import plural

_WIDTH = 12


def json(files: Sequence[FileStatistics]) -> str:
    """`{"files": [{"path", "format", "version", "worlds": [{"name", "models", ...}], "models": [...]}]}`."""
    return jsonlib.dumps({"files": [asdict(each) for each in files]}, indent=2) + "\n"


def text(files: Sequence[FileStatistics]) -> str:
    """Return a block of text for each model, below the heading of its file and world."""
    return "\n".join(line for each in files for line in _write_file(each)) + "\n"


REPORTERS: Mapping[str, Callable[[Sequence[FileStatistics]], str]] = {"text": text, "json": json}


def _write_file(found: FileStatistics) -> Iterator[str]:
    yield f"{found.path}: {found.format}{f' {found.version}' if found.version else ''}"
    for world in found.worlds:
        yield from _write_world(world)
    for model in found.models:
        yield from _write_model(model)


def _write_world(world: WorldStatistics) -> Iterator[str]:
    parts = [
        plural(len(world.models), "model"),
        plural(len(world.plugins), "plugin"),
        plural(world.lights, "light"),
    ]
    parts += [plural(world.joints, "joint")] * bool(world.joints)
    parts += [f"{plural(world.includes, 'include')} that were not read"] * bool(world.includes)
    yield f"world {world.name!r}: {', '.join(parts)}"
    for model in world.models:
        yield from _write_model(model)


def _write_model(model: ModelStatistics) -> Iterator[str]:
    yield f"model {model.name!r}{' (static)' if model.static else ''}"
    for name, words in _list_rows(model):
        if words:
            yield f"  {name:<{_WIDTH}}{words}"


def _list_rows(model: ModelStatistics) -> Iterator[tuple[str, str]]:
    yield "links", f"{model.links}, at most {plural(model.depth, 'joint')} from a root"
    yield "joints", _write_kinds(model.joints)
    yield "freedoms", _write_freedoms(model) if model.joints else ""
    yield "mass", _write_mass(model)
    yield "visuals", _write_kinds(model.visuals)
    yield "collisions", _write_kinds(model.collisions)
    if model.meshes:
        yield "meshes", _sum_meshes(model.meshes)
    for mesh in model.meshes:
        yield "", _write_mesh(mesh)
    yield "sensors", _write_kinds(model.sensors)
    yield "plugins", _write_kinds(model.plugins)
    for name in ("lights", "frames", "models", "includes"):
        number: int = getattr(model, name)
        yield name, str(number) if number else ""
    yield from _list_costs(model.cost)


def _list_costs(cost: Cost) -> Iterator[tuple[str, str]]:
    """Yield the costs that no other row has, and how to lower them."""
    words = [f"{cost.pixels_per_second:,.0f} pixels a second"] * bool(cost.pixels_per_second)
    words += [f"{cost.rays_per_second:,.0f} rays a second"] * bool(cost.rays_per_second)
    words += [f"{plural(cost.rates_assumed, 'sensor')} without an update rate at 1000 Hz"] * bool(cost.rates_assumed)
    yield "sensing", ", ".join(words)
    yield "textures", plural(cost.textures, "file") if cost.textures else ""
    for each in cost.advice:
        yield "cheaper", f"{each.category}, {each.reason}: --passes '{each.passes}'"


def _write_freedoms(model: ModelStatistics) -> str:
    closed = f", less what {plural(model.loops, 'closed loop')} take away" if model.loops else ""
    return f"{model.dof}{closed}"


def _write_mass(model: ModelStatistics) -> str:
    words = [f"{model.mass:.6g} kg"]
    words += [f"of it 1 kg each for {plural(model.masses_assumed, 'link')} that say none"] * bool(model.masses_assumed)
    words += [f"without {plural(model.masses_unknown, 'link')} of unknown mass"] * bool(model.masses_unknown)
    return ", ".join(words)


def _write_kinds(counts: Mapping[str, int]) -> str:
    if not counts:
        return ""
    return f"{sum(counts.values())}: {', '.join(f'{count} {kind}' for kind, count in counts.items())}"


def _sum_meshes(meshes: Sequence[MeshCost]) -> str:
    size = sum(mesh.bytes or 0 for mesh in meshes)
    drawn = sum(mesh.visuals * (mesh.triangles or 0) for mesh in meshes)
    touched = sum(mesh.collisions * (mesh.triangles or 0) for mesh in meshes)
    unknown = sum(mesh.triangles is None for mesh in meshes)
    words = f"{plural(len(meshes), 'file')}, {_write_size(size)}, {drawn} triangles drawn, {touched} for contact"
    return f"{words}, {unknown} not counted" if unknown else words


def _write_mesh(mesh: MeshCost) -> str:
    words = [_write_size(mesh.bytes)] if mesh.bytes is not None else []
    words += [plural(mesh.triangles, "triangle")] if mesh.triangles is not None else []
    uses = zip((mesh.visuals, mesh.collisions), ("visual", "collision"), strict=True)
    words += [plural(number, word) for number, word in uses if number]
    return f"{mesh.uri}: {', '.join(words)}{f' ({mesh.problem})' if mesh.problem else ''}"


def _write_size(count: int) -> str:
    """Return a number of bytes in units of powers of 1000."""
    size, units = float(count), ["B", "kB", "MB", "GB"]
    while size >= 1000 and len(units) > 1:
        size, units = size / 1000, units[1:]
    return f"{size:.3g} {units[0]}"
