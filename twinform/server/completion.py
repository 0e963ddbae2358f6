"""Completion: elements, attributes and values by the facts tables, names of the document, and what xacro has."""

import re
from collections.abc import Iterable, Iterator

from lsprotocol import types

from twinform.dataclass import dataclass
from twinform.diagnostics import Span
from twinform.ir.references import ReferenceKind
from twinform.lazy import lazy_pattern
from twinform.passes.plugins.catalog import systems
from twinform.passes.plugins.catalog_types import PluginParameter
from twinform.passes.structure.rename_parts import LOOKUP_ORDER
from twinform.schemas import Fact, rows_by_name
from twinform.server.document_names import kind_at, names_of, scope_of_reference
from twinform.server.documents import Cursor, CursorKind, TextDocument, cursor_at
from twinform.server.hover import text_of_row
from twinform.server.mapping import MappingRow
from twinform.server.names import ELEMENTS, Name, parameter_names
from twinform.server.navigation import search_of
from twinform.server.schema import PREFIX, SchemaPlace, described, inside, is_of_xacro, parameter_of, parameters_in
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode


def literal(text: str) -> str:
    """Escape a text for a snippet, in which `$CLIPBOARD` is what was copied last."""
    return text.replace("\\", "").replace("$", "\\$")


@dataclass(frozen=True, slots=True)
class Proposal:
    """Something to write: `new` is a snippet, in which `$` marks places to fill in.

    Rank 0 is for required parts, which come first; rank 2 is for those of dialects, which come last.
    """

    label: str
    new: str
    kind: types.CompletionItemKind
    detail: str = ""
    text: str = ""
    rank: int = 1


def names_for(session: Session, document: TextDocument, node: TolerantNode, kind: ReferenceKind) -> Iterator[Name]:
    """Yield the definitions that a reference of a kind in an element may mean, each name once."""
    scope = scope_of_reference(document, node)
    wanted = scope.get("name") if scope is not None and document.schema.format == "sdf" else None
    return _names_of_kinds(session, document, *_proposed_kinds(kind, document), scope=wanted)


def _names_of_kinds(session: Session, document: TextDocument, *kinds: str, scope: str | None = None) -> Iterator[Name]:
    """Yield the definitions of some kinds, in a scope of that name if one is given, each name once."""
    seen: set[str] = set()
    for other in _documents_with_names(session, document):
        for name in names_of(other):
            around = name.scope.get("name") if name.scope is not None else None
            if name.defines and name.kind in kinds and scope in {None, around} and name.text not in seen:
                seen.add(name.text)
                yield name


def _proposed_kinds(kind: ReferenceKind, document: TextDocument) -> tuple[str, ...]:
    """Return the kinds of definitions to propose for a kind of reference; in URDF only that kind itself."""
    if kind not in LOOKUP_ORDER:
        return (kind,)
    if document.schema.format == "urdf" or kind in {"link", "joint"}:
        return LOOKUP_ORDER[kind][:2] if kind != "joint" else ("joint",)
    return LOOKUP_ORDER[kind]


def _documents_with_names(session: Session, document: TextDocument) -> Iterator[TextDocument]:
    """Yield a document, its last well-formed state, and what it includes if it is xacro."""
    yield document
    # While somebody types, half of the document may be inside an element that is not closed yet.
    good = session.documents.last_good(document)
    if good is not None and good is not document:
        yield good
    if document.is_xacro:
        yield from session.neighbors.included(document, search_of(session, document))[1:]


_IN_EXPRESSION = lazy_pattern(r"\$\{[^}<>]*?(?P<word>[A-Za-z_]\w*)?$")
_IN_SUBSTITUTION = lazy_pattern(r"\$\((?P<command>[a-z]*)(?:\s+(?P<word>[\w.-]*))?$")
_COMMANDS = ("arg", "find", "dirname", "env", "optenv", "eval")
_LOOKED_BACK = 500


