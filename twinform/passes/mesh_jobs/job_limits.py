"""How much processor time and memory a job on a mesh may take, by the size of the files that it reads."""

import mmap
from pathlib import Path

from twinform.confinement.resources import Kind, limits, set_limit

MEMORY = 4 * 2**30
"""Bytes of address space for a job once its mesh has been read."""
SECONDS = 600
"""Seconds of processor time for a job once its mesh has been read."""
_READING_MEMORY, _READING_SECONDS = 3 * 2**26, 1
"""What reading a small file may take, in bytes beyond those of the libraries and in seconds."""
# How that grows with the size. The slowest reader takes a fifth of a second for this much text.
_MEMORY_PER_BYTE, _BYTES_PER_SECOND = 16, 2**21


def reading_seconds(size: int) -> int:
    """How many seconds of processor time reading this many bytes may take."""
    return _READING_SECONDS + size // _BYTES_PER_SECOND


def limit_reading(size: int, memory: int = MEMORY) -> None:
    """Limit this process to what reading this many bytes may take; `allow_work` lifts that up to `memory` bytes."""
    set_limit("CORE", 0)
    set_limit("AS", memory)
    set_limit("CPU", SECONDS)
    # What the libraries have reserved does not count against the mesh.
    if taken := _address_space():
        _lower("AS", taken + _READING_MEMORY + _MEMORY_PER_BYTE * size)
    _lower("CPU", reading_seconds(size))


def allow_work() -> None:
    """Raise the limits of this process, once the mesh has been read, to those of a whole job."""
    resource = limits()
    if resource is not None:
        # Only once a mesh has been read: a file that takes a reader long is refused after about a
        # second, while CoACD may take ten minutes.
        for kind in (resource.RLIMIT_AS, resource.RLIMIT_CPU):
            _, hard = resource.getrlimit(kind)
            resource.setrlimit(kind, (hard, hard))


def _lower(kind: Kind, most: int) -> None:
    """Lower the soft limit of a resource, so that it can be raised again."""
    resource = limits()
    if resource is not None:
        number = getattr(resource, f"RLIMIT_{kind}")
        soft, hard = resource.getrlimit(number)
        wanted = [each for each in (most, soft, hard) if each != resource.RLIM_INFINITY]
        resource.setrlimit(number, (min(wanted), hard))


def _address_space() -> int | None:
    """How many bytes this process has reserved, including its libraries; None where the system does not say."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[0]) * mmap.PAGESIZE
    except OSError:
        return None
