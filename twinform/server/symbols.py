"""The outline of a document, and the search for names in all documents that are open."""

from lsprotocol import types

from twinform.server.document_names import names_of
from twinform.server.documents import TextDocument
from twinform.server.name import Name
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
    "xacro:macro": types.SymbolKind.Function,
    "xacro:property": types.SymbolKind.Variable,
    "xacro:arg": types.SymbolKind.TypeParameter,
    "xacro:include": types.SymbolKind.File,
}
"""The elements that an outline shows."""
_OF_NAMES = {"macro": "xacro:macro", "property": "xacro:property", "arg": "xacro:arg"}
_DEEPEST = 32
_MOST_FOUND = 500


def outline(document: TextDocument) -> list[types.DocumentSymbol]:
    """The elements of a document that have a name, in each other as they stand."""
    found: list[types.DocumentSymbol] = []
    holders: list[tuple[TolerantNode, list[types.DocumentSymbol]]] = []
    for node in document.tree.nodes:
        while holders and holders[-1][0].end <= node.start_tag.start:
            holders.pop()
        if node.tag in _KINDS and len(holders) < _DEEPEST:
            inside: list[types.DocumentSymbol] = []
            symbol = _symbol(document, node)
            symbol.children = inside
            (holders[-1][1] if holders else found).append(symbol)
            holders.append((node, inside))
    return found


def search(session: Session, words: str) -> list[types.WorkspaceSymbol]:
    """What is called so, in any part of its name, in the documents that are open."""
    wanted = words.lower()
    found: list[types.WorkspaceSymbol] = []
    for document in session.documents:
        for name in names_of(document):
            if name.defines and wanted in name.text.lower() and (kind := _kind(name)) is not None:
                location = types.Location(document.uri, document.positions.range(name.span))
                found.append(types.WorkspaceSymbol(location, name.text, kind, container_name=document.path.name))
    return found[:_MOST_FOUND]


def _kind(name: Name) -> types.SymbolKind | None:
    return _KINDS.get(_OF_NAMES.get(name.kind, name.kind))


def _symbol(document: TextDocument, node: TolerantNode) -> types.DocumentSymbol:
    called = node.get("name") or node.get("reference") or node.get("filename")
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
