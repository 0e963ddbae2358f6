"""A pool of processes on pebble: a job may crash, hang or fill the memory without harm to the others."""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future
from functools import partial
from multiprocessing.connection import wait
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any, ParamSpec, TypeVar

from pebble import ProcessExpired, ProcessPool

from twinform.child_python import spawn_context
from twinform.compiler.workers.running import Failure, NotStartedError, Runner, run_on

Arguments = ParamSpec("Arguments")
Job = TypeVar("Job")
Result = TypeVar("Result")
# A process is replaced after this many jobs, whatever memory its libraries have kept.
_MOST_JOBS = 1000
_PATIENCE = 120.0
"""Seconds that a process may take to start, on a machine that is busy with other things."""


class _WorkerProcess(SpawnProcess):
    """A process that Ctrl-C does not reach: one that is starting would print a traceback. Its parent ends it."""

    def start(self) -> None:
        """Start it with SIGINT blocked, which it inherits; in this process only this thread blocks it, for a moment."""
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
    """Runs each job in one of so many processes, for so many seconds at most; the first job starts them.

    With `patience` the first job is handed over when a process is ready, for which so many seconds are waited.
    """

    def __init__(
        self, processes: int, seconds: float, most_jobs: int = _MOST_JOBS, patience: float | None = None
    ) -> None:
        self._processes, self._seconds, self._most_jobs = processes, seconds, most_jobs
        self._patience = patience
        self._pool: ProcessPool | None = None

    def submit(
        self, fn: Callable[Arguments, Result], /, *args: Arguments.args, **kwargs: Arguments.kwargs
    ) -> Future[Result]:
        """Hand over a job.

        Raises:
            NotStartedError: no process has become ready.
            BrokenExecutor: the pool lost a process that had nothing to do.
        """
        if self._pool is None:
            # that the task comes along imports what it needs before a job is taken, and its time begins
            spawn_context()
            context: Any = _WorkerContext()  # pebble describes contexts more narrowly than they are
            # pebble limits the time of each job, and a job that dies takes no other with it;
            # `concurrent.futures` has no time limit, and loky none for each job. It is typed,
            # maintained and 37 kB without dependencies. LGPL 3 allows a program under any license
            # to import it unchanged.
            self._pool = ProcessPool(self._processes, self._most_jobs, _begin, (fn,), context)
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


def process_runner(processes: int | None = None, seconds: float = 60) -> Runner:
    """Runs jobs in so many processes, as many as there are processors if not given."""
    count = processes or os.cpu_count() or 1
    return Runner(
        open=partial(ProcessExecutor, count, seconds, patience=_PATIENCE),
        window=2 * count,
        timed=True,
        failure=_failure,
        patience=seconds + _PATIENCE,
        resized=lambda jobs: process_runner(min(count, jobs), seconds),
    )


def run(
    task: Callable[[Job], Result], jobs: Iterable[Job], *, seconds: float = 60, processes: int | None = None
) -> Iterator[tuple[Job, Result | Failure]]:
    """Do the jobs in any order; yield each with what came of it. A job has so many seconds, those for starting apart.

    Raises:
        RuntimeError: the task raised; the message is its traceback.
    """
    every = list(jobs)
    count = min(processes or os.cpu_count() or 1, len(every))
    return run_on(process_runner(count, seconds), task, every)


def _require_ready(pool: ProcessPool, patience: float) -> None:
    """Wait until a process of a pool does something: one that dies while it starts has died of no job.

    Raises:
        NotStartedError: none does.
    """
    try:
        # Starting Python and importing the compiler takes longer than most models do, and several
        # seconds on a busy machine. The time of a job counts from when its process is there.
        pool.schedule(os.getpid).result(patience)
    except TimeoutError as error:
        raise NotStartedError(f"no process was ready within {patience:g} seconds") from error
    except (BrokenExecutor, ProcessExpired) as error:
        raise NotStartedError("the processes for the work die while they start") from error


def _failure(error: BaseException) -> Failure | None:
    if isinstance(error, TimeoutError):
        return Failure("did not come to an end", late=True)
    if isinstance(error, ProcessExpired):
        return Failure(f"the process died (exit code {error.exitcode})")
    return None


def _begin(_task: object) -> None:
    """Make a process ready."""
    # the engines that are judges, and some passes, write straight to the terminal
    silence = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        os.dup2(silence, stream.fileno())
    threading.Thread(target=_go_with_parent, daemon=True).start()


def _go_with_parent() -> None:
    """End this process when the one that started it is gone, also in the middle of a job."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)
