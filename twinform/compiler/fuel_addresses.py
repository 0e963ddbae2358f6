"""Gazebo Fuel: addresses of models and worlds, and the local cache in which the programs of Gazebo keep them.

https://fuel.gazebosim.org/1.0/OpenRobotics/models/Sun/3/files/meshes/sun.dae
~/.gz/fuel/fuel.gazebosim.org/openrobotics/models/sun/3/meshes/sun.dae
"""

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Literal, Self
from urllib.parse import quote, unquote, urlsplit

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern
from twinform.passes.shared.document_uris import FUEL_SERVERS

SERVER = FUEL_SERVERS[0]
"""The server that addresses are written for."""
TIP = "tip"
"""The word for the newest version in an address."""
# Environment variables that name the cache; releases up to Fortress read the second one.
_VARIABLES = ("GZ_FUEL_CACHE_PATH", "IGN_FUEL_CACHE_PATH")
# One server under two names: fuel.ignitionrobotics.org became fuel.gazebosim.org.
_TWINS = {SERVER: FUEL_SERVERS[1], FUEL_SERVERS[1]: SERVER}
_ADDRESS = lazy_pattern(r"/(?:\d+\.\d+/)?(?P<owner>[^/]+)/(?P<kind>models|worlds)/(?P<name>[^/]+)(?:/(?P<rest>.*))?")
_FIRST_OWNER = "openrobotics"
"""The owner whose models are preferred where several owners have one of a name."""
Kind = Literal["models", "worlds"]
_TO_VERSION = 5
"""The number of folders from a cache to a version: server, owner, kind, name, version."""


@dataclass(frozen=True, slots=True)
class FuelName:
    """A model or world on a server, or one `file` of it; without a `version` it is the newest one."""

    server: str
    owner: str
    kind: Kind
    name: str
    version: str = ""
    file: str = ""

    @classmethod
    def parse(cls, uri: str) -> Self | None:
        """Parse an address; None where it is not that of a model or world."""
        try:
            parts = urlsplit(uri.strip())
        except ValueError:  # such as a bracket without its like
            return None
        path = unquote(parts.path).rstrip("/")
        match = _ADDRESS.fullmatch(path)
        if match is None or "\0" in unquote(uri) or not {".", "..", ""}.isdisjoint(path.split("/")[1:]):
            return None
        version, _, rest = (match["rest"] or "").partition("/")
        file = "" if rest == "files" else rest.removeprefix("files/")
        kind: Kind = "models" if match["kind"] == "models" else "worlds"
        return cls(parts.hostname or "", match["owner"], kind, match["name"], "" if version == TIP else version, file)

    @property
    def uri(self) -> str:
        """The address."""
        version = self.version or (TIP if self.file else "")
        parts = (self.owner, self.kind, self.name, version, f"files/{self.file}" if self.file else "")
        return f"https://{self.server}/1.0/" + "/".join(quote(part) for part in parts if part)

    def folders(self, cache: Path) -> Iterator[Path]:
        """Yield the folders of its versions in a cache: names are in lower case there, except in older caches."""
        for server in dict.fromkeys((self.server, _TWINS.get(self.server, self.server))):
            yield cache / server / self.owner.lower() / self.kind / self.name.lower()
            yield cache / server / self.owner / self.kind / self.name


def caches(environment: Mapping[str, str]) -> tuple[Path, ...]:
    """Return the folders in which the programs of Gazebo keep what they have fetched."""
    named = tuple(environment[name] for name in _VARIABLES if environment.get(name))
    return _caches(named, environment.get("HOME") or str(Path.home()))


@lru_cache(maxsize=16)
def _caches(named: tuple[str, ...], home: str) -> tuple[Path, ...]:
    """Return the caches; the result is kept, because every file that is read asks for them."""
    return (*map(Path, named), Path(home, ".gz", "fuel"), Path(home, ".ignition", "fuel"))


def cached(uri: str, folders: Iterable[Path]) -> Path | None:
    """Return the folder or file that an address names; None where it is not on this machine."""
    name = FuelName.parse(uri)
    if name is None:
        return None
    for cache in folders:
        for versions in name.folders(cache):
            found = _inside(versions, name)
            if found is not None and found.resolve().is_relative_to(cache.resolve()):
                return found
    return None


def models_named(name: str, folders: Iterable[Path]) -> Iterator[Path]:
    """Yield the models of a name in the caches, of any owner, each in its newest version."""
    for cache in folders:
        owners = [owner for server in _folders(cache) for owner in _folders(server)]
        for owner in sorted(owners, key=lambda path: (path.name != _FIRST_OWNER, path)):
            for called in dict.fromkeys((name.lower(), name)):
                model = owner / "models" / called
                yield from (model / version for version in newest_first(model)[:1])


def _folders(folder: Path) -> list[Path]:
    try:
        return [each for each in folder.iterdir() if each.is_dir()]
    except OSError:
        return []


def name_of(path: Path, folders: Iterable[Path]) -> FuelName | None:
    """Return the name on its server of a file or folder in a cache; None where it is in none."""
    for cache in folders:
        if path.is_relative_to(cache):
            parts = path.relative_to(cache).parts
            if len(parts) >= _TO_VERSION and parts[2] in {"models", "worlds"} and parts[4].isdecimal():
                kind: Kind = "models" if parts[2] == "models" else "worlds"
                return FuelName(parts[0], parts[1], kind, parts[3], parts[4], "/".join(parts[5:]))
    return None


def newest_first(model: Path) -> list[str]:
    """Return the versions of a model or world that are in a cache, the newest first."""
    numbers = [folder.name for folder in _folders(model) if folder.name.isdecimal()]
    return sorted(numbers, key=int, reverse=True)


def _inside(model: Path, name: FuelName) -> Path | None:
    versions = [name.version] if name.version else newest_first(model)
    return next((model / each / name.file for each in versions if (model / each / name.file).exists()), None)
