"""Root folders: how far around a file other files belong to it."""

import os
import stat
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

REPOSITORY = (".git", ".hg")
"""What is at the top of a repository: a folder or, in a worktree or submodule, a file."""
PACKAGE = ("package.xml", "model.config")
"""What makes a folder a package of ROS or a model of Gazebo."""
# A search that climbed six folders where there was no repository let a xacro file in a downloads
# folder read keys out of the home folder.
PROJECT = ("twinform.toml", *PACKAGE)
"""What makes a folder a root where there is no repository."""
# Folders in which neighbors are looked for: a file in `ws/src/repository/package/urdf/parts` still
# sees `ws/src`.
_MOST_SEARCHED = 7


def find_root(file: Path) -> Path:
    """The folder whose files belong to a file: the top of its repository, else of its package, model or project.

    Of packages, models and projects the nearest of each kind counts, and of these the highest: a model in a package
    may use all of the package. Where there is none of them, it is the file's own folder.
    """
    own = own_folder(file)
    around: list[Path] = []
    # no folder above the top is looked at: whatever is there must not make a batch convert the file again
    for folder in chain((own,), folders_above(own)):
        if has_any(folder, REPOSITORY):
            return folder
        around.append(folder)
    marked = [folder for folder in around if has_any(folder, PROJECT)]
    nearest = [next((folder for folder in marked if has_any(folder, (name,))), own) for name in PROJECT if marked]
    return min(nearest, key=lambda folder: len(folder.parts), default=own)


def folders_around(file: Path) -> tuple[Path, ...]:
    """The file's own folder and those above it up to its root, as far as neighbors are looked for."""
    own, root = own_folder(file), find_root(file)
    folders = [own, *(folder for folder in own.parents if folder.is_relative_to(root))][:_MOST_SEARCHED]
    name = file.parent
    for place, folder in enumerate(folders):
        folders[place] = name
        # by the path by which the file was named as far as that goes, so that messages have it
        name = name.parent if name.name not in {"", ".."} else folder.parent
    return tuple(folders) if own.parent != own else ()


def neighborhood(root: Path) -> Path | None:
    """The folder in which other packages and models lie beside a root; None where that is no package or model."""
    is_alone = has_any(root, PACKAGE) and not has_any(root, REPOSITORY)
    return next(folders_above(root), None) if is_alone else None


def package_around(file: Path) -> Path | None:
    """The folder of the package or model that a file lies in; None where it lies in none."""
    own = own_folder(file)
    return next((folder for folder in chain((own,), folders_above(own)) if has_any(folder, PACKAGE)), None)


def own_folder(file: Path) -> Path:
    """The folder that a file lies in, as an absolute path by the name that was given."""
    folder = file.parent
    # `link/..` is not the folder that has the link, so such a path is not shortened by its letters
    return Path(os.path.realpath(folder)) if ".." in folder.parts else folder.absolute()


def folders_above(folder: Path) -> Iterator[Path]:
    """The folders above one, as far as they can belong to one project.

    A mark in the home folder, such as the repository of somebody's settings, or in a temporary folder that all users
    share says nothing about what else is there.
    """
    home = _identity(Path("~").expanduser())
    for each in (folder, *folder.parents):
        if _is_shared(each) or _identity(each) == home:
            # a link to such a folder may have come with an archive: it is no end, and no root either
            if not each.is_symlink():
                return
        elif each.parent == each:
            return
        elif each != folder:
            yield each


def has_any(folder: Path, names: tuple[str, ...]) -> bool:
    """Whether one of these is in a folder."""
    place = os.fspath(folder)  # joining paths of pathlib takes longer than asking for them
    return any(os.path.lexists(f"{place}{os.sep}{name}") for name in names)


def _identity(folder: Path) -> tuple[int, int] | None:
    try:
        status = folder.stat()
    except (OSError, ValueError):
        return None
    return status.st_dev, status.st_ino


def _is_shared(folder: Path) -> bool:
    """Whether everybody may put files into a folder, and nobody may remove those of others."""
    try:
        mode = folder.stat().st_mode
    except (OSError, ValueError):
        return False
    return bool(mode & stat.S_ISVTX and mode & stat.S_IWOTH)
