"""The base class of passes that make mesh files, and what they share: jobs, names of files, and what is reported."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import PurePosixPath
from typing import Literal, NamedTuple, Self

from pydantic import Field, field_validator

from twinform.diagnostics import DiagnosticSink, Location, SideFile, rules
from twinform.ir import Mesh
from twinform.passes.analyses.mesh_solids import MeshError, submesh_of
from twinform.passes.framework.assets import AssetPass
from twinform.passes.framework.side_files import CompanionPath, FilesPass
from twinform.passes.mesh_jobs.child_process import do
from twinform.passes.mesh_jobs.formats import MARK
from twinform.passes.mesh_jobs.job import MeshJob, MeshResult, Options
from twinform.passes.mesh_jobs.mesh_files import EXTRA
from twinform.passes.meshes.mesh_source import MeshSource, MeshSources
from twinform.passes.meshes.progress import working_on
from twinform.passes.meshes.results_cache import ResultsCache

_UNUSUAL = re.compile(r"[^\w.-]+")
_UNMARKED = (".png", ".jpg", ".jpeg", ".bin")


class MeshOutcome(NamedTuple):
    """What came of a mesh, and the file that it was made of."""

    result: MeshResult
    source: MeshSource
    stem: str


@dataclass(slots=True)
class Workbench:
    """One run of a pass on a document: it knows its meshes, does jobs on them, and names what they make."""

    sink: DiagnosticSink
    sources: MeshSources
    folder: str
    prefix: str
    cache: ResultsCache = field(default_factory=ResultsCache.usual)
    _stems: dict[str, str] = field(default_factory=dict[str, str])
    """Digests of jobs by what their files are called, in lower case."""

    def outcome(self, name: str, mesh: Mesh, options: Options) -> MeshOutcome:
        """What comes of the mesh of a shape.

        Raises:
            MeshError: it is not found, or cannot be read, or a library is not installed.
        """
        uri = (mesh.uri or "").strip()
        source = self.sources.find(uri)
        submesh, center = submesh_of(mesh)
        job = MeshJob(
            name, {**options, "submesh": submesh, "center": center}, source.kind, source.content, source.companions
        )
        stem = self._stem(job, source.stem if submesh is None else f"{source.stem}_{submesh}")
        job = replace(job, options={**job.options, "stem": stem})
        result = self.cache.get(job)
        if result is None:
            with working_on(uri):
                result = do(job)
            self.cache.put(job, result)
        if result.trouble == "missing":
            message = f"the mesh {uri!r} is not looked into: {result.message} is not installed"
            raise MeshError(rules.MESH_READER_MISSING, message, EXTRA)
        if result.trouble:
            raise MeshError(rules.UNREADABLE_MESH, f"the mesh {uri!r} cannot be used: {result.message}")
        return MeshOutcome(result, source, stem)

    def _stem(self, job: MeshJob, words: str) -> str:
        """What files made of a mesh are called, before what tells them apart; those of another mesh, otherwise."""
        # `NAME_hull.obj` can be read and reviewed; a digest in the name cannot.
        usual = _UNUSUAL.sub("_", words).lstrip("._") or "mesh"
        own, stem, count = job.digest({}), usual, 1
        while self._stems.setdefault(stem.casefold(), own) != own:
            count += 1
            stem = f"{usual}_{count}"
        return stem

    def add(self, stem: str, files: Mapping[str, bytes]) -> str:
        """Put files beside the result, by what follows the stem in their names; gives the URI of the first one.

        Raises:
            MeshError: a pass before this one has made another file of the name.
        """
        placed = {str(PurePosixPath(self.folder, stem + suffix)): data for suffix, data in files.items()}
        known = {each.path.casefold(): each.data for each in self.sink.side_files}
        for path, data in placed.items():
            if known.get(path.casefold(), data) != data:
                raise MeshError(rules.KEPT_MESH, f"a pass has made another file {path!r}", "give one of them a folder")
        for path, data in placed.items():
            if path.casefold() not in known:
                # Images have no place for a mark: of these, only a file with the same bytes is
                # written over.
                mark = None if path.lower().endswith(_UNMARKED) else MARK.encode()
                self.sink.side_files.append(SideFile(path, data, mark))
        return self.uri(next(iter(placed)))

    def uri(self, path: str) -> str:
        """How the document names a file that is made."""
        return f"{self.prefix.rstrip('/')}/{path}" if self.prefix else path


class MeshPass(AssetPass, FilesPass):
    """A pass that makes mesh files, which lie below the folder of the result and are named there by relative paths."""

    folder: CompanionPath = Field(
        default="meshes", description="Where files are written, below the folder of the result."
    )
    prefix: str = Field(
        default="", description="What their URIs begin with, such as package://arm; else they are relative paths."
    )
    gltf_up: Literal["z", "y"] = Field(
        default="z", description="Which axis of a glTF file is up: `z` as in Gazebo, `y` as in RViz and Drake."
    )

    @field_validator("prefix")
    @classmethod
    def _check_prefix(cls, prefix: str) -> str:
        if prefix and not re.fullmatch(r"(package|model)://[^/\s]+(/[^\s]*)?", prefix):
            raise ValueError("takes package://NAME or model://NAME")
        return prefix

    @property
    def place(self) -> str:
        """The folder of its files."""
        return self.folder

    def below(self, folder: str) -> Self:
        """Return the pass with its files in a folder of this name inside its own folder."""
        return self.model_copy(update={"folder": f"{self.folder}/{_UNUSUAL.sub('_', folder).lstrip('._') or 'model'}"})

    @property
    def read_options(self) -> Options:
        """How the files are to be read."""
        return {"gltf_up": self.gltf_up}

    def workbench(self, sink: DiagnosticSink) -> Workbench:
        """What a run on a document needs."""
        return Workbench(sink, MeshSources(self._assets, sink, self.prefix), self.folder, self.prefix)


def stays(sink: DiagnosticSink, error: MeshError, what: str, location: Location) -> None:
    """Say that a shape keeps its mesh, and why."""
    sink.report(error.rule, f"{what} stays as it is: {error.message}", location, help=error.help)


def length(meters: float) -> str:
    """A length for people; less than a nanometer is rounding, and differs from machine to machine."""
    return f"{max(1000 * meters, 1e-6):.3g} mm" if meters < 1 else f"{meters:.3g} m"


def number(value: object) -> float:
    """A number among the facts of a result."""
    return float(value) if isinstance(value, int | float) else 0.0
