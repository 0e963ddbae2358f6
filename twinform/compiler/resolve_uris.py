"""Resolves the URIs of a model to files."""

import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import field
from pathlib import Path
from posixpath import normpath
from typing import Literal, NamedTuple, Self
from urllib.parse import unquote, urlsplit

from twinform.compiler import fuel_addresses
from twinform.compiler.observing import Memo
from twinform.compiler.ros_packages import MODEL_CONFIG, PackageIndex, package_name
from twinform.dataclass import dataclass
from twinform.diagnostics import rules
from twinform.file_access import (
    OutsideError,
    Readable,
    find_root,
    folders_around,
    neighborhood,
    own_folder,
    package_around,
)
from twinform.passes import AssetError

_MODEL_VARIABLES = ("GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "SDF_PATH", "GAZEBO_MODEL_PATH")
_MOST_SHOWN = 6


class UriError(AssetError):
    """A URI leads nowhere, or to a file that must not be read."""


class SearchFolders(NamedTuple):
    """The folders that are searched because of where a file lies: those above it, and one beside them."""

    folders: tuple[Path, ...]
    neighbors: Path | None


@dataclass(frozen=True, slots=True)
class SearchPath:
    """The folders in which URIs are looked up.

    `own` folders come from the caller and are searched first. `models` contain a folder for each model, `packages` one
    for each package, and `workspaces` packages at any depth. The folders around the file with the URI come last. `seen`
    are the files that were found or read, so that none of them is overwritten. `unsaved` has the contents of files,
    by real path, that are open in an editor; they are used instead of those on the disk. `asked` are folders that the
    caller wants all models of: what lies in one of them may lead to all else in it.
    """

    own: tuple[Path, ...] = ()
    models: tuple[Path, ...] = ()
    packages: tuple[Path, ...] = ()
    workspaces: tuple[Path, ...] = ()
    fuel: tuple[Path, ...] = ()
    asked: tuple[Path, ...] = ()
    index: PackageIndex = field(default_factory=PackageIndex, compare=False, repr=False)
    seen: set[Path] = field(default_factory=set[Path], compare=False, repr=False)
    unsaved: Mapping[str, bytes] = field(default_factory=dict[str, bytes], compare=False, repr=False)
    _readable: Memo[Path, Readable] = field(default_factory=Memo[Path, Readable], compare=False, repr=False)
    _around: Memo[Path, SearchFolders] = field(default_factory=Memo[Path, SearchFolders], compare=False, repr=False)

    @classmethod
    def of(cls, own: Iterable[str | Path] = (), environment: Mapping[str, str] = os.environ) -> Self:
        """Make a search path of given folders and of those that the variables of Gazebo and ROS name."""
        ament = tuple(prefix / "share" for prefix in _folders_in_variable(environment, "AMENT_PREFIX_PATH"))
        return cls(
            own=tuple(map(Path, own)),
            models=tuple(folder for name in _MODEL_VARIABLES for folder in _folders_in_variable(environment, name)),
            packages=ament,
            workspaces=tuple(_folders_in_variable(environment, "ROS_PACKAGE_PATH")),
            fuel=fuel_addresses.caches(environment),
        )

    def find(self, uri: str, beside: Path) -> Path:
        """Return the file or folder that a URI in the file `beside` names.

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
        """Return the files that may be read because `file` leads to them, and `file` itself."""
        near = self._readable.get(file.parent, lambda: self._find_readable(file))
        return near.for_neighbor(file.name)

    def _find_readable(self, file: Path) -> Readable:
        named = (*self._roots(), *self.fuel, *self._asked_around(file))
        return Readable.of(file, named, self._environment_roots())

    def _asked_around(self, file: Path) -> tuple[Path, ...]:
        """Return the folders that the caller asked for and that a file lies in."""
        return tuple(each for each in self.asked if own_folder(file).is_relative_to(each.absolute()))

    def surroundings(self, file: Path) -> SearchFolders:
        """Return the folders around a file; they are kept, since a world may have a URI in each of its lines."""
        return self._around.get(file.parent, lambda: self._find_surroundings(file))

    def _find_surroundings(self, file: Path) -> SearchFolders:
        asked = (each.absolute() for each in self._asked_around(file))
        root = min((find_root(file), *asked), key=lambda each: len(each.parts))
        return SearchFolders(folders_around(file, root), neighborhood(root))

    def source_of(self, path: Path) -> Path | None:
        """Return the file that the build of a package puts where nothing is yet; None if there is none."""
        package = package_around(path)
        inner = own_folder(path).relative_to(package).joinpath(path.name).as_posix() if package else ""
        return next(filter(exists, self.index.sources(package, inner)), None) if package else None

    def unsaved_of(self, path: str | Path) -> bytes | None:
        """Return the content of a file that is open in an editor; None for other files."""
        return self.unsaved.get(os.path.realpath(path)) if self.unsaved else None

    def package(self, name: str, beside: Path) -> Path:
        """Return the folder of a package, for `$(find name)` and `package://name`.

        Raises:
            UriError: the package is not there, or the name is invalid.
        """
        return self._find_named(f"package://{name}", name, beside)

    def package_names(self, beside: Path) -> list[str]:
        """List the packages that a file can name, each as its `package.xml` does."""
        around, neighbors = self.surroundings(beside)
        folders = (*around, neighbors) if neighbors else around
        own = {self.index.name_of(folder) for folder in (*self.own, *folders)}
        near = (self.index.directly_in(folder) for folder in (*folders, *self.packages))
        far = (self.index.below(root) for root in (*self.own, *self.workspaces, *self._asked_around(beside)))
        return sorted(filter(None, own.union(*near, *far)))

    def model_names(self, beside: Path) -> list[str]:
        """List the folders with models of Gazebo that a file can name."""
        around, neighbors = self.surroundings(beside)
        folders = (*around, neighbors) if neighbors else around
        places = (*self._roots(), *folders, *(folder / "models" for folder in folders))
        return sorted(set[str]().union(*(self.index.models_in(place) for place in places)))

    def _find_named(self, uri: str, rest: str, beside: Path) -> Path:
        path = unquote(rest)
        name, _, inner = normpath(path).partition("/")
        if name in {"", "."} or "\0" in path:
            raise UriError(rules.UNRESOLVED_URI, f"{uri!r} names no model or package")
        if name == "..":
            raise UriError(rules.URI_LEAVES_FOLDER, f"{uri!r} leads out of the folders of models and packages")
        around, neighbors = self.surroundings(beside)
        folders = (*around, neighbors) if neighbors else around
        asked = self._asked_around(beside)
        found = self._first_readable(uri, (each / inner for each in self._candidates(name, folders, asked)), beside)
        if found is None and inner:
            sources = (
                path for each in self._candidates(name, folders, asked) for path in self.index.sources(each, inner)
            )
            found = self._first_readable(uri, sources, beside)
        if found is None:
            raise self._not_found(uri, (*self._roots(), *around))
        return found

    def _candidates(self, name: str, around: tuple[Path, ...], asked: tuple[Path, ...]) -> Iterator[Path]:
        """Yield every folder that a name may mean, the most likely first."""
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
        places = (
            *((self.index.below, root) for root in (*self.own, *self.workspaces)),
            *((self.index.directly_in, folder) for folder in around),
            *((self.index.below, root) for root in asked),
        )
        for packages, folder in places:
            if name in (found := packages(folder)):
                yield found[name]
        yield from fuel_addresses.models_named(name, self.fuel)

    def _roots(self) -> tuple[Path, ...]:
        return (*self.own, *self._environment_roots())

    def _environment_roots(self) -> tuple[Path, ...]:
        return (*self.models, *self.packages, *self.workspaces)

    def _first_readable(self, uri: str, paths: Iterable[Path], beside: Path) -> Path | None:
        """Return the first path that exists and may be read; None where none exists.

        Raises:
            UriError: a path exists, but none of these may be read.
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
        """Find a path that is absolute, beside the file, or in one of the folders."""
        around = self.surroundings(beside).folders
        roots = (beside.parent, *self._roots(), *around, *(folder / "models" for folder in around))
        found = self._first_readable(uri or path, (root / path for root in roots), beside) if path else None
        if found is None:
            raise self._not_found(uri or path, (beside.parent, *self._roots(), *around))
        return found

    def _find_cached(self, uri: str) -> Path:
        found = fuel_addresses.cached(uri, self.fuel)
        if found is None:
            host = _host(uri)
            if fuel_addresses.FuelName.parse(uri) is None:
                message = f"{uri!r} is no address of Fuel, and nothing is fetched from {host}"
                raise UriError(rules.UNRESOLVED_URI, message, "put the file beside the model, and name it by its path")
            message = f"{uri!r} is not in the local cache of Fuel, and nothing is fetched from {host}"
            advice = f"run `gz fuel download -u '{uri}'`, or `twinform fuel add FOLDER --owner NAME` where you have it"
            raise UriError(rules.UNRESOLVED_URI, message, _describe_search(self.fuel, advice))
        return found

    def _not_found(self, uri: str, roots: Iterable[Path]) -> UriError:
        where = _describe_search(dict.fromkeys(roots), "name other folders with --path DIR")
        return UriError(rules.UNRESOLVED_URI, f"{uri!r} is not found", where)


def exists(path: Path) -> bool:
    """Whether a file or folder exists."""
    try:
        return path.exists()
    except OSError:  # a name that is too long, a folder that may not be read
        return False


def _host(uri: str) -> str:
    """Return the host of an address, for a message."""
    try:
        return urlsplit(uri).hostname or "the network"
    except ValueError:  # such as a bracket without its like
        return "the network"


def _folders_in_variable(environment: Mapping[str, str], variable: str) -> Iterator[Path]:
    return (Path(part) for part in environment.get(variable, "").split(os.pathsep) if part)


def _describe_search(folders: Iterable[Path], advice: str) -> str:
    names = [str(folder) for folder in folders]
    more = f" and {len(names) - _MOST_SHOWN} more" if len(names) > _MOST_SHOWN else ""
    looked = f"looked in {', '.join(names[:_MOST_SHOWN])}{more}; " if names else ""
    return looked + advice


@dataclass(frozen=True, slots=True)
class LocalAssets:
    """The files that a document names, for passes; `beside` is the file of the document.

    `expand` makes the text of a xacro file; without it none is read.
    """

    search: SearchPath
    beside: Path
    expand: Callable[[Path], bytes] | None = field(default=None, compare=False, repr=False)

    @property
    def folder(self) -> Path | None:
        """The folder of the document; None for a text that came from no file."""
        return self.beside.parent if exists(self.beside) else None

    @property
    def readable(self) -> Readable:
        """The files that may be read because the document leads to them."""
        return self.search.readable(self.beside)

    def find(self, uri: str) -> Path:
        """Return the file or folder that a URI names.

        Raises:
            UriError: there is none, or it must not be read.
        """
        return self.search.find(uri, self.beside)

    def xml(self, path: Path, largest: int) -> bytes:
        """Return the text of an XML file that was found, of up to `largest` bytes; one of xacro is expanded.

        Raises:
            AssetError: it cannot be read or expanded, or must not be.
        """
        if path.suffix.lower() != ".xacro":
            try:
                text = self.readable.read(path, largest)
            except OSError as error:
                raise AssetError(rules.UNREADABLE_FILE, str(error)) from error
            if len(text) > largest:
                raise AssetError(rules.UNREADABLE_FILE, f"it has more than {largest:,} bytes")
            return text
        if self.expand is None:
            raise AssetError(rules.XACRO_REFUSED, f"{path.name!r} is xacro, which is not expanded here")
        return self.expand(path)

    def holder(self, folder: Path, kind: Literal["package", "model"]) -> str | None:
        """Return the name of the ROS package or Gazebo model that a folder is; None where it is none."""
        if kind == "package":
            return package_name(folder)
        if not exists(folder / MODEL_CONFIG):
            return None
        name = fuel_addresses.name_of(folder, self.search.fuel)
        return name.name if name else folder.name

    def address(self, file: Path) -> str | None:
        """Return the address on Fuel of a file or folder in its local cache; None for all others."""
        name = fuel_addresses.name_of(file, self.search.fuel)
        return name.uri if name else None
