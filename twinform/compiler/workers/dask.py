"""Runs jobs on the workers of a scheduler of Dask, on as many machines as there are."""

import logging
import platform
import time
from collections.abc import Callable, Generator, Mapping
from concurrent.futures import CancelledError, Executor, Future
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any, ParamSpec, TypeVar

from distributed import Client, KilledWorker

from twinform.compiler.workers.running import Failure, Runner, UnavailableError

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")
# Jobs that the scheduler holds at a time: enough for as many processors, and all that is lost if it
# goes away.
_WINDOW = 512
_PATIENCE = 600.0
"""Seconds for a scheduler or workers that went away to come back."""
_PAUSE = 2.0
_LONGEST_ANSWER = 60.0
"""Seconds that a scheduler may take to say which workers it has, and all of them to answer a question."""
# whoever loses a connection logs a traceback, and the command itself says what it waits for
_LOGGERS = ("distributed", "distributed.client", "tornado.application", "asyncio")


def dask_runner(address: str, patience: float = _PATIENCE, tell: Callable[[str], None] = lambda _: None) -> Runner:
    """Runs jobs on the workers of a scheduler.

    A worker that dies is Dask's business: its jobs go to others, until one has ended several workers. Where the
    scheduler itself goes away, or all workers do, they are waited for so many seconds of `patience`, and jobs that are
    lost are handed over again. `tell` is given what is waited for.
    """
    waiting = _Waiting(address, patience, tell)
    return Runner(
        open=partial(_connected, address, waiting),
        window=_WINDOW,
        failure=_failure,
        lost=(CancelledError, OSError),
        check=waiting.look,
        everywhere=_everywhere,
    )


class _Cluster(Executor):
    """The workers of a scheduler, as an executor."""

    def __init__(self, client: Any) -> None:
        self.client = client
        # not `pure`: a job that was lost must not be taken for the one that is handed over again
        self._executor: Executor = client.get_executor(pure=False)

    def submit(
        self, fn: Callable[Arguments, Result], /, *args: Arguments.args, **kwargs: Arguments.kwargs
    ) -> Future[Result]:
        return self._executor.submit(fn, *args, **kwargs)

    @property
    def has_workers(self) -> bool:
        """Whether the scheduler has any; False also where it does not answer."""
        try:
            return bool(self.client.sync(self.client.scheduler.ncores, callback_timeout=_LONGEST_ANSWER))
        except (OSError, RuntimeError):
            return False


class _Waiting:
    """How long a scheduler or its workers have been away."""

    def __init__(self, address: str, patience: float, tell: Callable[[str], None]) -> None:
        self._address, self._patience, self._tell = address, patience, tell
        self._since: float | None = None

    def look(self, executor: Executor) -> None:
        """Note whether there are workers.

        Raises:
            UnavailableError: there have been none for too long.
        """
        if not isinstance(executor, _Cluster) or executor.has_workers:
            self._since = None
        else:
            self.wait_for(f"a worker of the scheduler {self._address}")

    def wait_for(self, what: str) -> None:
        """Note that something is not there.

        Raises:
            UnavailableError: it has not been there for too long.
        """
        now = time.monotonic()
        if self._since is None:
            self._since = now
            self._tell(f"waiting for {what}, {self._patience:g} seconds at most")
        if now - self._since >= self._patience:
            raise UnavailableError(f"{what} was waited for in vain, {self._patience:g} seconds")

    @property
    def is_over(self) -> bool:
        """Whether all is there."""
        return self._since is None


@contextmanager
def _connected(address: str, waiting: _Waiting) -> Generator[Executor]:
    client = _client(address, waiting)
    try:
        cluster = _Cluster(client)
        waiting.look(cluster)
        while not waiting.is_over:
            time.sleep(_PAUSE)
            waiting.look(cluster)
        yield cluster
    finally:
        with suppress(Exception):  # whatever it is, the connection is no longer needed
            client.close(timeout=_PAUSE)


def _client(address: str, waiting: _Waiting) -> Any:
    """A connection; the scheduler may be about to start."""
    for name in _LOGGERS:
        logging.getLogger(name).setLevel(logging.CRITICAL)
    while True:
        try:
            return Client(address, timeout=_PAUSE, set_as_default=False)
        except OSError:
            waiting.wait_for(f"the scheduler {address}")
            time.sleep(_PAUSE)


def _everywhere(
    executor: Executor, function: Callable[..., object], arguments: tuple[object, ...]
) -> Mapping[str, object]:
    """What a function gives on each worker, or the exception that it raises there."""
    if not isinstance(executor, _Cluster):
        raise TypeError(executor)
    # what a worker of another version can be asked for by name are functions of Python itself
    nodes, found = (
        _asked(executor.client, each, words) for each, words in ((platform.node, ()), (function, arguments))
    )
    return {f"{nodes.get(each, 'a machine')} ({each})": result for each, result in found.items()}


def _asked(client: Any, function: Callable[..., object], arguments: tuple[object, ...]) -> dict[str, object]:
    question = partial(client.run, function, *arguments, on_error="return")
    found: dict[str, object] = question()
    return {address: result for address, result in found.items() if not isinstance(result, OSError)}


def _failure(error: BaseException) -> Failure | None:
    if isinstance(error, KilledWorker):
        return Failure("every worker that it was given to died")
    return None
