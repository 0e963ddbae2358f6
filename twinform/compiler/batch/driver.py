"""Runs a batch over all models of a folder. No model is opened here, only in worker processes, which may crash."""

import json
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path, PurePosixPath

from twinform.compiler.batch.files import PATTERNS, FolderError, models, outputs, require_apart
from twinform.compiler.batch.manifest import Manifest, digest, is_unchanged
from twinform.compiler.batch.places import Places, ledger_of, texts_of
from twinform.compiler.batch.record import Outcome, Record
from twinform.compiler.batch.task import Done, Task, work
from twinform.compiler.input.loading import LoadOptions
from twinform.compiler.output.files import write_all_atomically
from twinform.compiler.output.same_files import is_below
from twinform.compiler.request import ConversionRequest
from twinform.compiler.workers import Failure, run
from twinform.diagnostics import Policy
from twinform.passes import AssetPass, SideFilePass, registered_passes
from twinform.passes.framework.other_documents import DocumentPass


@dataclass(frozen=True, slots=True, kw_only=True)
class Batch:
    """What a run is asked for.

    A model may take so many `seconds`; `fresh` works on all of them again; `ledgers` puts beside each result the ledger
    of what was not expressed; `report` is where somebody will write the report.
    """

    source: Path
    dest: Path
    request: ConversionRequest
    load_options: LoadOptions
    policy: Policy = field(default_factory=Policy)
    patterns: tuple[str, ...] = PATTERNS
    jobs: int | None = None
    seconds: float = 60.0
    fresh: bool = False
    ledgers: bool = False
    report: Path | None = None

    @property
    def digest(self) -> str:
        """What tells requests apart: all that the results depend on besides the model."""
        request, load_options = self.request, self.load_options
        asked: list[object] = [
            version("twinform"),
            request.to,
            request.sdf_version,
            request.urdf_version,
            request.carriers,
        ]
        asked += [
            str(request.passes),
            request.expand_includes,
            self.ledgers,
            load_options.strict,
            load_options.engine,
            load_options.xacro,
        ]
        asked += [sorted(self.policy.allow), sorted(self.policy.deny), sorted(self._packages())]
        return digest(json.dumps(asked).encode())

    @property
    def repeats(self) -> bool:
        """Whether all is done again: because that is asked for, or because a pass may read more than the model."""
        return self.fresh or any(isinstance(step, AssetPass | DocumentPass) for step in self.request.passes)

    def _packages(self) -> Iterator[str]:
        """The packages that bring the passes, in their versions."""
        for name in {step.name for step in self.request.passes}:
            owner = registered_passes()[name].owner if name in registered_passes() else ""
            with suppress(ModuleNotFoundError):
                yield f"{owner} {version(owner)}" if owner else name


@dataclass(frozen=True, slots=True)
class _Job:
    """A model before the work on it; `known` is its record from earlier runs."""

    name: PurePosixPath
    blank: Record
    known: Record | None


def batch(asked: Batch) -> Iterator[tuple[Record, bool]]:
    """Work on every model; yield what came of each, and whether that was known before.

    Raises:
        FolderError: there is no such folder, the results would be among the sources, or a pass makes further files.
        OSError: the manifest cannot be written.
    """
    require_apart(asked.source, asked.dest)
    _require_one_file(asked.request)
    names = outputs(models(asked.source, asked.dest, asked.patterns), asked.request.to)
    places = Places(asked.source, asked.dest, names, ledgers=asked.ledgers)
    if asked.report:
        places.require_free(asked.report)
    manifest = Manifest(asked.dest)
    manifest.begin()
    blanks = _blanks(names, asked.digest)
    todo = {asked.source / name: _Job(name, blank, manifest.records.get(blank.source)) for name, blank in blanks}
    for record, known in _worked(todo, asked, places, manifest.folder / "faults"):
        if not known:
            manifest.add(record)
        yield record, known


def _require_one_file(request: ConversionRequest) -> None:
    for step in request.passes:
        if isinstance(step, SideFilePass):
            raise FolderError(f"{step.name} makes a file beside a result, and a batch has many: use twinform convert")


def _blanks(names: Mapping[PurePosixPath, PurePosixPath], request: str) -> Iterator[tuple[PurePosixPath, Record]]:
    """Each model with its record before anything is known of it."""
    for name, output in names.items():
        yield name, Record(source=str(name), digest="", request=request, output=str(output), outcome=Outcome.UNREADABLE)


def _worked(todo: Mapping[Path, _Job], asked: Batch, places: Places, faults: Path) -> Iterator[tuple[Record, bool]]:
    """What comes of the models in the order of the ends, and whether that was known."""
    tasks = [_task(path, job, asked, faults) for path, job in todo.items()]
    for task, result in run(work, tasks, seconds=asked.seconds, processes=asked.jobs):
        job, done = todo[task.path], _done(result)
        if done.known and job.known:
            record = job.known
        else:
            record = _recorded(job, done, asked, places)
            if job.known and (record.outcome is not Outcome.CONVERTED or record.output != job.known.output):
                _remove(asked.dest, job.known)
        if record.outcome is Outcome.CONVERTED:
            places.take(job.name)
        yield record, record is job.known


def _task(path: Path, job: _Job, asked: Batch, faults: Path) -> Task:
    known = job.known
    same = known and (known.request, known.output) == (job.blank.request, job.blank.output) and known.outcome.is_final
    known = known if same and not asked.repeats else None
    return Task(path, asked.request, asked.load_options, asked.policy, faults, known, asked.dest)


def _done(result: Done | Failure) -> Done:
    if isinstance(result, Failure):
        return Done(Outcome.LATE if result.late else Outcome.CRASHED, message=result.cause)
    return result


def _remove(dest: Path, known: Record) -> None:
    """Take away the result of an earlier run that no model stands for any more, unless somebody has changed it."""
    path = dest / known.output
    if known.made and is_below(path.parent, dest) and is_unchanged(path, known.made):
        for each in (path, ledger_of(path)):
            with suppress(OSError):
                each.unlink()


def _recorded(job: _Job, done: Done, asked: Batch, places: Places) -> Record:
    """Put the result, if there is one, in its place."""
    record = replace(
        job.blank,
        digest=done.digest,
        alone=done.alone,
        outcome=done.outcome,
        message=done.message,
        diagnostics=done.diagnostics,
        ledger=done.ledger,
    )
    if done.outcome is not Outcome.CONVERTED:
        return record
    problem = places.problem(job.name) or _written(asked.dest / record.output, done, ledger=asked.ledgers)
    if problem is not None:
        return replace(record, outcome=Outcome.UNWRITTEN, message=f"it cannot be written: {problem}")
    return replace(record, made=digest(done.text.encode()))


def _written(path: Path, done: Done, *, ledger: bool) -> str | None:
    """Write a result, and its ledger; gives the reason where that cannot be done."""
    try:
        write_all_atomically(texts_of(path, done.text, done.entries if ledger else None))
    except OSError as error:
        return error.strerror or str(error)
    return None
