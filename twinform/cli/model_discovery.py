"""Finds the model files that a command line means by files, folders and globs, in a fixed order, each once."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from twinform.cli.model_files import XACRO, Exclusion, FileKind, is_model

if TYPE_CHECKING:
    from twinform.cli.path_patterns import FolderWalk

_MAGIC = frozenset("*?[")


class NothingFoundError(ValueError):
    """A folder or pattern leads to no model."""


def discover(words: Sequence[str], exclusion: Exclusion, kind: FileKind = is_model) -> list[str]:
    """Find the files that words mean: files, folders with files of a kind, and globs.

    Named files are always found, unless the exclusion is enforced. A folder that cannot be listed is returned like a
    file, so that reading it reports why.

    Raises:
        NothingFoundError: there is no model in a folder, or none that fits a glob.
        PatternError: a pattern of the exclusion is invalid.
    """
    found: dict[str, str] = {}
    for word in words:
        for name in _find(word, exclusion, kind):
            found.setdefault(name if name == "-" else os.path.abspath(name), name)  # noqa: PTH100 - links stay links
    return list(found.values())


def _find(word: str, exclusion: Exclusion, kind: FileKind) -> Iterator[str]:
    if os.path.isdir(word):  # noqa: PTH112 - Path.is_dir raises where a name is too long
        if not (exclusion.force and _is_excluded(word, exclusion, is_folder=True)):
            yield from _find_below(word, exclusion, kind)
    elif _MAGIC & set(word) and not os.path.lexists(word):
        yield from _find_fitting(word, exclusion, kind)
    elif word == "-" or not (exclusion.force and _is_unwanted(word, exclusion, kind)):
        yield word


def _is_unwanted(word: str, exclusion: Exclusion, kind: FileKind) -> bool:
    """Whether a named file is excluded, or only has macros for others."""
    is_part = word.lower().endswith(XACRO) and not kind(Path(word))
    return is_part or _is_excluded(word, exclusion)


def _is_excluded(word: str, exclusion: Exclusion, *, is_folder: bool = False) -> bool:
    from twinform.cli.path_patterns import PathPatterns  # noqa: PLC0415 - most runs enforce no exclusion

    patterns = PathPatterns.of(exclusion.folder, exclusion.patterns)
    return patterns.match(os.path.abspath(word), is_folder=is_folder)  # noqa: PTH100 - links stay links


def _find_below(folder: str, exclusion: Exclusion, kind: FileKind) -> list[str]:
    from twinform.cli.path_patterns import FolderWalk  # noqa: PLC0415 - most runs name their files

    return _walk(FolderWalk(folder, exclusion, kind=kind), f"there is no model in {folder}")


def _find_fitting(pattern: str, exclusion: Exclusion, kind: FileKind) -> list[str]:
    """Find the files that fit a glob, below the last folder that it names without a wildcard."""
    from twinform.cli.path_patterns import FolderWalk, PathPatterns  # noqa: PLC0415 - as above

    parts = Path(pattern).parts
    fixed = next(place for place, part in enumerate(parts) if _MAGIC & set(part))
    top = os.path.join(*parts[:fixed]) if fixed else "."  # noqa: PTH118 - `.` stays
    wanted = PathPatterns.of(top, [f"/{'/'.join(parts[fixed:])}"])
    return _walk(
        FolderWalk(top, exclusion, wanted, named=not set(parts[-1]) <= {"*"}, kind=kind), f"no model fits {pattern}"
    )


def _walk(walk: "FolderWalk", problem: str) -> list[str]:
    """Walk through a folder, and raise `NothingFoundError` if nothing is found."""
    found = sorted(walk.run())
    if not found:
        what = f"; {walk.left_out} are excluded or ignored by git" if walk.left_out else ""
        raise NothingFoundError(f"{problem}{what}")
    return found
