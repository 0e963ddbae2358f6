"""Suggestions for a missing file: files of nearly the same name (capitals, typos, another folder)."""

import os
from collections.abc import Iterator
from itertools import islice
from pathlib import Path
from posixpath import normpath
from urllib.parse import unquote

from twinform.compiler.search.packages import MODEL_CONFIG, package_name
from twinform.compiler.search.resolve_uris import SearchPath, UriError, exists
from twinform.diagnostics import nearest_name
from twinform.file_access import Readable, folders_around

_MOST_ENTRIES = 2000
"""Entries of a folder that are looked at."""
# Models and packages are often not on this machine at all, so only a very similar name is taken for
# the intended one.
_ALIKE = 0.75
_FEW = 3
"""Letters that are in one of two names and not in the other."""
_NAMED = frozenset({"model", "package"})
_SCHEMES = ("file", "http", "https", "model", "package")


def is_elsewhere(uri: str, search: SearchPath, beside: Path) -> bool:
    """Whether a URI leads to where nothing of this machine is: an unknown package or model, or the network."""
    scheme, separator, rest = uri.partition("://")
    if not separator:
        return False
    if scheme not in _NAMED:
        return scheme != "file" or rest.startswith("media/")  # Gazebo Classic has its own media
    name = normpath(unquote(rest)).partition("/")[0]
    return _folder(name, search, beside) is None


def near_file(uri: str, search: SearchPath, beside: Path) -> str | None:
    """The part of a path that was probably meant instead of the first one that is not there."""
    scheme, separator, rest = uri.partition("://")
    if separator and scheme not in _SCHEMES:
        near = nearest_name(scheme, _SCHEMES, _ALIKE)
        return f"{near}://" if near and _is_slip(scheme, near) else None
    path = normpath(unquote(rest)) if separator else normpath(uri)
    if scheme not in _NAMED or not separator:
        return _near_below(beside.parent, path, beside)
    name, _, inner = path.partition("/")
    folder = _folder(name, search, beside)
    if folder is None:
        near = nearest_name(name, _known(scheme, search, beside), _ALIKE)
        return near if near and _is_slip(name, near) else None
    return _near_below(folder, inner, beside)


def _is_slip(name: str, near: str) -> bool:
    """Whether no more than a letter or two differ: a longer name is mostly another model of the same family."""
    from difflib import SequenceMatcher  # noqa: PLC0415 - few files are missing

    same = sum(block.size for block in SequenceMatcher(None, name, near, autojunk=False).get_matching_blocks())
    # `ball_valve_wall` is another model and not a misspelt `ball_valve`.
    return len(name) + len(near) - 2 * same <= _FEW


def _folder(name: str, search: SearchPath, beside: Path) -> Path | None:
    try:
        return search.package(name, beside)
    except UriError:
        return None


def _near_below(folder: Path, path: str, beside: Path) -> str | None:
    """What is called nearly like the first part of a path that is not in its folder."""
    for part in path.split("/"):
        if not exists(folder / part):
            suffix = Path(part).suffix.lower()
            alike = (each for each in _entries(folder) if Path(each).suffix.lower() == suffix)
            # a file from elsewhere must learn of no names but those around it
            return nearest_name(part, alike) if Readable.of(beside).allows(folder) else None
        folder = folder / part
    return None


def _known(scheme: str, search: SearchPath, beside: Path) -> Iterator[str]:
    """The names of the packages or models around a file, and in the folders that were named."""
    around = folders_around(beside)
    if scheme == "package":
        for folder in (*search.own, *around):
            yield from filter(None, (package_name(folder), *(package_name(folder / name) for name in _folders(folder))))
        return
    for folder in (*search.own, *search.models, *around, *(each / "models" for each in around)):
        yield from (name for name in _folders(folder) if exists(folder / name / MODEL_CONFIG))


def _entries(folder: Path) -> list[str]:
    return [entry.name for entry in _scanned(folder)]


def _folders(folder: Path) -> list[str]:
    # a thousand files beside each other would be opened for each of them, as if they were folders
    return [entry.name for entry in _scanned(folder) if entry.is_dir()]


def _scanned(folder: Path) -> list[os.DirEntry[str]]:
    try:
        with os.scandir(folder) as entries:
            return [entry for entry in islice(entries, _MOST_ENTRIES) if not entry.name.startswith(".")]
    except OSError:
        return []
