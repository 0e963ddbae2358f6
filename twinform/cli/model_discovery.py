"""Finds the model files that a command line means by files, folders and globs, in a fixed order, each once."""

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from twinform.cli.path_patterns import FolderWalk

XACRO = ".xacro"
_MODELS = (".urdf", ".sdf", ".world")
_JSON_MARK = b"urn:twinform:document:"
_ENOUGH = 2**12
"""Our own JSON documents have their mark within so many bytes."""
# The largest xacro file that is looked into, in bytes; a larger one counts as a model, and reading it is refused.
_LARGEST = 2**24
_DEFINITIONS = frozenset({"arg", "include", "macro", "property", "insert_block"})
"""Elements of xacro that are no part of a robot by themselves."""
_SHARED = frozenset({"material", "xacro:if", "xacro:unless"})
"""Elements that files with definitions for others have as well."""
_MAGIC = frozenset("*?[")
DEFAULT_EXCLUDE = ("build/", "install/", "log/", "node_modules/", "venv/", "site-packages/", "__pycache__/")
"""The default exclusion, folders that tools make; hidden files and folders are always left out."""


class PatternError(ValueError):
    """A pattern of paths that git would refuse."""


@dataclass(frozen=True, slots=True)
class Exclusion:
    """Patterns of files and folders to leave out, relative to a folder or to a walk that begins outside of it.

    `force` applies them to files that are named, too.
    """

    patterns: Sequence[str] = DEFAULT_EXCLUDE
    folder: Path = Path()
    force: bool = False


class FileKind(Protocol):
    """Tells whether a file in a folder is meant; `named` says that the user gave a pattern for the names."""

    def __call__(self, path: Path, /, *, named: bool = False) -> bool:
        """Look at the name, and into the file if the name does not tell."""
        ...


def is_model(path: Path, *, named: bool = False) -> bool:
    """Whether a file is a model; one that cannot be read counts as a model, and is reported when it is read."""
    name = path.name.lower()
    if name.endswith(XACRO):
        return _is_xacro_model(path)
    if name.endswith(".json"):
        return _JSON_MARK in _start(path, _ENOUGH)
    return named or name.endswith(_MODELS)


def is_text(path: Path, *, named: bool = False) -> bool:
    """Whether a file is XML for a model or for macros, by its name."""
    return named or path.name.lower().endswith((*_MODELS, XACRO))


def is_plain(path: Path, *, named: bool = False) -> bool:
    """Whether a file is a model without xacro, by its name."""
    return is_text(path, named=named) and not path.name.lower().endswith((XACRO, ".json"))


def _start(path: Path, size: int) -> bytes:
    from twinform.file_access import Readable  # noqa: PLC0415 - few names leave it open

    try:
        return Readable.of(path).read(path, size)
    except (OSError, ValueError):
        return b""


def _is_xacro_model(path: Path) -> bool:
    """Whether a xacro file makes a robot, and does not only define macros for others.

    A robot has a name, and has parts in it, or includes and no macros.
    """
    # Tried on 386 files of public repositories: it finds all that expand to a robot, and no others.
    from twinform.text import SourceText, UndecodableError, UnplacedError, spans  # noqa: PLC0415 - as above

    data = _start(path, _LARGEST)
    if not data and path.is_symlink():
        return True  # reading it reports why the link is not followed
    try:
        text = SourceText.of(data).text
        root = spans(text)
    except (UndecodableError, UnplacedError):
        return bool(data.strip()) or not path.is_file()
    if root.name.of(text) == "sdf":
        return True
    names = {child.name.of(text) for child in root.children}
    parts = {name for name in names if name.removeprefix("xacro:") not in _DEFINITIONS}
    assembles = "xacro:include" in names and "xacro:macro" not in names
    return root.name.of(text) == "robot" and "name" in root.attributes and (assembles or not parts <= _SHARED)


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
