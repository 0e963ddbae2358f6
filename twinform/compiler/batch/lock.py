"""A lock on a folder of results: two runs must not write one manifest, but shards may work side by side."""

import os
from collections.abc import Generator
from contextlib import contextmanager, suppress
from pathlib import Path

try:
    import fcntl
except ImportError:  # on Windows
    fcntl = None


class BusyError(Exception):
    """Another run is at work on the same results."""


@contextmanager
def locked(folder: Path, shard: str = "") -> Generator[None]:
    """Hold a folder, or a shard of it; the system lets go of it when the process ends, however that happens.

    Raises:
        BusyError: somebody else holds it.
        OSError: there is no writing in it.
    """
    with _held(folder / "lock", shared=bool(shard)):
        if not shard:
            yield
            return
        with _held(folder / f"lock-{shard}", shared=False):
            yield


@contextmanager
def _held(path: Path, *, shared: bool) -> Generator[None]:
    path.parent.mkdir(parents=True, exist_ok=True)
    # nobody removes the file: another run could then hold one of the same name
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0), 0o666)
    try:
        try:
            if fcntl is not None:
                # A run of all models excludes every other, while shards share this lock and exclude
                # only themselves. A file with a process ID would have to be doubted after a crash.
                fcntl.flock(descriptor, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise BusyError(f"another run is at work in {path.parent.parent}") from error
        yield
    finally:
        with suppress(OSError):
            os.close(descriptor)
