"""URIs of documents: the file that one stands for, or the name of a document that is no file of this machine."""

import os
import re
from pathlib import Path
from urllib.parse import unquote_to_bytes, urlsplit

_LONGEST_PATH = 4095
_LONGEST_NAME = 255
"""What Linux takes, in bytes."""
_PROCESSES = Path("/proc")
_UNFIT = re.compile(r"[^\w.+-]+")
_SHOWN = 100


def file_of(uri: str) -> Path | None:
    """The file of this machine that a URI stands for, whether it exists or not; None where it stands for none."""
    try:
        parts = urlsplit(uri)
        data = unquote_to_bytes(parts.path)
    except ValueError:  # brackets without an address in them, or half a character
        return None
    if parts.scheme != "file" or parts.netloc not in {"", "localhost"} or not _is_path(data):
        return None
    path = Path(os.fsdecode(data))
    # another process sees other files there, also through /dev/stdin and /dev/fd: a check would read something else
    return None if path.resolve().is_relative_to(_PROCESSES) else path


def path_of(uri: str) -> Path:
    """The file that a URI stands for, or else a name like that in the URI, which no file needs to have."""
    return file_of(uri) or Path(_name_of(uri))


def uri_of(path: Path) -> str:
    """The URI of a file."""
    return path.absolute().as_uri()


def _is_path(data: bytes) -> bool:
    is_short = len(data) <= _LONGEST_PATH and all(len(name) <= _LONGEST_NAME for name in data.split(b"/"))
    return data.startswith(b"/") and b"\0" not in data and is_short


def _name_of(uri: str) -> str:
    """The end of a URI, in which the kind of the file is."""
    return _UNFIT.sub("_", uri[-_SHOWN:].rpartition("/")[2]).lstrip(".") or "untitled"
