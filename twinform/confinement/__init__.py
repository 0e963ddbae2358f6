"""What the operating system holds a process to that reads what may be anybody's, whatever runs in it.

Three layers beneath it, each where the system has it, and none that the process can take back:

* limits of resources (POSIX): no writing, and no new file, connection or process;
* Landlock (Linux from 5.13 on): nothing in the file system, no TCP, no signals to others;
* seccomp (Linux on x86-64 and AArch64): no system calls but those of a process that calculates and talks through the
  pipes that it has.

It stands below all rooms and needs nothing of them: the process that expands xacro imports no other package of ours.
"""

import signal
import sys
from importlib import import_module

from twinform.confinement.resources import renounce_descriptors

__all__ = ["confine"]


def confine(*, threads: bool = False, opens: bool = False) -> list[str]:
    """Give up everything but computing and the open pipes; returns the names of the layers in force.

    With `threads` more of them may begin, which libraries for numbers do. With `opens` the process may ask for files,
    and Landlock alone refuses those of the file system: what is in memory has a name below `/proc/self/fd`.
    """
    # All three layers work through `ctypes` and need no dependency. Where a kernel lacks one, the
    # others hold. Python's audit hooks are no substitute: their documentation says that they are no
    # sandbox, and an expression reached the hook's own list.
    layers = {"resources": lambda: renounce_descriptors(threads=threads, opens=opens)}
    try:
        kernel = import_module("twinform.confinement.kernel")
        # in this order: a ruleset needs a descriptor, and limits need a system call
        layers = {
            "landlock": kernel.renounce_files,
            **layers,
            "seccomp": lambda: kernel.renounce_calls(threads=threads, opens=opens),
        }
    except ImportError:
        pass  # a Python without ctypes
    return [name for name, renounce in layers.items() if renounce()]


_SET_PARENT_DEATH_SIGNAL = 1


def end_with_parent() -> None:
    """Let the system kill this process when the thread that started it ends; only Linux does that."""
    if not sys.platform.startswith("linux"):
        return
    try:
        import ctypes  # noqa: PLC0415 - a Python may be without it
    except ImportError:
        return
    ctypes.CDLL(None).prctl(_SET_PARENT_DEATH_SIGNAL, signal.SIGKILL, 0, 0, 0)
