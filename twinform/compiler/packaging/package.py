"""The files of a package: where each goes, what its name is there, and how they are written into a folder.

Either all files are written or nothing is, and never over a file that somebody else has put there.
"""

import errno
import hashlib
import os
import shutil
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import field
from itertools import count
from pathlib import Path, PurePath, PurePosixPath
from types import MappingProxyType
from typing import Literal

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern
from twinform.storage.staging import remove_leftovers
from twinform.storage.transaction import Transaction, named_after, transaction
from twinform.storage.writing import stage_texts, sync_files

Content = bytes | Path
"""The content of a file: bytes, or another file that is copied."""


@dataclass(frozen=True, slots=True)
class Package:
    """The name of a package, and its files by their paths, which are sorted and stay inside the folder.

    Raises:
        ValueError: a path leaves the folder, is below a file, or two paths only differ in case.
    """

    name: str
    files: Mapping[str, Content]

    def __post_init__(self) -> None:
        seen: dict[str, str] = {}
        for path in self.files:
            if not is_inner_path(path):
                raise ValueError(f"{path!r} is no path in a package")
            other = seen.setdefault(path.casefold(), path)
            if other != path:
                raise ValueError(f"{path!r} and {other!r} are one file where capitals do not count")
        for path in self.files:
            if any(str(folder).casefold() in seen for folder in PurePosixPath(path).parents):
                raise ValueError(f"{path!r} is below a file")
        object.__setattr__(self, "files", MappingProxyType(dict(sorted(self.files.items()))))

    @property
    def folders(self) -> tuple[str, ...]:
        """The top folders of the package, sorted."""
        return tuple(sorted({path.partition("/")[0] for path in self.files if "/" in path}))

    def below(self, folder: str) -> Iterator[str]:
        """Return the paths in a folder of the package."""
        return (path for path in self.files if path.startswith(f"{folder}/"))


def is_inner_path(path: str) -> bool:
    """Whether a relative path stays in its folder, if there are no links."""
    parts = path.split("/")
    return all(parts) and not {".", ".."}.intersection(parts) and "\\" not in path and "\0" not in path


MARK = ".twinform-package"
"""The file that lists which files of a folder are ours."""
_HEAD = "# The files that `twinform package` has put here; it writes over no others.\n"


class OccupiedError(OSError):
    """The folder has files that `twinform package` has not put there."""


def write_package(
    package: Package, folder: Path, *, force: bool = False, beside: Mapping[Path, str] | None = None
) -> None:
    """Write a package into a folder, and the texts `beside` it to their paths; all are staged first, and then moved.

    Files of an earlier package are removed, unless they were changed since. Files of somebody else stay; where one has
    the name of a file of the package, nothing is written, unless `force` is true.

    Raises:
        OccupiedError: files of somebody else would be written over.
        OSError: it cannot be written; the folder is as it was.
    """
    target = Path(os.path.realpath(folder))
    if target.exists() and not target.is_dir():
        raise NotADirectoryError(errno.ENOTDIR, "a file stands where the folder of the package would be", str(target))
    ours = frozenset(_unchanged_files(target))
    over = _foreign_files(package, target, ours)
    if over and not force:
        more = f" and {len(over) - 1} more" if len(over) > 1 else ""
        message = f"{target / over[0]}{more} would be written over, and twinform has not put it there"
        raise OccupiedError(errno.EEXIST, message, str(target))
    with transaction() as moves:
        texts = stage_texts(moves, beside or {})
        _move_files(moves, package, target, {*ours, *over})
        for new, place in texts:
            with named_after(place):
                moves.move(new, place)
        moves.sync()
        moves.done = True
    for path in ours:
        _remove_empty_folders((target / path).parent, target)


