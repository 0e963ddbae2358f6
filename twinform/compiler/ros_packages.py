"""ROS packages: folders with a package.xml that has their name."""

import os
import posixpath
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field
from itertools import islice
from pathlib import Path
from typing import NamedTuple

from lxml import etree

from twinform.compiler.observing import Memo
from twinform.dataclass import dataclass
from twinform.file_access import read_regular
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement

MANIFEST = "package.xml"
"""The file that makes a folder a package."""
MODEL_CONFIG = "model.config"
"""The file that makes a folder a model of Gazebo."""
_BUILD = "CMakeLists.txt"
_INSTALL = lazy_pattern(r"(?i)\binstall\s*\(([^()]*)\)")
_COMMENT = lazy_pattern(r"#[^\n]*")
_SHARE = ("share/${PROJECT_NAME}", "${CATKIN_PACKAGE_SHARE_DESTINATION}")
_LARGEST = 2**20
_DEEPEST = 5
_MOST = 2000
"""The number of entries of a folder that are looked at."""
_MOST_WALKED = 10_000
"""The number of folders in which packages are looked for below one: an editor may have a whole home folder open."""
_SKIPPED = frozenset({"COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"})


def package_name(folder: Path) -> str | None:
    """Return the name of the package in a folder; None where there is none."""
    root = read_manifest(folder / MANIFEST)
    return None if root is None else (root.findtext("name") or "").strip() or None


def read_manifest(file: Path) -> XmlElement | None:
    """Read the manifest of a folder, a small XML file; None where there is none, or it is not well-formed."""
    try:
        # an installation links its manifests to those of the sources, and a manifest is never a link to anything else
        if os.path.basename(os.path.realpath(file)) != file.name:  # noqa: PTH119
            return None
        data = read_regular(file, _LARGEST)
        if len(data) > _LARGEST:
            return None
        return etree.fromstring(data, etree.XMLParser(resolve_entities=False, no_network=True))
    except (OSError, ValueError, etree.XMLSyntaxError):
        return None


class Install(NamedTuple):
    """A folder of the sources of a package, and the one that it becomes in the package that was built."""

    folder: str
    target: str


class FolderListing(NamedTuple):
    """The names in a folder that are not hidden: of its folders, and of everything by its suffix in lower case."""

    folders: tuple[str, ...]
    by_suffix: Mapping[str, Sequence[str]]


@dataclass(frozen=True, slots=True)
class PackageIndex:
    """The packages below some folders, and what is in folders: looked for once and on demand."""

    found: Memo[Path, dict[str, Path]] = field(default_factory=Memo[Path, dict[str, Path]])
    inside: Memo[Path, dict[str, Path]] = field(default_factory=Memo[Path, dict[str, Path]])
    names: Memo[Path, str | None] = field(default_factory=Memo[Path, str | None])
    listings: Memo[Path, FolderListing] = field(default_factory=Memo[Path, FolderListing])
    models: Memo[Path, tuple[str, ...]] = field(default_factory=Memo[Path, tuple[str, ...]])
    installs: Memo[Path, tuple[Install, ...]] = field(default_factory=Memo[Path, tuple[Install, ...]])
    robots: Memo[Path, tuple[Path, ...]] = field(default_factory=Memo[Path, tuple[Path, ...]])
    """The robots below a folder, which those who ask for them find."""
    parts: Memo[object, object] = field(default_factory=Memo[object, object])
    """What is in robots and their SRDF files, which those who ask for it read."""

    def name_of(self, folder: Path) -> str | None:
        """Return the name of the package in a folder; None where there is none."""
        return self.names.get(folder, lambda: package_name(folder))

    def sources(self, package: Path, inner: str) -> Iterator[Path]:
        """Yield the files of a package that its build may put at a path in its share folder."""
        for folder, target in self.installs.get(package, lambda: tuple(_installs(package))):
            if not target or inner.startswith(f"{target}/"):
                yield package / folder / inner.removeprefix(f"{target}/")

    def listing(self, folder: Path) -> FolderListing:
        """Return what is in a folder; nothing of one that cannot be listed."""
        return self.listings.get(folder, lambda: _list_folder(folder))

    def models_in(self, folder: Path) -> tuple[str, ...]:
        """Return the names of the folders in a folder that are models of Gazebo."""
        return self.models.get(folder, lambda: self._models_in(folder))

    def _models_in(self, folder: Path) -> tuple[str, ...]:
        folders = self.listing(folder).folders
        return tuple(name for name in folders if os.path.exists(f"{folder}{os.sep}{name}{os.sep}{MODEL_CONFIG}"))  # noqa: PTH110 - many

    def below(self, root: Path) -> Mapping[str, Path]:
        """Return the packages below a folder, by their names."""
        return self.found.get(root, lambda: dict(_packages_below(root)))

    def directly_in(self, folder: Path) -> Mapping[str, Path]:
        """Return the packages directly in a folder by their names, whatever the names of their own folders are."""
        return self.inside.get(
            folder, lambda: {called: each for each in _folders(folder) if (called := package_name(each))}
        )


def _installs(package: Path) -> Iterator[Install]:
    """Yield the folders that the build of a package puts elsewhere: `install(DIRECTORY ... DESTINATION share/...)`."""
    try:
        text = read_regular(package / _BUILD, _LARGEST)[:_LARGEST].decode(errors="replace")
    except (OSError, ValueError):
        return
    shares = (*_SHARE, f"share/{package_name(package)}")
    for found in _INSTALL.finditer(_COMMENT.sub("", text)):
        words = found[1].split()
        if words[:1] != ["DIRECTORY"] or "DESTINATION" not in words[:-1]:
            continue
        at = words.index("DESTINATION")
        share = next((each for each in shares if f"{words[at + 1]}/".startswith(f"{each}/")), None)
        below = words[at + 1].removeprefix(share).strip("/") if share else ""
        for folder in words[1:at] if share else ():
            # CMake installs `folder` with its name, and only the content of `folder/`
            target = posixpath.join(below, "" if folder.endswith("/") else posixpath.basename(folder)).strip("/")
            if target != posixpath.normpath(folder) and not folder.startswith(("/", "..", "$")):
                yield Install(posixpath.normpath(folder), target)


def _list_folder(folder: Path) -> FolderListing:
    by_suffix = defaultdict[str, list[str]](list)
    folders: list[str] = []
    try:
        with os.scandir(folder) as entries:
            for entry in islice(entries, _MOST):
                if not entry.name.startswith("."):
                    by_suffix[os.path.splitext(entry.name)[1].lower()].append(entry.name)  # noqa: PTH122 - many
                    # a thousand files beside each other would be opened for each of them, as if they were folders
                    folders += [entry.name] if entry.is_dir() else []
    except OSError:
        pass
    return FolderListing(tuple(folders), by_suffix)


def _folders(folder: Path) -> Iterator[Path]:
    """Yield the folders in a folder, sorted."""
    try:
        with os.scandir(folder) as entries:
            found = sorted(each.name for each in islice(entries, _MOST) if each.is_dir())
    except OSError:
        return
    yield from (folder / name for name in found)


def _packages_below(root: Path) -> Iterator[tuple[str, Path]]:
    """Yield every package below a folder with its name; a package does not contain others."""
    depth = len(root.parts)
    for place, folders, files in islice(os.walk(root), _MOST_WALKED):
        here = Path(place)
        name = package_name(here) if MANIFEST in files else None
        if name is not None:
            yield name, here
        if name is not None or _SKIPPED.intersection(files) or len(here.parts) - depth >= _DEEPEST:
            folders.clear()
        folders[:] = sorted(folder for folder in folders if not folder.startswith("."))
