"""What editors show of whole documents: outline, folding ranges, links, and the search for names."""

from collections.abc import Iterator

from lsprotocol import types

from twinform.compiler.resolve_uris import SearchPath
from twinform.diagnostics import Span
from twinform.server.document_names import names_of
from twinform.server.documents import TextDocument
from twinform.server.includes import includes_of, resolve_uri, target
from twinform.server.locations import uri_of
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode

_KINDS = {
    "robot": types.SymbolKind.Module,
    "world": types.SymbolKind.Namespace,
    "model": types.SymbolKind.Module,
    "link": types.SymbolKind.Class,
    "joint": types.SymbolKind.Event,
    "frame": types.SymbolKind.Key,
    "sensor": types.SymbolKind.Interface,
    "light": types.SymbolKind.Interface,
    "plugin": types.SymbolKind.Package,
    "visual": types.SymbolKind.Field,
    "collision": types.SymbolKind.Field,
    "material": types.SymbolKind.Constant,
    "transmission": types.SymbolKind.Operator,
    "ros2_control": types.SymbolKind.Operator,
    "gazebo": types.SymbolKind.Object,
    "include": types.SymbolKind.File,
    "actor": types.SymbolKind.Object,
    "mujoco": types.SymbolKind.Module,
    "worldbody": types.SymbolKind.Namespace,
    "body": types.SymbolKind.Class,
    "freejoint": types.SymbolKind.Event,
    "site": types.SymbolKind.Key,
    "geom": types.SymbolKind.Field,
    "default": types.SymbolKind.Constant,
    "xacro:macro": types.SymbolKind.Function,
    "xacro:property": types.SymbolKind.Variable,
    "xacro:arg": types.SymbolKind.TypeParameter,
    "xacro:include": types.SymbolKind.File,
}
"""The elements in an outline, and their icons."""
_OF_NAMES = {"macro": "xacro:macro", "property": "xacro:property", "arg": "xacro:arg"}
_DEEPEST = 32
_MOST_FOUND = 500


def outline(document: TextDocument) -> list[types.DocumentSymbol]:
    """Return the named elements of a document as a tree."""
    found: list[types.DocumentSymbol] = []
    holders: list[tuple[TolerantNode, list[types.DocumentSymbol]]] = []
    for node in document.tree.nodes:
        while holders and holders[-1][0].end <= node.start:
            holders.pop()
        if node.tag in _KINDS and len(holders) < _DEEPEST:
            inside: list[types.DocumentSymbol] = []
            symbol = _symbol(document, node)
            symbol.children = inside
            (holders[-1][1] if holders else found).append(symbol)
            holders.append((node, inside))
    return found


def search(session: Session, words: str) -> list[types.WorkspaceSymbol]:
    """Find definitions whose name contains some words, in all open documents."""
    wanted = words.lower()
    found: list[types.WorkspaceSymbol] = []
    for document in session.documents:
        for name in names_of(document):
            kind = _KINDS.get(_OF_NAMES.get(name.kind, name.kind))
            if name.defines and wanted in name.text.lower() and kind is not None:
                location = types.Location(document.uri, document.positions.range(name.span))
                found.append(types.WorkspaceSymbol(location, name.text, kind, container_name=document.path.name))
    return found[:_MOST_FOUND]


def _symbol(document: TextDocument, node: TolerantNode) -> types.DocumentSymbol:
    called = node.get("name") or node.get("reference") or node.get("filename") or node.get("class")
    positions = document.positions
    key = node.attributes.get("name")
    selected = key.value if key is not None and key.value.end > key.value.start else node.name
    return types.DocumentSymbol(
        name=called or f"<{node.tag}>",
        kind=_KINDS[node.tag],
        range=positions.range(node.whole),
        selection_range=positions.range(selected),
        detail=node.get("type") or (node.tag if called else None),
    )


def folds(document: TextDocument) -> list[types.FoldingRange]:
    """Return the elements and comments of several lines; the line of an end tag stays visible."""
    elements = ((node.whole, node.end_tag is not None, None) for node in document.tree.nodes)
    comments = ((aside, False, types.FoldingRangeKind.Comment) for aside in document.tree.asides)
    found: list[types.FoldingRange] = []
    for span, has_end_tag, kind in (*elements, *comments):
        first = document.positions.line(span.start)
        last = document.positions.line(max(span.start, span.end - 1)) - has_end_tag
        if last > first:
            found.append(types.FoldingRange(first, last, kind=kind))
    return found


# Elements of SDF whose text names a file that a person opens; not the library of a plugin.
_TEXTS = frozenset({"uri", "albedo_map", "normal_map", "roughness_map", "metalness_map", "filename", "file"})
_MOST_LINKS = 2_000


def links(document: TextDocument, search: SearchPath) -> list[types.DocumentLink]:
    """Return the places in a document that name existing files."""
    found: list[types.DocumentLink] = []
    included = {include.span: target(include, document, search) for include in includes_of(document)}
    for span, text in list(_uris(document))[:_MOST_LINKS]:
        path = included[span] if span in included else resolve_uri(text, document, search)
        if path is not None and path.is_file():
            range_ = document.positions.range(span)
            found.append(types.DocumentLink(range_, uri_of(path), tooltip=str(path)))
    return found


def _uris(document: TextDocument) -> Iterator[tuple[Span, str]]:
    for node in document.tree.nodes:
        if node.mentions("filename") and "filename" in node.attributes and node.tag != "plugin":
            yield node.attributes["filename"].value, node.values["filename"]
        elif node.tag in _TEXTS and not node.children and node.closed and not node.empty:
            span = document.tree.text_of(node)
            yield span, span.of(document.text)
