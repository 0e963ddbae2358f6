"""Completion of xacro: its elements, macros and their parameters, and what stands in `${...}` and `$(...)`."""

from collections.abc import Callable, Iterator

from twinform.compiler.input.xacro.vocabulary import BARE, CONSTANTS, MATH, PYTHON
from twinform.diagnostics import Span
from twinform.lazy import lazy_pattern
from twinform.server.completion.names import definitions_of, documents_with_names, macros_around
from twinform.server.completion.proposals import (
    ITEM,
    ElementPlace,
    Proposal,
    ValuePlace,
    element_snippet,
    literal,
    values,
)
from twinform.server.document_names import definitions_in, is_in
from twinform.server.documents import TextDocument
from twinform.server.names import ELEMENTS, Name, parameter_names
from twinform.server.navigation import search_of
from twinform.server.schema import PREFIX
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode

_IN_EXPRESSION = lazy_pattern(r"\$\{[^}<>]*?(?P<space>\b[A-Za-z_]\w*\.)?(?P<word>(?<![\w.])[A-Za-z_]\w*|(?<=\.)\w*)?$")
_IN_SUBSTITUTION = lazy_pattern(r"\$\((?P<command>[a-z]*)(?:\s+(?P<word>[\w.-]*))?$")
_COMMANDS = ("arg", "find", "dirname", "env", "optenv", "eval")
_LOOKED_BACK = 500
_HOLDING = frozenset({"macro", "if", "unless", "element"})
_SPACES = {"math.": MATH, "python.": PYTHON, "xacro.": ("load_yaml", "arg", "dotify", "abs_filename")}
_IN_MATH = ("pi", "e", "tau", "inf", "nan")


def has_xacro(document: TextDocument) -> bool:
    """Whether expressions and elements of xacro mean something in a document."""
    return document.is_xacro or "xmlns:xacro" in document.text


def propose_in_expression(session: Session, document: TextDocument, offset: int) -> tuple[Span, list[Proposal]] | None:
    """Propose what may be written in `${...}` or `$(...)` at an offset; None outside of both."""
    if not has_xacro(document):
        return None
    before = document.text[max(0, offset - _LOOKED_BACK) : offset]
    found = _IN_EXPRESSION.search(before)
    if found is not None:
        word, space = found["word"] or "", found["space"] or ""
        proposed = _in_namespace(space) if space else _in_expression(session, document, offset)
        return Span(offset - len(word), offset), list(proposed)
    found = _IN_SUBSTITUTION.search(before)
    if found is None:
        return None
    if found["word"] is None:
        return Span(offset - len(found["command"]), offset), list(values(_COMMANDS, ITEM.Keyword))
    word = Span(offset - len(found["word"]), offset)
    if found["command"] == "find":
        packages = search_of(session, document).package_names(document.path.absolute())
        return word, list(values(packages, ITEM.Module))
    names = definitions_of(session, document, "arg") if found["command"] == "arg" else ()
    return word, [_propose_name(each) for each in names if _is_before(each, document, offset)]


def _in_expression(session: Session, document: TextDocument, offset: int) -> Iterator[Proposal]:
    macros = list(macros_around(document.tree.at(offset)))
    for each in definitions_of(session, document, "param", "property"):
        is_known = _takes_value(each, macros) if each.kind == "param" else _is_visible(each, macros)
        if is_known and (each.kind == "param" or _is_before(each, document, offset)):
            yield _propose_name(each)
    yield from (Proposal(each, each, ITEM.Constant, rank=2) for each in CONSTANTS)
    yield from map(_propose_function, (*MATH, *BARE))


def _in_namespace(space: str) -> Iterator[Proposal]:
    yield from values(_IN_MATH if space == "math." else (), ITEM.Constant)
    yield from map(_propose_function, _SPACES.get(space, ()))


def _propose_function(name: str) -> Proposal:
    return Proposal(name, f"{name}($1)", ITEM.Function, rank=2)


def _propose_name(name: Name) -> Proposal:
    return Proposal(name.text, literal(name.text), ITEM.Variable, name.kind)


def _takes_value(parameter: Name, macros: list[TolerantNode]) -> bool:
    """Whether a parameter is one of the macros around, and takes a value and no block."""
    is_value = any(each.name == parameter.text and not each.block for each in parameter_names(parameter.node))
    return is_value and parameter.node in macros


def _is_visible(definition: Name, macros: list[TolerantNode]) -> bool:
    """Whether a property is not one of another macro's own."""
    own = next(macros_around(definition.node), None)
    return own is None or own in macros or definition.node.get("scope") in {"global", "parent"}


