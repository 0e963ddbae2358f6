"""A process pool in which a job may crash or hang without harm to the others."""

import multiprocessing
import os
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Generic, TypeVar

Job = TypeVar("Job")
Result = TypeVar("Result")
_SPAWN = multiprocessing.get_context("spawn")
_PATIENCE = 120.0
"""Seconds that a process may take to start, on a machine that is busy with other things."""


@dataclass(frozen=True, slots=True)
class Failure:
    """A job that never came back, and why; `late` where its time was over."""

    cause: str
    late: bool = False


@dataclass(frozen=True, slots=True)
class _Ready:
    """The first message of a process: from now on the time of its job counts."""


@dataclass(frozen=True, slots=True)
class _Raised:
    """A fault of the task itself, to be raised where it was asked for."""

    traceback: str


class _Worker(Generic[Job, Result]):
    """A process that does one job at a time, and a new process after each that did not survive its job."""

    def __init__(self, task: Callable[[Job], Result], seconds: float) -> None:
        self.task, self.seconds = task, seconds
        self.job: Job | None = None
        self.deadline = 0.0
        self._start()

    def give(self, job: Job) -> None:
        self.job = job
        self.deadline = time.monotonic() + self.seconds + (0 if self.ready else _PATIENCE)
        try:
            self.pipe.send(job)
        except OSError:  # it died while it had nothing to do
            self._restart()
            self.pipe.send(job)

    def take(self) -> Result | Failure | _Ready:
        """What came of the job, or that it has only just begun."""
        if not self.pipe.poll():
            return self._fail(Failure("did not come to an end", late=True))
        try:
            result = self.pipe.recv()
        except (EOFError, ConnectionResetError):
            self.process.join()
            return self._fail(Failure(f"the process died (exit code {self.process.exitcode})"))
        if isinstance(result, _Ready):
            self.ready, self.deadline = True, time.monotonic() + self.seconds
            return result
        self.job = None
        return _unless_raised(result)

    def stop(self) -> None:
        self.process.kill()
        self.process.join()
        self.pipe.close()

    def _fail(self, failure: Failure) -> Failure:
        self.job = None
        self._restart()
        return failure

    def _restart(self) -> None:
        self.stop()
        self._start()

    def _start(self) -> None:
        self.ready = False
        self.pipe, theirs = _SPAWN.Pipe()
        self.process = _SPAWN.Process(target=_serve, args=(theirs, self.task), daemon=True)
        self.process.start()
        theirs.close()


def run(
    task: Callable[[Job], Result], jobs: Iterable[Job], *, seconds: float = 60, processes: int | None = None
) -> Iterator[tuple[Job, Result | Failure]]:
    """Do the jobs in any order; yield each with what came of it. A job has so many seconds, those for starting apart.

    Raises:
        RuntimeError: the task raised; the message is its traceback.
    """
    waiting = list(reversed(list(jobs)))
    count = min(processes or os.cpu_count() or 1, len(waiting))
    workers: list[_Worker[Job, Result]] = []
    try:
        for _ in range(count):
            workers.append(_Worker(task, seconds))
            workers[-1].give(waiting.pop())
        yield from _work(workers, waiting)
    finally:
        for worker in workers:
            worker.stop()


def _work(workers: list[_Worker[Job, Result]], waiting: list[Job]) -> Iterator[tuple[Job, Result | Failure]]:
    while busy := [worker for worker in workers if worker.job is not None]:
        for worker in _with_news(busy):
            job, result = worker.job, worker.take()
            if job is None or isinstance(result, _Ready):
                continue
            if waiting:
                worker.give(waiting.pop())
            yield job, result


def _with_news(busy: list[_Worker[Job, Result]]) -> list[_Worker[Job, Result]]:
    """The workers that have sent something, have died, or are past their time."""
    patience = max(0.0, min(worker.deadline for worker in busy) - time.monotonic())
    spoken = wait([worker.pipe for worker in busy], patience)
    return [worker for worker in busy if worker.pipe in spoken or worker.deadline <= time.monotonic()]


def _unless_raised(result: Result | _Raised) -> Result:
    if not isinstance(result, _Raised):
        return result
    raise RuntimeError(result.traceback)


def _go_with_parent() -> None:
    """End this process when the one that started it is gone, also in the middle of a job."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(1)


def _serve(pipe: Connection, task: Callable[[Job], Result]) -> None:
    # the engines that are judges, and some passes, write straight to the terminal
    silence = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        os.dup2(silence, stream.fileno())
    threading.Thread(target=_go_with_parent, daemon=True).start()
    pipe.send(_Ready())
    while True:
        try:
            job = pipe.recv()
        except (EOFError, KeyboardInterrupt):
            return
        try:
            result = task(job)
        except Exception:  # noqa: BLE001 - whatever it is, the other process raises it
            result = _Raised(traceback.format_exc())
        pipe.send(result)
