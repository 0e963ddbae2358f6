"""Landlock: a process of Linux gives up the file system for good.

The numbers are those of `linux/landlock.h`; the three system calls have the same numbers on all machines.
"""

import ctypes
import sys

_CREATE_RULESET, _RESTRICT_SELF = 444, 446
_ASK_VERSION = 1
_NO_NEW_PRIVILEGES = 38
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
