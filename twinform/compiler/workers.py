"""Runs jobs in processes that may crash, hang or fill the memory, or on any executor: one bad job harms no other."""

import multiprocessing
import os
import signal
import sys
import threading
import traceback
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Executor, Future
from concurrent.futures import wait as wait_for_futures
from contextlib import AbstractContextManager, nullcontext
from functools import partial
from itertools import islice
from multiprocessing.connection import wait
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any, Generic, ParamSpec, TypeVar

from pebble import ProcessExpired, ProcessPool

from twinform.child_python import spawn_context
from twinform.dataclass import dataclass

Arguments = ParamSpec("Arguments")
Job = TypeVar("Job")
Result = TypeVar("Result")
_MOST_BREAKS = 5
"""How many executors in a row may break before any result has come back."""
_PAUSE = 5.0
"""Seconds without a result after which the runner checks that its executor is still there."""
_MOST_JOBS = 1000
"""A process is replaced after this many jobs, whatever memory its libraries have kept."""
_PATIENCE = 120.0
"""Seconds that a process may take to start on a busy machine."""


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a job never came back; `late` means that it ran out of time."""

    cause: str
    late: bool = False


class NotStartedError(BrokenExecutor):
    """An executor broke before it began any job."""


class UnavailableError(RuntimeError):
    """There is nobody left to do the work."""


def _no_failure(_: BaseException) -> Failure | None:
    return None


@dataclass(frozen=True, slots=True, kw_only=True)
class Runner:
    """How jobs are run.

    `open` makes an executor, and another one when it breaks and the runner is `renewed`. At most `window` jobs are
    submitted at a time. A `timed` executor enforces the time limit of jobs itself, and a `remote` one runs them on
    other machines. `failure` recognizes exceptions of a future which mean that its job never came back. An exception
    in `lost` means that the executor is gone through no fault of a job. An executor that returns nothing for
    `patience` seconds is broken. `check` is called now and then while there are no results, and raises when waiting
    is pointless. `resized` returns a runner for fewer jobs at a time.
    """

    open: Callable[[], AbstractContextManager[Executor]]
    window: int
    renewed: bool = True
    timed: bool = False
    remote: bool = False
    failure: Callable[[BaseException], Failure | None] = _no_failure
    lost: tuple[type[Exception], ...] = (CancelledError,)
    patience: float | None = None
    check: Callable[[Executor], None] | None = None
    resized: "Callable[[int], Runner] | None" = None

    def for_jobs(self, count: int) -> "Runner":
        """Return a runner for this many jobs, which starts no process that would have nothing to do."""
        return self.resized(count) if self.resized else self

    @classmethod
    def of(cls, executor: Executor, window: int = 64) -> "Runner":
        """Return a runner for an executor that the caller owns and shuts down."""
        return cls(open=lambda: nullcontext(executor), window=window, renewed=False)


def run_on(
    runner: Runner, task: Callable[[Job], Result], jobs: Iterable[Job]
) -> Generator[tuple[Job, Result | Failure]]:
    """Run a task on every job, and yield each job with its result, in any order. Without jobs no executor is opened.

    Raises:
        RuntimeError: the task raised, or could not be sent; the message is the traceback.
        UnavailableError: there is nobody to do the work.
        BrokenExecutor: the executor broke and is not renewed, or breaks whatever it is given.
    """
    return _Run(runner, task, iter(jobs)).results()


class _Run(Generic[Job, Result]):
    """One run: the jobs that are waiting, and those that an executor had when it broke."""

    def __init__(self, runner: Runner, task: Callable[[Job], Result], waiting: Iterator[Job]) -> None:
        self.runner, self.task, self.waiting = runner, task, waiting
        self.again: deque[Job] = deque()
        self.suspects: deque[Job] = deque()
        """Jobs one of which broke the executor; each is tried again alone, to find out which."""
        self.breaks = 0

    def results(self) -> Generator[tuple[Job, Result | Failure]]:
        while self._is_left():
            alone = bool(self.suspects)
            runner = self.runner.for_jobs(1) if alone else self.runner
            try:
                with runner.open() as executor:
                    yield from self._run_on(executor, alone=alone)
            except (BrokenExecutor, *runner.lost) as error:  # it broke before it was given a job
                self._count_break(error)

    def _is_left(self) -> bool:
        if not self.again and not self.suspects:
            self.again.extend(islice(self.waiting, 1))
        return bool(self.again or self.suspects)

    def _run_on(self, executor: Executor, *, alone: bool) -> Iterator[tuple[Job, Result | Failure]]:
        """Yield results until no job is left for this executor or it breaks; with `alone`, suspects one at a time."""
        pending: dict[Future[Result], Job] = {}
        try:
            while True:
                self._submit_more(executor, pending, alone=alone)
                if not pending:
                    return
                for future in self._wait(executor, pending):
                    result = self._result(future)
                    self.breaks = 0
                    yield pending.pop(future), result
        except (BrokenExecutor, *self.runner.lost) as error:
            yield from self._sort_out(error, list(pending.values()), alone=alone)

    def _submit_more(self, executor: Executor, pending: dict[Future[Result], Job], *, alone: bool) -> None:
        queue, most = (self.suspects, 1) if alone else (self.again, self.runner.window)
        while len(pending) < most and (queue if alone else self._is_left()):
            job = queue.popleft()
            try:
                pending[executor.submit(self.task, job)] = job
            except (BrokenExecutor, *self.runner.lost):
                queue.appendleft(job)  # it was never begun
                raise
            except UnavailableError:
                raise
            except Exception as error:
                raise _with_traceback(error) from error

    def _wait(self, executor: Executor, pending: dict[Future[Result], Job]) -> set[Future[Result]]:
        silent = 0.0
        pause = _PAUSE if self.runner.check else self.runner.patience
        while not (done := wait_for_futures(pending, pause, FIRST_COMPLETED).done):
            silent += pause or 0
            if self.runner.check:
                self.runner.check(executor)
            if self.runner.patience is not None and silent >= self.runner.patience:
                raise BrokenExecutor("nothing comes back from it")
        return done

    def _result(self, future: Future[Result]) -> Result | Failure:
        try:
            return future.result()
        except (BrokenExecutor, *self.runner.lost):
            raise
        except Exception as error:
            failure = self.runner.failure(error)
            if failure is None:
                raise _with_traceback(error) from error
            return failure

    def _sort_out(self, error: Exception, jobs: list[Job], *, alone: bool) -> Iterator[tuple[Job, Failure]]:
        """Decide what happens to the jobs of an executor that broke."""
        self._count_break(error)
        if not isinstance(error, BrokenExecutor):
            self.again.extend(jobs)
        elif alone:
            yield from ((job, Failure("the process died")) for job in jobs)
        else:
            # A pool of `concurrent.futures` that loses a process is broken as a whole. So is one of pebble that loses
            # an idle process, or one that dies while it holds the pipe: no exit code says which job that was.
            self.suspects.extend(jobs)

    def _count_break(self, error: Exception) -> None:
        self.breaks += 1
        if self.runner.renewed and self.breaks <= _MOST_BREAKS:
            return
        if isinstance(error, BrokenExecutor):
            raise error
        raise UnavailableError(f"the connection was lost {self.breaks} times in a row: {error}") from error


def _with_traceback(error: Exception) -> RuntimeError:
    return RuntimeError("".join(traceback.format_exception(error)))


class _WorkerProcess(SpawnProcess):
    """A process that ignores Ctrl-C: one that is starting would print a traceback. Its parent ends it."""

    def start(self) -> None:
        """Start the process with SIGINT blocked, which it inherits; only this thread blocks it, and only for now."""
        if not hasattr(signal, "pthread_sigmask"):  # Windows
            super().start()
            return
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            super().start()
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)


class _WorkerContext(SpawnContext):
    Process = _WorkerProcess


class ProcessExecutor(Executor):
    """An executor of pebble's processes, which start with the first job; each job may take `seconds` at most.

    With `patience` the first job is submitted when a process is ready, which may take that many seconds. Jobs find
    what they have in `common` by `common_of_jobs`: each process gets it once.
    """

    def __init__(
        self,
        processes: int,
        seconds: float,
        most_jobs: int = _MOST_JOBS,
        patience: float | None = None,
        common: object = None,
    ) -> None:
        self._processes, self._seconds, self._most_jobs = processes, seconds, most_jobs
        self._patience, self._common = patience, common
        self._pool: ProcessPool | None = None

    def submit(
        self, fn: Callable[Arguments, Result], /, *args: Arguments.args, **kwargs: Arguments.kwargs
    ) -> Future[Result]:
        """Submit a job.

        Raises:
            NotStartedError: no process has become ready.
            BrokenExecutor: the pool lost an idle process.
        """
        if self._pool is None:
            spawn_context()
            context: Any = _WorkerContext()  # pebble describes contexts more narrowly than they are
            # pebble limits the time of each job, and a job that dies takes no other with it. `concurrent.futures` has
            # no time limit and breaks as a whole; joblib 1.6 ends the run: of eight jobs, one of which dies and one
            # of which hangs, two have a result. pebble is typed, maintained and 37 kB without dependencies. LGPL 3
            # allows a program under any license to import it unchanged. The task is passed along so that a process
            # imports what it needs before its first job, whose time is running.
            self._pool = ProcessPool(self._processes, self._most_jobs, _prepare_process, (fn, self._common), context)
            if self._patience is not None:
                _require_ready(self._pool, self._patience)
        try:
            return self._pool.schedule(fn, args, kwargs, self._seconds)
        except RuntimeError as error:
            raise BrokenExecutor(str(error)) from error

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End all processes; jobs that are not done never will be."""
        del wait, cancel_futures
        if self._pool is not None:
            self._pool.stop()
            self._pool.join()


