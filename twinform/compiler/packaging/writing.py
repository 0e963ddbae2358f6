"""Writes a package into its folder: all of it or nothing, never over what somebody else has put there."""

import errno
import hashlib
import os
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from twinform.compiler.packaging.package import Content, Package, is_inner_path

MARK = ".twinform-package"
"""The file that says which files of a folder are ours."""
_HEAD = "# The files that `twinform package` has put here; it writes over no others.\n"


class OccupiedError(OSError):
    """The folder has files that `twinform package` has not put there."""


def write_package(package: Package, folder: Path, *, force: bool = False) -> None:
    """Put the package where `folder` is. It is written beside it, and then moved.

    What an earlier package has left there goes away, unless somebody has changed it since. Files of somebody else stay;
    where one has the name of a file of the package, nothing is written, unless it is told to (`force`).

    Raises:
        OccupiedError: files of somebody else would be written over.
        OSError: it cannot be written; the folder is as it was.
    """
    target = Path(os.path.realpath(folder))
    if target.exists() and not target.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, "a file stands where the folder of the package would be", str(target))
    ours = frozenset(_unchanged(target))
    over = _in_the_way(package, target, ours)
    if over and not force:
        more = f" and {len(over) - 1} more" if len(over) > 1 else ""
        message = f"{target / over[0]}{more} would be written over, and twinform has not put it there"
        raise OccupiedError(errno.EEXIST, message, str(target))
    target.parent.mkdir(parents=True, exist_ok=True)
    room = Path(tempfile.mkdtemp(prefix=f".{target.name[:64]}.", dir=target.parent))
    try:
        new = room / "new"
        for path, content in package.files.items():
            _put(content, new / path)
        _put(_mark(new, package), new / MARK)
        if target.exists():
            _Exchange(target, room / "old").run(new, (*package.files, MARK), {*over, *ours})
        else:
            new.rename(target)
    finally:
        shutil.rmtree(room, ignore_errors=True)


@dataclass(slots=True)
class _Exchange:
    """Moves files into a folder that is there; the old ones are kept in another until all have moved."""

    target: Path
    old: Path
    moved: list[str] = field(default_factory=list[str])
    taken: list[str] = field(default_factory=list[str])

    def run(self, new: Path, paths: Iterable[str], old: Iterable[str]) -> None:
        try:
            for path in sorted(old):
                self._take_away(path)
            for path in paths:
                self._take_away(path)
                (self.target / path).parent.mkdir(parents=True, exist_ok=True)
                (new / path).rename(self.target / path)
                self.moved.append(path)
        except BaseException:
            self._take_back()
            raise
        for path in self.taken:
            _remove_empty_folders((self.target / path).parent, self.target)

    def _take_away(self, path: str) -> None:
        """Move an old file aside, or a link in the place of a file or folder; no link is followed."""
        at = self.target / path
        if _through_link(at, self.target) or not (at.is_symlink() or at.is_file()):
            return
        (self.old / path).parent.mkdir(parents=True, exist_ok=True)
        at.rename(self.old / path)
        self.taken.append(path)

    def _take_back(self) -> None:
        for path in reversed(self.moved):
            with suppress(OSError):
                (self.target / path).unlink()
        for path in reversed(self.taken):
            with suppress(OSError):
                (self.old / path).rename(self.target / path)


def _in_the_way(package: Package, target: Path, ours: frozenset[str]) -> list[str]:
    """The files in a folder, links too, that are not ours and where one of the package will be."""
    found: dict[str, None] = {}
    for path in package.files:
        for place in (*reversed([str(each) for each in Path(path).parents][:-1]), path):
            at = target / place
            if at.is_symlink() or (at.exists() and (place == path or not at.is_dir())):
                found.setdefault(place)
                break
    return [place for place in found if place not in ours]


def _through_link(path: Path, folder: Path) -> bool:
    """Whether a link is on the way to a path in a folder."""
    return any(parent.is_symlink() for parent in path.parents if parent != folder and parent.is_relative_to(folder))


def _remove_empty_folders(folder: Path, top: Path) -> None:
    with suppress(OSError):  # it is not empty
        while folder != top:
            folder.rmdir()
            folder = folder.parent


def _unchanged(folder: Path) -> Iterator[str]:
    """The files of an earlier package, as far as they are what it has put there."""
    for path, digest in _listed(folder / MARK).items():
        at = folder / path
        with suppress(OSError):
            if not at.is_symlink() and not _through_link(at, folder) and at.is_file() and _digest(at) == digest:
                yield path


def _listed(mark: Path) -> dict[str, str]:
    """What an earlier package has put there, and its digests; nothing where no list is ours, or one path leads away."""
    try:
        text = mark.read_text(encoding="utf-8") if mark.is_file() and not mark.is_symlink() else ""
    except (OSError, UnicodeDecodeError):
        return {}
    lines = text.removeprefix(_HEAD).splitlines() if text.startswith(_HEAD) else []
    rows = {path: digest for digest, _, path in (line.partition("  ") for line in lines)}
    return rows if all(map(is_inner_path, rows)) else {}


def _mark(folder: Path, package: Package) -> bytes:
    """The list, in the notation of `sha256sum`."""
    return (_HEAD + "".join(f"{_digest(folder / path)}  {path}\n" for path in package.files)).encode()


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _put(content: Content, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(content, bytes):
        path.write_bytes(content)
    else:
        shutil.copyfile(content, path)
