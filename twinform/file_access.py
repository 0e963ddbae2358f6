"""File access: which files the files of a stranger may lead to, and the one reader that opens them."""

import errno
import os
import stat
from collections.abc import Callable, Iterable, Iterator
from itertools import chain
from pathlib import Path
from typing import BinaryIO, Self

from twinform.dataclass import dataclass

MADE_BY_TOOLS = ("build", "install", "log", "node_modules", "venv", "site-packages", "__pycache__")
"""Names of folders that hold nothing that people write."""
_HIDDEN = f"{os.sep}."


class OutsideError(PermissionError):
    """A file must not be read: `reason` says where its name leads, and `help` what to do if that is intended."""

    def __init__(self, path: str, reason: str, place: str) -> None:
        super().__init__(errno.EACCES, f"it {reason}", path)
        self.reason = reason
        import shlex  # noqa: PLC0415 - few files lead outside

        folder = shlex.quote(os.path.dirname(place))
        self.help = f"if this is meant, name that file itself, or give its folder: --path {folder}"


@dataclass(frozen=True, slots=True)
class Readable:
    """The files that may be read: those in certain folders, wherever links lead, except hidden ones.

    `around` are folders without links, and `beside` one in which only packages and models may be read. `named` are
    others, by their names: those of the command line and the environment. Of these, `installed` may have links into
    packages and models that lie anywhere: colcon links an installation to the sources that it was made from. `single`
    are files that were named themselves.
    """

    around: tuple[str, ...] = ()
    named: tuple[Path, ...] = ()
    installed: tuple[Path, ...] = ()
    single: frozenset[str] = frozenset()
    beside: str = ""

    @classmethod
    def of(cls, file: Path, named: Iterable[Path] = (), installed: Iterable[Path] = ()) -> Self:
        """Return what may be read for a file: itself, its surroundings, and the folders that were named.

        Its own folder is known by the name that was given: a link in it that leads out of its root is not followed.
        """
        own = own_folder(file)
        top = find_root(file)
        real = os.path.realpath(own)
        is_linked = real != os.fspath(own)  # if it has no links in its name, no folder above it has any
        root = os.path.realpath(top) if is_linked else os.fspath(top)
        if own.parent == own:  # the root of the file system holds all that there is
            return cls((), tuple(named), tuple(installed), frozenset({os.path.join(real, file.name)}))
        is_inside = _is_below(real, root)
        # a file in a hidden folder, which was named itself, still has its neighbors
        around = (root, real) if is_inside and real != root else (root,)
        single = frozenset({os.path.join(real, file.name)} if is_inside else ())
        neighbors = neighborhood(top)
        beside = (os.path.realpath(neighbors) if is_linked else os.fspath(neighbors)) if neighbors else ""
        return cls(around, tuple(named), tuple(installed), single, beside)

    def for_neighbor(self, name: str) -> Self:
        """Return what may be read for another file in the folder of the one that this is for."""
        single = frozenset(os.path.join(os.path.dirname(each), name) for each in self.single)
        return type(self)(self.around, self.named, self.installed, single, self.beside)

    def allows(self, path: str | Path) -> bool:
        """Tell whether a file or folder may be read, or does not exist."""
        return self._allows_path(path, os.path.realpath(path))

    def _allows_path(self, path: str | Path, real: str) -> bool:
        # A link `robot.urdf -> ~/.netrc` in a downloaded repository must not make that file
        # readable, so the real place decides and not the name.
        return self._allows_place(real) or self._is_linked_package(path, real)

    def require(self, path: str | Path) -> str:
        """Raise an error for a file or folder that must not be read; return its real path.

        Raises:
            OutsideError: it lies outside, or is hidden.
        """
        real = os.path.realpath(path)
        if not self._allows_path(path, real):
            raise OutsideError(str(path), self._reason(real), real)
        return real

    def read(self, path: str | Path, size: int | None = None) -> bytes:
        """Read a file; of one larger than `size`, one byte more than that.

        Raises:
            OutsideError: it must not be read.
            OSError: it cannot be read, or is no regular file.
        """
        # The place of the opened descriptor is compared with the one that was checked, so that
        # nothing can be exchanged in between.
        expected = self.require(path)

        def check(place: str) -> None:
            if place != expected and not self._allows_place(place):
                raise OutsideError(str(path), self._reason(place), place)

        return read_regular(Path(path), size, check)

    def _allows_place(self, real: str) -> bool:
        if real in self.single or any(_is_visible_in(real, folder) for folder in self.around):
            return True
        return any(_is_visible_in(real, os.path.realpath(folder)) for folder in self.named) or self._is_beside(real)

    def _is_beside(self, real: str) -> bool:
        """Tell whether a path is in a package or model that lies beside that of the file."""
        # In a workspace, `$(find b)` in `ws/src/a` means `ws/src/b`. Keys and passwords do not lie
        # inside packages, so neighboring packages are readable and nothing else beside them is.
        if not self.beside or real == self.beside or not _is_visible_in(real, self.beside):
            return False
        name = os.path.relpath(real, self.beside).split(os.sep)[0]
        return has_any(Path(self.beside, name), PACKAGE)

    def _is_linked_package(self, path: str | Path, real: str) -> bool:
        """Tell whether a link in an installation leads to a package or model."""
        name = os.path.abspath(path)
        if not any(_is_visible_in(name, os.path.abspath(folder)) for folder in self.installed):
            return False
        package = package_around(Path(real))
        return package is not None and _is_visible_in(real, str(package))

    def _reason(self, real: str) -> str:
        folders = (*self.around, *map(os.path.realpath, self.named))
        if any(_is_below(real, folder) for folder in folders):
            return f"leads to {real!r}, which is hidden, and hidden files and folders are not read"
        return f"leads to {real!r}, outside of the folders of models and packages"


