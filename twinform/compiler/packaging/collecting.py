"""Collects the files that a model names, and the files that those name themselves, for a package."""

import hashlib
import stat
from collections.abc import Iterator
from dataclasses import field
from pathlib import Path
from posixpath import basename, relpath
from posixpath import dirname as folder_of
from urllib.parse import unquote

from twinform.compiler.packaging.package import (
    Content,
    FileKind,
    PackageLayout,
    PackagePlaces,
    digest_of,
    kind_of,
    suffix_of,
)
from twinform.compiler.resolve_uris import LocalAssets
from twinform.dataclass import dataclass
from twinform.diagnostics import Rule
from twinform.diagnostics.rules import UNPACKAGED_FILE, URI_LEAVES_FOLDER
from twinform.file_access import OutsideError
from twinform.passes.framework.assets import AssetError, FindingError
from twinform.passes.mesh_jobs.mesh_files import POINTER, is_pointer
from twinform.passes.mesh_references import FORMATS, ReferenceFormat

HIGHEST = 8
"""The number of folders upwards in which a package or model is looked for."""


@dataclass(frozen=True, slots=True)
class FileOrigins:
    """Finds the packages and models that the files of a document lie in."""

    assets: LocalAssets
    _known: dict[Path, tuple[Path, str] | None] = field(default_factory=dict[Path, tuple[Path, str] | None])

    def place(self, file: Path) -> tuple[str, tuple[str, ...]]:
        """Return the name of the package or model that a file lies in, or an empty one, and the path in it."""
        holder = self._holder(file.parent)
        if holder is not None:
            folder, name = holder
            return name, file.relative_to(folder).parts
        own = self.assets.folder
        if own is not None and file.is_relative_to(own) and ".." not in file.relative_to(own).parts:
            return "", file.relative_to(own).parts
        return "", (file.name,)

    def _holder(self, folder: Path) -> tuple[Path, str] | None:
        """Return the nearest folder upwards that is a package or model, and its name."""
        for around in (folder, *folder.parents)[:HIGHEST]:
            if around not in self._known:
                name = self.assets.holder(around, "package") or self.assets.holder(around, "model")
                self._known[around] = (around, name) if name else None
            if self._known[around] is not None:
                return self._known[around]
        return None


_LARGEST_READ = 2**28
"""A file is only looked into up to this size."""
_BEGINNING = 64
_MOST_IN_FOLDER = 2000
_TEXTURE_FOLDERS = ("", "../materials/textures", "../textures", "../../materials/textures")
"""The folders in which Gazebo looks for an image named without a folder, relative to the file that names it."""
# A package is given away, so its rules are stricter than those of reading: a document may name
# files of the folders around it, but only meshes, images, sounds, and scripts go in, and what a
# mesh names must lie in its own package, in that of the document, or in a folder that was named.
_NAMED: dict[FileKind, frozenset[FileKind]] = {
    "mesh": frozenset({"image", "data"}),
    "data": frozenset({"image"}),
    "script": frozenset({"image"}),
}
"""The kinds of files that a file of each kind may name."""


class UncollectedError(FindingError):
    """Why a file is not put into the package."""

    def __init__(self, message: str, help: str | None = None, rule: Rule = UNPACKAGED_FILE) -> None:
        super().__init__(rule, message, help)


