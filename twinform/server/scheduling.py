"""Scheduling of checks: a document is checked once nothing was typed for a moment, in the worker's process.

If the text changes during a check, the check goes on, since a new process would take longer, and its findings are
dropped. A check that takes too long is ended with its process.
"""

import asyncio
from collections.abc import Awaitable, Callable
from concurrent.futures import BrokenExecutor, Future
from typing import ParamSpec, TypeVar

from pebble import ProcessExpired

from twinform.compiler.workers import ProcessExecutor
from twinform.server.checking import Checked, CheckJob, check

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


PAUSE = 0.15
"""Seconds without a key after which a document is checked."""
JobOf = Callable[[str], CheckJob | None]
Show = Callable[[str, "Checked | str"], Awaitable[None]]
"""Shows the result of checking a document: the findings, or why there are none."""


class Checks:
    """The checks that are waiting or running, at most one for each document."""

    def __init__(self, worker: Worker, job_of: JobOf, show: Show) -> None:
        self._worker, self._job_of, self._show = worker, job_of, show
        self._tasks: dict[str, asyncio.Task[None]] = {}
        self._wanted: dict[str, int] = {}
        self._due: dict[str, float] = {}

    def want(self, uri: str, pause: float = PAUSE) -> None:
        """Check a document after a pause without typing."""
        loop = asyncio.get_running_loop()
        self._wanted[uri] = self._wanted.get(uri, 0) + 1
        self._due[uri] = loop.time() + pause
        if uri not in self._tasks:
            self._tasks[uri] = loop.create_task(self._run(uri))

    def forget(self, uri: str) -> None:
        """Cancel the check of a document."""
        self._wanted.pop(uri, None)
        self._due.pop(uri, None)
        task = self._tasks.pop(uri, None)
        if task is not None:
            task.cancel()

    def stop(self) -> None:
        """Cancel all checks."""
        for uri in list(self._tasks):
            self.forget(uri)

    async def _run(self, uri: str) -> None:
        """Check a document again until its last text is checked."""
        try:
            done = -1
            while done != self._wanted[uri]:
                await self._wait_for_pause(uri)
                done = self._wanted[uri]
                job = self._job_of(uri)
                if job is None:
                    return
                outcome = await self._check(job)
                if done == self._wanted[uri]:
                    await self._show(uri, outcome)
        except Exception as error:  # noqa: BLE001 - see below
            # whatever it is, other documents are still checked
            await self._show(uri, f"the file could not be checked: this is a fault of twinform: {error!r}")
        finally:
            if self._tasks.get(uri) is asyncio.current_task():
                del self._tasks[uri]

    async def _wait_for_pause(self, uri: str) -> None:
        """Wait until the pause is over, which each key restarts."""
        loop = asyncio.get_running_loop()
        # The pause is counted from the last key: a loop that looks again after a whole pause would
        # wait for up to two of them.
        while (left := self._due[uri] - loop.time()) > 0:
            await asyncio.sleep(left)

    async def _check(self, job: CheckJob) -> Checked | str:
        try:
            return await self._worker.run(check, job)
        except TaskError as error:
            return f"the file could not be checked: {error}"
