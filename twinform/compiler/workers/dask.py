"""Runs jobs on the workers of a scheduler of Dask, on as many machines as there are."""

import logging
import time
from collections.abc import Generator
from concurrent.futures import CancelledError, Executor
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any

from distributed import Client, KilledWorker

from twinform.compiler.workers.running import Failure, Runner

_WINDOW = 512
"""Jobs that the scheduler has at a time: enough for as many processors, and all that is done twice if it goes away."""
_PATIENCE = 600.0
"""Seconds for a scheduler that went away to come back."""
_PAUSE = 2.0


def dask_runner(address: str, patience: float = _PATIENCE) -> Runner:
    """Runs jobs on the workers of a scheduler.

    A worker that dies is Dask's business: its jobs go to others, until one has ended several workers. Where the
    scheduler itself goes away, it is waited for, and the jobs that it had are handed over again.
    """
    return Runner(
        open=partial(_connected, address, patience), window=_WINDOW, failure=_failure, lost=(CancelledError, OSError)
    )


@contextmanager
def _connected(address: str, patience: float) -> Generator[Executor]:
    client = _client(address, patience)
    try:
        # not `pure`: a job that was lost must not be taken for the one that is handed over again
        yield client.get_executor(pure=False)
    finally:
        with suppress(Exception):  # whatever it is, the connection is no longer needed
            client.close(timeout=_PAUSE)


def _client(address: str, patience: float) -> Any:
    """A connection; the scheduler may be about to start."""
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)  # the command reports what it waits for
    end = time.monotonic() + patience
    while True:
        try:
            return Client(address, timeout=_PAUSE, set_as_default=False)
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(_PAUSE)


def _failure(error: BaseException) -> Failure | None:
    if isinstance(error, KilledWorker):
        return Failure("every worker that it was given to died")
    return None
