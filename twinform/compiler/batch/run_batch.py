"""Runs a batch: plans what there is to do, has it done on an executor, and records what comes back.

No model is opened here, only by what the executor runs, which may crash.
"""

import json
from collections.abc import Generator, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import closing, contextmanager
from dataclasses import field, replace
from pathlib import Path

from twinform.compiler.batch.entries import FolderError, ModelEntry, ResultPlaces, Shard, outputs, require_apart
from twinform.compiler.batch.jobs import Convert, Diff
from twinform.compiler.batch.manifest import Manifest
from twinform.compiler.batch.record import ModelRecord, ModelResult, Outcome
from twinform.compiler.batch.recording import BatchPlan, Recorder
from twinform.compiler.batch.task import (
    READERS,
    BatchJob,
    Done,
    Task,
    Worksite,
    own_version,
    size_of,
    version_of,
    versions,
    work,
)
from twinform.compiler.dependencies import describe_options
from twinform.compiler.input.loading import LoadOptions
from twinform.compiler.observing import digest
from twinform.compiler.workers import Failure, Runner, process_runner, run_on
from twinform.dataclass import dataclass
from twinform.passes import FilesPass
from twinform.storage.staging import temporary_folder


class UnfitWorkerError(Exception):
    """A worker has another version or other files; the message names its machine and what differs."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Batch:
    """A job, and the entries below the folder `source` that it is to be done with.

    Results go to `dest`, with a manifest of what they depend on; without `dest` nothing is known from earlier runs. A
    model may take `seconds`; `fresh` works on all models again. `report` is the path where the caller writes a report.
    Messages say `shown` in place of the folder. `contents` has the digests of its files, where the caller has just
    written them.
    """

    source: Path
    entries: Sequence[ModelEntry]
    job: BatchJob
    load_options: LoadOptions
    dest: Path | None = None
    shard: Shard | None = None
    seconds: float = 60.0
    fresh: bool = False
    report: Path | None = None
    shown: str = ""
    contents: Mapping[str, str] = field(default_factory=dict[str, str])

    @property
    def chosen(self) -> list[ModelEntry]:
        """The models of this shard."""
        return [entry for entry in self.entries if self.shard is None or self.shard.has(entry)]

    @property
    def request(self) -> str:
        """The digest of everything besides files that results depend on."""
        load_options = self.load_options
        limits = (load_options.limits.size, load_options.limits.tags)
        asked: list[object] = [own_version(), load_options.strict, load_options.engine, load_options.xacro, limits]
        search = load_options.search
        folders = (search.own, search.models, search.packages, search.workspaces, search.fuel)
        asked += [list(map(str, each)) for each in folders]
        asked += [[each.label, each.name] for each in load_options.profiles]
        asked += [sorted(load_options.arguments.items()), load_options.variables]
        # A development version that is edited in place keeps its version number; --fresh is for that.
        asked += [[f"{name} {version_of(name)}".rstrip() for name in READERS], describe_options(self.job)]
        return digest(json.dumps(asked).encode())


@contextmanager
def batch(asked: Batch, executor: Executor | Runner | None = None) -> Generator[Iterator[ModelResult]]:
    """Do the job with every model, and yield an iterator of results, in the order in which they come.

    Without an `executor` the work is done in processes, one for each processor. An executor that breaks ends the run; a
    `Runner` opens another one.

    Raises:
        FolderError: the results would be among the sources, or a pass makes further files.
        BusyError: another run writes to the same folder.
        OSError: a result or the manifest cannot be written, as when the disk is full or gone.
        UnfitWorkerError: a worker has another compiler, or does not see the same files.
        RuntimeError: the executor cannot be given the work, or nobody is there to do it.
        BrokenExecutor: it broke.
    """
    entries, request = asked.chosen, asked.request
    names = _plan_outputs(asked, entries)
    runner = executor if isinstance(executor, Runner) else _make_runner(executor, asked.seconds)
    if asked.dest is None:
        with closing(_work_on_all(asked, entries, names, Recorder(request, None, None, asked.shown), runner)) as found:
            yield found
        return
    require_apart(asked.source, asked.dest)
    places = ResultPlaces(asked.source, asked.dest, entries, names)
    if asked.report:
        places.require_free(asked.report)
    with Manifest(asked.dest, asked.shard.label if asked.shard else "").open() as manifest:
        recorder = Recorder(request, manifest, places, asked.shown)
        with closing(_work_on_all(asked, entries, names, recorder, runner)) as found:
            yield found


def _work_on_all(
    asked: Batch,
    entries: Sequence[ModelEntry],
    names: Mapping[str, str],
    recorder: Recorder,
    runner: Runner,
) -> Generator[ModelResult]:
    plan = BatchPlan(
        recorder.request,
        str(asked.source),
        asked.dest,
        recorder.manifest,
        fresh=asked.fresh,
        contents=asked.contents,
    )
    todo: list[ModelEntry] = []
    for entry in entries:
        if missing := _find_missing(entry, asked, recorder.request):
            yield ModelResult(missing, known=False)
        # Known results are passed on before any work begins, so that a run with nothing to do
        # starts no worker.
        elif known := plan.known(entry, names[entry.name]):
            yield recorder.note(known)
        else:
            todo.append(entry)
    tasks = (_make_task(entry, asked, names[entry.name], plan, recorder, runner) for entry in todo)
    # One process plans and writes, and any executor does the work. A database of jobs that workers share would need a
    # server (SQLite does not work over a file server), and every worker would write where the results are. Here a
    # worker that dies has written nothing, and results are the same wherever they were made.
    for task, result in run_on(runner.for_jobs(len(todo)), work, tasks):
        yield recorder.record(task, _interpret(task, result))


def _make_runner(executor: Executor | None, seconds: float) -> Runner:
    return process_runner(seconds=seconds) if executor is None else Runner.of(executor)


def _plan_outputs(asked: Batch, entries: Sequence[ModelEntry]) -> Mapping[str, str]:
    """Return the path of each result by the name of its model; empty paths for jobs without results."""
    job = asked.job
    if not isinstance(job, Convert):
        return {entry.name: "" for entry in entries}
    for step in job.to.passes:
        if isinstance(step, FilesPass) and step.only_file:
            raise FolderError(f"{step.name} makes a file beside a result, and a batch has many: use twinform convert")
    # of all models, so that the place of one does not depend on the shard that it is in
    every = outputs((entry.name for entry in asked.entries), job.to.to)
    return {entry.name: every[entry.name] for entry in entries}


def _find_missing(entry: ModelEntry, asked: Batch, request: str) -> ModelRecord | None:
    """Return a record for a model that has none to be compared with; None if it has one."""
    if entry.path and (entry.other or not isinstance(asked.job, Diff)):
        return None
    side = "second" if entry.path else "first"
    message = f"there is no such model in the {side} folder"
    return ModelRecord(source=entry.name, request=request, outcome=Outcome.MISSING, message=message)


def _make_task(
    entry: ModelEntry, asked: Batch, output: str, plan: BatchPlan, recorder: Recorder, runner: Runner
) -> Task:
    manifest, search = recorder.manifest, asked.load_options.search
    folders = (asked.source, *search.own, *search.models, *search.packages, *search.workspaces)
    task = Task(
        entry=entry,
        job=asked.job,
        root=str(asked.source),
        load_options=asked.load_options,
        dest=str(asked.dest) if asked.dest else "",
        output=output,
        known=plan.candidate(entry, output),
        faults=(manifest.folder if manifest else temporary_folder() / "twinform") / "faults",
        seconds=None if runner.timed else asked.seconds,
        version=own_version(),
    )
    if not runner.remote:
        return task
    return replace(task, site=Worksite(versions(), tuple(map(str, folders))), size=size_of(task.path))


def _interpret(task: Task, result: Done | Failure) -> Done:
    # A worker that crashed or ran late says nothing about what it read, so nothing is remembered and the model is done
    # again.
    if isinstance(result, Failure):
        return Done(outcome=Outcome.LATE if result.late else Outcome.CRASHED, message=result.cause, dependencies=None)
    if result.is_unfit and task.site and size_of(task.path) != task.size:
        return Done(outcome=Outcome.UNREADABLE, message="it has changed in the meantime", dependencies=None)
    if result.is_unfit:
        raise UnfitWorkerError(result.message)
    return result
