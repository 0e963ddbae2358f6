"""What the operating system holds the process that expands xacro to, whatever runs in it.

Three layers beneath the interpreter, each where the system has it, and none that the process can take back:

* limits of resources (POSIX): memory, time, no writing, and once the task has been heard no new file, connection or
  process;
* Landlock (Linux from 5.13 on): nothing in the file system, no TCP, no signals to others;
* seccomp (Linux on x86-64 and AArch64): no system calls but those of a process that calculates and talks through the
  pipes that it has.
"""

from importlib import import_module

from twinform.compiler.input.xacro.worker.confinement.resources import limit, renounce_descriptors

__all__ = ["confine", "limit"]


def confine() -> list[str]:
    """Give up everything but calculating and the open pipes; the names of the layers that hold from here on."""
    layers = {"resources": renounce_descriptors}
    try:
        landlock = import_module("twinform.compiler.input.xacro.worker.confinement.landlock")
        seccomp = import_module("twinform.compiler.input.xacro.worker.confinement.seccomp")
        # in this order: a ruleset needs a descriptor, and limits need a system call
        layers = {"landlock": landlock.renounce_files, **layers, "seccomp": seccomp.renounce_calls}
    except ImportError:
        pass  # a Python without ctypes
    return [name for name, renounce in layers.items() if renounce()]
