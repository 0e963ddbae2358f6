"""Jobs on one mesh file and their results, as messages of bytes: for the child process and for the cache.

A message is the length of a JSON text in eight bytes, the JSON text, and the bytes of the files whose sizes it lists.
"""

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import BinaryIO, Literal, TypeAlias, cast

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
    # No pickles: the cache holds nothing that can be executed when it is read, and the process at
    # the other end may be taken over by a mesh.
    text = json.dumps({**head, "sizes": [len(each) for each in files]}).encode()
    return b"".join((len(text).to_bytes(_PREFIX, "big"), text, *files))


def unpack_message(stream: BinaryIO) -> tuple[dict[str, object], list[bytes]] | None:
    """Read the next message of a stream: its head and its files; None at the end of the stream.

    Raises:
        BadMessageError: the stream ends in the middle of a message, or has something else.
    """
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
