"""What may be written at the cursor in the language of xacro: elements, macros, parameters, and expressions."""

import re
from collections.abc import Iterator

from lsprotocol import types

from twinform.diagnostics import Span
from twinform.server.documents import TextDocument
from twinform.server.known_names import names_of_kind
from twinform.server.name import Name
from twinform.server.proposal import Proposal, literal
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode
from twinform.server.xacro_names import ELEMENTS, PREFIX, parameter_names

_ITEM = types.CompletionItemKind
_IN_EXPRESSION = re.compile(r"\$\{[^}<>]*?(?P<word>[A-Za-z_]\w*)?$")
_IN_SUBSTITUTION = re.compile(r"\$\((?P<command>[a-z]*)(?:\s+(?P<word>[\w.-]*))?$")
_COMMANDS = ("arg", "find", "dirname", "env", "optenv", "eval")
_LOOKED_BACK = 500


def in_expression(session: Session, document: TextDocument, offset: int) -> tuple[Span, list[Proposal]] | None:
    """What may be written in `${...}` or `$(...)` at an offset; None outside of these."""
    before = document.text[max(0, offset - _LOOKED_BACK) : offset]
    found = _IN_EXPRESSION.search(before)
    if found is not None:
        names = [
            each
            for each in names_of_kind(session, document, "param", "property")
            if each.kind == "property" or _is_here(each, document, offset)
        ]
        word = found["word"] or ""
        return Span(offset - len(word), offset), [_named(each.text, each.kind) for each in names]
    found = _IN_SUBSTITUTION.search(before)
    if found is None:
        return None
    if found["word"] is None:
        commands = [Proposal(each, each, _ITEM.Keyword) for each in _COMMANDS]
        return Span(offset - len(found["command"]), offset), commands
    names = names_of_kind(session, document, "arg") if found["command"] == "arg" else ()
    return Span(offset - len(found["word"]), offset), [_named(each.text, each.kind) for each in names]


def xacro_elements(session: Session, document: TextDocument, *, bare: bool) -> Iterator[Proposal]:
    """The elements of xacro, and the macros that can be called."""
    if not document.is_xacro and "xmlns:xacro" not in document.text:
        return
    for name, (needed, _, text) in ELEMENTS.items():
        tag = f"{PREFIX}{name}"
        attributes = "".join(f' {each}="${number}"' for number, each in enumerate(needed, 1))
        ending = f">\n  $0\n</{tag}>" if name in {"macro", "if", "unless", "element"} else "/>$0"
        yield Proposal(tag, tag if bare else f"{tag}{attributes}{ending}", _ITEM.Keyword, "xacro", text)
    for macro in names_of_kind(session, document, "macro"):
        tag = f"{PREFIX}{macro.text}"
        needed = [each.name for each in parameter_names(macro.node) if each.needed]
        attributes = "".join(f' {literal(each)}="${number}"' for number, each in enumerate(needed, 1))
        new = literal(tag) if bare else f"{literal(tag)}{attributes}/>$0"
        yield Proposal(tag, new, _ITEM.Function, macro.node.get("params") or "")


def xacro_attributes(
    session: Session, document: TextDocument, node: TolerantNode, *, named: bool
) -> Iterator[Proposal]:
    """The attributes of an element of xacro, or the parameters of the macro that is called."""
    local = node.tag.removeprefix(PREFIX)
    if local in ELEMENTS:
        needed, others, _ = ELEMENTS[local]
        for name in (*needed, *others):
            if name not in node.attributes:
                yield Proposal(name, name if named else f'{name}="$1"', _ITEM.Property, rank=0 if name in needed else 1)
        return
    for macro in names_of_kind(session, document, "macro"):
        for each in parameter_names(macro.node) if macro.text == local else ():
            if not each.block and each.name not in node.attributes:
                name = literal(each.name)
                new = name if named else f'{name}="$1"'
                yield Proposal(each.name, new, _ITEM.Property, each.written, rank=0 if each.needed else 1)


def _is_here(parameter: Name, document: TextDocument, offset: int) -> bool:
    """Whether a place is in the macro of a parameter."""
    macro = parameter.node
    return macro in document.tree.nodes and macro.start_tag.start <= offset <= macro.end


def _named(text: str, kind: str) -> Proposal:
    return Proposal(text, literal(text), _ITEM.Variable, kind)