def _is_before(definition: Name, document: TextDocument, offset: int) -> bool:
    """Whether a definition is read before what stands at an offset: macros are read when they are called."""
    node = definition.node
    if not is_in(document, node) or node.end <= offset:
        return True
    return node.start > offset and next(macros_around(document.tree.at(offset)), None) is not None


def propose_xacro(place: ElementPlace) -> Iterator[Proposal]:
    """Propose the elements of xacro, and the macros that can be called."""
    document = place.document
    if not has_xacro(document):
        return
    in_macro = next(macros_around(place.parent), None) is not None
    for name, (needed, _, text) in ELEMENTS.items():
        if name == "insert_block" and not in_macro:
            continue
        tag = f"{PREFIX}{name}"
        new = tag if place.bare else element_snippet(tag, needed, holds=name in _HOLDING)
        yield Proposal(tag, new, ITEM.Keyword, "xacro", text)
    for macro in definitions_of(place.session, document, "macro"):
        yield _call_of(macro, bare=place.bare)


def _call_of(macro: Name, *, bare: bool) -> Proposal:
    """Propose a call of a macro with the parameters that it needs, and with room for its blocks."""
    tag = literal(f"{PREFIX}{macro.text}")
    parameters = parameter_names(macro.node)
    needed = (literal(each.name) for each in parameters if each.needed)
    new = tag if bare else element_snippet(tag, needed, holds=any(each.block for each in parameters))
    return Proposal(f"{PREFIX}{macro.text}", new, ITEM.Function, macro.node.get("params") or "")


def propose_blocks(place: ElementPlace) -> Iterator[Proposal]:
    """Propose the blocks of the macro that is called around a place."""
    macro = _macro_of_call(place.session, place.document, place.parent)
    for each in parameter_names(macro.node) if macro is not None else ():
        if each.block and each.name not in place.siblings:
            name = literal(each.name)
            new = name if place.bare else f"{name} $1/>$0"
            yield Proposal(each.name, new, ITEM.Field, f"block of {place.parent.tag}", rank=0)


def _macro_of_call(session: Session, document: TextDocument, node: TolerantNode) -> Name | None:
    local = node.tag.removeprefix(PREFIX)
    if local == node.tag or local in ELEMENTS:
        return None
    return next((each for each in definitions_of(session, document, "macro") if each.text == local), None)


def propose_attributes_of_xacro(
    session: Session, document: TextDocument, node: TolerantNode, *, named: bool
) -> Iterator[Proposal]:
    """Propose the attributes of an element of xacro, or the parameters of the macro that it calls."""
    local = node.tag.removeprefix(PREFIX)
    if local in ELEMENTS:
        needed, others, _ = ELEMENTS[local]
        for name in (*needed, *others):
            if name not in node.attributes:
                yield Proposal(name, name if named else f'{name}="$1"', ITEM.Property, rank=0 if name in needed else 1)
        return
    macro = _macro_of_call(session, document, node)
    for each in parameter_names(macro.node) if macro is not None else ():
        if not each.block and each.name not in node.attributes:
            name = literal(each.name)
            new = name if named else f'{name}="$1"'
            yield Proposal(each.name, new, ITEM.Property, each.written, rank=0 if each.needed else 1)


def _propose_inserted(place: ValuePlace) -> Iterator[Proposal]:
    """Propose the blocks of the macro around, and the properties that hold elements."""
    for macro in macros_around(place.node):
        blocks = (each.name for each in parameter_names(macro) if each.block)
        yield from values(blocks, ITEM.Field, "block")
    for other in documents_with_names(place.session, place.document):
        for name in definitions_in(other):
            if name.kind == "property" and name.node.children:
                yield _propose_name(name)


def _propose_macros(place: ValuePlace) -> Iterator[Proposal]:
    yield from map(_propose_name, definitions_of(place.session, place.document, "macro"))


def _propose_booleans(_: ValuePlace) -> Iterator[Proposal]:
    yield from values(("true", "false"))


def _propose_scopes(place: ValuePlace) -> Iterator[Proposal]:
    # a property at the top has nothing around it
    yield from values(("parent", "global") if next(macros_around(place.node), None) else ("global",))


VALUES: dict[tuple[str, str], Callable[[ValuePlace], Iterator[Proposal]]] = {
    ("xacro:insert_block", "name"): _propose_inserted,
    ("xacro:call", "macro"): _propose_macros,
    ("xacro:if", "value"): _propose_booleans,
    ("xacro:unless", "value"): _propose_booleans,
    ("xacro:include", "optional"): _propose_booleans,
    ("xacro:property", "scope"): _propose_scopes,
    ("xacro:property", "lazy_eval"): _propose_booleans,
    ("xacro:property", "remove"): _propose_booleans,
}
"""What is proposed for the attributes of elements of xacro."""
