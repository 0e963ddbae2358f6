"""Fills the local cache of Gazebo Fuel from folders, so that includes by address are found without a network."""

import os
import shutil
from collections.abc import Iterable, Iterator
from filecmp import cmp
from pathlib import Path

from lxml import etree

from twinform.compiler.fuel_addresses import FuelName, Kind, name_of, newest_first
from twinform.compiler.model_config import manifest
from twinform.dataclass import dataclass
from twinform.file_access import Readable
from twinform.lazy import lazy_pattern
from twinform.storage.transaction import named_after, transaction
from twinform.storage.writing import sync_files

_PART = lazy_pattern(r"[^./\\\x00-\x1f][^/\\\x00-\x1f]*")
"""The name of a single folder that is not hidden."""
_WORLDS = ("*.sdf", "*.world")


class FuelError(ValueError):
    """Why something cannot be put into the cache."""


@dataclass(frozen=True, slots=True)
class Resource:
    """A folder that is a model or a world, and its name."""

    folder: Path
    kind: Kind
    name: str


def resources(folder: Path) -> list[Resource]:
    """Return the model or world that a folder is, or the models in it.

    Raises:
        FuelError: there is none.
    """
    if manifest(folder) is not None:
        return [_model(folder)]
    inner = [_model(each) for each in sorted(folder.iterdir()) if each.is_dir() and manifest(each) is not None]
    if inner:
        return inner
    worlds = [path for pattern in _WORLDS for path in sorted(folder.glob(pattern))]
    if worlds:
        return [Resource(folder, "worlds", worlds[0].stem)]
    raise FuelError(f"{folder} has no model.config, no folders with one, and no world: *.sdf, *.world")


def add(resource: Resource, cache: Path, server: str, owner: str, name: str, version: int | None = None) -> FuelName:
    """Put a folder into a cache, unless a version with the same files is there, and return its address.

    Raises:
        FuelError: a name is no name of a folder, or this version is there with other files.
        OSError: it cannot be written.
    """
    for part in (server, owner, name):
        if not _PART.fullmatch(part):
            raise FuelError(f"{part!r} cannot be a part of an address: it is empty, hidden, or has a slash")
    # The layout of gz-fuel-tools, so that Gazebo finds the same models. Nothing here opens a
    # network connection, and yet includes by address have to be found on a build machine.
    versions = cache / server.lower() / owner.lower() / resource.kind / name.lower()
    there = newest_first(versions)
    # The same files are no new version, so that the command can stand in a script.
    same = next((each for each in there if _same(resource.folder, versions / each)), None)
    if version is not None and str(version) in there and same != str(version):
        raise FuelError(f"{versions / str(version)} is there with other files; give another --resource-version")
    chosen = str(version) if version is not None else same or str(int(there[0]) + 1 if there else 1)
    if chosen not in there:
        _copy(resource.folder, versions / chosen)
    return FuelName(server, owner, resource.kind, name, chosen)


def listed(caches: Iterable[Path]) -> Iterator[FuelName]:
    """Yield the addresses of everything in the caches, each in its newest version."""
    for cache in caches:
        for kind in ("models", "worlds"):
            for versions in sorted(cache.glob(f"*/*/{kind}/*")):
                for newest in newest_first(versions)[:1]:
                    name = name_of(versions / newest, (cache,))
                    if name is not None:
                        yield name


def _model(folder: Path) -> Resource:
    """Return a model with the name in its model.config, which is its name on the server."""
    config = manifest(folder)
    name = ""
    if config is not None:
        try:
            root = etree.fromstring(
                Readable.of(config).read(config), etree.XMLParser(resolve_entities=False, no_network=True)
            )
            name = (root.findtext("name") or "").strip()
        except etree.XMLSyntaxError as error:
            raise FuelError(f"{config} is no XML: {error}") from error
    return Resource(folder, "models", name or folder.resolve().name)


def _files(folder: Path) -> list[str]:
    """Return the files of a folder, without hidden ones and links that lead out of the folder."""
    readable, found = Readable((os.path.realpath(folder),)), list[str]()
    for place, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        paths = [Path(place, name) for name in sorted(files) if not name.startswith(".")]
        inside = (path for path in paths if path.is_file() and readable.allows(path))
        found += [path.relative_to(folder).as_posix() for path in inside]
    return found


def _same(a: Path, b: Path) -> bool:
    """Whether two folders have the same files."""
    names = _files(a)
    return names == _files(b) and all(cmp(a / name, b / name, shallow=False) for name in names)


def _copy(source: Path, target: Path) -> None:
    """Copy a folder, all of it or nothing."""
    with transaction() as moves, named_after(target):
        new, names = moves.stage(target.parent), _files(source)
        for name in names:
            (new / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source / name, new / name)
        sync_files((new / name, target / name) for name in names)
        moves.move(new, target)
        moves.sync()
        moves.done = True