def in_expression(session: Session, document: TextDocument, offset: int) -> tuple[Span, list[Proposal]] | None:
    """Propose what may be written in `${...}` or `$(...)` at an offset; None outside of both."""
    before = document.text[max(0, offset - _LOOKED_BACK) : offset]
    found = _IN_EXPRESSION.search(before)
    if found is not None:
        names = [
            each
            for each in _names_of_kinds(session, document, "param", "property")
            if each.kind == "property" or _is_in_macro_of(each, document, offset)
        ]
        word = found["word"] or ""
        return Span(offset - len(word), offset), [_propose_name(each) for each in names]
    found = _IN_SUBSTITUTION.search(before)
    if found is None:
        return None
    if found["word"] is None:
        commands = [Proposal(each, each, _ITEM.Keyword) for each in _COMMANDS]
        return Span(offset - len(found["command"]), offset), commands
    names = _names_of_kinds(session, document, "arg") if found["command"] == "arg" else ()
    return Span(offset - len(found["word"]), offset), [_propose_name(each) for each in names]


def xacro_elements(session: Session, document: TextDocument, *, bare: bool) -> Iterator[Proposal]:
    """Propose the elements of xacro, and the macros that can be called."""
    if not document.is_xacro and "xmlns:xacro" not in document.text:
        return
    for name, (needed, _, text) in ELEMENTS.items():
        tag = f"{PREFIX}{name}"
        attributes = "".join(f' {each}="${number}"' for number, each in enumerate(needed, 1))
        ending = f">\n  $0\n</{tag}>" if name in {"macro", "if", "unless", "element"} else "/>$0"
        yield Proposal(tag, tag if bare else f"{tag}{attributes}{ending}", _ITEM.Keyword, "xacro", text)
    for macro in _names_of_kinds(session, document, "macro"):
        tag = f"{PREFIX}{macro.text}"
        needed = [each.name for each in parameter_names(macro.node) if each.needed]
        attributes = "".join(f' {literal(each)}="${number}"' for number, each in enumerate(needed, 1))
        new = literal(tag) if bare else f"{literal(tag)}{attributes}/>$0"
        yield Proposal(tag, new, _ITEM.Function, macro.node.get("params") or "")


def xacro_attributes(
    session: Session, document: TextDocument, node: TolerantNode, *, named: bool
) -> Iterator[Proposal]:
    """Propose the attributes of an element of xacro, or the parameters of the macro that it calls."""
    local = node.tag.removeprefix(PREFIX)
    if local in ELEMENTS:
        needed, others, _ = ELEMENTS[local]
        for name in (*needed, *others):
            if name not in node.attributes:
                yield Proposal(name, name if named else f'{name}="$1"', _ITEM.Property, rank=0 if name in needed else 1)
        return
    for macro in _names_of_kinds(session, document, "macro"):
        for each in parameter_names(macro.node) if macro.text == local else ():
            if not each.block and each.name not in node.attributes:
                name = literal(each.name)
                new = name if named else f'{name}="$1"'
                yield Proposal(each.name, new, _ITEM.Property, each.written, rank=0 if each.needed else 1)


def _is_in_macro_of(parameter: Name, document: TextDocument, offset: int) -> bool:
    """Whether an offset is in the macro of a parameter."""
    macro = parameter.node
    return macro in document.tree.nodes and macro.start <= offset <= macro.end


def _propose_name(name: Name) -> Proposal:
    return Proposal(name.text, literal(name.text), _ITEM.Variable, name.kind)


_ITEM = types.CompletionItemKind
_BOOLS = ("true", "false")
_PLACE = lazy_pattern(r"(?P<escaped>\\\$)|\$\{[^}$]*\}|\$.?", re.DOTALL)


def complete(session: Session, document: TextDocument, offset: int) -> types.CompletionList:
    """List what may be written at an offset, in place of the word that is there."""
    cursor = cursor_at(document, offset)
    if cursor is None:
        return types.CompletionList(is_incomplete=False, items=[])
    expression = in_expression(session, document, offset)
    if expression is not None:
        span, found = expression
        return _completion_list(session, document, span, found)
    return _completion_list(session, document, *_proposals(session, document, cursor, offset))