def _move_files(moves: Transaction, package: Package, target: Path, old: set[str]) -> None:
    """Stage the files of a package and move them to their places; `old` are the files and links that are removed."""
    remove_leftovers(target.parent)
    is_new = not target.exists()
    new = moves.stage(target.parent if is_new else target)
    for path, content in package.files.items():
        with named_after(target / path):
            _write_content(content, new / path)
    rows = {path: digest_of(new / path) for path in package.files}
    (new / MARK).write_bytes(_mark_bytes(rows.items()))
    sync_files((new / path, target / path) for path in (*package.files, MARK))
    if is_new:
        with named_after(target):
            moves.move(new, target)
        return
    # a run that is killed on the way leaves old and new files, and this says of both that they are ours
    both = moves.stage(target)
    both.write_bytes(_mark_bytes([*_read_mark(target / MARK), *rows.items()]))
    moves.move(both, target / MARK)
    for path in sorted(old):
        if _has_to_go(target / path, target, stays=path in rows):
            moves.take_away(target / path, target)
    for path in (*package.files, MARK):
        with named_after(target / path):
            moves.make((target / path).parent)
            moves.move(new / path, target / path)


def _foreign_files(package: Package, target: Path, ours: frozenset[str]) -> list[str]:
    """Return the files and links of somebody else that are in the places of the package's files."""
    found: dict[str, None] = {}
    for path in package.files:
        for place in (*reversed([str(each) for each in Path(path).parents][:-1]), path):
            at = target / place
            if at.is_symlink() or (at.exists() and (place == path or not at.is_dir())):
                found.setdefault(place)
                break
    return [place for place in found if place not in ours]


def _has_to_go(path: Path, folder: Path, *, stays: bool) -> bool:
    """Whether an old file, or a link in the place of a file or folder, is removed before the new files are moved.

    A file that is replaced stays until then. Files behind a link are somebody else's.
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


def _unchanged_files(folder: Path) -> Iterator[str]:
    """Yield the files of an earlier package that were not changed since.

    Raises:
        OSError: one cannot be read.
    """
    for path, digest in _read_mark(folder / MARK):
        at = folder / path
        if not at.is_symlink() and not _through_link(at, folder) and at.is_file() and digest_of(at) == digest:
            yield path


def _read_mark(mark: Path) -> list[tuple[str, str]]:
    """Read an earlier package's list of paths and digests; nothing if it is not ours, or a path leaves the folder."""
    try:
        text = mark.read_text(encoding="utf-8") if mark.is_file() and not mark.is_symlink() else ""
    except UnicodeDecodeError:
        return []
    lines = text.removeprefix(_HEAD).splitlines() if text.startswith(_HEAD) else []
    rows = [(path, digest) for digest, _, path in (line.partition("  ") for line in lines)]
    return rows if all(is_inner_path(path) for path, _ in rows) else []


def _mark_bytes(rows: Iterable[tuple[str, str]]) -> bytes:
    """Write the list of files, in the notation of `sha256sum`."""
    return (_HEAD + "".join(f"{digest}  {path}\n" for path, digest in rows)).encode()


def digest_of(path: Path) -> str:
    """Return the SHA-256 of a file."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _write_content(content: Content, path: Path) -> None:
    """Write bytes, or copy a file, to a path in the package."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(content, bytes):
        path.write_bytes(content)
    else:
        shutil.copyfile(content, path)


FileKind = Literal["mesh", "image", "sound", "script", "data"]

_SUFFIXES: dict[FileKind, str] = {
    "mesh": "3ds 3mf blend bvh dae fbx glb gltf iv lwo lws msh obj off ply stl stla stlb usd usda usdc usdz vtk vtp "
    "wrl x x3d",
    "image": "asc bmp dds dem exr gif hdr hgt jpeg jpg ktx ktx2 pgm png ppm svg tga tif tiff vrt webp",
    "sound": "flac mp3 ogg wav",
    "script": "cg compositor frag glsl hlsl material metal particle program vert",
    "data": "bin mtl",
}
_KINDS: dict[str, FileKind] = {suffix: kind for kind, suffixes in _SUFFIXES.items() for suffix in suffixes.split()}


def suffix_of(path: PurePath | str) -> str:
    """Return the suffix of a name in lower case, without the dot."""
    return PurePath(path).suffix.lower().removeprefix(".")


def kind_of(path: PurePath | str) -> FileKind | None:
    """Return the kind of a file by its name; None where it is not known."""
    return _KINDS.get(suffix_of(path))


