"""Real meshes of packages that are installed, and of folders that are named: so many of each format, of every size."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from testbed.installed_robots import installed_folders

MOST = {"stl": 30, "dae": 30, "obj": 22, "ply": 8, "glb": 5, "gltf": 8}
"""How many of each format are looked at."""
_LARGEST = 2**20
_ASSIMP = Path("/usr/share/assimp/models")
"""Debian's package assimp-testmodels: files of every format, many of them odd or broken."""


@dataclass(frozen=True, slots=True)
class MeshFile:
    """A mesh by the name that the page has for it."""

    name: str
    path: Path

    @property
    def format(self) -> str:
        """The format, by the suffix."""
        return self.path.suffix.lower().removeprefix(".")


def chosen(folders: Iterable[str]) -> list[MeshFile]:
    """The meshes to look at: of each format, as many as its share says, from the smallest to the largest."""
    named = [_ASSIMP, *map(Path, folders)]
    folders_by_name = [*installed_folders(), *((folder.name, folder) for folder in named)]
    every = [each for name, folder in folders_by_name for each in _below(folder, name)]
    found: list[MeshFile] = []
    for kind, most in MOST.items():
        own = sorted(
            (each for each in every if each.format == kind), key=lambda each: (each.path.stat().st_size, each.name)
        )
        step = max(1.0, len(own) / most)
        found += [own[int(at * step)] for at in range(min(most, len(own)))]
    return sorted(found, key=lambda each: (each.path.stat().st_size, each.name))


def _below(folder: Path, name: str) -> Iterator[MeshFile]:
    for path in sorted(folder.rglob("*")):
        if path.suffix.lower().removeprefix(".") in MOST and path.is_file() and path.stat().st_size <= _LARGEST:
            yield MeshFile(f"{name}/{path.relative_to(folder)}", path)
