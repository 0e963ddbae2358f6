"""Where each file of a model goes in a package, and what it is called there."""

import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count

from twinform.compiler.packaging.file_kinds import FileKind, kind_of

_UNSAFE = re.compile(r"[^A-Za-z0-9._-]+")
"""What some reader of URIs, some file system or some build tool would not take in a name."""
_FOLDERS: dict[str, tuple[str, ...]] = {
    "meshes": ("meshes", "mesh"),
    "textures": ("materials", "textures", "texture", "media"),
    "scripts": ("materials", "scripts"),
    "sounds": ("sounds", "sound", "audio", "media"),
}
"""What folders are called that the ones of a package stand for."""
_ROLES: Mapping[FileKind, str] = {
    "mesh": "meshes", "data": "meshes", "image": "textures", "script": "scripts", "sound": "sounds"
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class PackageLayout:
    """The folders of a package, and how its files are named from outside: `model://arm/meshes/base.stl`.

    `names` has what the package is called in URIs of each scheme; without one, files are named by
    paths from its folder.
    """

    names: Mapping[str, str]
    meshes: str = "meshes"
    textures: str = "materials/textures"
    scripts: str = "materials/scripts"
    sounds: str = "sounds"

    def uri(self, path: str, scheme: str) -> str:
        """The URI of a file of the package."""
        return f"{scheme}://{self.names[scheme]}/{path}" if scheme in self.names else path

    def places(self, parts: Sequence[str], kind: FileKind, holder: str = "") -> Iterator[str]:
        """Where a file may go that is known by its path in its own package or model, the shortest path first.

        What lies among meshes stays there, so that most meshes find their textures as before.
        """
        parts = tuple(map(safe_name, parts))
        among_meshes = any(part.lower() in _FOLDERS["meshes"] for part in parts[:-1])
        role = "meshes" if among_meshes else _ROLES[kind]
        folder = {
            "meshes": self.meshes, "scripts": self.scripts, "sounds": self.sounds, "textures": self.textures
        }[role]  # fmt: skip
        above, inner = _around(parts, _FOLDERS[role])
        named = (*((safe_name(holder),) if holder else ()), *above)[-1:]
        for path in dict.fromkeys((inner, (*named, *inner), parts)):
            yield "/".join((folder, *path))


def _around(parts: tuple[str, ...], called: tuple[str, ...]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """A path before and after the last of its folders that are called so; all is after where none is."""
    found = [place for place, part in enumerate(parts[:-1]) if part.lower() in called]
    if not found:
        return (), parts
    before = tuple(part for part in parts[: found[-1]] if part.lower() not in called)
    return before, parts[found[-1] + 1 :]


def safe_name(name: str) -> str:
    """A name of a file or folder that every system takes, and every reader of URIs finds."""
    # Readers of URIs do not agree on percent signs, so names get letters, digits, dots, dashes and
    # underscores only.
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode() if not name.isascii() else name
    return _UNSAFE.sub("_", plain).lstrip(".-") or "_"


@dataclass(slots=True)
class PackagePlaces:
    """The places in a package that are taken, where capitals do not count: no file is where a folder is."""

    files: set[str] = field(default_factory=set[str])
    folders: set[str] = field(default_factory=set[str])

    def take(self, wanted: Iterable[str]) -> str:
        """The first of several places that is free, or else the name of the last one with a number."""
        place = next(filter(self._is_free, _with_numbers(wanted)))
        self._take(place)
        return place

    def take_folder(self, wanted: Iterable[str], names: Sequence[str]) -> str:
        """The first of several folders in which there is room for files of these names, which they take."""
        folders = _with_numbers(wanted)
        place = next(each for each in folders if all(self._is_free(f"{each}/{name}") for name in names))
        for name in names:
            self._take(f"{place}/{name}")
        return place

    def _is_free(self, place: str) -> bool:
        known = place.casefold()
        return known not in self.files and known not in self.folders and self.files.isdisjoint(_above(known))

    def _take(self, place: str) -> None:
        self.files.add(place.casefold())
        self.folders.update(_above(place.casefold()))


def _above(place: str) -> Iterator[str]:
    """The folders that a place is in."""
    while "/" in place:
        place = place.rpartition("/")[0]
        yield place


def _with_numbers(wanted: Iterable[str]) -> Iterator[str]:
    """The places, and then numbered ones right below the first folder, where nothing but folders is."""
    last = ""
    for last in wanted:
        yield last
    top, name = last.partition("/")[0] + "/" if "/" in last else "", last.rpartition("/")[2]
    stem, dot, suffix = name.rpartition(".")
    for number in count(2):
        yield f"{top}{stem}_{number}.{suffix}" if dot and kind_of(name) else f"{top}{name}_{number}"
