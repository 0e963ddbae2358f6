"""Records which files a task reads, lists or looks for, and which environment variables it reads.

Files are opened by our readers, by passes of other packages, and by mesh libraries. So nothing has to report them: the
interpreter raises an audit event for every `open` and listing. There is none for `os.stat`, `os.lstat` and
`os.readlink`, which are wrapped.
"""

import os
import stat
import sys
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import field
from functools import cache
from pathlib import Path
from typing import Any, Generic, TypeVar

from twinform.dataclass import dataclass

Key = TypeVar("Key")
Value = TypeVar("Value")
# Each place in the code could report what it reads, but passes and mesh readers of others would
# not, and one that is forgotten gives a stale result that nobody notices.
_WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT
_OPEN, _LISTINGS = "open", frozenset({"os.listdir", "os.scandir"})


@cache
def _known_by_version() -> tuple[str, ...]:
    """Python, its packages and devices: their version is part of the request, and nobody edits them."""
    import sysconfig  # noqa: PLC0415 - only runs that are observed

    folders = {
        *(sysconfig.get_path(name) for name in ("stdlib", "platstdlib", "purelib", "platlib")),
        str(Path(__file__).resolve().parents[1]),
        "/dev",
        "/proc",
        "/sys",
    }
    return tuple(f"{folder}{os.sep}" for folder in folders)


_CODE = (".py", ".pyc", ".so", ".pyd")


@dataclass(slots=True)
class Observation:
    """The files that were read, folders that were listed, and paths that were looked at, by absolute path.

    Each has its status before it was read, or None where nothing was there. `names` are paths at which was looked
    without following a link there, and what stood at each (`describe_name`). Files that are so `young` that their times
    prove nothing also have the digest of their content. Variables have their values. The task has `failed` if it did so
    for a reason that is in no file, and may end in another way the next time. `parts` belong to values that were made
    before and kept in a `Memo`.
    """

    read: dict[str, os.stat_result | None] = field(default_factory=dict[str, os.stat_result | None])
    listed: dict[str, os.stat_result | None] = field(default_factory=dict[str, os.stat_result | None])
    looked_at: dict[str, os.stat_result | None] = field(default_factory=dict[str, os.stat_result | None])
    names: dict[str, str] = field(default_factory=dict[str, str])
    young: dict[str, str] = field(default_factory=dict[str, str])
    variables: dict[str, str | None] = field(default_factory=dict[str, str | None])
    failed: bool = False
    parts: dict[int, "Observation"] = field(default_factory=dict[int, "Observation"])

    def walk(self) -> "Iterator[Observation]":
        """Yield the observation and all its parts, each once."""
        found: dict[int, Observation] = {}
        left: list[Observation] = [self]
        while left:
            here = left.pop()
            if id(here) not in found:
                found[id(here)] = here
                left.extend(here.parts.values())
                yield here

    def merged(self) -> "Observation":
        """Return one observation of all that was observed, also in the parts."""
        whole = Observation()
        for each in self.walk():
            for table in _TABLES:
                getattr(whole, table).update(getattr(each, table))
            whole.failed |= each.failed
        return whole


_TABLES = ("read", "listed", "looked_at", "names", "young", "variables")
_CURRENT: ContextVar[Observation | None] = ContextVar("observation", default=None)


@contextmanager
def observed() -> Generator[Observation]:
    """Record the files and variables that are used inside, in this thread."""
    _install()
    _known_by_version()  # importing what says so is not the work that is observed
    observation = Observation()
    token = _CURRENT.set(observation)
    try:
        yield observation
    finally:
        _CURRENT.reset(token)


class Memo(Generic[Key, Value]):
    """Values that are made when they are first asked for, and kept.

    Whoever is observed while asking for one depends on the files that it was made from, as if it were made again.
    """

    def __init__(self) -> None:
        self._known: dict[Key, tuple[Value, Observation | None]] = {}

    def get(self, key: Key, make: Callable[[], Value]) -> Value:
        """Return the value for a key."""
        asking = _CURRENT.get()
        if key in self._known:
            value, seen = self._known[key]
            if asking is None:
                return value
            if seen is not None:
                asking.parts[id(seen)] = seen
                return value
        if asking is None:
            value, seen = make(), None
        else:
            with observed() as seen:
                asking.parts[id(seen)] = seen
                value = make()
        self._known[key] = value, seen
        return value


def note_variable(name: str, value: str | None) -> None:
    """Record that an environment variable was read."""
    observation = _CURRENT.get()
    if observation is not None:
        observation.variables.setdefault(name, value)


def note_failure() -> None:
    """Record that a process died or was late, or that a file could not be read that is there."""
    observation = _CURRENT.get()
    if observation is not None:
        observation.failed = True


def note_look(path: str) -> None:
    """Record that a path was looked at in another way than by `os.stat`."""
    _note("looked_at", path, _status(path))


