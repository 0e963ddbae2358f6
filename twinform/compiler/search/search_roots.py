"""Search roots: the folders around a file, in which its neighbors are."""

from pathlib import Path

_HIGHEST = 6
"""So many folders up: a file in `ws/src/repository/package/urdf/parts` still sees the workspace's sources."""
TOPS = (".git", ".hg")
"""What is at the top of a repository: a folder or, in a worktree or submodule, a file."""


def folders_around(file: Path) -> tuple[Path, ...]:
    """The file's own folder and those above it, up to the top of its repository; never the root of the file system."""
    found: list[Path] = []
    folder = file.parent
    real = folder.resolve()
    while len(found) <= _HIGHEST and real.parent != real:
        found.append(folder)
        if any((real / entry).exists() for entry in TOPS):
            break
        folder, real = _above(folder, real), real.parent
    return tuple(found)


def _above(folder: Path, real: Path) -> Path:
    """The folder above, by the path by which the file was named as far as that goes."""
    return folder.parent if folder.name not in {"", ".."} else real.parent
