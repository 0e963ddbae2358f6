"""Who wants to know which mesh is being worked on: passes print nothing, and a large mesh takes minutes."""

from collections.abc import Callable, Generator
from contextlib import contextmanager
from contextvars import ContextVar

Watcher = Callable[[str | None], None]
"""Is told the URI of the mesh that work begins on, and None when it is done."""

_watcher: ContextVar[Watcher | None] = ContextVar("mesh_watcher", default=None)


@contextmanager
def watched_by(watcher: Watcher) -> Generator[None]:
    """Tell somebody, as long as this lasts."""
    token = _watcher.set(watcher)
    try:
        yield
    finally:
        _watcher.reset(token)


@contextmanager
def working_on(uri: str) -> Generator[None]:
    """Say what is being worked on."""
    watcher = _watcher.get()
    if watcher is None:
        yield
        return
    watcher(uri)
    try:
        yield
    finally:
        watcher(None)
