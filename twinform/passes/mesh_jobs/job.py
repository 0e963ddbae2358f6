"""Jobs on one mesh file, and what comes of them, as messages of bytes: for the process that does them and the cache.

A message is the length of a JSON text in eight bytes, that text, and the bytes of files, whose lengths it has.
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
# Of all files of a message. The process that sends it may have been taken over by a mesh.
_MOST_BYTES = 2**30


class BadMessageError(ValueError):
    """Bytes that are no message, such as half of one."""


@dataclass(frozen=True, slots=True)
class MeshJob:
    """What is to be done with a mesh file: the `kind` is its format, `companions` the files that it names itself."""

    name: str
    options: Options
    kind: str
    content: bytes = field(repr=False)
    companions: Mapping[str, bytes] = field(default_factory=dict[str, bytes], repr=False)

    @property
    def size(self) -> int:
        """The bytes that are read."""
        return len(self.content) + sum(map(len, self.companions.values()))

    def to_bytes(self) -> bytes:
        """The message."""
        head = {"name": self.name, "options": dict(self.options), "kind": self.kind, "companions": [*self.companions]}
        return packed(head, [self.content, *self.companions.values()])

    @classmethod
    def read(cls, stream: BinaryIO) -> "MeshJob | None":
        """The next one of a stream; None at its end.

        Raises:
            BadMessageError: the stream ends in the middle of one.
        """
        message = unpacked(stream)
        if message is None:
            return None
        head, (content, *companions) = message
        names = cast("list[str]", head["companions"])
        options = cast("dict[str, Number]", head["options"])
        return cls(str(head["name"]), options, str(head["kind"]), content, dict(zip(names, companions, strict=True)))

    def digest(self, versions: Mapping[str, str]) -> str:
        """What a result is known by: everything that it depends on."""
        head = [self.name, sorted(self.options.items()), self.kind, sorted(self.companions), sorted(versions.items())]
        parts = [json.dumps(head).encode(), self.content, *(self.companions[name] for name in sorted(self.companions))]
        return hashlib.sha256(b"".join(hashlib.sha256(part).digest() for part in parts)).hexdigest()


@dataclass(frozen=True, slots=True)
class MeshResult:
    """What came of a job: numbers and words about it, and files, by what their names end in."""

    facts: Mapping[str, object]
    files: Mapping[str, bytes] = field(default_factory=dict[str, bytes], repr=False)
    trouble: Trouble | None = None
    message: str = ""

    def to_bytes(self) -> bytes:
        """The message."""
        head = {"facts": dict(self.facts), "files": [*self.files], "trouble": self.trouble, "message": self.message}
        return packed(head, [*self.files.values()])

    @classmethod
    def read(cls, stream: BinaryIO) -> "MeshResult":
        """The next one of a stream.

        Raises:
            BadMessageError: there is none, or half of one.
        """
        message = unpacked(stream)
        if message is None:
            raise BadMessageError("nothing came back")
        head, files = message
        facts, names = cast("dict[str, object]", head["facts"]), cast("list[str]", head["files"])
        return cls(
            facts, dict(zip(names, files, strict=True)), cast("Trouble | None", head["trouble"]), str(head["message"])
        )


def packed(head: Mapping[str, object], files: Sequence[bytes]) -> bytes:
    """A message."""
    # No pickles: the cache holds nothing that can be executed when it is read, and the process at
    # the other end may be taken over by a mesh.
    text = json.dumps({**head, "sizes": [len(each) for each in files]}).encode()
    return b"".join((len(text).to_bytes(_PREFIX, "big"), text, *files))


def unpacked(stream: BinaryIO) -> tuple[dict[str, object], list[bytes]] | None:
    """The next message of a stream; None at its end.

    Raises:
        BadMessageError: the stream ends in the middle of one, or has something else.
    """
    prefix = stream.read(_PREFIX)
    if not prefix:
        return None
    length = int.from_bytes(prefix, "big")
    if len(prefix) < _PREFIX or length > _LONGEST_TEXT:
        raise BadMessageError("no message")
    try:
        head = json.loads(_exactly(stream, length))
        sizes = [int(size) for size in head.pop("sizes")]
        if min(sizes, default=0) < 0 or sum(sizes) > _MOST_BYTES:
            raise BadMessageError("a message with too much")
        return head, [_exactly(stream, size) for size in sizes]
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise BadMessageError(str(error)) from error


def _exactly(stream: BinaryIO, count: int) -> bytes:
    found = stream.read(count)
    if len(found) < count:
        raise BadMessageError("it ends too early")
    return found
