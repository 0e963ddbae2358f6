"""The run over all models of a folder."""

import json
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from importlib.metadata import version
from pathlib import Path

from twinform.compiler.batch.files import PATTERNS, alone, models, outputs, require_apart
from twinform.compiler.batch.manifest import Manifest, digest
from twinform.compiler.batch.record import Outcome, Record
from twinform.compiler.batch.task import Done, Task, work
from twinform.compiler.files import write_all_atomically
from twinform.compiler.loading import Reading
from twinform.compiler.orders import Order
from twinform.compiler.workers import Failure, run
from twinform.diagnostics import Policy
from twinform.passes import AssetPass, registered_passes
from twinform.passes.other_documents import DocumentPass

LEDGER = ".ledger.json"
"""What the name of a result has more where it is that of its ledger."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Batch:
    """What a run is asked for.

    A model may take so many `seconds`; `fresh` works on all of them again; `ledgers` puts beside each result the ledger
    of what was not expressed.
    """

    source: Path
    dest: Path
    order: Order
    reading: Reading
    policy: Policy = field(default_factory=Policy)
    patterns: tuple[str, ...] = PATTERNS
    jobs: int | None = None
    seconds: float = 60.0
    fresh: bool = False
    ledgers: bool = False

    @property
    def digest(self) -> str:
        """What tells orders apart: all that has a say in the results besides the model."""
        order, reading = self.order, self.reading
        asked: list[object] = [version("twinform"), order.to, order.sdf_version, order.urdf_version, order.carriers]
        asked += [str(order.passes), order.expand_includes, self.ledgers, reading.strict, reading.engine, reading.xacro]
        asked += [sorted(self.policy.allow), sorted(self.policy.deny), sorted(self._packages())]
        return digest(json.dumps(asked).encode())

    @property
    def opens_files(self) -> bool:
        """Whether a pass may read more than the model."""
        return any(isinstance(step, AssetPass | DocumentPass) for step in self.order.passes)

    def _packages(self) -> Iterator[str]:
        """The packages that bring the passes, in their versions."""
        for name in {step.name for step in self.order.passes}:
            owner = registered_passes()[name].owner if name in registered_passes() else ""
            with suppress(ModuleNotFoundError):
                yield f"{owner} {version(owner)}" if owner else name


@dataclass(frozen=True, slots=True)
class _Job:
    """A model before the work on it; `known` is what earlier runs say of it."""

    blank: Record
    known: Record | None


def batch(asked: Batch) -> Iterator[tuple[Record, bool]]:
    """Work on every model; yield what came of each, and whether that was known before.

    Raises:
        FolderError: there is no such folder, or the results would be among the sources.
        OSError: the manifest cannot be written.
    """
    require_apart(asked.source, asked.dest)
    manifest = Manifest(asked.dest)
    manifest.begin()
    todo: dict[Path, _Job] = {}
    order = asked.digest
    for name, output in outputs(models(asked.source, asked.dest, asked.patterns), asked.order.to).items():
        job = _look(asked.source / name, str(name), str(output), order, manifest)
        if isinstance(job, Record):
            manifest.add(job)
            yield job, False
        elif job.known and _holds(job.blank, job.known, asked):
            yield job.known, True
        else:
            todo[asked.source / name] = job
    for record in _worked(todo, asked, manifest.folder / "faults"):
        manifest.add(record)
        yield record, False


def _worked(todo: Mapping[Path, _Job], asked: Batch, faults: Path) -> Iterator[Record]:
    """What comes of the models that need work, in the order of the ends."""
    tasks = [Task(path, asked.order, asked.reading, asked.policy, faults) for path in todo]
    for task, result in run(work, tasks, seconds=asked.seconds, processes=asked.jobs):
        job, done = todo[task.path], _done(result)
        record = _recorded(job, done, asked)
        if job.known and (record.outcome is not Outcome.CONVERTED or record.output != job.known.output):
            _remove(asked.dest, job.known)
        yield record


def _look(path: Path, name: str, output: str, order: str, manifest: Manifest) -> _Job | Record:
    """A model before the work on it; one that cannot be read has its record already."""
    blank = Record(source=name, digest="", order=order, output=output, outcome=Outcome.UNREADABLE)
    try:
        content = path.read_bytes()
    except OSError as error:
        return replace(blank, message=f"it cannot be read: {error.strerror}")
    blank = replace(blank, digest=digest(content), alone=alone(path, content))
    return _Job(blank, manifest.records.get(blank.source))


def _holds(blank: Record, known: Record, asked: Batch) -> bool:
    """Whether what is known of a model is still so, and its result still there."""
    if asked.fresh or asked.opens_files or not (blank.alone and known.outcome.is_final):
        return False
    if (known.digest, known.order, known.output) != (blank.digest, blank.order, blank.output):
        return False
    return known.outcome is not Outcome.CONVERTED or _is_there(asked.dest, known)


def _is_there(dest: Path, record: Record) -> bool:
    """Whether a result is as it was written."""
    try:
        return digest((dest / record.output).read_bytes()) == record.made
    except OSError:
        return False


def _done(result: Done | Failure) -> Done:
    if isinstance(result, Failure):
        return Done(Outcome.LATE if result.late else Outcome.CRASHED, message=result.cause)
    return result


def _remove(dest: Path, known: Record) -> None:
    """Take away the result of an earlier run that no model stands for any more, unless somebody has changed it."""
    if known.made and _is_there(dest, known):
        for name in (known.output, known.output + LEDGER):
            with suppress(OSError):
                (dest / name).unlink()


def _recorded(job: _Job, done: Done, asked: Batch) -> Record:
    """Put the result, if there is one, in its place."""
    record = replace(
        job.blank, outcome=done.outcome, message=done.message, diagnostics=done.diagnostics, ledger=done.ledger
    )
    if done.outcome is not Outcome.CONVERTED:
        return record
    path = asked.dest / record.output
    texts = {path: done.text, **({path.with_name(path.name + LEDGER): done.entries} if asked.ledgers else {})}
    try:
        write_all_atomically(texts)
    except OSError as error:
        return replace(record, outcome=Outcome.UNWRITTEN, message=f"it cannot be written: {error.strerror}")
    return replace(record, made=digest(done.text.encode()))
