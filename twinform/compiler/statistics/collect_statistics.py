"""Collects the statistics of each model of a file."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from twinform.compiler.input.loading import LoadResult
from twinform.compiler.search.resolve_uris import LocalAssets, SearchPath
from twinform.compiler.statistics.mesh_costs import MeshFiles
from twinform.compiler.statistics.model import ModelStatistics, model_statistics
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Format, Link, Model, walk
from twinform.passes import NO_ASSETS, Assets, Pipeline


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
    whole = _summary(document, LocalAssets(search, beside) if meshes else NO_ASSETS)
    files = MeshFiles(search, beside, meshes)

    def counted(models: Iterable[Model]) -> tuple[ModelStatistics, ...]:
        return tuple(model_statistics(model, document.format, files.costs(model)) for model in models)

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
        format=document.format,
        version=document.version,
        worlds=worlds,
        models=counted(whole.models),
    )


def _summary(document: Document, assets: Assets) -> Document:
    """The document with what its `<gazebo>` elements have and what its readers compute in their places."""
    sink = DiagnosticSink()
    if document.format is Format.URDF:
        from twinform.passes.legalise.to_sdf.fold_gazebo import FoldGazebo  # noqa: PLC0415 - SDF does not need it

        return Pipeline((FoldGazebo(),)).run(document, sink)
    if not any(isinstance(node, Link) and node.inertial and node.inertial.auto for node in walk(document)):
        return document
    from twinform.passes.sdf_versions.write_inertias import WriteInertias  # noqa: PLC0415 - few files have these

    return Pipeline((WriteInertias(version="1.10"),)).with_files(assets).run(document, sink)
