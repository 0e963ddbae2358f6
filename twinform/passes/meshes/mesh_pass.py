"""The base class of passes that make mesh files, and what they share: jobs, a cache of results, names, and reports.

The cache is `$XDG_CACHE_HOME/twinform/meshes`, or the folder that `TWINFORM_MESH_CACHE` names; `off` there disables it.
A result appears all at once, under a name that is the digest of everything that it depends on, so several processes may
use the folder at a time.
"""

import hashlib
import io
import os
from collections.abc import Callable, Generator, Mapping
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from dataclasses import field, replace
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path, PurePosixPath
from typing import Literal, NamedTuple, Self

from pydantic import Field, field_validator

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, SideFile, rules
from twinform.ir import Mesh
from twinform.lazy import lazy_pattern
from twinform.passes.framework.pass_base import AssetPass, FilesPass
from twinform.passes.framework.side_files import CompanionPath
from twinform.passes.mesh_jobs.child_process import do
from twinform.passes.mesh_jobs.job import BadMessageError, MeshJob, MeshResult, Options
from twinform.passes.mesh_jobs.mesh_files import MARK
from twinform.passes.meshes.mesh_source import MeshSource, MeshSources
from twinform.passes.shared.mesh_solids import MeshError, require_result, submesh_of
from twinform.request_options import known_prefix
from twinform.storage.user_cache import prune, user_cache
from twinform.storage.writing import write_atomically

VARIABLE = "TWINFORM_MESH_CACHE"
_LIBRARIES = ("twinform", "coacd", "fast-simplification", "numpy", "pycollada", "scipy", "trimesh")
_MOST = 2**30
"""Bytes that are kept; beyond them, the results that were used longest ago are deleted."""
_DIGEST = hashlib.sha256().digest_size
FORMAT = "3"
"""Is raised when a job makes something else although no version of a library changed."""


@dataclass(frozen=True, slots=True)
class ResultsCache:
    """Results in a folder; nothing is kept if it is None."""

    folder: Path | None

    @classmethod
    def usual(cls) -> Self:
        """The cache of the user."""
        chosen = os.environ.get(VARIABLE, "")
        return cls(None if chosen == "off" else Path(chosen) if chosen else user_cache("meshes"))

    def get(self, job: MeshJob) -> MeshResult | None:
        """The result of a job that was done before; None where there is none, or where it is damaged."""
        path = self._path(job)
        if path is None:
            return None
        with suppress(OSError, BadMessageError, ValueError, KeyError):
            data = path.read_bytes()
            if hashlib.sha256(data[_DIGEST:]).digest() == data[:_DIGEST]:
                os.utime(path)
                return MeshResult.read(io.BytesIO(data[_DIGEST:]))
        return None

    def put(self, job: MeshJob, result: MeshResult) -> None:
        """Keep a result; a folder that cannot be written to is no reason to fail."""
        path = self._path(job)
        if path is None or result.trouble:
            return
        data = result.to_bytes()
        with suppress(OSError):
            write_atomically(path, hashlib.sha256(data).digest() + data, durably=False)  # half a result has no digest
            prune(path.parent, _MOST)

    def _path(self, job: MeshJob) -> Path | None:
        if self.folder is not None:
            with suppress(OSError):  # which versions are installed cannot be read
                return (
                    self.folder
                    / f"{job.digest({'format': FORMAT, **{name: _version(name) for name in _LIBRARIES}})}.result"
                )
        return None


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


_UNUSUAL_IN_NAMES = lazy_pattern(r"[^\w.-]+")
_WITHOUT_MARK = (".png", ".jpg", ".jpeg", ".bin")


class MeshOutcome(NamedTuple):
    """The result of a job on a mesh, the file that it was made of, and the stem for the names of new files."""

    result: MeshResult
    source: MeshSource
    stem: str


