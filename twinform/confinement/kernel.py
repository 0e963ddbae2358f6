"""What the kernel of Linux takes from a process for good: the file system (Landlock), and system calls (seccomp).

The numbers of Landlock are those of `linux/landlock.h`; its three system calls have the same numbers on all machines.
What seccomp leaves is reading and writing what is open, memory that no code can run in, the clock, signals and the end.
The filter is a program for the BPF machine of the kernel; every other call fails with "operation not permitted".
"""

import ctypes
import os
import sys
from collections.abc import Iterator

_SET_SECCOMP, _FILTER = 22, 2
_NO_NEW_PRIVILEGES = 38
_LOAD, _JUMP_IF_EQUAL, _JUMP_IF_SET, _RETURN = 0x20, 0x15, 0x45, 0x06
_NUMBER, _ARCHITECTURE, _FIRST_ARGUMENT, _THIRD_ARGUMENT = 0, 4, 16, 32
"""Where they stand in `struct seccomp_data`."""
_ALLOW, _DENY, _UNKNOWN = 0x7FFF0000, 0x00050001, 0x00050026
_EXECUTABLE = 0x4
_THREAD = 0x10000

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
THREAD_CALLS = {
    "set_robust_list": (273, 99), "rseq": (334, 293), "sched_yield": (24, 124), "sched_getaffinity": (204, 123),
    "clock_nanosleep": (230, 115), "set_tid_address": (218, 96), "prlimit64": (302, 261),
}  # fmt: skip
"""What threads take besides: in their beginning, while they wait, and to know how large a stack is."""
OPENING_CALLS = {"openat": (257, 56), "stat": (4, 79), "lstat": (6, 79), "newfstatat": (262, 79), "readlink": (89, 78)}
"""What opening a file by its name takes; the second machine has one call for three of them."""
_CLONE, _CLONE3 = (56, 220), (435, 435)


class _Instruction(ctypes.Structure):
    _fields_ = (
        ("code", ctypes.c_uint16),
        ("if_true", ctypes.c_uint8),
        ("if_false", ctypes.c_uint8),
        ("value", ctypes.c_uint32),
    )


class _Program(ctypes.Structure):
    _fields_ = (("length", ctypes.c_uint16), ("instructions", ctypes.POINTER(_Instruction)))


def renounce_calls(*, threads: bool = False, opens: bool = False) -> bool:
    """Give up all system calls but the listed ones; returns whether the kernel enforces it."""
    if not sys.platform.startswith("linux") or sys.maxsize < 2**32:
        return False
    machine = os.uname().machine
    if machine not in ARCHITECTURES:
        return False
    instructions = [_Instruction(*each) for each in program(machine, threads=threads, opens=opens)]
    array = (_Instruction * len(instructions))(*instructions)
    loaded = _Program(len(instructions), array)
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0) != 0:
        return False
    return libc.prctl(_SET_SECCOMP, _FILTER, ctypes.byref(loaded), 0, 0) == 0


def program(machine: str, *, threads: bool = False, opens: bool = False) -> Iterator[tuple[int, int, int, int]]:
    """Assemble the filter: code, instructions to skip if true and if false, value."""
    column = list(ARCHITECTURES).index(machine)
    calls = CALLS | (THREAD_CALLS if threads else {}) | (OPENING_CALLS if opens else {})
    plain = [numbers[column] for numbers in calls.values()]
    # The architecture comes first: numbers mean other calls in another ABI (seccomp(2)).
    yield _LOAD, 0, 0, _ARCHITECTURE
    yield _JUMP_IF_EQUAL, 1, 0, ARCHITECTURES[machine]
    yield _RETURN, 0, 0, _DENY
    yield _LOAD, 0, 0, _NUMBER
    if threads:
        # its flags lie in memory, which no filter reads; the C library takes the older call where there is none
        yield from _if_called(_CLONE3[column], [(_RETURN, 0, 0, _UNKNOWN)])
        yield from _if_called(_CLONE[column], _only_if(_FIRST_ARGUMENT, _THREAD, right=True))
    for numbers in MAPPING_CALLS.values():
        yield from _if_called(numbers[column], _only_if(_THIRD_ARGUMENT, _EXECUTABLE, right=False))
    for number in plain:
        yield from _if_called(number, [(_RETURN, 0, 0, _ALLOW)])
    yield _RETURN, 0, 0, _DENY


def _if_called(number: int, then: list[tuple[int, int, int, int]]) -> Iterator[tuple[int, int, int, int]]:
    """Return what to do if the loaded call number is this one."""
    yield _JUMP_IF_EQUAL, 0, len(then), number
    yield from then


def _only_if(argument: int, flag: int, *, right: bool) -> list[tuple[int, int, int, int]]:
    """Allow a call only if a flag of one of its arguments is set, or only if it is not."""
    allowed, denied = (_RETURN, 0, 0, _ALLOW), (_RETURN, 0, 0, _DENY)
    first, second = (allowed, denied) if right else (denied, allowed)
    return [(_LOAD, 0, 0, argument), (_JUMP_IF_SET, 0, 1, flag), first, second]


_CREATE_RULESET, _RESTRICT_SELF = 444, 446
_ASK_VERSION = 1
_FILES = {1: 0x1FFF, 2: 0x3FFF, 3: 0x7FFF, 5: 0xFFFF}
"""Kinds of access to files that there are from a version on, one bit each."""
_CONNECTIONS = {4: 0x3}
_SCOPES = {6: 0x3}


class _Ruleset(ctypes.Structure):
    _fields_ = (("files", ctypes.c_uint64), ("connections", ctypes.c_uint64), ("scopes", ctypes.c_uint64))


def renounce_files() -> bool:
    """Give up opening, listing, making and deleting files; returns whether the kernel enforces it."""
    if not sys.platform.startswith("linux"):
        return False
    libc = ctypes.CDLL(None, use_errno=True)
    version = libc.syscall(_CREATE_RULESET, None, ctypes.c_size_t(0), ctypes.c_uint32(_ASK_VERSION))
    if version < 1:
        return False
    # no rules are added: all that is handled is denied
    ruleset = _Ruleset(_known(_FILES, version), _known(_CONNECTIONS, version), _known(_SCOPES, version))
    size = ctypes.c_size_t(ctypes.sizeof(ruleset))
    descriptor = libc.syscall(_CREATE_RULESET, ctypes.byref(ruleset), size, ctypes.c_uint32(0))
    # Without this flag an unprivileged process may not restrict itself (landlock(7)).
    if descriptor < 0 or libc.prctl(_NO_NEW_PRIVILEGES, 1, 0, 0, 0) != 0:
        return False
    return libc.syscall(_RESTRICT_SELF, ctypes.c_int(descriptor), ctypes.c_uint32(0)) == 0


def _known(kinds: dict[int, int], version: int) -> int:
    return next((bits for since, bits in sorted(kinds.items(), reverse=True) if version >= since), 0)
