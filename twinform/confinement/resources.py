"""Limits of resources, where the system has them: POSIX."""

from importlib import import_module
from typing import Any, Literal

Kind = Literal["AS", "CORE", "CPU", "FSIZE", "NOFILE", "NPROC"]
"""A limit, by the end of its name in `resource`."""


DESCRIPTORS = 64
"""How many descriptors a process has that may open what is in memory."""


# A limit of zero for file sizes also stops writing through descriptors that are already open, and
# one of zero for descriptors makes every new `open`, `socket` and `pipe` fail.
def renounce_descriptors(*, threads: bool = False, opens: bool = False) -> bool:
    """Give up opening files and connections and starting processes; returns whether the system enforces it."""
    set_limit("FSIZE", 0)
    if not threads:  # which count as processes
        set_limit("NPROC", 0)
    return set_limit("NOFILE", DESCRIPTORS if opens else 0)


def set_limit(kind: Kind, most: int, grace: int = 0) -> bool:
    """Set a limit, and how far it may be raised again, unless it is stricter already; returns whether it exists."""
    resource = limits()
    if resource is None:
        return False
    number = getattr(resource, f"RLIMIT_{kind}")
    soft, hard = (most + grace if each == resource.RLIM_INFINITY else each for each in resource.getrlimit(number))
    try:
        resource.setrlimit(number, (min(most, soft, hard), min(most + grace, hard)))
    except (OSError, ValueError):
        return False
    return True


def limits() -> Any:
    """Return the module `resource`; None if the system has no such limits."""
    try:
        return import_module("resource")
    except ImportError:  # Windows
        return None
