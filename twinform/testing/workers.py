"""A pool of processes in which a job may crash or hang without harm to the others."""

import multiprocessing
import os
import sys
import time
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Generic, TypeVar

Job = TypeVar("Job")
Result = TypeVar("Result")
_SPAWN = multiprocessing.get_context("spawn")


@dataclass(frozen=True, slots=True)
class Failure:
    """A job that never came back, and why."""

    cause: str


@dataclass(frozen=True, slots=True)
class _Raised:
    """A fault of the task itself, to be raised where it was asked for."""

    traceback: str


class _Worker(Generic[Job, Result]):
    """A process that does one job at a time, and a new process after each that did not survive its job."""

    def __init__(self, task: Callable[[Job], Result]) -> None:
        self.task = task
        self.job: Job | None = None
        self.deadline = 0.0
        self._start()

    def give(self, job: Job, seconds: float) -> None:
        self.job, self.deadline = job, time.monotonic() + seconds
        self.pipe.send(job)

    def take(self) -> Result | Failure:
        """What came of the job."""
        self.job = None
        if not self.pipe.poll():
            self.stop()
            self._start()
            return Failure("did not come to an end")
        try:
            result = self.pipe.recv()
        except (EOFError, ConnectionResetError):
            self.stop()
            failure = Failure(f"the process died (exit code {self.process.exitcode})")
            self._start()
            return failure
        return _unless_raised(result)

    def stop(self) -> None:
        self.process.kill()
        self.process.join()
        self.pipe.close()

    def _start(self) -> None:
        self.pipe, theirs = _SPAWN.Pipe()
        self.process = _SPAWN.Process(target=_serve, args=(theirs, self.task), daemon=True)
        self.process.start()
        theirs.close()


def run(
    task: Callable[[Job], Result], jobs: Iterable[Job], *, seconds: float = 60, processes: int | None = None
) -> Iterator[tuple[Job, Result | Failure]]:
    """Do the jobs in any order; yield each with what came of it.

    Raises:
        RuntimeError: the task raised; the message is its traceback.
    """
    waiting = list(reversed(list(jobs)))
    count = min(processes or os.cpu_count() or 1, max(1, len(waiting)))
    workers: list[_Worker[Job, Result]] = [_Worker(task) for _ in range(count)]
    for worker in workers[: len(waiting)]:
        worker.give(waiting.pop(), seconds)
    while busy := [worker for worker in workers if worker.job is not None]:
        for worker in _ready(busy):
            job = worker.job
            assert job is not None
            result = worker.take()
            if waiting:
                worker.give(waiting.pop(), seconds)
            yield job, result
    for worker in workers:
        worker.stop()


def _ready(busy: list[_Worker[Job, Result]]) -> list[_Worker[Job, Result]]:
    """The workers that have something to say, have died, or are past their time."""
    patience = max(0.0, min(worker.deadline for worker in busy) - time.monotonic())
    spoken = wait([worker.pipe for worker in busy], patience)
    return [worker for worker in busy if worker.pipe in spoken or worker.deadline <= time.monotonic()]


def _unless_raised(result: Result | _Raised) -> Result:
    if not isinstance(result, _Raised):
        return result
    raise RuntimeError(result.traceback)


def _serve(pipe: Connection, task: Callable[[Job], Result]) -> None:
    # the engines that are judges here write their warnings straight to the terminal
    silence = os.open(os.devnull, os.O_WRONLY)
    for stream in (sys.stdout, sys.stderr):
        os.dup2(silence, stream.fileno())
    while True:
        try:
            job = pipe.recv()
        except EOFError:
            return
        try:
            result = task(job)
        except Exception:  # noqa: BLE001 - whatever it is, the other process raises it
            result = _Raised(traceback.format_exc())
        pipe.send(result)
