"""Jobs on one mesh file and their results, as messages of bytes: for the child process and for the cache.

A message is the length of a JSON text in eight bytes, the JSON text, and the bytes of the files whose sizes it lists.
"""

from collections.abc import Mapping, Sequence
from dataclasses import field
from pathlib import Path
from typing import BinaryIO, Literal, TypeAlias, cast

from twinform.confinement.resources import Kind, limits, set_limit
from twinform.dataclass import dataclass

Number: TypeAlias = float | int | str | bool | None
Options: TypeAlias = Mapping[str, Number | Sequence[Number]]
Trouble = Literal["missing", "unreadable"]
"""Why there is no result: a library is not installed, or the mesh is no use."""

_PREFIX = 8
_LONGEST_TEXT = 2**26
# All files of a message together. The process that sends it may have been taken over by a mesh.
_MOST_BYTES = 2**30


class BadMessageError(ValueError):
    """Bytes that are not a whole message."""


@dataclass(frozen=True, slots=True)
class MeshJob:
    """A job on a mesh file: `kind` is the format of the file, `companions` the files that it names."""

    name: str
    options: Options
    kind: str
    content: bytes = field(repr=False)
    companions: Mapping[str, bytes] = field(default_factory=dict[str, bytes], repr=False)

    @property
    def size(self) -> int:
        """How many bytes a job has to read."""
        return len(self.content) + sum(map(len, self.companions.values()))

    def to_bytes(self) -> bytes:
        """The job as a message."""
        head = {"name": self.name, "options": dict(self.options), "kind": self.kind, "companions": [*self.companions]}
        return pack_message(head, [self.content, *self.companions.values()])

    @classmethod
    def read(cls, stream: BinaryIO) -> "MeshJob | None":
        """Read the next job of a stream; None at the end of the stream.

        Raises:
            BadMessageError: the stream ends in the middle of a message.
        """
        message = unpack_message(stream)
        if message is None:
            return None
        head, (content, *companions) = message
        names = cast("list[str]", head["companions"])
        options = cast("dict[str, Number]", head["options"])
        return cls(str(head["name"]), options, str(head["kind"]), content, dict(zip(names, companions, strict=True)))

    def digest(self, versions: Mapping[str, str]) -> str:
        """A digest of everything that the result depends on: the job, and the versions of the libraries."""
        import hashlib  # noqa: PLC0415 - most models have no meshes to open
        import json  # noqa: PLC0415 - as above

        head = [self.name, sorted(self.options.items()), self.kind, sorted(self.companions), sorted(versions.items())]
        parts = [json.dumps(head).encode(), self.content, *(self.companions[name] for name in sorted(self.companions))]
        return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()


@dataclass(frozen=True, slots=True)
class MeshResult:
    """The result of a job: facts about the mesh, and files by the endings of their names."""

    facts: Mapping[str, object]
    files: Mapping[str, bytes] = field(default_factory=dict[str, bytes], repr=False)
    trouble: Trouble | None = None
    message: str = ""

    def to_bytes(self) -> bytes:
        """The result as a message."""
        head = {"facts": dict(self.facts), "files": [*self.files], "trouble": self.trouble, "message": self.message}
        return pack_message(head, [*self.files.values()])

    @classmethod
    def read(cls, stream: BinaryIO) -> "MeshResult":
        """Read the next result of a stream.

        Raises:
            BadMessageError: the stream ends before or in the middle of the message.
        """
        message = unpack_message(stream)
        if message is None:
            raise BadMessageError("nothing came back")
        head, files = message
        facts, names = cast("dict[str, object]", head["facts"]), cast("list[str]", head["files"])
        return cls(
            facts, dict(zip(names, files, strict=True)), cast("Trouble | None", head["trouble"]), str(head["message"])
        )


def pack_message(head: Mapping[str, object], files: Sequence[bytes]) -> bytes:
    """Join a head and files to a message."""
    import json  # noqa: PLC0415 - as above

    # No pickles: the cache holds nothing that can be executed when it is read, and the process at
    # the other end may be taken over by a mesh.
    text = json.dumps({**head, "sizes": [len(each) for each in files]}).encode()
    return b"".join((len(text).to_bytes(_PREFIX, "big"), text, *files))


def unpack_message(stream: BinaryIO) -> tuple[dict[str, object], list[bytes]] | None:
    """Read the next message of a stream: its head and its files; None at the end of the stream.

    Raises:
        BadMessageError: the stream ends in the middle of a message, or has something else.
    """
    import json  # noqa: PLC0415 - as above

    prefix = stream.read(_PREFIX)
    if not prefix:
        return None
    length = int.from_bytes(prefix, "big")
    if len(prefix) < _PREFIX or length > _LONGEST_TEXT:
        raise BadMessageError("no message")
    try:
        head = json.loads(_read_exactly(stream, length))
        sizes = [int(size) for size in head.pop("sizes")]
        if min(sizes, default=0) < 0 or sum(sizes) > _MOST_BYTES:
            raise BadMessageError("a message with too much")
        return head, [_read_exactly(stream, size) for size in sizes]
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise BadMessageError(str(error)) from error


def _read_exactly(stream: BinaryIO, count: int) -> bytes:
    """Read that many bytes, or raise BadMessageError."""
    found = stream.read(count)
    if len(found) < count:
        raise BadMessageError("it ends too early")
    return found


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
    import mmap  # noqa: PLC0415 - as above

    try:
        return int(Path("/proc/self/statm").read_text().split()[0]) * mmap.PAGESIZE
    except OSError:
        return None