def process_runner(processes: int | None = None, seconds: float = 60, common: object = None) -> Runner:
    """Return a runner of this many processes; without a number, as many as there are processors.

    Jobs find what they have in `common` by `common_of_jobs`.
    """
    count = processes or os.cpu_count() or 1
    return Runner(
        open=partial(ProcessExecutor, count, seconds, patience=_PATIENCE, common=common),
        window=2 * count,
        timed=True,
        failure=_failure_of_process,
        patience=seconds + _PATIENCE,
        resized=lambda jobs: process_runner(min(count, jobs), seconds, common),
    )


def run(
    task: Callable[[Job], Result], jobs: Iterable[Job], *, seconds: float = 60, processes: int | None = None
) -> Iterator[tuple[Job, Result | Failure]]:
    """Run a task on every job in processes, and yield each job with its result, in any order.

    Raises:
        RuntimeError: the task raised; the message is its traceback.
    """
    every = list(jobs)
    return run_on(process_runner(processes, seconds).for_jobs(len(every) or 1), task, every)


def _require_ready(pool: ProcessPool, patience: float) -> None:
    """Wait until a process of a pool does something: one that dies while it starts was not killed by a job.

    Raises:
        NotStartedError: none does.
    """
    try:
        # Starting Python and importing the compiler takes longer than most models do, and several seconds on a busy
        # machine. The time of a job counts from when its process is there.
        pool.schedule(os.getpid).result(patience)
    except TimeoutError as error:
        raise NotStartedError(f"no process was ready within {patience:g} seconds") from error
    except (BrokenExecutor, ProcessExpired) as error:
        raise NotStartedError("the processes for the work die while they start") from error


def _failure_of_process(error: BaseException) -> Failure | None:
    if isinstance(error, TimeoutError):
        return Failure("did not come to an end", late=True)
    if isinstance(error, ProcessExpired):
        return Failure(f"the process died (exit code {error.exitcode})")
    return None


_common: list[Any] = [None]


def common_of_jobs() -> Any:
    """Return what the jobs of this process have in common."""
    return _common[0]


def _prepare_process(_task: object, common: object) -> None:
    _common[0] = common
    # the engines that are judges, and some passes, write straight to the terminal
    silence = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        os.dup2(silence, stream.fileno())
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """End this process when the one that started it is gone, even in the middle of a job."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)
