"""`Readable`: the files that a file may lead to. Whatever reads files that others have written or named asks here."""

import errno
import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from twinform.file_access.regular_files import read_regular
from twinform.file_access.roots import PACKAGE, find_root, has_any, neighborhood, own_folder, package_around

_HIDDEN = f"{os.sep}."


class OutsideError(PermissionError):
    """A file must not be read: `reason` is where its name leads, and `help` what to do if that is meant."""

    def __init__(self, path: str, reason: str) -> None:
        super().__init__(errno.EACCES, f"it {reason}", path)
        self.reason = reason
        self.help = "if this is meant, name that file itself, or give its folder with --path DIR"


@dataclass(frozen=True, slots=True)
class Readable:
    """The files that may be read: those in folders, wherever links lead, and none that are hidden in there.

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
        root, real = os.path.realpath(top), os.path.realpath(own)
        if own.parent == own:  # the root of the file system holds all that there is
            return cls((), tuple(named), tuple(installed), frozenset({os.path.join(real, file.name)}))
        is_inside = _is_below(real, root)
        # a file in a hidden folder, which was named itself, still has its neighbors
        around = (root, real) if is_inside and real != root else (root,)
        single = frozenset({os.path.join(real, file.name)} if is_inside else ())
        neighbors = neighborhood(top)
        beside = os.path.realpath(neighbors) if neighbors else ""
        return cls(around, tuple(named), tuple(installed), single, beside)

    def allows(self, path: str | Path) -> bool:
        """Whether a file or folder may be read, or is not there."""
        # A link `robot.urdf -> ~/.netrc` in a downloaded repository must not make that file
        # readable, so the real place decides and not the name.
        real = os.path.realpath(path)
        return self._allows_place(real) or self._is_linked_package(path, real)

    def require(self, path: str | Path) -> None:
        """Refuse a file or folder that must not be read.

        Raises:
            OutsideError: it lies outside, or is hidden.
        """
        if not self.allows(path):
            raise OutsideError(str(path), self._reason(os.path.realpath(path)))

    def read(self, path: str | Path, size: int | None = None) -> bytes:
        """The bytes of a file; of one that has more than `size`, one byte more than these.

        Raises:
            OutsideError: it must not be read.
            OSError: it cannot be read, or is no regular file.
        """
        self.require(path)
        # The place of the opened descriptor is compared with the one that was checked, so that
        # nothing can be exchanged in between.
        expected = os.path.realpath(path)

        def check(place: str) -> None:
            if place != expected and not self._allows_place(place):
                raise OutsideError(str(path), self._reason(place))

        return read_regular(Path(path), size, check)

    def _allows_place(self, real: str) -> bool:
        if real in self.single or any(_is_visible_in(real, folder) for folder in self.around):
            return True
        return any(_is_visible_in(real, os.path.realpath(folder)) for folder in self.named) or self._is_beside(real)

    def _is_beside(self, real: str) -> bool:
        """Whether it is a package or model, or in one, that lies beside that of the file."""
        # In a workspace, `$(find b)` in `ws/src/a` means `ws/src/b`. Keys and passwords do not lie
        # inside packages, so neighboring packages are readable and nothing else beside them is.
        if not self.beside or real == self.beside or not _is_visible_in(real, self.beside):
            return False
        name = os.path.relpath(real, self.beside).split(os.sep)[0]
        return has_any(Path(self.beside, name), PACKAGE)

    def _is_linked_package(self, path: str | Path, real: str) -> bool:
        """Whether a link in an installation leads to a package or model."""
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


def _is_below(path: str, folder: str) -> bool:
    return path == folder or path.startswith(folder.rstrip(os.sep) + os.sep)


def _is_visible_in(path: str, folder: str) -> bool:
    """Whether a path leads into a folder, and through nothing there whose name begins with a dot."""
    return _is_below(path, folder) and _HIDDEN not in path[len(folder.rstrip(os.sep)) :]
