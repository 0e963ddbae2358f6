"""Decides where each file of a model goes in a package, and what its name is there.

The kind of a file follows from its name: mesh, image, sound, material script, or data of a mesh. Files of other kinds
are put into no package.
"""

import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from itertools import count
from pathlib import PurePath
from typing import Literal

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern

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
