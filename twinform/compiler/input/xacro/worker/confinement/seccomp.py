"""seccomp: a process of Linux gives up all system calls but those that calculating takes.

What is left is reading and writing what is open, memory that no code can run in, the clock, signals and the end. The
filter is a program for the BPF machine of the kernel; every other call fails with "operation not permitted".
"""

import ctypes
import os
import sys
from collections.abc import Iterator

_SET_SECCOMP, _FILTER = 22, 2
_NO_NEW_PRIVILEGES = 38
_LOAD, _JUMP_IF_EQUAL, _JUMP_IF_SET, _RETURN = 0x20, 0x15, 0x45, 0x06
_NUMBER, _ARCHITECTURE, _THIRD_ARGUMENT = 0, 4, 32
"""Where they stand in `struct seccomp_data`."""
_ALLOW, _DENY = 0x7FFF0000, 0x00050001
_EXECUTABLE = 0x4

ARCHITECTURES = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
CALLS = {
    "read": (0, 63), "write": (1, 64), "close": (3, 57), "fstat": (5, 80), "lseek": (8, 62),
    "munmap": (11, 215), "brk": (12, 214), "mremap": (25, 216), "madvise": (28, 233),
    "rt_sigaction": (13, 134), "rt_sigprocmask": (14, 135), "rt_sigreturn": (15, 139), "sigaltstack": (131, 132),
    "getpid": (39, 172), "gettid": (186, 178), "futex": (202, 98), "restart_syscall": (219, 128),
    "gettimeofday": (96, 169), "clock_gettime": (228, 113), "getrandom": (318, 278),
    "exit": (60, 93), "exit_group": (231, 94),
}  # fmt: skip
"""What is allowed, by its numbers on these two machines."""
MAPPING_CALLS = {"mmap": (9, 222), "mprotect": (10, 226)}
"""What is allowed for memory that is not executable."""


class _Instruction(ctypes.Structure):
    _fields_ = (
        ("code", ctypes.c_uint16),
        ("if_true", ctypes.c_uint8),
        ("if_false", ctypes.c_uint8),
        ("value", ctypes.c_uint32),
    )


class _Program(ctypes.Structure):
    _fields_ = (("length", ctypes.c_uint16), ("instructions", ctypes.POINTER(_Instruction)))


def renounce_calls() -> bool:
    """Make no system calls any more but those of the list; whether the kernel holds to that."""
    if not sys.platform.startswith("linux") or sys.maxsize < 2**32:
        return False
    machine = os.uname().machine
    if machine not in ARCHITECTURES:
        return False
    instructions = [_Instruction(*each) for each in program(machine)]
    array = (_Instruction * len(instructions))(*instructions)
    loaded = _Program(len(instructions), array)
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0) != 0:
        return False
    return libc.prctl(_SET_SECCOMP, _FILTER, ctypes.byref(loaded), 0, 0) == 0


def program(machine: str) -> Iterator[tuple[int, int, int, int]]:
    """The program: code, how many instructions to skip if true and if not, value."""
    column = list(ARCHITECTURES).index(machine)
    plain = [numbers[column] for numbers in CALLS.values()]
    mapping = [numbers[column] for numbers in MAPPING_CALLS.values()]
    calls = len(plain) + len(mapping)
    yield _LOAD, 0, 0, _ARCHITECTURE
    yield _JUMP_IF_EQUAL, 0, calls + 1, ARCHITECTURES[machine]
    yield _LOAD, 0, 0, _NUMBER
    for place, number in enumerate(mapping):
        yield _JUMP_IF_EQUAL, calls - place, 0, number
    for place, number in enumerate(plain):
        yield _JUMP_IF_EQUAL, len(plain) - place + 2, 0, number
    yield _RETURN, 0, 0, _DENY
    yield _LOAD, 0, 0, _THIRD_ARGUMENT
    yield _JUMP_IF_SET, 1, 0, _EXECUTABLE
    yield _RETURN, 0, 0, _ALLOW
    yield _RETURN, 0, 0, _DENY
