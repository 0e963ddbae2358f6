"""From the words of a command line to the files that they mean, in a fixed order, each once."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from twinform.cli.files.exclusion import Exclusion
from twinform.cli.files.model_files import XACRO, FileKind, is_model

if TYPE_CHECKING:
    from twinform.cli.files.walking import FolderWalk

_MAGIC = frozenset("*?[")


class NothingFoundError(ValueError):
    """A folder or pattern leads to no model."""


def discover(words: Sequence[str], exclusion: Exclusion, kind: FileKind = is_model) -> list[str]:
    """What files, folders and globs mean, where folders hold files of this kind.

    Named files are always meant, unless the exclusion is enforced.

    A folder that cannot be listed is among the files: whoever reads it says why.

    Raises:
        NothingFoundError: there is no model in a folder, or none that a pattern fits.
        PatternError: the exclusion has a pattern that is none.
    """
    found: dict[str, str] = {}
    for word in words:
        for name in _meant(word, exclusion, kind):
            found.setdefault(name if name == "-" else os.path.abspath(name), name)  # noqa: PTH100 - links stay links
    return list(found.values())


def _meant(word: str, exclusion: Exclusion, kind: FileKind) -> Iterator[str]:
    if os.path.isdir(word):  # noqa: PTH112 - Path.is_dir raises where a name is too long
        if not (exclusion.force and _is_excluded(word, exclusion, is_folder=True)):
            yield from _below(word, exclusion, kind)
    elif _MAGIC & set(word) and not os.path.lexists(word):
        yield from _fitting(word, exclusion, kind)
    elif word == "-" or not (exclusion.force and _is_unwanted(word, exclusion, kind)):
        yield word


def _is_unwanted(word: str, exclusion: Exclusion, kind: FileKind) -> bool:
    """Whether a file that is named is excluded, or has macros for others and no model."""
    is_part = word.lower().endswith(XACRO) and not kind(Path(word))
    return is_part or _is_excluded(word, exclusion)


def _is_excluded(word: str, exclusion: Exclusion, *, is_folder: bool = False) -> bool:
    from twinform.cli.files.patterns import PathPatterns  # noqa: PLC0415 - most runs enforce no exclusion

    patterns = PathPatterns.of(exclusion.folder, exclusion.patterns)
    return patterns.match(os.path.abspath(word), is_folder=is_folder)  # noqa: PTH100 - links stay links


def _below(folder: str, exclusion: Exclusion, kind: FileKind) -> list[str]:
    from twinform.cli.files.walking import FolderWalk  # noqa: PLC0415 - most runs name their files

    return _some(FolderWalk(folder, exclusion, kind=kind), f"there is no model in {folder}")


def _fitting(pattern: str, exclusion: Exclusion, kind: FileKind) -> list[str]:
    """What fits a glob, from the last folder on that it names."""
    from twinform.cli.files.patterns import PathPatterns  # noqa: PLC0415 - as above
    from twinform.cli.files.walking import FolderWalk  # noqa: PLC0415 - as above

    parts = Path(pattern).parts
    fixed = next(place for place, part in enumerate(parts) if _MAGIC & set(part))
    top = os.path.join(*parts[:fixed]) if fixed else "."  # noqa: PTH118 - `.` stays
    wanted = PathPatterns.of(top, [f"/{'/'.join(parts[fixed:])}"])
    return _some(
        FolderWalk(top, exclusion, wanted, named=not set(parts[-1]) <= {"*"}, kind=kind), f"no model fits {pattern}"
    )


def _some(walk: "FolderWalk", problem: str) -> list[str]:
    found = sorted(walk.run())
    if not found:
        what = f"; {walk.left_out} are excluded or ignored by git" if walk.left_out else ""
        raise NothingFoundError(f"{problem}{what}")
    return found
