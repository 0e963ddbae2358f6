"""Files that belong together: what a document includes, and which documents of the workspace include it."""

import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from twinform.compiler.search.resolve_uris import SearchPath
from twinform.diagnostics import Span
from twinform.passes import AssetError
from twinform.server.document_files import DocumentFiles
from twinform.server.documents import TextDocument
from twinform.server.tolerant_tree import TolerantNode

_FIND = re.compile(r"\$\(find\s+(?P<package>[\w.-]+)\)(?P<rest>.*)", re.DOTALL)
_DIRNAME = re.compile(r"\$\(dirname\)/?")
ENDINGS = (".urdf", ".xacro", ".sdf", ".world", ".gazebo")
"""The names of files that are looked through for includes."""
_MOST_FILES = 500
# The most includes of one document that are followed: one that leads nowhere is looked for in every
# folder.
_MOST_INCLUDES = 2_000
_MOST_FOLDERS = 2_000
_SKIPPED = frozenset({"node_modules", "build", "install", "log", "__pycache__"})


@dataclass(frozen=True, slots=True)
class DocumentInclude:
    """An include: the element, the piece of text that names the file, and what this is."""

    node: TolerantNode
    span: Span
    uri: str


def includes_of(document: TextDocument) -> tuple[DocumentInclude, ...]:
    """The files that a document includes, by what it calls them."""
    return document.once(_includes)


def target(include: DocumentInclude, document: TextDocument, search: SearchPath) -> Path | None:
    """The file that an include leads to; None where it leads nowhere, or that is known only once it is expanded."""
    found = resolved(include.uri, document, search)
    if found is not None and found.is_dir():
        from twinform.compiler.includes.model_config import manifest, model_file  # noqa: PLC0415 - few name folders
        from twinform.diagnostics import DiagnosticSink  # noqa: PLC0415 - as above

        config = manifest(found)
        return model_file(config, None, DiagnosticSink()) if config else found / "model.sdf"
    return found


def resolved(uri: str, document: TextDocument, search: SearchPath) -> Path | None:
    """The file or folder that a URI in a document means."""
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


def _includes(document: TextDocument) -> tuple[DocumentInclude, ...]:
    return tuple(islice(_find_includes(document), _MOST_INCLUDES))


def _find_includes(document: TextDocument) -> Iterator[DocumentInclude]:
    for node in document.tree.nodes:
        if node.tag in {"xacro:include", "include"} and "filename" in node.attributes:
            yield DocumentInclude(node, node.attributes["filename"].value, node.values["filename"])
        elif node.tag == "uri" and node.parent is not None and node.parent.tag == "include":
            span = document.tree.text_of(node)
            yield DocumentInclude(node.parent, span, span.of(document.text))


class IncludedNeighbors:
    """Finds the documents that are connected by includes, among those of the workspace."""

    def __init__(self, files: DocumentFiles) -> None:
        self._files = files

    def included(self, document: TextDocument, search: SearchPath) -> list[TextDocument]:
        """A document and all that it includes, each once; the nearest first."""
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
        """A document, all that it includes, and all that include it, with all that these include."""
        found = {each.path: each for each in self.included(document, search)}
        for path in _models(folders):
            other = self._files.document(path) if path not in found else None
            if other is None or not includes_of(other):
                continue
            group = self.included(other, search)
            if any(each.path == document.path for each in group):
                found.update((each.path, each) for each in group)
        return list(found.values())


def _models(folders: Iterable[Path]) -> Iterator[Path]:
    """The files of models in some folders."""
    looked, count = 0, 0
    for folder in folders:
        for place, inner, names in os.walk(folder):
            looked += 1
            inner[:] = (
                []
                if looked > _MOST_FOLDERS
                else sorted(each for each in inner if not each.startswith(".") and each not in _SKIPPED)
            )
            for name in sorted(names):
                if name.lower().endswith(ENDINGS):
                    count += 1
                    if count > _MOST_FILES:
                        return
                    yield Path(place, name)
