"""Includes: the files that a document includes, and the documents of the workspace that include it."""

import re
from collections.abc import Iterable, Iterator
from itertools import chain, islice
from pathlib import Path

from twinform.compiler.input.root_names import MJCF, is_mjcf
from twinform.compiler.resolve_uris import SearchPath
from twinform.dataclass import dataclass
from twinform.diagnostics import Span
from twinform.file_access import walk_folders
from twinform.lazy import lazy_pattern
from twinform.passes import AssetError
from twinform.server.documents import DocumentFiles, TextDocument
from twinform.server.tolerant_tree import TolerantNode

_FIND = lazy_pattern(r"\$\(find\s+(?P<package>[\w.-]+)\)(?P<rest>.*)", re.DOTALL)
_DIRNAME = lazy_pattern(r"\$\(dirname\)/?")
ENDINGS = (".urdf", ".xacro", ".sdf", ".world", ".gazebo", *MJCF)
"""The suffixes of files that are searched for includes; of those called `.xml` only MJCF is."""
_MOST_FILES = 500
# The most includes of one document that are followed, since one that leads nowhere is looked for in every folder.
_MOST_INCLUDES = 2_000
_MOST_FOLDERS = 2_000


@dataclass(frozen=True, slots=True)
class DocumentInclude:
    """An include: the element, and the place and text of the URI."""

    node: TolerantNode
    span: Span
    uri: str


def includes_of(document: TextDocument) -> tuple[DocumentInclude, ...]:
    """Return the includes of a document."""
    return document.once(_collect_includes)


def target(include: DocumentInclude, document: TextDocument, search: SearchPath) -> Path | None:
    """Find the file of an include; None if there is none, or if the URI has expressions of xacro."""
    found = resolve_uri(include.uri, document, search)
    if found is not None and found.is_dir():
        from twinform.compiler.model_config import manifest, model_file  # noqa: PLC0415 - few name folders
        from twinform.diagnostics import DiagnosticSink  # noqa: PLC0415 - as above

        config = manifest(found)
        return model_file(config, None, DiagnosticSink()) if config else found / "model.sdf"
    return found


def resolve_uri(uri: str, document: TextDocument, search: SearchPath) -> Path | None:
    """Find the file or folder of a URI in a document."""
    wanted = _DIRNAME.sub("", uri.strip())
    package = _FIND.fullmatch(wanted)
    if package is not None:
        wanted = f"package://{package['package']}{package['rest']}"
    if not wanted or "$" in wanted:
        return None
    try:
        return search.find(wanted, document.path.absolute())
    except (AssetError, OSError, ValueError):
        return None


def _collect_includes(document: TextDocument) -> tuple[DocumentInclude, ...]:
    return tuple(islice(_find_includes(document), _MOST_INCLUDES))


def _find_includes(document: TextDocument) -> Iterator[DocumentInclude]:
    for node in document.tree.nodes:
        if node.tag in {"xacro:include", "include"} and "filename" in node.attributes:
            yield DocumentInclude(node, node.attributes["filename"].value, node.values["filename"])
        elif node.tag == "include" and "file" in node.attributes:  # of MJCF
            yield DocumentInclude(node, node.attributes["file"].value, node.values["file"])
        elif node.tag == "uri" and node.parent is not None and node.parent.tag == "include":
            span = document.tree.text_of(node)
            yield DocumentInclude(node.parent, span, span.of(document.text))


class IncludedNeighbors:
    """Finds the documents of the workspace that are connected by includes."""

    def __init__(self, files: DocumentFiles) -> None:
        self._files = files

    def included(self, document: TextDocument, search: SearchPath) -> list[TextDocument]:
        """Return a document and all that it includes, directly or through others; the nearest first."""
        found: dict[Path, TextDocument] = {document.path: document}
        waiting = [document]
        while waiting and len(found) < _MOST_FILES:
            here = waiting.pop(0)
            for include in includes_of(here):
                path = target(include, here, search)
                other = self._files.document(path) if path is not None and path not in found else None
                if path is not None and other is not None:
                    found[path] = other
                    waiting.append(other)
        return list(found.values())

    def connected(self, document: TextDocument, search: SearchPath, folders: Iterable[Path]) -> list[TextDocument]:
        """Return a document, all that it includes, and all that include it, with everything that these include."""
        found = {each.path: each for each in self.included(document, search)}
        for path in files_below(folders, ENDINGS):
            other = self._files.document(path) if path not in found else None
            if other is None or not includes_of(other):
                continue
            group = self.included(other, search)
            if any(each.path == document.path for each in group):
                found.update((each.path, each) for each in group)
        return list(found.values())


def files_below(folders: Iterable[Path], endings: tuple[str, ...], most: int = _MOST_FILES) -> Iterator[Path]:
    """Yield the files in some folders and below whose names end so, the nearest folders first; no more than `most`."""
    found = (
        Path(place, name)
        for place, names in islice(chain.from_iterable(map(walk_folders, folders)), _MOST_FOLDERS)
        for name in sorted(names)
        if name.lower().endswith(endings) and (not name.lower().endswith(".xml") or is_mjcf(Path(place, name)))
    )
    yield from islice(found, most)