def _completion_list(
    session: Session, document: TextDocument, span: Span, found: Iterable[Proposal]
) -> types.CompletionList:
    range_ = document.positions.range(span)
    snippet = session.snippets
    items = [
        types.CompletionItem(
            label=each.label,
            kind=each.kind,
            detail=each.detail or None,
            documentation=types.MarkupContent(types.MarkupKind.Markdown, each.text) if each.text else None,
            sort_text=f"{each.rank}{number:04}",
            filter_text=each.label,
            insert_text_format=types.InsertTextFormat.Snippet if snippet else types.InsertTextFormat.PlainText,
            text_edit=types.TextEdit(range_, each.new if snippet else plain(each.new)),
        )
        for number, each in enumerate(found)
    ]
    return types.CompletionList(is_incomplete=False, items=items)


def plain(snippet: str) -> str:
    """Remove the places to fill in from a snippet."""
    return _PLACE.sub(lambda found: "$" if found["escaped"] else "", snippet)


def _proposals(
    session: Session, document: TextDocument, cursor: Cursor, offset: int
) -> tuple[Span, Iterable[Proposal]]:
    node = cursor.node
    match cursor.kind:
        case CursorKind.TAG:
            whole = node is not None and node.whole_tag
            return cursor.piece, _elements(session, document, node.parent if node else None, node, bare=whole)
        case CursorKind.ATTRIBUTE if node is not None:
            return cursor.piece, _attributes(session, document, node, named=cursor.attribute is not None)
        case CursorKind.VALUE if node is not None and cursor.attribute is not None:
            return cursor.piece, _values(session, document, node, cursor.attribute)
        case CursorKind.END_TAG if node is not None:
            return cursor.piece, [Proposal(node.tag, node.tag, _ITEM.Property)]
        case _:
            return _in_text(session, document, cursor, offset)


def _in_text(session: Session, document: TextDocument, cursor: Cursor, offset: int) -> tuple[Span, Iterable[Proposal]]:
    """Propose an end tag that was begun, values for the text of an element, or elements."""
    node = cursor.node
    start = document.text.rfind("<", 0, offset)
    if start >= 0 and document.text.startswith("</", start) and ">" not in document.text[start:offset]:
        tag = [Proposal(f"/{node.tag}", f"{node.tag}>", _ITEM.Property)] if node is not None else []
        return Span(start + 2, offset), tag
    if node is not None and not node.children:
        values = list(_values(session, document, node, None))
        if values:
            return cursor.piece, values
    empty = Span(offset, offset)
    piece = cursor.piece if "<" not in cursor.piece.of(document.text) and cursor.piece.end == offset else empty
    return piece, _with_bracket(_elements(session, document, node, None, bare=False))


def _with_bracket(found: Iterable[Proposal]) -> Iterator[Proposal]:
    for each in found:
        yield Proposal(each.label, f"<{each.new}", each.kind, each.detail, each.text, each.rank)


def _elements(
    session: Session, document: TextDocument, parent: TolerantNode | None, own: TolerantNode | None, *, bare: bool
) -> Iterator[Proposal]:
    """Propose the elements that may stand in another; `bare` proposes the names only."""
    if parent is None:
        yield from _roots(document) if document.tree.root in (None, own) else ()
        return
    there = [child.tag for child in parent.children if child is not own]
    place = document.schema.place(parent)
    for row in _children(place) if place is not None else ():
        if row.fact.repeats or row.fact.name not in there:
            name = row.fact.name
            new = name if bare else _element(name, row)
            yield Proposal(name, new, _ITEM.Class, _detail(row.fact), text_of_row(row), _rank(row.fact))
    for parameter in parameters_in(parent):
        if not parameter.is_attribute and (parameter.is_many or parameter.name not in there):
            yield _parameter(parameter, bare=bare)
    yield from xacro_elements(session, document, bare=bare)


def _children(place: SchemaPlace) -> list[MappingRow]:
    names = [row.name for row in place.known() if not row.is_attribute]
    rows = (place.below(name) for name in dict.fromkeys(names))
    return [row for row in rows if row is not None]


def _roots(document: TextDocument) -> Iterator[Proposal]:
    start = document.schema.start()
    if start is None:
        return
    if start.format == "urdf":
        yield Proposal("robot", 'robot name="$1">\n  $0\n</robot>', _ITEM.Class)
    else:
        yield Proposal("sdf", 'sdf version="${1:1.11}">\n  $0\n</sdf>', _ITEM.Class)