@dataclass(slots=True)
class Collection:
    """The files of a package while they are collected: files of equal content are there once.

    `sources` has the original of each file, also of those in which names of other files are rewritten. A `lenient`
    collection leaves out files that a mesh names and that are missing, and notes them in `problems`. Without
    `companions`, what meshes name is left out, for readers that look at nothing of it.
    """

    layout: PackageLayout
    lenient: bool = False
    companions: bool = True
    files: dict[str, Content] = field(default_factory=dict[str, Content])
    sources: dict[str, Path] = field(default_factory=dict[str, Path])
    problems: list[UncollectedError] = field(default_factory=list[UncollectedError])
    _places: PackagePlaces = field(default_factory=PackagePlaces)
    _reserved: set[str] = field(default_factory=set[str])
    _by_source: dict[Path, str] = field(default_factory=dict[Path, str])
    _by_content: dict[tuple[object, ...], str] = field(default_factory=dict[tuple[object, ...], str])

    def reserve(self, path: str) -> None:
        """Keep a place free for a file that is generated later."""
        self._places.take([path])
        self._reserved.add(path)

    def is_reserved(self, uri: str) -> bool:
        """Whether a URI leads to a file of the package that is generated later."""
        return any(uri == self.layout.uri(path, scheme) for path in self._reserved for scheme in self.layout.names)

    def add(self, found: Path, kinds: frozenset[FileKind], assets: LocalAssets) -> str:
        """Put a file of one of these kinds, or a folder of scripts or images, into the package; return its place.

        Raises:
            UncollectedError: it does not belong there, or cannot be read.
        """
        origins = FileOrigins(assets)
        try:
            real = found.resolve()
            if real in self._by_source:
                return self._by_source[real]
            if real.is_dir() and "script" in kinds:
                place = self._collect_folder(found, origins)
            elif kind_of(found) in kinds:
                place = self._collect_file(found, origins)
            else:
                wanted = " or ".join(sorted(kinds))
                raise UncollectedError(f"{str(found)!r} is no {wanted} by its name, so it is put into no package")
        except OSError as error:
            raise UncollectedError(f"{str(found)!r} cannot be read: {error.strerror or error}") from error
        self._by_source[real] = place
        return place

    def put(self, path: str, data: bytes) -> None:
        """Put a file that a pass has made into the package, at its own path; the same file may be put again.

        Raises:
            UncollectedError: another file is there.
        """
        if self.files.get(path) == data:
            return
        if self._places.take([path]) != path:
            raise UncollectedError(f"a pass makes {path!r}, and another file of the package is there")
        self.files[path] = data

    def _collect_folder(self, folder: Path, origins: FileOrigins) -> str:
        """Collect a folder of scripts or images, which are found by their names and therefore stay together."""
        inside = sorted(each for each in folder.iterdir() if kind_of(each) in {"image", "script"} and each.is_file())
        if len(inside) > _MOST_IN_FOLDER:
            raise UncollectedError(f"{str(folder)!r} has more than {_MOST_IN_FOLDER} files")
        if not inside:
            raise UncollectedError(f"{str(folder)!r} is a folder without images and scripts")
        kinds = {kind_of(each) for each in inside}
        kind: FileKind = "script" if "script" in kinds else "image"
        wanted = (folder_of(path) for path in self._wanted_places(inside[0], kind, origins))
        place = self._places.take_folder(wanted, [each.name for each in inside])
        for each in inside:
            own = f"{place}/{each.name}"
            self.files[own] = self.sources[own] = self._checked(each, origins)
            self._by_source.setdefault(each.resolve(), own)
        return place

    def _collect_file(self, found: Path, origins: FileOrigins) -> str:
        kind = kind_of(found) or "data"
        content = self._checked(found, origins)
        format_ = FORMATS.get(suffix_of(found))
        if format_ is None or not self.companions or content.stat().st_size > _LARGEST_READ:
            return self._place_of(found, kind, content, (digest_of(content),), origins)
        data = origins.assets.readable.read(found)
        named = self._places_of_references(found, kind, data, format_, origins)
        key = (hashlib.sha256(data).hexdigest(), *sorted(named.items()))
        place = self._place_of(found, kind, content, key, origins)
        names = {name: _name_in_file(target, place, format_) for name, target in named.items()}
        # Only the names are replaced, in the bytes of the file: a mesh that went through a library
        # comes back with other numbers.
        if self.sources[place] == content and any(name != written for written, name in names.items()):
            self.files[place] = format_.rewritten(data, names)
        return place

    def _place_of(
        self, found: Path, kind: FileKind, content: Path, key: tuple[object, ...], origins: FileOrigins
    ) -> str:
        """Return the place of a file: that of a file with the same content, or a new one."""
        # Files of one content and one ending are one file. The ending counts, since readers tell
        # the format of a mesh by it.
        key = (suffix_of(found), *key)
        if key not in self._by_content:
            place = self._places.take(self._wanted_places(found, kind, origins))
            self._by_content[key] = place
            self.files[place] = self.sources[place] = content
        return self._by_content[key]

    def _wanted_places(self, found: Path, kind: FileKind, origins: FileOrigins) -> Iterator[str]:
        """Yield where a file may go: as it lies in its own package, or else below the name of that package."""
        holder, parts = origins.place(found)
        return self.layout.places(parts, kind, holder)

    def _checked(self, path: Path, origins: FileOrigins) -> Path:
        """Return the file that a path really leads to.

        Raises:
            UncollectedError: it is not a file, or a link leads out of all known folders.
        """
        real = path.resolve()
        if not stat.S_ISREG(real.stat().st_mode):
            raise UncollectedError(f"{str(path)!r} is no file")
        try:
            beginning = origins.assets.readable.read(path, _BEGINNING)
        except OutsideError as error:
            raise UncollectedError(f"{str(path)!r} {error.reason}", error.help, URI_LEAVES_FOLDER) from error
        # A clone without `git lfs pull` has a text of three lines in the place of each mesh, which
        # Gazebo would report as a broken mesh.
        if is_pointer(beginning):
            raise UncollectedError(f"{str(path)!r} is {POINTER}", "run `git lfs pull` in its repository")
        if kind_of(real) != kind_of(path):
            raise UncollectedError(f"{str(path)!r} leads to {str(real)!r}, which is another kind of file")
        return real

    def _places_of_references(
        self, found: Path, kind: FileKind, data: bytes, format_: ReferenceFormat, origins: FileOrigins
    ) -> dict[str, str]:
        """Collect the files that a file names, and return their places."""
        try:
            names = format_.references(data)
        except ValueError as error:
            raise UncollectedError(f"{str(found)!r} cannot be read: {error}") from error
        places: dict[str, str] = {}
        for name in names:
            try:
                places[name] = self._collect_companion(name, found, kind, origins)
            except UncollectedError as error:
                if not self.lenient or error.rule.fatal:
                    raise
                self.problems.append(error)
        return places

    def _collect_companion(self, name: str, by: Path, kind: FileKind, origins: FileOrigins) -> str:
        path = _companion_path(name, by, origins)
        if path is None:
            raise UncollectedError(f"{str(by)!r} names {name!r}, which is not there", _advice_for_missing(name))
        if kind_of(path) not in _NAMED.get(kind, ()):
            raise UncollectedError(f"{str(by)!r} names {name!r}, but it cannot need a file of that kind")
        try:
            origins.assets.readable.require(path)
        except OutsideError as error:
            message = f"{str(by)!r} names {name!r}, which {error.reason}"
            raise UncollectedError(message, error.help, URI_LEAVES_FOLDER) from error
        real = path.resolve()
        if real not in self._by_source:
            self._by_source[real] = self._collect_file(path, origins)
        return self._by_source[real]


def _companion_path(name: str, by: Path, origins: FileOrigins) -> Path | None:
    """Find the file that another one names by a URI, a path from its own folder, or a bare name."""
    for written in dict.fromkeys((name, unquote(name), unquote(name).replace("\\", "/"))):
        if "://" in written and not written.startswith("file://"):
            try:
                return origins.assets.find(written)
            except AssetError:
                continue
        path = written.removeprefix("file://")
        folders = _TEXTURE_FOLDERS if "/" not in path else ("",)
        for folder in folders:
            candidate = by.parent / folder / path
            if _is_file(candidate):
                return candidate
    return None


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a name that is too long, or has a zero in it
        return False


def _advice_for_missing(name: str) -> str | None:
    if name[1:2] == ":" or name.startswith(("/", "file:///")):
        return "it is a path on the machine that made the file: copy the file beside it, and write its name alone"
    return "put the file there, or correct the name; --allow-missing goes on without it"


def _name_in_file(target: str, place: str, format_: ReferenceFormat) -> str:
    """Return the name of a file of the package in another one."""
    return basename(target) if format_.by_name else relpath(target, folder_of(place))