_UNSAFE = lazy_pattern(r"[^A-Za-z0-9._-]+")
"""Characters that some reader of URIs, file system or build tool does not take in a name."""
_FOLDERS: dict[str, tuple[str, ...]] = {
    "meshes": ("meshes", "mesh"),
    "textures": ("materials", "textures", "texture", "media"),
    "scripts": ("materials", "scripts"),
    "sounds": ("sounds", "sound", "audio", "media"),
}
"""The usual names of the folders for each role."""
_ROLES: Mapping[FileKind, str] = {
    "mesh": "meshes", "data": "meshes", "image": "textures", "script": "scripts", "sound": "sounds"
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class PackageLayout:
    """The folders of a package, and the URIs of its files, such as `model://arm/meshes/base.stl`.

    `names` has the name of the package in URIs of each scheme; without one, files are named by paths from its folder.
    """

    names: Mapping[str, str]
    meshes: str = "meshes"
    textures: str = "materials/textures"
    scripts: str = "materials/scripts"
    sounds: str = "sounds"

    def uri(self, path: str, scheme: str) -> str:
        """Return the URI of a file of the package."""
        return f"{scheme}://{self.names[scheme]}/{path}" if scheme in self.names else path

    def places(self, parts: Sequence[str], kind: FileKind, holder: str = "") -> Iterator[str]:
        """Yield where a file may go, by its path in its own package or model, the shortest path first.

        Files that lie among meshes stay there, so that most meshes find their textures as before.
        """
        parts = tuple(map(safe_name, parts))
        among_meshes = any(part.lower() in _FOLDERS["meshes"] for part in parts[:-1])
        role = "meshes" if among_meshes else _ROLES[kind]
        folder = {
            "meshes": self.meshes, "scripts": self.scripts, "sounds": self.sounds, "textures": self.textures
        }[role]  # fmt: skip
        above, inner = _split_at_folder(parts, _FOLDERS[role])
        named = (*((safe_name(holder),) if holder else ()), *above)[-1:]
        for path in dict.fromkeys((inner, (*named, *inner), parts)):
            yield "/".join((folder, *path))


def _split_at_folder(parts: tuple[str, ...], called: tuple[str, ...]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Split a path at its last folder with one of these names; all is after it where there is none."""
    found = [place for place, part in enumerate(parts[:-1]) if part.lower() in called]
    if not found:
        return (), parts
    before = tuple(part for part in parts[: found[-1]] if part.lower() not in called)
    return before, parts[found[-1] + 1 :]


def safe_name(name: str) -> str:
    """Return a name of a file or folder that every system takes and every reader of URIs finds."""
    # Readers of URIs do not agree on percent signs, so names get letters, digits, dots, dashes and
    # underscores only.
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode() if not name.isascii() else name
    return _UNSAFE.sub("_", plain).lstrip(".-") or "_"


@dataclass(slots=True)
class PackagePlaces:
    """The places in a package that are taken, regardless of case; no file is where a folder is."""

    files: set[str] = field(default_factory=set[str])
    folders: set[str] = field(default_factory=set[str])

    def take(self, wanted: Iterable[str]) -> str:
        """Take the first free place of several, or else the last one with a number."""
        place = next(filter(self._is_free, _with_numbers(wanted)))
        self._mark_taken(place)
        return place

    def take_folder(self, wanted: Iterable[str], names: Sequence[str]) -> str:
        """Take places for files of these names in the first of several folders where all are free."""
        folders = _with_numbers(wanted)
        place = next(each for each in folders if all(self._is_free(f"{each}/{name}") for name in names))
        for name in names:
            self._mark_taken(f"{place}/{name}")
        return place

    def _is_free(self, place: str) -> bool:
        known = place.casefold()
        return known not in self.files and known not in self.folders and self.files.isdisjoint(_folders_above(known))

    def _mark_taken(self, place: str) -> None:
        self.files.add(place.casefold())
        self.folders.update(_folders_above(place.casefold()))


def _folders_above(place: str) -> Iterator[str]:
    """Yield the folders that a place is in."""
    while "/" in place:
        place = place.rpartition("/")[0]
        yield place


def _with_numbers(wanted: Iterable[str]) -> Iterator[str]:
    """Yield the places, and then numbered ones directly in the top folder of the last one."""
    last = ""
    for last in wanted:
        yield last
    top, name = last.partition("/")[0] + "/" if "/" in last else "", last.rpartition("/")[2]
    stem, dot, suffix = name.rpartition(".")
    for number in count(2):
        yield f"{top}{stem}_{number}.{suffix}" if dot and kind_of(name) else f"{top}{name}_{number}"