def itself(file: Path) -> Readable | None:
    """Return what may be read for a file by a name without links: the file alone; None where links lead to it.

    A file without links may be read wherever it lies, and to find its surroundings takes longer than to read it.
    """
    place = os.path.join(own_folder(file), file.name)
    try:
        real = os.path.realpath(file)
    except ValueError:  # no file has such a name
        return None
    return Readable(single=frozenset({place})) if real == place else None


def _is_below(path: str, folder: str) -> bool:
    return path == folder or path.startswith(folder.rstrip(os.sep) + os.sep)


def _is_visible_in(path: str, folder: str) -> bool:
    """Tell whether a path leads into a folder without a hidden part."""
    return _is_below(path, folder) and _HIDDEN not in path[len(folder.rstrip(os.sep)) :]


_DO_NOT_WAIT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
STREAMS = ("/dev/", "/proc/")
"""How paths of streams begin that somebody names on purpose, such as `/dev/stdin`, which is a link itself."""
_WORDS = {
    stat.S_IFIFO: "a pipe",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFSOCK: "a socket",
}
# Bytes that are read at once. Most files are smaller, and Python reserves as much memory as it is
# asked for.
_PIECE = 2**16


def read_regular(path: Path, size: int | None = None, check: Callable[[str], object] | None = None) -> bytes:
    """Read a regular file, following symbolic links; of one larger than `size`, one byte more than that.

    `check` is called with the place of the file that was opened, without links, and raises where it must not be read.

    Raises:
        OSError: it cannot be read, or is no regular file.
    """
    _require_regular(path.stat(), path)
    # Opening a named pipe for reading blocks until somebody writes to it; O_NONBLOCK returns at
    # once.
    descriptor = os.open(path, os.O_RDONLY | _DO_NOT_WAIT)
    with os.fdopen(descriptor, "rb") as file:
        status = os.fstat(file.fileno())
        _require_regular(status, path)  # something else may have taken its place
        if check is not None:
            check(_place_of(file.fileno(), path, status))
        return file.read() if size is None else read_up_to(file, size)


def read_up_to(file: BinaryIO, size: int) -> bytes:
    """Read an open file; of one larger than the limit, one byte more."""
    parts: list[bytes] = []
    left = size + 1
    while left > 0:
        wanted = min(left, _PIECE)
        parts.append(file.read(wanted))
        left = left - wanted if len(parts[-1]) == wanted else 0
    return b"".join(parts)


def _require_regular(status: os.stat_result, path: Path) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    if not stat.S_ISREG(status.st_mode):
        kind = _WORDS.get(stat.S_IFMT(status.st_mode), "something else")
        raise OSError(errno.EINVAL, f"it is {kind} and no file", str(path))


def _place_of(descriptor: int, path: Path, status: os.stat_result) -> str:
    """Return where an open file really is.

    Raises:
        OSError: that is not known, since something was moved meanwhile.
    """
    try:
        return os.readlink(f"/proc/self/fd/{descriptor}").removesuffix(" (deleted)")
    except OSError:  # Linux alone knows it of the open file
        place = os.path.realpath(path)
        if not os.path.samestat(os.stat(place, follow_symlinks=False), status):
            raise
        return place


REPOSITORY = (".git", ".hg")
"""What is at the top of a repository: a folder or, in a worktree or submodule, a file."""
PACKAGE = ("package.xml", "model.config")
"""What makes a folder a package of ROS or a model of Gazebo."""
CEILING = "TWINFORM_ROOT"
"""The environment variable with a folder above which no file below it has its root."""
# A search that climbed six folders where there was no repository let a xacro file in a downloads
# folder read keys out of the home folder.
PROJECT = ("twinform.toml", *PACKAGE)
"""What makes a folder a root where there is no repository."""
# Folders in which neighbors are looked for: a file in `ws/src/repository/package/urdf/parts` still
# sees `ws/src`.
_MOST_SEARCHED = 7