@dataclass(slots=True)
class Workbench:
    """One run of a pass on a document: finds its meshes, does jobs on them, and names the new files."""

    sink: DiagnosticSink
    sources: MeshSources
    folder: str
    prefix: str
    cache: ResultsCache = field(default_factory=ResultsCache.usual)
    _stems: dict[str, str] = field(default_factory=dict[str, str])
    """Digests of jobs by the stems of their files, in lower case."""

    def outcome(self, name: str, mesh: Mesh, options: Options) -> MeshOutcome:
        """Do a job on the mesh of a shape, or take the result from the cache.

        Raises:
            MeshError: the mesh is not found or cannot be read, or a library is not installed.
        """
        uri = (mesh.uri or "").strip()
        source = self.sources.find(uri)
        submesh, center = submesh_of(mesh)
        job = MeshJob(
            name, {**options, "submesh": submesh, "center": center}, source.kind, source.content, source.companions
        )
        stem = self._choose_stem(job, source.stem if submesh is None else f"{source.stem}_{submesh}")
        job = replace(job, options={**job.options, "stem": stem})
        result = self.cache.get(job)
        if result is None:
            with working_on(uri):
                result = do(job)
            self.cache.put(job, result)
        require_result(result, uri, "used")
        return MeshOutcome(result, source, stem)

    def _choose_stem(self, job: MeshJob, words: str) -> str:
        """What the names of files made of a mesh begin with; other meshes never get the same stem."""
        # `NAME_hull.obj` can be read and reviewed; a digest in the name cannot.
        usual = _UNUSUAL_IN_NAMES.sub("_", words).lstrip("._") or "mesh"
        own, stem, count = job.digest({}), usual, 1
        while self._stems.setdefault(stem.casefold(), own) != own:
            count += 1
            stem = f"{usual}_{count}"
        return stem

    def add(self, stem: str, files: Mapping[str, bytes]) -> str:
        """Put files beside the result, by what follows the stem in their names; the URI of the first one.

        Raises:
            MeshError: an earlier pass has made a different file of this name.
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
                mark = None if path.lower().endswith(_WITHOUT_MARK) else MARK.encode()
                self.sink.side_files.append(SideFile(path, data, mark))
        return self.uri(next(iter(placed)))

    def uri(self, path: str) -> str:
        """The URI by which the document names a new file."""
        return f"{self.prefix.rstrip('/')}/{path}" if self.prefix else path


class MeshPass(AssetPass, FilesPass):
    """A pass that makes mesh files below the folder of the result, which the document names by relative paths."""

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
        return known_prefix(prefix) if prefix else prefix

    @property
    def place(self) -> str:
        """The folder of the new files."""
        return self.folder

    def below(self, folder: str) -> Self:
        """The pass with its files in a folder of this name inside of its own folder."""
        return self.model_copy(
            update={"folder": f"{self.folder}/{_UNUSUAL_IN_NAMES.sub('_', folder).lstrip('._') or 'model'}"}
        )

    @property
    def read_options(self) -> Options:
        """Options of jobs that say how to read the files."""
        return {"gltf_up": self.gltf_up}

    def workbench(self, sink: DiagnosticSink) -> Workbench:
        """The workbench for a run on a document."""
        return Workbench(sink, MeshSources(self._assets, sink, self.prefix), self.folder, self.prefix)


Watcher = Callable[[str | None], None]
"""Called with the URI of a mesh when work on it begins, and with None when that is done."""
_watcher: ContextVar[Watcher | None] = ContextVar("mesh_watcher", default=None)


@contextmanager
def watched_by(watcher: Watcher) -> Generator[None]:
    """Have a watcher called for each mesh that is worked on in this context."""
    token = _watcher.set(watcher)
    try:
        yield
    finally:
        _watcher.reset(token)


@contextmanager
def working_on(uri: str) -> Generator[None]:
    """Call the watcher, if there is one, at the begin and the end of the work on a mesh."""
    watcher = _watcher.get()
    if watcher is None:
        yield
        return
    watcher(uri)
    try:
        yield
    finally:
        watcher(None)


def report_kept_mesh(sink: DiagnosticSink, error: MeshError, what: str, location: Location) -> None:
    """Report that a shape keeps its mesh, and why."""
    sink.report(error.rule, f"{what} stays as it is: {error.message}", location, help=error.help)


def as_number(value: object) -> float:
    """A fact of a result as a number; 0 where it is none."""
    return float(value) if isinstance(value, int | float) else 0.0


def without_submesh(mesh: Mesh) -> Mesh:
    """The mesh without its `<submesh>`: a file that was made of one part has no others."""
    kept = tuple(part for part in mesh.opaque if not (part.element and part.element.name == "submesh"))
    return mesh if len(kept) == len(mesh.opaque) else mesh.copy(opaque=kept)
