"""When documents are checked: once nothing was typed for a moment, one at a time, in another process.

A check that a newer text has overtaken still ends, since a new process would take longer, and its findings are
forgotten. One that takes too long is ended with its process, and so is one of a document that was closed.
"""

import asyncio
from collections.abc import Awaitable, Callable

from twinform.server.checking import Checked, CheckJob, check
from twinform.server.workers import TaskError, Worker

PAUSE = 0.15
"""Seconds without a key after which a document is checked."""
JobOf = Callable[[str], CheckJob | None]
Show = Callable[[str, "Checked | str"], Awaitable[None]]
"""Shows what came of the check of a document: the findings, or why there are none."""


class Checks:
    """The checks that are waiting or running, one for each document at most."""

    def __init__(self, worker: Worker, job_of: JobOf, show: Show) -> None:
        self._worker, self._job_of, self._show = worker, job_of, show
        self._tasks: dict[str, asyncio.Task[None]] = {}
        self._wanted: dict[str, int] = {}
        self._due: dict[str, float] = {}

    def want(self, uri: str, pause: float = PAUSE) -> None:
        """Have a document checked soon."""
        loop = asyncio.get_running_loop()
        self._wanted[uri] = self._wanted.get(uri, 0) + 1
        self._due[uri] = loop.time() + pause
        if uri not in self._tasks:
            self._tasks[uri] = loop.create_task(self._run(uri))

    def forget(self, uri: str) -> None:
        """Have a document not checked any more."""
        self._wanted.pop(uri, None)
        self._due.pop(uri, None)
        task = self._tasks.pop(uri, None)
        if task is not None:
            task.cancel()

    def stop(self) -> None:
        """Have no document checked any more."""
        for uri in list(self._tasks):
            self.forget(uri)

    async def _run(self, uri: str) -> None:
        """Check a document until the last check is of its last text."""
        try:
            done = -1
            while done != self._wanted[uri]:
                await self._quiet(uri)
                done = self._wanted[uri]
                job = self._job_of(uri)
                if job is None:
                    return
                outcome = await self._outcome(job)
                if done == self._wanted[uri]:
                    await self._show(uri, outcome)
        except Exception as error:  # noqa: BLE001 - see below
            # whatever it is, the other documents are still checked
            await self._show(uri, f"the file could not be checked: this is a fault of twinform: {error!r}")
        finally:
            if self._tasks.get(uri) is asyncio.current_task():
                del self._tasks[uri]

    async def _quiet(self, uri: str) -> None:
        """Wait until nothing was typed for the pause, which each key begins again."""
        loop = asyncio.get_running_loop()
        # The pause is counted from the last key: a loop that looks again after a whole pause would
        # wait for up to two of them.
        while (left := self._due[uri] - loop.time()) > 0:
            await asyncio.sleep(left)

    async def _outcome(self, job: CheckJob) -> Checked | str:
        try:
            return await self._worker.run(check, job)
        except TaskError as error:
            return f"the file could not be checked: {error}"
