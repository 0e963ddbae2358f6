"""Links in a document: meshes, textures and included files, as far as they can be found."""

from collections.abc import Iterator

from lsprotocol import types

from twinform.compiler.search.resolve_uris import SearchPath
from twinform.diagnostics import Span
from twinform.server.documents import TextDocument
from twinform.server.editor_uris import uri_of
from twinform.server.includes import includes_of, resolved, target

# Elements of SDF whose text names a file that a person opens; the library of a plugin is none.
_TEXTS = frozenset({"uri", "albedo_map", "normal_map", "roughness_map", "metalness_map", "filename", "file"})
_MOST = 2_000


def links(document: TextDocument, search: SearchPath) -> list[types.DocumentLink]:
    """The pieces of a document that name files which are there."""
    found: list[types.DocumentLink] = []
    included = {include.span: target(include, document, search) for include in includes_of(document)}
    for span, text in list(_uris(document))[:_MOST]:
        path = included[span] if span in included else resolved(text, document, search)
        if path is not None and path.is_file():
            range_ = document.positions.range(span)
            found.append(types.DocumentLink(range_, uri_of(path), tooltip=str(path)))
    return found


def _uris(document: TextDocument) -> Iterator[tuple[Span, str]]:
    for node in document.tree.nodes:
        if "filename" in node.attributes and node.tag != "plugin":
            yield node.attributes["filename"].value, node.values["filename"]
        elif node.tag in _TEXTS and not node.children and node.closed and not node.empty:
            span = document.tree.text_of(node)
            yield span, span.of(document.text)
