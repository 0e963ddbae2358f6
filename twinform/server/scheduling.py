"""When documents are checked: once nothing was typed for a moment, one at a time, in another process.

A check that a newer text has overtaken still ends, since a new process would take longer, and its findings are
forgotten. One that takes too long is ended with its process, and so is one of a document that was closed.
"""

import asyncio
from collections.abc import Awaitable, Callable
from concurrent.futures import BrokenExecutor

from pebble import ProcessExpired

from twinform.compiler.workers.processes import ProcessExecutor
from twinform.server.checking import Checked, Job, check

PAUSE = 0.15
"""Seconds without a key after which a document is checked."""
_SECONDS = 30.0
"""The longest check; one of the largest document that is followed takes a tenth of it."""
JobOf = Callable[[str], Job | None]
Show = Callable[[str, "Checked | str"], Awaitable[None]]
"""Shows what came of the check of a document: the findings, or why there are none."""


class Checks:
    """The checks that are waiting or running, one for each document at most."""

    def __init__(self, job_of: JobOf, show: Show) -> None:
        self._job_of, self._show = job_of, show
        self._tasks: dict[str, asyncio.Task[None]] = {}
        self._wanted: dict[str, int] = {}
        self._executor = ProcessExecutor(1, _SECONDS)

    def want(self, uri: str, pause: float = PAUSE) -> None:
        """Have a document checked soon."""
        self._wanted[uri] = self._wanted.get(uri, 0) + 1
        if uri not in self._tasks:
            self._tasks[uri] = asyncio.get_running_loop().create_task(self._run(uri, pause))

    def forget(self, uri: str) -> None:
        """Have a document not checked any more."""
        self._wanted.pop(uri, None)
        task = self._tasks.pop(uri, None)
        if task is not None:
            task.cancel()

    def stop(self) -> None:
        """End the process."""
        for uri in list(self._tasks):
            self.forget(uri)
        self._executor.shutdown()

    async def _run(self, uri: str, pause: float) -> None:
        """Check a document until the last check is of its last text."""
        try:
            done = -1
            while done != self._wanted[uri]:
                await self._quiet(uri, pause)
                done, pause = self._wanted[uri], PAUSE
                job = self._job_of(uri)
                if job is None:
                    return
                outcome = await self._outcome(job)
                if done == self._wanted[uri]:
                    await self._show(uri, outcome)
        finally:
            if self._tasks.get(uri) is asyncio.current_task():
                del self._tasks[uri]

    async def _quiet(self, uri: str, pause: float) -> None:
        """Wait until nothing was typed for so long."""
        seen = -1
        while seen != self._wanted[uri]:
            seen = self._wanted[uri]
            await asyncio.sleep(pause)

    async def _outcome(self, job: Job) -> Checked | str:
        for _ in range(2):
            try:
                return await asyncio.wrap_future(self._executor.submit(check, job))
            except TimeoutError:
                return f"the check took longer than {_SECONDS:g} seconds and was ended"
            except ProcessExpired as error:
                return f"the process of the check died (exit code {error.exitcode})"
            except BrokenExecutor:  # the process died while it had nothing to do
                self._executor.shutdown()
                self._executor = ProcessExecutor(1, _SECONDS)
            except Exception as error:  # noqa: BLE001 - whatever is wrong with us must not take the editor's server down
                return f"the check failed, which is a fault of twinform: {error!r}"
        return "the process of the check cannot be started"
