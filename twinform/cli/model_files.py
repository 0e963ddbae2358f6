"""Which files are models, by their names and contents, and which are excluded from a search."""

from collections.abc import Callable, Sequence
from dataclasses import field
from pathlib import Path
from typing import Protocol

from twinform.compiler.input.load_options import XACRO
from twinform.compiler.input.root_names import is_mjcf, may_be_mjcf
from twinform.dataclass import dataclass
from twinform.file_access import MADE_BY_TOOLS

SRDF = ".srdf"
PARAMETERS = (".yaml", ".yml")
_MODELS = (".urdf", ".sdf", ".world")
_JSON_MARK = b"urn:twinform:document:"
_ENOUGH = 2**12
"""Our own JSON documents have their mark within so many bytes."""
# The largest xacro file that is looked into, in bytes; a larger one counts as a model, and reading it is refused.
_LARGEST = 2**24
_BLANK = b"\xef\xbb\xbf\xff\xfe \t\r\n"
"""What may stand before the first tag."""
DEFAULT_EXCLUDE = tuple(f"{name}/" for name in MADE_BY_TOOLS)
"""The default exclusion, folders that tools make; hidden files and folders are always left out."""


class PatternError(ValueError):
    """A pattern of paths that git would refuse."""


@dataclass(frozen=True, slots=True)
class Exclusion:
    """Patterns of files and folders to leave out, relative to a folder or to a walk that begins outside of it.

    `force` applies them to files that are named, too. `in_folder` knows the exclusion of folders that have their own.
    """

    patterns: Sequence[str] = DEFAULT_EXCLUDE
    folder: Path = Path()
    force: bool = False
    in_folder: "FolderExclusion | None" = field(default=None, compare=False, repr=False)

    def of_folder(self, folder: str) -> "Exclusion":
        """Return the exclusion for what is in a folder."""
        return (self.in_folder(folder) if self.in_folder else None) or self


FolderExclusion = Callable[[str], Exclusion | None]
"""Returns the exclusion for what is in a folder, or None where the usual one counts."""


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
    if may_be_mjcf(name):
        return _is_mjcf_model(path) if is_mjcf(path) else named
    return named or name.endswith(_MODELS)


def is_checked(path: Path, *, named: bool = False) -> bool:
    """Whether a file is a model, a xacro file with parts of one, or one that names the parts of one."""
    name = path.name.lower()
    if name.endswith(".world"):
        # worlds of Stage, a simulator in the plane, have the same ending and are no XML
        start = _start(path, _ENOUGH).lstrip(_BLANK)
        return not start or start.startswith((b"<", b"\0<"))
    if name.endswith(PARAMETERS):
        return is_companion_file(path)
    if may_be_mjcf(name):
        return named or is_mjcf(path)
    return is_model(path, named=named) if name.endswith(".json") else named or name.endswith((*_MODELS, SRDF, *XACRO))


def is_companion_file(path: Path) -> bool:
    """Whether a file that is no xacro names the parts of a robot: SRDF, and YAML with parameters that do."""
    name = path.name.lower()
    if not name.endswith(PARAMETERS):
        return name.endswith(SRDF)
    from twinform.compiler.companions.check_companion import is_companion  # noqa: PLC0415 - many folders have none
    from twinform.compiler.companions.yaml_leaves import LARGEST  # noqa: PLC0415 - as above

    return is_companion(path, _start(path, LARGEST + 1))


def is_text(path: Path, *, named: bool = False) -> bool:
    """Whether a file is XML for a model or for macros, by its name, or by its root where it is called `.xml`."""
    name = path.name.lower()
    return named or (is_mjcf(path) if may_be_mjcf(name) else name.endswith((*_MODELS, *XACRO)))


def is_plain(path: Path, *, named: bool = False) -> bool:
    """Whether a file is a model without xacro, by its name."""
    return is_text(path, named=named) and not path.name.lower().endswith((*XACRO, ".json"))


def is_fixable(path: Path, *, named: bool = False) -> bool:
    """Whether a file is a model, with or without xacro."""
    return not path.name.lower().endswith(".json") and is_model(path, named=named)


def _start(path: Path, size: int) -> bytes:
    from twinform.file_access import Readable  # noqa: PLC0415 - few names leave it open

    try:
        return Readable.of(path).read(path, size)
    except (OSError, ValueError):
        return b""


def _is_xacro_model(path: Path) -> bool:
    """Whether a xacro file makes a robot, and does not only define macros for others."""
    from twinform.compiler.input.include_graph import outline  # noqa: PLC0415 - few folders have any

    data = _start(path, _LARGEST)
    if not data and path.is_symlink():
        return True  # reading it reports why the link is not followed
    return outline(data).is_robot if data.strip() else not path.is_file()


def _is_mjcf_model(path: Path) -> bool:
    from twinform.compiler.input.include_graph import is_mjcf_model  # noqa: PLC0415 - few folders have any

    return is_mjcf_model(path)
