"""What one job on a mesh may cost: time of the processor and memory, by the size of what is read."""

import mmap
from pathlib import Path

from twinform.confinement.resources import Kind, limits, set_limit

MEMORY = 4 * 2**30
"""Bytes of address space for the work on a mesh that has been read."""
SECONDS = 600
"""Of processor time, for the same."""
_READING_MEMORY, _READING_SECONDS = 3 * 2**26, 1
"""What reading a small file may take beside the libraries."""
# How that grows with the size. The slowest reader takes a fifth of a second for this much text.
_MEMORY_PER_BYTE, _BYTES_PER_SECOND = 16, 2**21


def reading_seconds(size: int) -> int:
    """The seconds that reading so many bytes may take."""
    return _READING_SECONDS + size // _BYTES_PER_SECOND


def limit_reading(size: int, memory: int = MEMORY) -> None:
    """Hold this process to what reading so many bytes may take; `allow_work` lifts it up to `memory` bytes."""
    set_limit("CORE", 0)
    set_limit("AS", memory)
    set_limit("CPU", SECONDS)
    # What the libraries have reserved does not count against the mesh.
    if taken := _address_space():
        _lower("AS", taken + _READING_MEMORY + _MEMORY_PER_BYTE * size)
    _lower("CPU", reading_seconds(size))


def allow_work() -> None:
    """Let the work on what has been read take more than reading it."""
    resource = limits()
    if resource is not None:
        # Only once a mesh has been read: a file that takes a reader long is refused after about a
        # second, while CoACD may take ten minutes.
        for kind in (resource.RLIMIT_AS, resource.RLIMIT_CPU):
            _, hard = resource.getrlimit(kind)
            resource.setrlimit(kind, (hard, hard))


def _lower(kind: Kind, most: int) -> None:
    """Lower a limit so that it can be raised again."""
    resource = limits()
    if resource is not None:
        number = getattr(resource, f"RLIMIT_{kind}")
        soft, hard = resource.getrlimit(number)
        wanted = [each for each in (most, soft, hard) if each != resource.RLIM_INFINITY]
        resource.setrlimit(number, (min(wanted), hard))


def _address_space() -> int | None:
    """The bytes that this process has reserved, libraries among them; None where the system does not say."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[0]) * mmap.PAGESIZE
    except OSError:
        return None
