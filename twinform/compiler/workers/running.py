"""Runs jobs on an executor that may break: a new one takes its place, and only the job that broke it is given up."""

import traceback
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Executor, Future, wait
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from itertools import islice
from typing import Generic, TypeVar

Job = TypeVar("Job")
Result = TypeVar("Result")
_MOST_BREAKS = 5
"""Executors in a row that break before anything has come of them."""


@dataclass(frozen=True, slots=True)
class Failure:
    """A job that never came back, and why; `late` where its time was over."""

    cause: str
    late: bool = False


def _no_failure(_: BaseException) -> Failure | None:
    return None


@dataclass(frozen=True, slots=True, kw_only=True)
class Runner:
    """How jobs are run: `open` gives an executor, and another one where that broke, if it is `renewed`.

    At most `window` jobs are handed over at a time; `timed` means that it ends those whose time is over. `failure`
    recognizes exceptions of a future that mean that its job never came back. After `lost` ones the executor is gone
    for a reason that no job is to blame for. An executor from which nothing comes for so many seconds of `patience` is
    broken.
    """

    open: Callable[[], AbstractContextManager[Executor]]
    window: int
    renewed: bool = True
    timed: bool = False
    failure: Callable[[BaseException], Failure | None] = _no_failure
    lost: tuple[type[Exception], ...] = (CancelledError,)
    patience: float | None = None

    @classmethod
    def of(cls, executor: Executor, window: int = 64) -> "Runner":
        """A runner for an executor of the caller's, who also shuts it down."""
        return cls(open=lambda: nullcontext(executor), window=window, renewed=False)


def run_on(
    runner: Runner, task: Callable[[Job], Result], jobs: Iterable[Job]
) -> Iterator[tuple[Job, Result | Failure]]:
    """Do the jobs in any order; yield each with what came of it. Without a job no executor is opened.

    Raises:
        RuntimeError: the task raised, or could not be handed over; the message is the traceback.
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
            with self.runner.open() as executor:
                yield from self._on(executor)

    def _is_left(self) -> bool:
        if not self.again and not self.suspects:
            self.again.extend(islice(self.waiting, 1))
        return bool(self.again or self.suspects)

    def _on(self, executor: Executor) -> Iterator[tuple[Job, Result | Failure]]:
        """What comes of an executor, until nothing is left to do or it breaks."""
        pending: dict[Future[Result], Job] = {}
        alone = False
        try:
            while True:
                alone = self._submit_more(executor, pending, alone=alone)
                if not pending:
                    return
                for future in self._completed(pending):
                    result = self._result(future)
                    self.breaks = 0
                    yield pending.pop(future), result
        except (BrokenExecutor, *self.runner.lost) as error:
            yield from self._after(error, list(pending.values()))

    def _submit_more(self, executor: Executor, pending: dict[Future[Result], Job], *, alone: bool) -> bool:
        """Give the executor more to do; gives whether it has one suspect, and is to have nothing else."""
        if alone and pending:
            return True
        if self.suspects:
            if pending:
                return False
            self._submit(executor, pending, self.suspects.popleft())
            return True
        while len(pending) < self.runner.window and self._is_left():
            self._submit(executor, pending, self.again.popleft())
        return False

    def _submit(self, executor: Executor, pending: dict[Future[Result], Job], job: Job) -> None:
        try:
            pending[executor.submit(self.task, job)] = job
        except (BrokenExecutor, *self.runner.lost):
            self.again.append(job)  # it was never begun
            raise
        except Exception as error:
            raise _raised(error) from error

    def _completed(self, pending: dict[Future[Result], Job]) -> set[Future[Result]]:
        done = wait(pending, self.runner.patience, FIRST_COMPLETED).done
        if not done:
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

    def _after(self, error: Exception, jobs: list[Job]) -> Iterator[tuple[Job, Failure]]:
        """Sort out whose fault it is that an executor broke."""
        self.breaks += 1
        if not self.runner.renewed or self.breaks > _MOST_BREAKS:
            raise error
        if not isinstance(error, BrokenExecutor):
            self.again.extend(jobs)
        elif len(jobs) == 1:
            yield jobs[0], Failure("the process died")
        else:
            self.suspects.extend(jobs)


def _raised(error: Exception) -> RuntimeError:
    return RuntimeError("".join(traceback.format_exception(error)))
