"""Limits of resources, where the system has them: POSIX."""

import signal
import sys
from importlib import import_module
from types import FrameType
from typing import Any

from twinform.compiler.input.xacro.worker.failures import TimeUpError

MEMORY = 2**29
SECONDS = 10
"""Of processor time. The slowest real file that we know takes from one to nine, as machines are."""
_GRACE = 2
"""More seconds, to report where the time went."""
_DEEPEST = 4000
"""Frames of Python. xacro takes about ten for each macro inside a macro."""


def limit() -> None:
    """Keep whatever takes long or grows from taking the machine with it."""
    sys.setrecursionlimit(_DEEPEST)
    resource = _resource()
    if resource is None:
        return
    _set(resource, resource.RLIMIT_AS, MEMORY)
    _set(resource, resource.RLIMIT_FSIZE, 0)
    signal.signal(signal.SIGXCPU, _time_is_up)
    _set(resource, resource.RLIMIT_CPU, SECONDS, _GRACE)


def renounce_descriptors() -> bool:
    """Open no file or connection and start no process any more; whether the system holds to that."""
    resource = _resource()
    if resource is None:
        return False
    _set(resource, resource.RLIMIT_NPROC, 0)
    return _set(resource, resource.RLIMIT_NOFILE, 0)


def _resource() -> Any:
    try:
        return import_module("resource")
    except ImportError:  # Windows
        return None


def _set(resource: Any, kind: int, most: int, grace: int = 0) -> bool:
    soft, hard = (most + grace if each == resource.RLIM_INFINITY else each for each in resource.getrlimit(kind))
    try:
        resource.setrlimit(kind, (min(most, soft, hard), min(most + grace, hard)))
    except (OSError, ValueError):
        return False
    return True


def _time_is_up(signum: int, frame: FrameType | None) -> None:
    del signum, frame
    raise TimeUpError(f"the expansion takes more than {SECONDS} seconds of the processor")
