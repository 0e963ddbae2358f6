"""Which files are models, by their names and contents, and which are excluded from a search."""

from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

from twinform.dataclass import dataclass

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
