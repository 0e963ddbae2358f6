"""Runs jobs on an executor that may break: a new one takes its place, and only the job that broke it is given up."""

import traceback
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Executor, Future, wait
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from itertools import islice
from typing import Generic, TypeVar

Job = TypeVar("Job")
Result = TypeVar("Result")
# Executors in a row that break before any result has come back.
_MOST_BREAKS = 5
_PAUSE = 5.0
"""Seconds of silence after which somebody looks whether an executor is still there."""


@dataclass(frozen=True, slots=True)
class Failure:
    """A job that never came back, and why; `late` where its time was over."""

    cause: str
    late: bool = False


class NotStartedError(BrokenExecutor):
    """An executor broke before it began any job."""


class UnavailableError(RuntimeError):
    """There is nobody who could do the work."""


def _no_failure(_: BaseException) -> Failure | None:
    return None


@dataclass(frozen=True, slots=True, kw_only=True)
class Runner:
    """How jobs are run: `open` gives an executor, and another one where that broke, if it is `renewed`.

    At most `window` jobs are handed over at a time; `timed` means that it ends those whose time is over. `failure`
    recognizes exceptions of a future that mean that its job never came back. After `lost` ones the executor is gone
    for a reason that no job is to blame for. An executor from which nothing comes for so many seconds of `patience` is
    broken; `check` looks now and then whether it still can be waited for, and raises where it cannot. `everywhere` has
    each worker call a function once; it gives what comes of that, or the exception, by the name of the machine.
    `resized` gives the same for fewer jobs at a time.
    """

    open: Callable[[], AbstractContextManager[Executor]]
    window: int
    renewed: bool = True
    timed: bool = False
    failure: Callable[[BaseException], Failure | None] = _no_failure
    lost: tuple[type[Exception], ...] = (CancelledError,)
    patience: float | None = None
    check: Callable[[Executor], None] | None = None
    everywhere: "Everywhere | None" = None
    resized: "Callable[[int], Runner] | None" = None

    def for_jobs(self, count: int) -> "Runner":
        """The runner for so many jobs, which starts nothing that would have none."""
        return self.resized(count) if self.resized else self

    @classmethod
    def of(cls, executor: Executor, window: int = 64) -> "Runner":
        """A runner for an executor of the caller's, who also shuts it down."""
        return cls(open=lambda: nullcontext(executor), window=window, renewed=False)


Everywhere = Callable[[Executor, Callable[..., object], tuple[object, ...]], Mapping[str, object]]


def run_on(
    runner: Runner, task: Callable[[Job], Result], jobs: Iterable[Job]
) -> Iterator[tuple[Job, Result | Failure]]:
    """Do the jobs in any order; yield each with what came of it. Without a job no executor is opened.

    Raises:
        RuntimeError: the task raised, or could not be handed over; the message is the traceback.
        UnavailableError: there is nobody to do it.
        BrokenExecutor: the executor broke and is not renewed, or breaks whatever it is given.
    """
    return _Run(runner, task, iter(jobs)).results()


class _Run(Generic[Job, Result]):
    """The jobs that are waiting, and those that were in the hands of an executor that broke."""

    def __init__(self, runner: Runner, task: Callable[[Job], Result], waiting: Iterator[Job]) -> None:
        self.runner, self.task, self.waiting = runner, task, waiting
        self.again: deque[Job] = deque()
        self.suspects: deque[Job] = deque()
        """One of them broke the executor; each is tried again alone, so that it is known which."""
        self.breaks = 0

    def results(self) -> Iterator[tuple[Job, Result | Failure]]:
        while self._is_left():
            alone = bool(self.suspects)
            runner = self.runner.for_jobs(1) if alone else self.runner
            try:
                with runner.open() as executor:
                    yield from self._on(executor, alone=alone)
            except (BrokenExecutor, *runner.lost) as error:  # it broke before it was given a job
                self._count_break(error)

    def _is_left(self) -> bool:
        if not self.again and not self.suspects:
            self.again.extend(islice(self.waiting, 1))
        return bool(self.again or self.suspects)

    def _on(self, executor: Executor, *, alone: bool) -> Iterator[tuple[Job, Result | Failure]]:
        """What comes of an executor, until nothing is left for it or it breaks; suspects are each `alone` in it."""
        pending: dict[Future[Result], Job] = {}
        try:
            while True:
                self._submit_more(executor, pending, alone=alone)
                if not pending:
                    return
                for future in self._completed(executor, pending):
                    result = self._result(future)
                    self.breaks = 0
                    yield pending.pop(future), result
        except (BrokenExecutor, *self.runner.lost) as error:
            yield from self._after(error, list(pending.values()), alone=alone)

    def _submit_more(self, executor: Executor, pending: dict[Future[Result], Job], *, alone: bool) -> None:
        queue, most = (self.suspects, 1) if alone else (self.again, self.runner.window)
        while len(pending) < most and (queue if alone else self._is_left()):
            self._submit(executor, pending, queue)

    def _submit(self, executor: Executor, pending: dict[Future[Result], Job], queue: deque[Job]) -> None:
        job = queue.popleft()
        try:
            pending[executor.submit(self.task, job)] = job
        except (BrokenExecutor, *self.runner.lost):
            queue.appendleft(job)  # it was never begun
            raise
        except UnavailableError:
            raise
        except Exception as error:
            raise _raised(error) from error

    def _completed(self, executor: Executor, pending: dict[Future[Result], Job]) -> set[Future[Result]]:
        silent = 0.0
        pause = _PAUSE if self.runner.check else self.runner.patience
        while not (done := wait(pending, pause, FIRST_COMPLETED).done):
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
                raise _raised(error) from error
            return failure

    def _after(self, error: Exception, jobs: list[Job], *, alone: bool) -> Iterator[tuple[Job, Failure]]:
        """Sort out whose fault it is that an executor broke."""
        self._count_break(error)
        if not isinstance(error, BrokenExecutor):
            self.again.extend(jobs)
        elif alone:
            yield from ((job, Failure("the process died")) for job in jobs)
        else:
            # a process that has died while it started breaks a pool as one does that has died of a job
            # A pool of `concurrent.futures` that loses a process is broken as a whole, and so is one
            # of pebble that loses an idle one. Each job that it had is therefore tried alone.
            self.suspects.extend(jobs)

    def _count_break(self, error: Exception) -> None:
        self.breaks += 1
        if self.runner.renewed and self.breaks <= _MOST_BREAKS:
            return
        if isinstance(error, BrokenExecutor):
            raise error
        raise UnavailableError(f"the connection was lost {self.breaks} times in a row: {error}") from error


def _raised(error: Exception) -> RuntimeError:
    return RuntimeError("".join(traceback.format_exception(error)))
