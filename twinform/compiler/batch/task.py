"""The work on one model of a batch, on whatever executor it lands."""

import ctypes
import hashlib
import os
import platform
import threading
import time
from collections.abc import Generator, Mapping
from contextlib import contextmanager
from dataclasses import field, replace
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Protocol, runtime_checkable

from twinform.compiler.batch.entries import ModelEntry
from twinform.compiler.batch.record import ModelRecord, Outcome, Row
from twinform.compiler.dependencies import Dependency, dependencies_of, renewed, status
from twinform.compiler.input.loading import LoadOptions
from twinform.compiler.observing import observed
from twinform.compiler.reproducers import write_reproducer
from twinform.compiler.resolve_uris import SearchPath
from twinform.dataclass import dataclass
from twinform.passes import PassError

# Versions of Python and lxml may differ between machines: they change the wording of some messages and no result that
# we know of.
READERS = ("collada", "pycollada", "scipy", "trimesh", "xacro")
"""Packages that the outcome of a model depends on where they are installed."""


@dataclass(frozen=True, slots=True)
class Worksite:
    """What a worker on another machine must have in common with the command: versions, and folders that it sees."""

    versions: Mapping[str, str]
    folders: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Task:
    """One model, and what is to be done with it.

    `root` is the folder of the models, `dest` that of the results if there is one, and `output` the path of the result
    in it. `known` is the record of an earlier run, which still counts if no dependency has changed. `faults` is the
    folder for reproducers of passes that fail. `seconds` is the time limit, where the executor does not enforce one.
    `version` is the version of twinform that asks for the work. A task for another machine has a `site`, and the `size`
    that the model has here.
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
    site: Worksite | None = None
    size: int | None = None

    @property
    def path(self) -> Path:
        """The file of the model."""
        return Path(self.root, self.entry.path)


@dataclass(frozen=True, slots=True, kw_only=True)
class Done:
    """The result of a task; `known` means that the earlier result still counts, and nothing was done.

    `texts` are the files to write, by their paths below the folder of the results. `dependencies` is None where the
    work has to be done again, because something changed meanwhile, or the model could not even be opened. `is_unfit`
    means that this worker must not do the work, which says nothing about the model.
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
    """What a batch does with each model: a dataclass, whose fields are the options that the outcome depends on."""

    def work(self, task: Task, content: bytes) -> Done:
        """Do the job with a model.

        Raises:
            PassError: a pass is at fault.
        """
        ...


class LateError(BaseException):
    """The time limit is over; no handler of `Exception` holds it up."""


def work(task: Task) -> Done:
    """Do the job with one model. Faults of the model, of a pass and of twinform itself end up in the result."""
    if problem := _find_misfit(task):
        return Done(outcome=Outcome.FAILED, message=problem, dependencies=None, is_unfit=True)
    begin = time.time_ns()
    if task.known and (same := _renew(task.known, task.root)) is not None:
        return Done(outcome=task.known.outcome, known=True, dependencies=same, time=begin)
    with observed() as seen:
        done = _work_within_time(task)
    if done.dependencies is None:
        return done
    seen = seen.merged()
    dependencies = dependencies_of(seen, _absolute(task.root), outside=_absolute(task.dest) if task.dest else None)
    return replace(done, dependencies=dependencies, variables=seen.variables, time=begin)


@cache
def own_version() -> str:
    """Return the version of twinform."""
    return version("twinform")


def version_of(package: str) -> str:
    """Return the version of a package; empty where it is not installed."""
    try:
        return version(package)
    except PackageNotFoundError:
        return ""


@cache
def versions() -> dict[str, str]:
    """Return the versions of twinform and its readers, and the digest of its code, by name."""
    return {"twinform": own_version(), "the code of twinform": _digest_code()} | {
        each: version_of(each) for each in READERS
    }


def _digest_code() -> str:
    """Return the digest of the package: an installation that is edited in place keeps its version."""
    top = Path(__file__).parents[2]
    whole = hashlib.sha256()
    for path in sorted(top.rglob("*.py")):
        whole.update(f"{path.relative_to(top).as_posix()}\0".encode())
        whole.update(path.read_bytes())
    return whole.hexdigest()


