"""Endings of files, and the name of the root element, which tells MJCF from all else that is called `.xml`."""

from pathlib import Path, PurePath
from typing import Literal, TypeVar

AnyPath = TypeVar("AnyPath", bound=PurePath)

ENOUGH = 2**16
"""Bytes that contain the root element of every file, except those that begin with a very long comment."""
MJCF = (".mjcf", ".xml")
"""Endings of MJCF; of `.xml` only where the root element says so."""
FORMATS: dict[str, Literal["urdf", "sdf", "mjcf", "json"]] = {
    ".urdf": "urdf", ".sdf": "sdf", ".world": "sdf", ".mjcf": "mjcf", ".json": "json",
}  # fmt: skip
"""The format of a file by its ending, where that says it."""
_MODELS = frozenset({*FORMATS, *MJCF, ".xacro"})

_SKIPPED = ((b"<!--", b"-->"), (b"<?", b"?>"), (b"<!", b">"))
"""What may stand before the root element: beginnings and ends."""
_NAME_END = b" \t\r\n/>"


def root_name(text: bytes) -> bytes:
    """Return the name of the root element, behind comments, declarations and instructions; empty if there is none."""
    at = text.find(b"<")
    while at >= 0:
        end = next((end for start, end in _SKIPPED if text.startswith(start, at)), None)
        if end is None:
            return _name_at(text, at + 1)
        past = text.find(end, at)
        at = text.find(b"<", past) if past >= 0 else -1
    return b""


def without_endings(path: AnyPath) -> AnyPath:
    """Return a path without the endings of models: `robot` for `robot.urdf.xacro`."""
    while path.suffix.lower() in _MODELS and path.stem:
        path = path.with_suffix("")
    return path


def may_be_mjcf(name: str) -> bool:
    """Whether a file may be MJCF by its name."""
    return name.lower().endswith(MJCF)


def is_mjcf(path: Path) -> bool:
    """Whether a file is MJCF or a part of it: it is called `.mjcf`, or `.xml` and has the root `<mujoco>`."""
    name = path.name.lower()
    return name.endswith(".mjcf") or (name.endswith(".xml") and root_name(_start(path)) == b"mujoco")


def _start(path: Path) -> bytes:
    from twinform.file_access import Readable  # noqa: PLC0415 - few names leave it open

    try:
        return Readable.of(path).read(path, _LITTLE)[:_LITTLE]
    except (OSError, ValueError):
        return b""


# Folders have many files called .xml that are none of ours.
_LITTLE = 2**13


def _name_at(text: bytes, start: int) -> bytes:
    end = start
    while end < len(text) and text[end] not in _NAME_END:
        end += 1
    return text[start:end]