_STAT, _LSTAT, _READLINK = os.stat, os.lstat, os.readlink
_SECOND = 1_000_000_000
# Nanoseconds: FAT counts in steps of two seconds, NFS and HFS in steps of one.
_TICK = 2 * _SECOND
# The longest step of clocks that count fractions of seconds; that of ext4 is 4 ms.
_FINE_TICK = 20_000_000


def is_coarse(time: int) -> bool:
    """Whether a time comes from a clock of whole seconds, as far as can be seen."""
    return time % _SECOND == 0


def is_young(modified: int, changed: int, now: int) -> bool:
    """Whether a file was written so recently that it may be written again without a trace in its times."""
    return modified >= now - _TICK or changed >= now - (_TICK if is_coarse(changed) else _FINE_TICK)


def digest(content: bytes) -> str:
    """Return the SHA-256 of a content."""
    import hashlib  # noqa: PLC0415 - it loads OpenSSL, and most runs need none

    return hashlib.sha256(content).hexdigest()


def _status(path: Any) -> os.stat_result | None:
    try:
        return _STAT(path)
    except (OSError, ValueError):
        return None


@cache
def _install() -> None:
    """Listen from now on; it costs next to nothing while nothing is observed."""
    import shutil  # noqa: F401, PLC0415 # pyright: ignore[reportUnusedImport] - it looks once at what `os` can do

    sys.addaudithook(_hear)
    for able in (os.supports_dir_fd, os.supports_fd, os.supports_follow_symlinks, os.supports_effective_ids):
        if os.stat in able:
            able.add(_stat)
    os.stat, os.lstat, os.readlink = _stat, _lstat, _readlink


def _hear(event: str, arguments: tuple[Any, ...]) -> None:
    if event == _OPEN:
        path, _, flags = arguments
        if _CURRENT.get() is not None and not (isinstance(flags, int) and flags & _WRITING):
            _note("read", path)
            _note_young(path)
    elif event in _LISTINGS and _CURRENT.get() is not None and not _is_import(event, arguments[0]):
        _note("listed", arguments[0] if arguments[0] is not None else ".")


def _is_import(event: str, path: object) -> bool:
    """Whether a folder is listed by Python's import system."""
    return event == "os.listdir" and path in sys.path_importer_cache


def _stat(path: Any, *, dir_fd: int | None = None, follow_symlinks: bool = True) -> os.stat_result:
    observation = _CURRENT.get()
    if observation is None or dir_fd is not None or not follow_symlinks:
        return _STAT(path, dir_fd=dir_fd, follow_symlinks=follow_symlinks)
    try:
        status = _STAT(path)
    except OSError:
        _note("looked_at", path, None)
        raise
    _note("looked_at", path, status)
    return status


def _lstat(path: Any, *, dir_fd: int | None = None) -> os.stat_result:
    if dir_fd is None:
        _note_name(path)
    return _LSTAT(path, dir_fd=dir_fd)


def _readlink(path: Any, *, dir_fd: int | None = None) -> Any:
    if dir_fd is None:
        _note_name(path)
    return _READLINK(path, dir_fd=dir_fd)


def _note_name(path: Any) -> None:
    observation = _CURRENT.get()
    if observation is not None and path not in observation.names:  # most are absolute, and asked for again and again
        name = _absolute(path)
        if name is not None and name not in observation.names and not _is_known_by_version(name):
            observation.names[name] = describe_name(name)


def describe_name(path: str) -> str:
    """Return what stands at a path, without following a link there; empty where nothing does."""
    try:
        mode = _LSTAT(path).st_mode
        return f"link {_READLINK(path)}" if stat.S_ISLNK(mode) else str(stat.S_IFMT(mode))
    except (OSError, ValueError):
        return ""


def _note_young(path: Any) -> None:
    """Keep the digest of a file that may change while it is read without a trace in its time."""
    name, observation = _absolute(path), _CURRENT.get()
    status = observation.read.get(name) if observation and name is not None else None
    if observation is None or name is None or status is None or name in observation.young:
        return
    if stat.S_ISREG(status.st_mode) and is_young(status.st_mtime_ns, status.st_ctime_ns, time.time_ns()):
        token = _CURRENT.set(None)  # this is not the work that is observed
        try:
            observation.young[name] = digest(Path(name).read_bytes())
        except OSError:
            pass  # the work will find out
        finally:
            _CURRENT.reset(token)


_ASK: Any = object()


def _note(what: str, path: Any, status: Any = _ASK) -> None:
    observation, name = _CURRENT.get(), _absolute(path)
    if observation is None or name is None or _is_known_by_version(name):
        return
    found: dict[str, os.stat_result | None] = getattr(observation, what)
    if name not in found:
        found[name] = _status(name) if status is _ASK else status


def _is_known_by_version(name: str) -> bool:
    return name.startswith(_known_by_version()) or name.endswith(_CODE)


def _absolute(path: Any) -> str | None:
    """Return a path as an absolute one, otherwise as it was written; None for the number of an open file."""
    if path is None or isinstance(path, int):
        return None
    return os.path.join(os.getcwd(), os.fsdecode(path))  # noqa: PTH118, PTH109 - Path would change how it is written
