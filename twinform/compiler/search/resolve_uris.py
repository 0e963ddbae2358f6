"""Resolves the URIs of a model to files."""

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from posixpath import normpath
from typing import Literal, NamedTuple, Self
from urllib.parse import unquote, urlsplit

from twinform.compiler.search import fuel
from twinform.compiler.search.packages import MODEL_CONFIG, PackageIndex, package_name
from twinform.diagnostics import rules
from twinform.file_access import OutsideError, Readable, find_root, folders_around, neighborhood
from twinform.passes import AssetError

_MODEL_VARIABLES = ("GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "SDF_PATH", "GAZEBO_MODEL_PATH")
_MOST_SHOWN = 6


class UriError(AssetError):
    """A URI that leads nowhere, or where it must not lead."""


class SearchFolders(NamedTuple):
    """The folders that are searched because of where a file lies: those around it, and one beside them."""

    folders: tuple[Path, ...]
    neighbors: Path | None


@dataclass(frozen=True, slots=True)
class SearchPath:
    """The folders in which URIs are looked up.

    `own` comes from the caller and is looked in first; `models` hold a folder for each model, `packages` one for each
    package, and `workspaces` packages at any depth. The folders around the file that has the URI come last. `seen` are
    the files that were found or read, so that nothing is written over one of them. `unsaved` are files, without links,
    that are open in an editor: their contents count in place of what is on the disk.
    """

    own: tuple[Path, ...] = ()
    models: tuple[Path, ...] = ()
    packages: tuple[Path, ...] = ()
    workspaces: tuple[Path, ...] = ()
    fuel: tuple[Path, ...] = ()
    index: PackageIndex = field(default_factory=PackageIndex, compare=False, repr=False)
    seen: set[Path] = field(default_factory=set[Path], compare=False, repr=False)
    unsaved: Mapping[str, bytes] = field(default_factory=dict[str, bytes], compare=False, repr=False)
    _readable: dict[Path, Readable] = field(default_factory=dict[Path, Readable], compare=False, repr=False)
    _around: dict[Path, SearchFolders] = field(default_factory=dict[Path, SearchFolders], compare=False, repr=False)

    @classmethod
    def of(cls, own: Iterable[str | Path] = (), environment: Mapping[str, str] = os.environ) -> Self:
        """The folders given, and those that the variables of Gazebo and ROS name."""
        ament = tuple(prefix / "share" for prefix in _folders(environment, "AMENT_PREFIX_PATH"))
        return cls(
            own=tuple(map(Path, own)),
            models=tuple(folder for name in _MODEL_VARIABLES for folder in _folders(environment, name)),
            packages=ament,
            workspaces=tuple(_folders(environment, "ROS_PACKAGE_PATH")),
            fuel=fuel.caches(environment),
        )

    def find(self, uri: str, beside: Path) -> Path:
        """The file or folder that a URI names, which stands in the file `beside`.

        Raises:
            UriError: there is none, or it must not be read.
        """
        found = self._find(uri.strip(), beside)
        self.seen.add(found)
        return found

    def _find(self, uri: str, beside: Path) -> Path:
        scheme, separator, rest = uri.partition("://")
        if not separator:
            return self._find_path(uri, beside)
        match scheme:
            case "model" | "package":
                return self._find_named(uri, rest, beside)
            case "file":
                return self._find_path(unquote(rest), beside, uri)
            case "http" | "https":
                return self._find_cached(uri)
            case _:
                raise UriError(rules.UNRESOLVED_URI, f"{uri!r} has a scheme that is not known: {scheme!r}")

    def readable(self, file: Path) -> Readable:
        """The files that may be read because `file` leads to them, and this file."""
        if file not in self._readable:
            self._readable[file] = Readable.of(file, (*self._roots(), *self.fuel), self._of_environment())
        return self._readable[file]

    def _surroundings(self, file: Path) -> SearchFolders:
        """The folders around a file, asked for once: a world may have a URI in each of its lines."""
        if file not in self._around:
            self._around[file] = SearchFolders(folders_around(file), neighborhood(find_root(file)))
        return self._around[file]

    def unsaved_of(self, path: str | Path) -> bytes | None:
        """What an editor has of a file; None where none does."""
        return self.unsaved.get(os.path.realpath(path)) if self.unsaved else None

    def package(self, name: str, beside: Path) -> Path:
        """The folder of a package, as `$(find name)` and `package://name` mean it.

        Raises:
            UriError: it is not there, or is no name.
        """
        return self._find_named(f"package://{name}", name, beside)

    def _find_named(self, uri: str, rest: str, beside: Path) -> Path:
        path = unquote(rest)
        name, _, inner = normpath(path).partition("/")
        if name in {"", "."} or "\0" in path:
            raise UriError(rules.UNRESOLVED_URI, f"{uri!r} names no model or package")
        if name == "..":
            raise UriError(rules.URI_LEAVES_FOLDER, f"{uri!r} leads out of the folders of models and packages")
        around, neighbors = self._surroundings(beside)
        candidates = self._candidates(name, (*around, neighbors) if neighbors else around)
        found = self._first_readable(uri, (folder / inner for folder in candidates), beside)
        if found is None:
            raise self._missing(uri, (*self._roots(), *around))
        return found

    def _candidates(self, name: str, around: tuple[Path, ...]) -> Iterator[Path]:
        """Every folder that may be called so, the most likely first."""
        # A folder called like the model comes first, as in Gazebo and ROS; folders that a
        # package.xml or a model.config calls so come after, and the cache of Fuel last of all.
        # Gazebo would not look there, but a file that another machine wrote can then be read.
        for root in self._roots():
            yield root / name
        for root in (*self.own, *self.workspaces):
            if root.name == name or self.index.name_of(root) == name:
                yield root
        for folder in around:
            if folder.name == name or self.index.name_of(folder) == name:
                yield folder
            yield folder / name
            yield folder / "models" / name
        for root in (*self.own, *self.workspaces):
            yield from self.index.named(name, root)
        for folder in around:
            yield from self.index.directly_in(name, folder)
        yield from fuel.models_named(name, self.fuel)

    def _roots(self) -> tuple[Path, ...]:
        return (*self.own, *self._of_environment())

    def _of_environment(self) -> tuple[Path, ...]:
        return (*self.models, *self.packages, *self.workspaces)

    def _first_readable(self, uri: str, paths: Iterable[Path], beside: Path) -> Path | None:
        """The first of some paths that is there and may be read; None where none is there.

        Raises:
            UriError: those that are there must not be read.
        """
        readable = self.readable(beside)
        denied: OutsideError | None = None
        for path in paths:
            if exists(path):
                try:
                    readable.require(path)
                except OutsideError as error:
                    denied = denied or error
                else:
                    return path
        # Only after all paths were tried: a link that leads out of its folder must not hide a good
        # file in the next one.
        if denied is not None:
            raise UriError(rules.URI_LEAVES_FOLDER, f"{uri!r} {denied.reason}", denied.help) from denied
        return None

    def _find_path(self, path: str, beside: Path, uri: str | None = None) -> Path:
        """A path: absolute, beside the file, or in one of the folders."""
        around = self._surroundings(beside).folders
        roots = (beside.parent, *self._roots(), *around, *(folder / "models" for folder in around))
        found = self._first_readable(uri or path, (root / path for root in roots), beside) if path else None
        if found is None:
            raise self._missing(uri or path, (beside.parent, *self._roots(), *around))
        return found

    def _find_cached(self, uri: str) -> Path:
        found = fuel.cached(uri, self.fuel)
        if found is None:
            host = _host(uri)
            if fuel.FuelName.parse(uri) is None:
                message = f"{uri!r} is no address of Fuel, and nothing is fetched from {host}"
                raise UriError(rules.UNRESOLVED_URI, message, "put the file beside the model, and name it by its path")
            message = f"{uri!r} is not in the local cache of Fuel, and nothing is fetched from {host}"
            advice = f"run `gz fuel download -u '{uri}'`, or `twinform fuel add FOLDER --owner NAME` where you have it"
            raise UriError(rules.UNRESOLVED_URI, message, _searched(self.fuel, advice))
        return found

    def _missing(self, uri: str, roots: Iterable[Path]) -> UriError:
        where = _searched(dict.fromkeys(roots), "name other folders with --path DIR")
        return UriError(rules.UNRESOLVED_URI, f"{uri!r} is not found", where)


def exists(path: Path) -> bool:
    """Whether a file or folder is there."""
    try:
        return path.exists()
    except OSError:  # a name that is too long, a folder that may not be read
        return False


def _host(uri: str) -> str:
    """The machine that an address names, for a message."""
    try:
        return urlsplit(uri).hostname or "the network"
    except ValueError:  # such as a bracket without its like
        return "the network"


def _folders(environment: Mapping[str, str], variable: str) -> Iterator[Path]:
    return (Path(part) for part in environment.get(variable, "").split(os.pathsep) if part)


def _searched(folders: Iterable[Path], advice: str) -> str:
    names = [str(folder) for folder in folders]
    more = f" and {len(names) - _MOST_SHOWN} more" if len(names) > _MOST_SHOWN else ""
    looked = f"looked in {', '.join(names[:_MOST_SHOWN])}{more}; " if names else ""
    return looked + advice


@dataclass(frozen=True, slots=True)
class LocalAssets:
    """The files that the document in the file `beside` names, for its passes."""

    search: SearchPath
    beside: Path

    @property
    def folder(self) -> Path | None:
        """The folder of the document; None for a text that came from no file."""
        return self.beside.parent if exists(self.beside) else None

    @property
    def readable(self) -> Readable:
        """The files that may be read because the document leads to them."""
        return self.search.readable(self.beside)

    def find(self, uri: str) -> Path:
        """The file or folder that a URI names.

        Raises:
            UriError: there is none, or it must not be read.
        """
        return self.search.find(uri, self.beside)

    def holder(self, folder: Path, kind: Literal["package", "model"]) -> str | None:
        """What the package of ROS or the model of Gazebo is called that a folder is; None where it is none."""
        if kind == "package":
            return package_name(folder)
        if not exists(folder / MODEL_CONFIG):
            return None
        name = fuel.name_of(folder, self.search.fuel)
        return name.name if name else folder.name

    def address(self, file: Path) -> str | None:
        """The address on Fuel of a file or folder in its local cache; None for all others."""
        name = fuel.name_of(file, self.search.fuel)
        return name.uri if name else None
