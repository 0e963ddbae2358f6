"""Completion of files: meshes, textures, included files, and the packages and models that they are in."""

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from twinform.compiler.named_files import IMAGES
from twinform.file_access import package_around
from twinform.server.completion.proposals import ITEM, Proposal, ValuePlace, values
from twinform.server.documents import TextDocument
from twinform.server.includes import files_below, resolve_uri
from twinform.server.navigation import search_of

HEIGHTMAPS = (*IMAGES, ".dem", ".asc", ".hgt")
XACROS = (".xacro", ".urdf", ".gazebo")
MODELS = (".sdf", ".urdf", ".world")
SOUNDS = (".wav", ".mp3", ".ogg", ".flac")
_MOST = 300
"""The files that are offered at once."""


def packages(place: ValuePlace) -> list[str]:
    """List the packages that a document can name."""
    return search_of(place.session, place.document).package_names(place.document.path.absolute())


def propose_files(place: ValuePlace, endings: tuple[str, ...]) -> Iterator[Proposal]:
    """Propose the files with some endings that a URI can name, from the folder on that is written already."""
    head = place.typed[: place.typed.rfind("/") + 1]
    if head == "package://":
        yield from values((f"{head}{name}/" for name in packages(place)), ITEM.Module)
    elif head == "model://":
        yield from _models(place, endings)
    elif head:
        search = search_of(place.session, place.document)
        # xacro makes an absolute path of `$(find ...)`
        where = head.removeprefix("file://") if head.startswith("file://$(") else head
        folder = resolve_uri(where.rstrip("/") or "/", place.document, search)
        yield from _in_folder(head, folder, endings, place.document) if folder is not None else ()
    else:
        yield from _from_the_beginning(place, endings)


def _from_the_beginning(place: ValuePlace, endings: tuple[str, ...]) -> Iterator[Proposal]:
    """Propose files of the document's own package and beside it, and how a URI can begin."""
    document, is_xacro = place.document, endings is XACROS
    own = document.path.absolute().parent
    package = package_around(document.path)
    name = search_of(place.session, document).index.name_of(package) if package is not None else None
    if package is not None and name is not None:
        head = f"$(find {name})/" if is_xacro else f"package://{name}/"
        yield from _files(head, package, endings, document)
    for path in files_below((package or own,), endings, _MOST):
        if path != document.path and (not is_xacro or path.is_relative_to(own)):
            yield from values([Path(os.path.relpath(path, own)).as_posix()], ITEM.File)
    beginnings = ("$(find ",) if is_xacro else ("package://", "file://")
    beginnings += ("file://$(find ",) if document.is_xacro and not is_xacro else ()
    if document.schema.format == "sdf":
        yield from _models(place, endings)
        beginnings = ("model://", *beginnings)
    yield from values(beginnings, ITEM.Keyword)


def _models(place: ValuePlace, endings: tuple[str, ...]) -> Iterable[Proposal]:
    """Propose models of Gazebo: as they are where one is included, else as the beginning of the way to a file."""
    names = search_of(place.session, place.document).model_names(place.document.path.absolute())
    return values((f"model://{name}{'' if endings is MODELS else '/'}" for name in names), ITEM.Module)


def _in_folder(head: str, folder: Path, endings: tuple[str, ...], document: TextDocument) -> Iterator[Proposal]:
    """Propose the folders in a folder, and all files below."""
    try:
        inner = sorted(each.name for each in os.scandir(folder) if each.is_dir() and not each.name.startswith("."))
    except OSError:
        return
    yield from _files(head, folder, endings, document)
    holding = [name for name in inner[:_MOST] if next(files_below((folder / name,), endings, 1), None)]
    yield from values((f"{head}{name}/" for name in holding), ITEM.Folder)


def _files(head: str, folder: Path, endings: tuple[str, ...], document: TextDocument) -> Iterable[Proposal]:
    found = (path for path in files_below((folder,), endings, _MOST) if path != document.path)
    return values((f"{head}{path.relative_to(folder).as_posix()}" for path in found), ITEM.File)
