"""Gazebo Fuel models in the local cache."""

import re
from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from pathlib import Path
from urllib.parse import unquote, urlsplit

_TWINS = {"fuel.gazebosim.org": "fuel.ignitionrobotics.org", "fuel.ignitionrobotics.org": "fuel.gazebosim.org"}
"""One server under two names."""
_ADDRESS = re.compile(r"/(?:\d+\.\d+/)?(?P<owner>[^/]+)/models/(?P<name>[^/]+)(?:/(?P<rest>.*))?")


def caches(environment: Mapping[str, str]) -> tuple[Path, ...]:
    """The folders in which the programs of Gazebo keep what they fetched."""
    return _caches(environment.get("GZ_FUEL_CACHE_PATH"), environment.get("HOME") or str(Path.home()))


@lru_cache(maxsize=16)
def _caches(named: str | None, home: str) -> tuple[Path, ...]:
    """Every file that is read asks for them, and few need them."""
    return (*([Path(named)] if named else []), Path(home, ".gz", "fuel"), Path(home, ".ignition", "fuel"))


def cached(uri: str, folders: Iterable[Path]) -> Path | None:
    """The folder or file of a model that a Fuel address names; None where it is not on this machine."""
    parts = urlsplit(uri)
    match = _ADDRESS.fullmatch(unquote(parts.path).rstrip("/"))
    host = parts.hostname or ""
    if match is None or ".." in unquote(parts.path).split("/"):
        return None
    version, inner = _version_and_file(match["rest"] or "")
    for cache in folders:
        for server in (host, _TWINS.get(host, host)):
            for model in _spellings(cache / server, match["owner"], match["name"]):
                found = _inside(model, version, inner)
                if found is not None and found.resolve().is_relative_to(cache.resolve()):
                    return found
    return None


def _spellings(server: Path, owner: str, name: str) -> Iterator[Path]:
    """The cache has names in lower case; older ones kept them."""
    yield server / owner.lower() / "models" / name.lower()
    yield server / owner / "models" / name


def _version_and_file(rest: str) -> tuple[str, str]:
    """What follows the name: `3`, `tip`, `tip/files/meshes/box.dae`."""
    version, _, more = rest.partition("/")
    return ("" if version == "tip" else version), more.removeprefix("files/") if more != "files" else ""


def _inside(model: Path, version: str, inner: str) -> Path | None:
    versions = [version] if version else _newest_first(model)
    return next((model / each / inner for each in versions if (model / each / inner).exists()), None)


def _newest_first(model: Path) -> list[str]:
    if not model.is_dir():
        return []
    numbers = [folder.name for folder in model.iterdir() if folder.name.isdecimal() and folder.is_dir()]
    return sorted(numbers, key=int, reverse=True)