def size_of(path: Path) -> int | None:
    """Return the size of a file; None where there is nothing."""
    found = status(str(path))
    return None if found is None else found.st_size


def _absolute(path: str) -> str:
    return os.path.join(os.getcwd(), path)  # noqa: PTH109, PTH118 - as paths are observed


# A worker of another version makes other results, and one that does not see the files, or sees older ones, says of good
# models that they cannot be read. Every task asks, since workers may join in the middle of a run.
def _find_misfit(task: Task) -> str:
    """Return why this machine must not do the work; empty where it may."""
    own, site = versions(), task.site
    if task.version and task.version != own_version():
        return f"{platform.node()} has twinform {own_version()}, and {task.version} asks for the work"
    if site is None:
        return ""
    for name, wanted in site.versions.items():
        if own[name] != wanted:
            return f"{platform.node()} has {_describe_version(name, own[name])}, not {_describe_version(name, wanted)}"
    for folder in site.folders:
        if not Path(folder).is_dir():
            return _does_not_see(folder)
    size = size_of(task.path)
    if size is not None and size != task.size:
        return f"{platform.node()} has another {task.path}"
    return _does_not_see(str(task.path)) if size is None else ""


def _describe_version(name: str, version: str) -> str:
    return f"{name} {version[:12] or 'missing'}"


def _does_not_see(path: str) -> str:
    advice = "" if Path(path).is_absolute() else "; where workers run in another folder, give paths from the root"
    return f"{platform.node()} does not see {path}{advice}"


def _machine(task: Task) -> str:
    """Return where this is, for messages from another machine."""
    return f", on {platform.node()}" if task.site else ""


def _renew(known: ModelRecord, root: str) -> tuple[Dependency, ...] | None:
    """Return the dependencies of a record with their status now; None where something has changed."""
    same = all(os.environ.get(name) == value for name, value in known.variables.items())
    return renewed(known.dependencies, root) if same else None


def _work_within_time(task: Task) -> Done:
    try:
        with time_limit(task.seconds):
            return _read_and_work(_with_own_search(task))
    except LateError:
        return Done(outcome=Outcome.LATE, message="did not come to an end")


@contextmanager
def time_limit(seconds: float | None) -> Generator[None]:
    """Raise `LateError` in this thread after so many seconds, at its next step in Python.

    Signals reach the main thread only, and an executor may work in any. What never comes back from C is not ended; the
    limits on size and depth are there for that.

    Raises:
        LateError: the time is over.
    """
    if seconds is None:
        yield
        return
    lock, ended = threading.Lock(), False
    thread = threading.get_ident()

    def end() -> None:
        with lock:
            if not ended:
                ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), ctypes.py_object(LateError))

    timer = threading.Timer(seconds, end)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        with lock:
            ended = True
        timer.cancel()


def _with_own_search(task: Task) -> Task:
    """Return the task with a new search path: a used one would not look again for what it has found."""
    old = task.load_options.search
    search = SearchPath(old.own, old.models, old.packages, old.workspaces, old.fuel)
    arguments = dict(task.entry.arguments) or task.load_options.arguments
    return replace(task, load_options=replace(task.load_options, search=search, arguments=arguments))


def _read_and_work(task: Task) -> Done:
    try:
        # Models are opened here, in a process with a time limit: a pipe called `robot.urdf` would hold the planning
        # process forever. They are never URLs, so fsspec would not help: includes, packages and macros are looked for
        # around a model by `stat` and by listing folders, which mounting a store provides.
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
        return Done(outcome=Outcome.FAILED, message=f"{error}; {_write_reproducer(error, task)}")
    except LateError:
        raise
    except Exception as error:  # noqa: BLE001 - one bad model never stops the rest
        return Done(outcome=Outcome.FAILED, message=f"a fault of twinform: {type(error).__name__}: {error}")


def _write_reproducer(error: PassError, task: Task) -> str:
    """Write what reproduces the fault of a pass, and return how to."""
    try:
        path = write_reproducer(error, str(task.path), task.faults)
    except (OSError, TypeError, ValueError) as problem:
        return f"nothing could be written that makes it come again: {problem}"
    return f"to see it again{_machine(task)}: twinform reproduce {path}"
