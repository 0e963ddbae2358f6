"""Runs jobs on the workers of a Dask scheduler, on as many machines as there are."""

import logging
import time
from collections.abc import Callable, Generator
from concurrent.futures import CancelledError, Executor
from contextlib import contextmanager, suppress
from typing import Any

from distributed import Client, KilledWorker

from twinform.compiler.workers import Failure, Runner, UnavailableError

_WINDOW = 512
"""Jobs that the scheduler holds at a time: enough for as many processors, and all that is lost if it goes away."""
_PATIENCE = 600.0
"""Seconds for a scheduler or workers that went away to come back."""
_PAUSE = 2.0
_LONGEST_ANSWER = 60.0
"""Seconds that a scheduler may take to say which workers it has."""
# Whoever loses a connection logs a traceback, and the command itself says what it waits for.
_LOGGERS = ("distributed", "distributed.client", "tornado.application", "asyncio")


def dask_runner(address: str, patience: float = _PATIENCE, tell: Callable[[str], None] = lambda _: None) -> Runner:
    """Return a runner that runs jobs on the workers of a scheduler.

    Dask itself gives the jobs of a worker that dies to others, until a job has ended several workers. When the
    scheduler or all workers go away, the runner waits for them for `patience` seconds and submits the lost jobs again.
    `tell` is called with what it waits for.
    """
    cluster = _Cluster(address, patience, tell)
    return Runner(
        open=cluster.connect,
        window=_WINDOW,
        remote=True,
        failure=_failure,
        lost=(CancelledError, OSError),
        check=cluster.check,
    )


class _Cluster:
    """A scheduler and its workers, and how long they have been away."""

    def __init__(self, address: str, patience: float, tell: Callable[[str], None]) -> None:
        self._address, self._patience, self._tell = address, patience, tell
        self._away_since: float | None = None
        self._client: Any = None

    @contextmanager
    def connect(self) -> Generator[Executor]:
        """Wait for the scheduler and a worker, and yield an executor on them."""
        for name in _LOGGERS:
            logging.getLogger(name).setLevel(logging.CRITICAL)
        while (client := self._try_to_connect()) is None:
            time.sleep(_PAUSE)
        self._client = client
        try:
            while not self._has_workers():
                self._wait_for_worker()
                time.sleep(_PAUSE)
            self._away_since = None
            # not `pure`: a job that was lost must not be taken for the one that is submitted again
            yield client.get_executor(pure=False)
        finally:
            with suppress(Exception):  # whatever it is, the connection is no longer needed
                client.close(timeout=_PAUSE)

    def check(self, _: Executor) -> None:
        """Raise where there have been no workers for too long.

        Raises:
            UnavailableError: the patience has run out.
        """
        if self._has_workers():
            self._away_since = None
        else:
            self._wait_for_worker()

    def _try_to_connect(self) -> Any:
        try:
            return Client(self._address, timeout=_PAUSE, set_as_default=False)
        except OSError:  # the scheduler may be about to start
            self._wait_for(f"the scheduler {self._address}")
            return None

    def _has_workers(self) -> bool:
        try:
            return bool(self._client.sync(self._client.scheduler.ncores, callback_timeout=_LONGEST_ANSWER))
        except (OSError, RuntimeError):
            return False

    def _wait_for_worker(self) -> None:
        self._wait_for(f"a worker of the scheduler {self._address}")

    def _wait_for(self, what: str) -> None:
        now = time.monotonic()
        if self._away_since is None:
            self._away_since = now
            self._tell(f"waiting for {what}, {self._patience:g} seconds at most")
        if now - self._away_since >= self._patience:
            raise UnavailableError(f"{what} was waited for in vain, {self._patience:g} seconds")


def _failure(error: BaseException) -> Failure | None:
    if isinstance(error, KilledWorker):
        return Failure("every worker that it was given to died")
    return None
