"""The worker: a process for tasks on files that may be hostile, with a limit of time for each."""

import asyncio
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Future
from typing import ParamSpec, TypeVar

from pebble import ProcessExpired

from twinform.compiler.workers import ProcessExecutor

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")
# The longest task. Checking the largest document that is followed takes a tenth of it.
_SECONDS = 30.0


class TaskError(Exception):
    """A task has no result; the message says why."""


class Worker:
    """Runs tasks in one process, which is replaced when a task takes too long or crashes it."""

    def __init__(self, seconds: float = _SECONDS) -> None:
        self._seconds = seconds
        # A check may hang or crash on a hostile document, and the global interpreter lock must not
        # hold back an answer.
        self._executor = ProcessExecutor(1, seconds)

    async def run(self, task: Callable[Arguments, Result], *args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        """Run a task and return its result.

        Raises:
            TaskError: it has none.
        """
        try:
            try:
                return await asyncio.wrap_future(self._submit(task, *args, **kwargs))
            except (ProcessExpired, BrokenExecutor):
                # the process may have died before the task began; a task that ends its process does so again
                return await asyncio.wrap_future(self._submit(task, *args, **kwargs))
        except TimeoutError as error:
            raise TaskError(f"it took longer than {self._seconds:g} seconds and was ended") from error
        except ProcessExpired as error:
            raise TaskError(f"its process died (exit code {error.exitcode})") from error
        except BrokenExecutor as error:
            raise TaskError(f"its process cannot be started: {error}") from error
        except Exception as error:
            raise TaskError(f"this is a fault of twinform: {error!r}") from error

    def stop(self) -> None:
        """End the process."""
        self._executor.shutdown()

    def _submit(
        self, task: Callable[Arguments, Result], *args: Arguments.args, **kwargs: Arguments.kwargs
    ) -> Future[Result]:
        try:
            return self._executor.submit(task, *args, **kwargs)
        except BrokenExecutor:  # the process died while it was idle
            self._executor.shutdown()
            self._executor = ProcessExecutor(1, self._seconds)
            return self._executor.submit(task, *args, **kwargs)
