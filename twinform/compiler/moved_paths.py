"""Rewrites the relative paths of a document for another folder, and names the files of two documents alike."""

import os
from dataclasses import field
from pathlib import Path
from typing import Literal
from urllib.parse import quote, unquote

from twinform.compiler.resolve_uris import LocalAssets, exists
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import MISSING_FILE
from twinform.file_access import Readable
from twinform.ir import Document
from twinform.lazy import lazy_pattern
from twinform.passes.framework.assets import AssetError
from twinform.passes.shared.document_uris import map_uris

_ABSOLUTE = lazy_pattern(r"[A-Za-z][\w+.-]*:|/|__")
"""A scheme, a path from the root, or a keyword such as `__default__`."""
_FILE = "file://"


@dataclass(frozen=True, slots=True)
class MovedAssets:
    """The files that a document with rewritten paths names: they are found by their old and new paths."""

    source: LocalAssets
    folder: Path | None
    """The folder from which the new paths lead."""
    before: dict[str, str] = field(default_factory=dict[str, str])
    """The path in the source for each new path."""

    @property
    def readable(self) -> Readable:
        """The files that may be read because the source leads to them."""
        return self.source.readable

    def find(self, uri: str) -> Path:
        """Return the file or folder that a URI names.

        Raises:
            UriError: there is none, or it must not be read.
        """
        return self.source.find(self.before.get(uri, uri))

    def xml(self, path: Path, largest: int) -> bytes:
        """Return the text of an XML file that was found, of up to `largest` bytes; one of xacro is expanded.

        Raises:
            AssetError: it cannot be read or expanded, or must not be.
        """
        return self.source.xml(path, largest)

    def holder(self, folder: Path, kind: Literal["package", "model"]) -> str | None:
        """Return the name of the ROS package or Gazebo model that a folder is; None where it is none."""
        return self.source.holder(folder, kind)

    def address(self, file: Path) -> str | None:
        """Return the address on Fuel of a file or folder in its local cache; None for all others."""
        return self.source.address(file)


def moved(document: Document, source: LocalAssets, folder: Path, sink: DiagnosticSink) -> tuple[Document, MovedAssets]:
    """Rewrite paths so that they lead to the same files from another folder; return the document and its files.

    A path that leads to no file stays as it is, with a warning.
    """
    here, there = source.beside.parent.resolve(), folder.resolve()
    assets = MovedAssets(source, there)
    if here == there:
        return document, assets

    missing = set[str]()

    def change(uri: str, _kind: str, where: Location) -> str:
        path = _relative_path(uri)
        if path is None:
            return uri
        found = _find_file(path, source)
        # Not guessed at: Gazebo may look for it in its resource folders.
        if found is None:
            _report_missing(path, where, sink, missing)
            return uri
        # By real paths, since `..` behind a symbolic link leads elsewhere.
        new = os.path.relpath(found.parent.resolve() / found.name, there).replace(os.sep, "/")
        made = _FILE + quote(new) if uri.strip().startswith(_FILE) else new
        assets.before[made] = uri
        return made

    return map_uris(document, change), assets


def named_alike(document: Document, source: LocalAssets, names: dict[Path, str]) -> Document:
    """Return a document that calls each file as `names` do; a file that they lack comes into them, as it is called.

    Only what a relative path leads to is a file here.
    """

    def change(uri: str, _kind: str, _where: Location) -> str:
        file = _real_file(uri, source)
        return uri if file is None else names.setdefault(file, uri)

    return map_uris(document, change)


def _real_file(uri: str, source: LocalAssets) -> Path | None:
    path = _relative_path(uri)
    found = None if path is None else _find_file(path, source)
    return None if found is None else found.resolve()


def _relative_path(uri: str) -> str | None:
    """Return the path of a URI that is relative to the file; None for other URIs."""
    path = uri.strip()
    if path.startswith(_FILE):
        path = unquote(path.removeprefix(_FILE))
    return None if not path or _ABSOLUTE.match(path) else path


def _find_file(path: str, source: LocalAssets) -> Path | None:
    """Find a file beside the source or in the search folders; it is not opened here, so it may be anywhere."""
    beside = source.beside.parent / path
    if exists(beside):
        return beside
    try:
        return source.find(path)
    except AssetError:
        return None


def _report_missing(path: str, where: Location, sink: DiagnosticSink, reported: set[str]) -> None:
    """Report once for each path that it is left unchanged."""
    if path not in reported:
        reported.add(path)
        rest = "so it is left unchanged; it is relative to the folder of the source, not of the result"
        sink.report(MISSING_FILE, f"{path!r} leads to no file, {rest}", where, found=path)
