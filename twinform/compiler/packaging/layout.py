"""Where each file of a model goes in a package, and what it is called there."""

import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from twinform.compiler.packaging.file_kinds import FileKind, kind_of

_UNSAFE = re.compile(r"[^A-Za-z0-9._-]+")
"""What some reader of URIs, some file system or some build tool would not take in a name."""
_FOLDERS: dict[str, tuple[str, ...]] = {
    "meshes": ("meshes", "mesh"),
    "textures": ("materials", "textures", "texture", "media"),
    "scripts": ("materials", "scripts"),
}
"""What folders are called that the ones of a package stand for."""


@dataclass(frozen=True, slots=True)
class Layout:
    """The folders of a package, and how its files are named from outside: `model://arm/meshes/base.stl`.

    `names` has what the package is called in URIs of each scheme; without one, files are named by
    paths from its folder.
    """

    names: Mapping[str, str]
    meshes: str = "meshes"
    textures: str = "materials/textures"
    scripts: str = "materials/scripts"

    def uri(self, path: str, scheme: str) -> str:
        """The URI of a file of the package."""
        return f"{scheme}://{self.names[scheme]}/{path}" if scheme in self.names else path

    def place(self, parts: Sequence[str], kind: FileKind) -> str:
        """Where a file goes that is known by its path in its own package or model.

        What lies beside meshes stays there, so that most meshes find their textures as before.
        """
        parts = tuple(map(safe_name, parts))
        if parts[0].lower() in _FOLDERS["meshes"] or kind in {"mesh", "data"}:
            return _below(self.meshes, parts, _FOLDERS["meshes"])
        if kind == "script":
            return _below(self.scripts, parts, _FOLDERS["scripts"])
        return _below(self.textures, parts, _FOLDERS["textures"])


def _below(folder: str, parts: Sequence[str], called: tuple[str, ...]) -> str:
    """A path in a folder, without the folders at its beginning that are called as this one may be."""
    *above, name = parts
    while above and above[0].lower() in called:
        del above[0]
    return "/".join((folder, *above, name))


def safe_name(name: str) -> str:
    """A name of a file or folder that every system takes, and every reader of URIs finds."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode() if not name.isascii() else name
    return _UNSAFE.sub("_", plain).lstrip(".-") or "_"


@dataclass(slots=True)
class Places:
    """The places in a package that are taken, where capitals do not count."""

    taken: set[str] = field(default_factory=set[str])

    def take(self, wanted: Iterable[str]) -> str:
        """The first of several places that is free, or else the last one with a number."""
        place = ""
        for place in _tries(wanted):
            if place.casefold() not in self.taken:
                break
        self.taken.add(place.casefold())
        return place


def _tries(wanted: Iterable[str]) -> Iterator[str]:
    last = ""
    for place in wanted:
        last = place
        yield place
    stem, dot, suffix = last.rpartition(".")
    number = 2
    while True:
        yield f"{stem}_{number}.{suffix}" if dot and kind_of(last) else f"{last}_{number}"
        number += 1