def find_root(file: Path) -> Path:
    """Return the folder that a file belongs to: the top of its repository, else of its package, model or project.

    Of packages, models and projects the nearest of each kind counts, and of these the highest: a model in a package
    may use all of the package. Where there is none of them, it is the file's own folder. The folder that TWINFORM_ROOT
    names counts as the top of a repository.
    """
    own = own_folder(file)
    around: list[Path] = []
    # no folder above the top is looked at: whatever is there must not make a batch convert the file again
    for folder in chain((own,), folders_above(own)):
        if has_any(folder, REPOSITORY) or _is_ceiling(_status(folder)):
            return folder
        around.append(folder)
    marked = [folder for folder in around if has_any(folder, PROJECT)]
    nearest = [next((folder for folder in marked if has_any(folder, (name,))), own) for name in PROJECT if marked]
    return min(nearest, key=lambda folder: len(folder.parts), default=own)


def folders_around(file: Path, root: Path | None = None) -> tuple[Path, ...]:
    """Return the file's folder and those above it, up to its root, in which neighbors are searched."""
    own, root = own_folder(file), root or find_root(file)
    folders = [own, *(folder for folder in own.parents if folder.is_relative_to(root))][:_MOST_SEARCHED]
    name = file.parent
    for place, folder in enumerate(folders):
        folders[place] = name
        # by the path by which the file was named as far as that goes, so that messages have it
        name = name.parent if name.name not in {"", ".."} else folder.parent
    return tuple(folders) if own.parent != own else ()


def walk_folders(top: Path) -> Iterator[tuple[str, list[str]]]:
    """Yield a folder and those below in order, each with the names in it; hidden ones and `MADE_BY_TOOLS` left out."""
    for place, inner, names in os.walk(top):
        inner[:] = sorted(each for each in inner if not each.startswith(".") and each not in MADE_BY_TOOLS)
        yield place, names


def neighborhood(root: Path) -> Path | None:
    """Return the folder in which other packages and models lie beside a root; None if it is no package or model."""
    is_alone = has_any(root, PACKAGE) and not has_any(root, REPOSITORY)
    return next(folders_above(root), None) if is_alone else None


def package_around(file: Path) -> Path | None:
    """Return the folder of the package or model that a file lies in; None if there is none."""
    own = own_folder(file)
    return next((folder for folder in chain((own,), folders_above(own)) if has_any(folder, PACKAGE)), None)


def own_folder(file: Path) -> Path:
    """Return the folder of a file as an absolute path, by the name that was given."""
    folder = file.parent
    # `link/..` is not the folder that has the link, so such a path is not shortened by its letters
    return Path(os.path.realpath(folder)) if ".." in folder.parts else folder.absolute()


def folders_above(folder: Path) -> Iterator[Path]:
    """Return the folders above one that can belong to the same project.

    A mark in the home folder, such as the repository of somebody's settings, or in a temporary folder that all users
    share says nothing about what else is there. For what lies in the folder that TWINFORM_ROOT names, none is above it.
    """
    home = _identity(_status(os.path.expanduser("~")))
    for each in (folder, *folder.parents):
        status = _status(each)
        if _is_shared(status) or _identity(status) == home:
            # a link to such a folder may have come with an archive: it is no end, and no root either
            if not each.is_symlink():
                return
        elif each.parent == each:
            return
        elif each != folder:
            yield each
        if _is_ceiling(status):
            return


def may_be_root(folder: Path) -> bool:
    """Return whether a folder that somebody asks for can be a project: not their home, nor one that all users share."""
    return next(folders_above(folder / "any"), None) is not None


def has_any(folder: Path, names: tuple[str, ...]) -> bool:
    """Tell whether a folder contains one of these names."""
    place = os.fspath(folder)  # joining paths of pathlib takes longer than asking for them
    return any(os.path.lexists(f"{place}{os.sep}{name}") for name in names)


def _status(folder: str | Path) -> os.stat_result | None:
    try:
        return os.stat(folder)
    except (OSError, ValueError):
        return None


def _is_ceiling(status: os.stat_result | None) -> bool:
    """Tell whether a folder is the one that the environment names as the highest root."""
    named = os.environ.get(CEILING)
    return bool(named) and status is not None and _identity(_status(named)) == _identity(status)


def _identity(status: os.stat_result | None) -> tuple[int, int] | None:
    return (status.st_dev, status.st_ino) if status else None


def _is_shared(status: os.stat_result | None) -> bool:
    """Tell whether everybody may write into a folder without removing the files of others, as in /tmp."""
    return bool(status and status.st_mode & stat.S_ISVTX and status.st_mode & stat.S_IWOTH)