def _element(name: str, row: MappingRow) -> str:
    """Make the snippet of an element without its `<`, with the required attributes."""
    place = inside(row)
    known = place.known()
    needed = [fact for fact in known if fact.is_attribute and fact.required]
    attributes = "".join(f" {_attribute(fact, number)}" for number, fact in enumerate(needed, 1))
    if row.fact.type is not None or place.inside.type is not None:
        return f"{name}{attributes}>${len(needed) + 1}</{name}>$0"
    if any(not fact.is_attribute for fact in known) or row.fact.any or place.inside.any:
        return f"{name}{attributes}>\n  $0\n</{name}>"
    return f"{name}{attributes}/>$0"


def _attribute(fact: Fact, number: int) -> str:
    name = fact.name.removeprefix("@")
    if fact.enum:
        return f'{name}="${{{number}|{",".join(fact.enum)}|}}"'
    return f'{name}="${number}"' if fact.default is None else f'{name}="${{{number}:{fact.default}}}"'


def _parameter(parameter: PluginParameter, *, bare: bool) -> Proposal:
    name = parameter.name
    ending = ">\n  $0\n</" if parameter.children else ">$1</"
    new = name if bare else f"{name}{ending}{name}>"
    return Proposal(
        name, new, _ITEM.Field, parameter.type, described(parameter), rank=0 if parameter.is_required else 1
    )


def _attributes(session: Session, document: TextDocument, node: TolerantNode, *, named: bool) -> Iterator[Proposal]:
    """Propose the attributes that an element does not have yet; `named` proposes the names only."""
    if is_of_xacro(node.tag):
        yield from xacro_attributes(session, document, node, named=named)
        return
    place = document.schema.place(node)
    for fact in rows_by_name(place.known(), place.version).values() if place else ():
        name = fact.name.removeprefix("@")
        row = place.below(fact.name) if place and fact.is_attribute else None
        if row is not None and name not in node.attributes:
            new = name if named else _attribute(fact, 1)
            yield Proposal(name, new, _ITEM.Property, _detail(fact), text_of_row(row), _rank(fact))


def _values(session: Session, document: TextDocument, node: TolerantNode, attribute: str | None) -> Iterator[Proposal]:
    """Propose the values of an attribute or, without one, of the text of an element."""
    if node.parent is None and attribute == "version" and document.schema.table is not None:
        for version in reversed(document.schema.table.versions):
            yield Proposal(version, version, _ITEM.EnumMember)
        return
    row = document.schema.row(node, attribute)
    for value in _enumerated_values(row):
        yield Proposal(value, value, _ITEM.EnumMember)
    kind = kind_at(document, node, attribute)
    if kind is not None:
        for name in names_for(session, document, node, kind):
            yield Proposal(name.text, literal(name.text), _ITEM.Reference, name.kind)
    if node.tag == "plugin" and attribute in {"filename", "name"}:
        yield from _plugins(attribute)
    parameter = parameter_of(node) if attribute is None else None
    if parameter is not None:
        choices = parameter.choices or (_BOOLS if parameter.type == "bool" else ())
        for value in choices:
            yield Proposal(value, value, _ITEM.EnumMember)


def _enumerated_values(row: MappingRow | None) -> tuple[str, ...]:
    if row is None:
        return ()
    fact = row.fact
    also = tuple(value for value, _ in fact.also)
    return (*fact.enum, *also) or (_BOOLS if fact.type == "bool" else ())


def _plugins(attribute: str) -> Iterator[Proposal]:
    for each in systems().values():
        value = each.file if attribute == "filename" else each.class_name
        yield Proposal(value, value, _ITEM.Module, each.name)


def _rank(fact: Fact) -> int:
    return 2 if fact.dialect else 0 if fact.required else 1


def _detail(fact: Fact) -> str:
    words = [fact.type or "", fact.unit or "", f"default {fact.default}" if fact.default is not None else ""]
    words += ["required"] if fact.required else []
    words += [fact.dialect or ""]
    return ", ".join(filter(None, words))
