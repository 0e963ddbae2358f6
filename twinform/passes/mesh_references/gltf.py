"""Buffers and images that a glTF file names, in its text form and in the binary one (GLB)."""

import json
import struct
from collections.abc import Iterator, Mapping
from typing import Any, cast
from urllib.parse import quote, unquote

_HEADER = struct.Struct("<4sII")
_CHUNK = struct.Struct("<I4s")
_DATA = "data:"
"""What is in the file itself begins so."""


def references(data: bytes) -> list[str]:
    """The files that a glTF file names.

    Raises:
        ValueError: it is no glTF file.
    """
    return list(dict.fromkeys(unquote(part["uri"]) for part in _parts(_object(data))))


def rewritten(data: bytes, files: Mapping[str, str]) -> bytes:
    """A glTF file with other names of files."""
    whole = _object(data)
    for part in _parts(whole):
        name = unquote(part["uri"])
        part["uri"] = quote(files.get(name, name))
    return json.dumps(whole, ensure_ascii=False, separators=(",", ":")).encode()


def references_of_binary(data: bytes) -> list[str]:
    """The files that a GLB file names; most have all inside.

    Raises:
        ValueError: it is no GLB file.
    """
    return references(_json_chunk(data)[0])


def rewritten_binary(data: bytes, files: Mapping[str, str]) -> bytes:
    """A GLB file with other names of files."""
    content, end = _json_chunk(data)
    new = rewritten(content, files)
    new += b" " * (-len(new) % 4)
    chunk = _CHUNK.pack(len(new), b"JSON") + new
    magic, version, _ = _HEADER.unpack_from(data)
    return _HEADER.pack(magic, version, _HEADER.size + len(chunk) + len(data) - end) + chunk + data[end:]


def _json_chunk(data: bytes) -> tuple[bytes, int]:
    """The description in a GLB file, and where it ends."""
    start = _HEADER.size + _CHUNK.size
    if len(data) < start or data[:4] != b"glTF":
        raise ValueError("it does not begin as a GLB file does")
    length, kind = _CHUNK.unpack_from(data, _HEADER.size)
    if kind != b"JSON" or start + length > len(data):
        raise ValueError("its first part is no JSON")
    return data[start : start + length], start + length


def _object(data: bytes) -> dict[str, Any]:
    try:
        whole: object = json.loads(data)
    except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
        raise ValueError(f"it is no glTF file: {error}") from error
    if not isinstance(whole, dict):
        raise ValueError("it is no glTF file: it has no object")  # noqa: TRY004 - the file is wrong, not a type of ours
    return cast("dict[str, Any]", whole)


def _parts(whole: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The buffers and images that are other files."""
    for name in ("buffers", "images"):
        found = whole.get(name)
        for part in cast("list[object]", found) if isinstance(found, list) else ():
            if isinstance(part, dict):
                entry = cast("dict[str, Any]", part)
                if isinstance(entry.get("uri"), str) and not entry["uri"].startswith(_DATA):
                    yield entry
