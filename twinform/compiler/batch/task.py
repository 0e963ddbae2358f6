"""The work on one model of a batch, on whatever executor it lands."""

import os
import platform
import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Protocol, runtime_checkable

from twinform.compiler.batch.dependencies import Dependency, dependencies_of, renewed
from twinform.compiler.batch.entries import ModelEntry
from twinform.compiler.batch.record import ModelRecord, Outcome, Row
from twinform.compiler.batch.time_limit import LateError, time_limit
from twinform.compiler.batch.worksite import fingerprint, own_version
from twinform.compiler.input.loading import LoadOptions
from twinform.compiler.observing import observed
from twinform.compiler.reproducers.reproducer_files import write_reproducer
from twinform.compiler.search.resolve_uris import SearchPath
from twinform.passes import PassError


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """One model, and what is to be done with it.

    `root` is the folder of the models, `dest` that of the results if there are any, `output` the place of the result
    in it. `known` is what came of it in an earlier run, if that counts as long as nothing has changed. `faults` is a
    folder for what makes the faults of passes come again. `seconds` are those that it may take where the executor does
    not see to that itself. `version` is that of the compiler that asks, and `site` the fingerprint of all that another
    machine must have in common with it.
    """

    entry: ModelEntry
    job: "BatchJob"
    root: str
    load_options: LoadOptions
    dest: str = ""
    output: str = ""
    known: ModelRecord | None = None
    faults: Path | None = None
    seconds: float | None = None
    version: str = ""
    site: str = ""

    @property
    def path(self) -> Path:
        """The file of the model."""
        return Path(self.root, self.entry.path)


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """What came of it; `known` means that it is what was known, and nothing was done.

    `texts` are the files to write by their places below the folder of the results. `dependencies` is None where the
    work has to be done again, because something has changed in the meantime, or the model could not even be opened.
    It `is_unfit` where the worker is, so that it says nothing about the model.
    """

    outcome: Outcome
    texts: Mapping[str, str | bytes] = field(default_factory=dict[str, "str | bytes"])
    message: str = ""
    diagnostics: list[Row] = field(default_factory=list[Row])
    ledger: dict[str, int] = field(default_factory=dict[str, int])
    details: Row = field(default_factory=Row)
    dependencies: tuple[Dependency, ...] | None = ()
    variables: Mapping[str, str | None] = field(default_factory=dict[str, "str | None"])
    time: int = 0
    known: bool = False
    is_unfit: bool = False


@runtime_checkable
class BatchJob(Protocol):
    """What a batch does with each model."""

    @property
    def request(self) -> list[object]:
        """The options that the outcome depends on, as JSON."""
        ...

    def work(self, task: Task, content: bytes) -> Done:
        """Do it.

        Raises:
            PassError: a pass is at fault.
        """
        ...


def work(task: Task) -> Done:
    """Do what is asked for with a model; no fault of it, of a pass or of ours gets out."""
    if problem := _unfit(task):
        return Done(outcome=Outcome.FAILED, message=problem, dependencies=None, is_unfit=True)
    begin = time.time_ns()
    if task.known and (same := _renewed(task.known, task.root)) is not None:
        return Done(outcome=task.known.outcome, known=True, dependencies=same, time=begin)
    with observed() as seen:
        done = _within_time(task)
    if done.dependencies is None:
        return done
    dependencies = dependencies_of(seen, _absolute(task.root), outside=_absolute(task.dest) if task.dest else None)
    return replace(done, dependencies=dependencies, variables=seen.variables, time=begin)


def _absolute(path: str) -> str:
    return os.path.join(os.getcwd(), path)  # noqa: PTH109, PTH118 - as paths are observed


def _unfit(task: Task) -> str:
    """Why the work must not be done here; nothing where it may."""
    own = own_version()
    if task.version and task.version != own:
        return f"this is twinform {own}, and {task.version} asks for the work{_machine(task)}"
    if task.site and task.site != fingerprint():
        return f"the code of twinform, or a package that it reads with, is another one{_machine(task)}"
    if task.site and not Path(task.root).is_dir():
        return f"there is no folder {task.root}{_machine(task)}"
    return ""


def _machine(task: Task) -> str:
    """Where this is, if it may be elsewhere."""
    return f", on {platform.node()}" if task.site else ""


def _renewed(known: ModelRecord, root: str) -> tuple[Dependency, ...] | None:
    """What a record depends on with its status now; None where something has changed."""
    same = all(os.environ.get(name) == value for name, value in known.variables.items())
    return renewed(known.dependencies, root) if same else None


def _within_time(task: Task) -> Done:
    try:
        with time_limit(task.seconds):
            return _worked(_alone(task))
    except LateError:
        return Done(outcome=Outcome.LATE, message="did not come to an end")


def _alone(task: Task) -> Task:
    """The task with a search of its own: one that others have used would not look again for what they have found."""
    old = task.load_options.search
    search = SearchPath(old.own, old.models, old.packages, old.workspaces, old.fuel)
    arguments = dict(task.entry.arguments) or task.load_options.arguments
    return replace(task, load_options=replace(task.load_options, search=search, arguments=arguments))


def _worked(task: Task) -> Done:
    try:
        # Models are opened here, in a process with a time limit: a pipe called `robot.urdf` would
        # hold the planning process forever. They are never URLs: includes, packages and macros are
        # looked for around a model by `stat` and by listing folders, which mounting a store
        # provides.
        content = task.load_options.search.readable(task.path).read(task.path, task.load_options.limits.size)
    except OSError as error:
        return Done(
            outcome=Outcome.UNREADABLE,
            message=f"it cannot be read{_machine(task)}: {error.strerror}",
            dependencies=None,
        )
    try:
        return task.job.work(task, content)
    except PassError as error:
        return Done(outcome=Outcome.FAILED, message=f"{error}; {_reproducer(error, task)}")
    except LateError:
        raise
    except Exception as error:  # noqa: BLE001 - one bad model never stops the rest
        return Done(outcome=Outcome.FAILED, message=f"a fault of twinform: {type(error).__name__}: {error}")


def _reproducer(error: PassError, task: Task) -> str:
    try:
        path = write_reproducer(error, str(task.path), task.faults)
    except (OSError, TypeError, ValueError) as problem:
        return f"nothing could be written that makes it come again: {problem}"
    return f"to see it again{_machine(task)}: twinform reproduce {path}"
