"""Which files of a folder are models, and what each becomes."""

import os
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path, PurePosixPath

PATTERNS = ("*.urdf", "*.sdf", "*.world", "*.urdf.xacro", "*.sdf.xacro", "*.world.xacro")
"""Files that are models by their names; other xacro files are mostly parts of models."""
_ENDINGS = frozenset({".urdf", ".sdf", ".world", ".xml", ".json", ".xacro"})


class FolderError(ValueError):
    """A batch cannot be made from one folder into the other."""


def require_apart(source: Path, dest: Path) -> None:
    """Raise where results would become sources of the next run, or be written over them.

    Raises:
        FolderError: the source is no folder, or is the target, or lies in it.
    """
    if not source.is_dir():
        raise FolderError(f"{source} is no folder")
    if dest.exists() and not dest.is_dir():
        raise FolderError(f"{dest} is no folder")
    if source.resolve().is_relative_to(dest.resolve()):
        raise FolderError(f"{dest} is {source} or has it inside; the results need a folder of their own")


def models(source: Path, dest: Path, patterns: Sequence[str]) -> list[PurePosixPath]:
    """The models below a folder, relative to it and sorted; hidden folders and that of the results are left out."""
    results = dest.resolve()
    found: list[PurePosixPath] = []
    for place, folders, files in os.walk(source):
        here = Path(place)
        folders[:] = [name for name in folders if not name.startswith(".") and (here / name).resolve() != results]
        inside = PurePosixPath(here.relative_to(source).as_posix())
        found += [inside / name for name in files if any((inside / name).match(pattern) for pattern in patterns)]
    return sorted(found)


def outputs(names: Iterable[PurePosixPath], to: str) -> Mapping[PurePosixPath, PurePosixPath]:
    """Where each model goes: under its own name with the new ending; a world in SDF keeps `.world`.

    Where two would go to one place, as `a.urdf` and `a.sdf` do, both keep their old endings before the new one.
    """
    plain = {name: _stem(name).with_name(f"{_stem(name).name}.{_ending(name, to)}") for name in names}
    taken = Counter(_folded(path) for path in plain.values())
    return {
        name: path if taken[_folded(path)] == 1 else name.with_name(f"{name.name}.{to}") for name, path in plain.items()
    }


def _stem(name: PurePosixPath) -> PurePosixPath:
    while name.suffix.lower() in _ENDINGS and name.stem:
        name = name.with_suffix("")
    return name


def _ending(name: PurePosixPath, to: str) -> str:
    return "world" if to == "sdf" and ".world" in map(str.lower, name.suffixes) else to


def _folded(path: PurePosixPath) -> str:
    """Paths that some file systems take for one are one."""
    return str(path).casefold()


def alone(path: Path, content: bytes) -> bool:
    """Whether a model is surely made of this file alone, so that its digest shows whether anything has changed.

    An automatic inertia is computed from meshes; in UTF-16, which has zero bytes, nothing is looked for.
    """
    if path.suffix.lower() == ".xacro" or b"\0" in content or b"<include" in content:
        return False
    return b"<mesh" not in content or b"auto" not in content
