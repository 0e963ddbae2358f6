"""The work on one model of a batch, on whatever executor it lands."""

import os
import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Protocol, runtime_checkable

from twinform.compiler.batch.dependencies import Dependency, are_same, dependencies_of
from twinform.compiler.batch.entries import Entry
from twinform.compiler.batch.record import Outcome, Record, Row
from twinform.compiler.batch.time_limit import LateError, time_limit
from twinform.compiler.input.loading import LoadOptions
from twinform.compiler.input.regular_files import read_regular
from twinform.compiler.observing import observed
from twinform.compiler.reproducers.files import write_reproducer
from twinform.compiler.search.uris import SearchPath
from twinform.passes import PassError


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """One model, and what is to be done with it.

    `root` is the folder of the models, `dest` that of the results if there are any, `output` the place of the result
    in it. `known` is what came of it in an earlier run, if that counts as long as nothing has changed. `faults` is a
    folder for what makes the faults of passes come again. `seconds` are those that it may take where the executor does
    not see to that itself.
    """

    entry: Entry
    job: "Job"
    root: str
    load_options: LoadOptions
    dest: str = ""
    output: str = ""
    known: Record | None = None
    faults: Path | None = None
    seconds: float | None = None
    version: str = ""

    @property
    def path(self) -> Path:
        """The file of the model."""
        return Path(self.root, self.entry.path)


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """What came of it; `known` means that it is what was known, and nothing was done.

    `texts` are the files to write by their places below the folder of the results. `dependencies` is None where the
    work has to be done again, because something has changed in the meantime, or the model could not even be opened.
    """

    outcome: Outcome
    texts: Mapping[str, str | bytes] = field(default_factory=dict[str, str | bytes])
    message: str = ""
    diagnostics: list[Row] = field(default_factory=list[Row])
    ledger: dict[str, int] = field(default_factory=dict[str, int])
    details: Row = field(default_factory=Row)
    dependencies: tuple[Dependency, ...] | None = ()
    variables: Mapping[str, str | None] = field(default_factory=dict[str, "str | None"])
    time: int = 0
    known: bool = False


@runtime_checkable
class Job(Protocol):
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


@cache
def own_version() -> str:
    """The version of the compiler that works here."""
    return version("twinform")


def work(task: Task) -> Done:
    """Do what is asked for with a model; no fault of it, of a pass or of ours gets out."""
    own = own_version()
    if task.version and task.version != own:
        return Done(outcome=Outcome.FAILED, message=f"this is twinform {own}, and {task.version} asks for the work")
    if task.known and _holds(task.known, task):
        return _noted_again(task.known, task)
    begin = time.time_ns()
    with observed() as seen:
        done = _within_time(task)
    if done.dependencies is None:
        return done
    dependencies = dependencies_of(seen, _absolute(task.root), outside=_absolute(task.dest) if task.dest else None)
    return replace(done, dependencies=dependencies, variables=seen.variables, time=begin)


def _absolute(path: str) -> str:
    return os.path.join(os.getcwd(), path)  # noqa: PTH109, PTH118 - as paths are observed


def _holds(known: Record, task: Task) -> bool:
    """Whether what is known of a model is still so, and its results are still there."""
    same = all(os.environ.get(name) == value for name, value in known.variables.items())
    return same and are_same(known.dependencies, task.root) and are_same(known.results, task.dest)


def _noted_again(known: Record, task: Task) -> Done:
    """What is known, with the times that files have now."""
    now = time.time_ns()
    return Done(
        outcome=known.outcome,
        known=True,
        dependencies=tuple(_with_time(each, task.root) for each in known.dependencies),
        time=now,
    )


def _with_time(dependency: Dependency, root: str) -> Dependency:
    if not dependency.digest:
        return dependency
    try:
        return replace(dependency, time=Path(root, dependency.path).stat().st_mtime_ns)
    except OSError:
        return dependency


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
        content = read_regular(task.path, task.load_options.limits.size)
    except OSError as error:
        return Done(outcome=Outcome.UNREADABLE, message=f"it cannot be read: {error.strerror}", dependencies=None)
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
    return f"to see it again: twinform reproduce {path}"
