"""Writes a package into its folder: all of it or nothing, never over what somebody else has put there."""

import errno
import hashlib
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path

from twinform.compiler.packaging.package import Content, Package, is_inner_path
from twinform.storage.staging import remove_leftovers
from twinform.storage.transaction import Transaction, named_after, transaction
from twinform.storage.writing import stage_texts, sync_files

MARK = ".twinform-package"
"""The file that says which files of a folder are ours."""
_HEAD = "# The files that `twinform package` has put here; it writes over no others.\n"


class OccupiedError(OSError):
    """The folder has files that `twinform package` has not put there."""


def write_package(
    package: Package, folder: Path, *, force: bool = False, beside: Mapping[Path, str] | None = None
) -> None:
    """Put the package where `folder` is, and the texts `beside` it where they belong; all are written, and then moved.

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
    with transaction() as moves:
        texts = stage_texts(moves, beside or {})
        _write(moves, package, target, {*ours, *over})
        for new, place in texts:
            with named_after(place):
                moves.move(new, place)
        moves.sync()
        moves.done = True
    for path in ours:
        _remove_empty_folders((target / path).parent, target)


def _write(moves: Transaction, package: Package, target: Path, old: set[str]) -> None:
    """Move all files of a package to where they belong; `old` are the files and links of the folder that go."""
    remove_leftovers(target.parent)
    is_new = not target.exists()
    new = moves.stage(target.parent if is_new else target)
    for path, content in package.files.items():
        with named_after(target / path):
            _write_content(content, new / path)
    rows = {path: _digest(new / path) for path in package.files}
    (new / MARK).write_bytes(_mark(rows.items()))
    sync_files((new / path, target / path) for path in (*package.files, MARK))
    if is_new:
        with named_after(target):
            moves.move(new, target)
        return
    # a run that is killed on the way leaves old and new files, and this says of both that they are ours
    both = moves.stage(target)
    both.write_bytes(_mark([*_listed(target / MARK), *rows.items()]))
    moves.move(both, target / MARK)
    for path in sorted(old):
        if _has_to_go(target / path, target, stays=path in rows):
            moves.take_away(target / path, target)
    for path in (*package.files, MARK):
        with named_after(target / path):
            moves.make((target / path).parent)
            moves.move(new / path, target / path)


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


def _has_to_go(path: Path, folder: Path, *, stays: bool) -> bool:
    """Whether an old file, or a link in the place of a file or folder, is removed before new files come.

    One that a new file takes the place of stays until then. What lies behind a link on the way is somebody else's.
    """
    return not _through_link(path, folder) and (path.is_symlink() or (path.is_file() and not stays))


def _through_link(path: Path, folder: Path) -> bool:
    """Whether a link is on the way to a path in a folder."""
    return any(parent.is_symlink() for parent in path.parents if parent != folder and parent.is_relative_to(folder))


def _remove_empty_folders(folder: Path, top: Path) -> None:
    with suppress(OSError):  # it is not empty
        while folder != top:
            folder.rmdir()
            folder = folder.parent


def _unchanged(folder: Path) -> Iterator[str]:
    """The files of an earlier package, as far as they are what it has put there.

    Raises:
        OSError: one cannot be read.
    """
    for path, digest in _listed(folder / MARK):
        at = folder / path
        if not at.is_symlink() and not _through_link(at, folder) and at.is_file() and _digest(at) == digest:
            yield path


def _listed(mark: Path) -> list[tuple[str, str]]:
    """What an earlier package has put there, and its digests; nothing where no list is ours, or one path leads away."""
    try:
        text = mark.read_text(encoding="utf-8") if mark.is_file() and not mark.is_symlink() else ""
    except UnicodeDecodeError:
        return []
    lines = text.removeprefix(_HEAD).splitlines() if text.startswith(_HEAD) else []
    rows = [(path, digest) for digest, _, path in (line.partition("  ") for line in lines)]
    return rows if all(is_inner_path(path) for path, _ in rows) else []


def _mark(rows: Iterable[tuple[str, str]]) -> bytes:
    """The list, in the notation of `sha256sum`."""
    return (_HEAD + "".join(f"{digest}  {path}\n" for path, digest in rows)).encode()


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _write_content(content: Content, path: Path) -> None:
    """Write bytes, or copy a file, to a path in the package."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(content, bytes):
        path.write_bytes(content)
    else:
        shutil.copyfile(content, path)
