"""Proposals of completion: names that can be referred to, and elements, parameters and expressions of xacro."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from lsprotocol import types

from twinform.diagnostics import Span
from twinform.ir.references import ReferenceKind
from twinform.passes.structure.rename_parts import LOOKUP_ORDER
from twinform.server.document_names import names_of, scope_of_reference
from twinform.server.documents import TextDocument
from twinform.server.names import ELEMENTS, Name, parameter_names
from twinform.server.navigation import search_of
from twinform.server.schema import PREFIX
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


_ITEM = types.CompletionItemKind
_IN_EXPRESSION = re.compile(r"\$\{[^}<>]*?(?P<word>[A-Za-z_]\w*)?$")
_IN_SUBSTITUTION = re.compile(r"\$\((?P<command>[a-z]*)(?:\s+(?P<word>[\w.-]*))?$")
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
