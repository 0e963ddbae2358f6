"""The files that a command is given; `-` is standard input."""

import stat
import sys
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.input.size_limits import LARGEST
from twinform.file_access import STREAMS, Readable, read_up_to

# Bytes that contain the root element of every file, except those that begin with a very long
# comment.
_ENOUGH = 2**16

_FORMATS = {b"robot": "urdf", b"sdf": "sdf"}
_SUFFIXES = {".urdf": "urdf", ".sdf": "sdf", ".world": "sdf", ".json": "json"}
_SKIPPED = ((b"<!--", b"-->"), (b"<?", b"?>"), (b"<!", b">"))
"""What may stand before the root element: beginnings and ends."""

_STDIN = "<stdin>"

_NAME_END = b" \t\r\n/>"


class InputSource(NamedTuple):
    """A file by its path, or the bytes of standard input, under the name that messages use."""

    content: str | bytes
    name: str

    @property
    def path(self) -> Path:
        """The file; that of standard input may be one too, where the shell has opened it."""
        return Path("/dev/stdin" if self.name == _STDIN else self.name)

    @property
    def format(self) -> str | None:
        """`urdf`, `sdf` or `json`, by a look at the beginning and then at the suffix; None where neither tells."""
        head = self.content[:_ENOUGH] if isinstance(self.content, bytes) else _head(Path(self.content))
        if head.lstrip()[:1] == b"{":
            return "json"
        return _FORMATS.get(_root_name(head)) or format_of_suffix(self.name)


def open_source(argument: str, size: int = LARGEST) -> InputSource:
    """The source that an argument names; streams are read here, of what is too large a part."""
    if argument == "-":
        return InputSource(read_up_to(sys.stdin.buffer, size), _STDIN)
    if _is_stream(argument):
        with Path(argument).open("rb") as pipe:
            return InputSource(read_up_to(pipe, size), argument)
    return InputSource(argument, argument)


def _is_stream(argument: str) -> bool:
    """Whether it is a pipe or device that was named as one: `/dev/stdin`, or `<(xacro robot.urdf.xacro)` in a shell.

    One of another name may be a trap in somebody's folder: nobody ever writes into it, or a link leads to it.
    """
    if not argument.startswith(STREAMS):
        return False
    try:
        mode = Path(argument).stat().st_mode
    except (OSError, ValueError):
        return False  # the compiler reports it
    return stat.S_ISFIFO(mode) or stat.S_ISCHR(mode)


def format_of_suffix(name: str) -> str | None:
    """The format that a file of this name has by custom; `robot.urdf.xacro` is URDF."""
    path = Path(name)
    suffix = path.suffix.lower()
    return _SUFFIXES.get(Path(path.stem).suffix.lower() if suffix == ".xacro" else suffix)


def _head(path: Path) -> bytes:
    try:
        return Readable.of(path).read(path, _ENOUGH)[:_ENOUGH]
    except (OSError, ValueError):
        return b""  # the compiler reports it


def _root_name(text: bytes) -> bytes:
    """The name in the first tag that is no comment, declaration or instruction."""
    at = text.find(b"<")
    while at >= 0:
        end = next((end for start, end in _SKIPPED if text.startswith(start, at)), None)
        if end is None:
            return _name_at(text, at + 1)
        past = text.find(end, at)
        at = text.find(b"<", past) if past >= 0 else -1
    return b""


def _name_at(text: bytes, start: int) -> bytes:
    end = start
    while end < len(text) and text[end] not in _NAME_END:
        end += 1
    return text[start:end]
