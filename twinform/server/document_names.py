"""Names in a document: what is defined, and what refers to it by its name.

Which attributes and texts are references is known from the fields of the IR that they fill (`ir/references.py`); in
plugins and other parts without a typed form, the name of the parameter shows it, as `rename` goes by.
"""

from collections.abc import Iterable, Iterator
from functools import cache
from typing import NamedTuple, TypeVar

from twinform.compiler.input.size_limits import MOST_ATTRIBUTES
from twinform.diagnostics import Span
from twinform.ir import Element
from twinform.ir.references import REFERENCES, ReferenceKind
from twinform.passes.structure.reference_words import kind_of_attribute, kind_of_text
from twinform.server.documents import TextDocument
from twinform.server.mapping.row_targets import field_of
from twinform.server.mapping.rows import FormatName, MappingRow
from twinform.server.name import Name
from twinform.server.schema import is_of_xacro
from twinform.server.tolerant_tree import TolerantNode
from twinform.server.xacro_names import XACRO_KINDS, xacro_names

Key = TypeVar("Key")
DEFINED = ("link", "joint", "frame", "model", "material", "sensor")
"""What is called by its attribute `name`, and can be found by it."""
_SCOPES = frozenset({"model", "world", "robot"})
_STATES = frozenset({"model", "model_state"})
_MACRO = "xacro:macro"
# Deeper names are not followed: each step of `a::b::c` is known by all those before it, which is
# quadratic.
_MOST_STEPS = 64
_FIELDS: dict[str, ReferenceKind] = {
    f"{node.__name__}.{field}": kind for node, fields in REFERENCES.items() for field, kind in fields.items()
}


def names_of(document: TextDocument) -> tuple[Name, ...]:
    """All names in a document, in the order of the text."""
    return document.once(_collected)


class NameSurroundings(NamedTuple):
    """The nearest scope and macro, the element itself included, and whether it is part of a recorded state."""

    scope: TolerantNode | None
    macro: TolerantNode | None
    in_state: bool


_NOWHERE = NameSurroundings(None, None, in_state=False)


def surroundings(document: TextDocument, node: TolerantNode | None) -> NameSurroundings:
    """What is around an element in a document: nothing, if the element is one of another document."""
    return document.once(_all_surroundings).get(node, _NOWHERE)


def _all_surroundings(document: TextDocument) -> dict[TolerantNode | None, NameSurroundings]:
    """Return the surroundings of all elements, each made from its parent's: climbing for each takes minutes."""
    found: dict[TolerantNode | None, NameSurroundings] = {None: _NOWHERE}
    for node in document.tree.nodes:
        outer, parent = found[node.parent], node.parent
        found[node] = NameSurroundings(
            scope=node if node.tag in _SCOPES else outer.scope,
            macro=node if node.tag == _MACRO else outer.macro,
            in_state=outer.in_state or (parent is not None and parent.tag == "state"),
        )
    return found


def defined(document: TextDocument, text: str, kind: str, scope: TolerantNode | None) -> list[Name]:
    """The definitions of a name of a kind in one scope."""
    return document.once(_by_scope).get((text, kind, scope), [])


def defined_anywhere(document: TextDocument, text: str, kind: str) -> list[Name]:
    """The definitions of a name of a kind in any scope."""
    return document.once(_by_kind).get((text, kind), [])


def _collected(document: TextDocument) -> tuple[Name, ...]:
    """All names; those of models first, then those of xacro."""
    return (*_names(document), *xacro_names(document))


def _by_scope(document: TextDocument) -> dict[tuple[str, str, TolerantNode | None], list[Name]]:
    return _grouped(((each.text, each.kind, each.scope), each) for each in names_of(document) if each.defines)


def _by_kind(document: TextDocument) -> dict[tuple[str, str], list[Name]]:
    return _grouped(((each.text, each.kind), each) for each in names_of(document) if each.defines)


def _grouped(pairs: Iterable[tuple[Key, Name]]) -> dict[Key, list[Name]]:
    found: dict[Key, list[Name]] = {}
    for key, name in pairs:
        found.setdefault(key, []).append(name)
    return found


def name_at(document: TextDocument, offset: int) -> Name | None:
    """The name around an offset; the innermost, where one is in an expression that is in another."""
    around = [each for each in names_of(document) if each.span.start <= offset <= each.span.end]
    return min(around, key=lambda each: each.span.end - each.span.start, default=None)


def _names(document: TextDocument) -> Iterator[Name]:
    for node in document.tree.nodes:
        if node.tag and not is_of_xacro(node.tag) and len(node.attributes) <= MOST_ATTRIBUTES:
            yield from _of_attributes(document, node)
            yield from _of_text(document, node)


def _of_attributes(document: TextDocument, node: TolerantNode) -> Iterator[Name]:
    for attribute, span in node.attributes.items():
        value = node.values[attribute]
        if not value:
            continue
        if attribute == "name" and _defines(document, node):
            yield Name(value, span.value, node, node.tag, defines=True, scope=surroundings(document, node.parent).scope)
            continue
        if attribute == "name" and node.tag in _STATES and surroundings(document, node).in_state:
            yield Name(value, span.value, node, "model", defines=False)
            continue
        # Rows of the facts tables lead to fields of the IR, and `REFERENCES` says what these name,
        # so an editor needs no list of its own. A test renames every name of the examples in the
        # text and by the pass, and compares the models.
        kind = kind_at(document, node, attribute)
        if kind is not None:
            yield from _steps(document, value, span.value, node, kind)


def _steps(document: TextDocument, text: str, span: Span, node: TolerantNode, kind: str) -> Iterator[Name]:
    """A reference; of `model::part` each step on its own, known by all the steps before it."""
    if text.count("::") >= _MOST_STEPS:
        return
    start, scope = span.start, scope_of_reference(document, node)
    for step in text.split("::"):
        end = start + len(step)
        last = end == span.end
        whole = text[: end - span.start]
        if step:
            yield Name(whole, Span(start, end), node, kind if last else "model", defines=False, scope=scope)
        start = end + len("::")


def _of_text(document: TextDocument, node: TolerantNode) -> Iterator[Name]:
    if node.children or node.empty or not node.closed:
        return
    kind = kind_at(document, node, None)
    names_include = node.tag == "name" and node.parent is not None and node.parent.tag == "include"
    if kind is None and not names_include:
        return
    span = document.tree.text_of(node)
    text = span.of(document.text)
    if names_include and text and node.parent is not None:
        yield Name(text, span, node.parent, "model", defines=True, scope=surroundings(document, node.parent).scope)
    elif kind is not None and text and "<" not in text:
        yield from _steps(document, text, span, node, kind)


def _defines(document: TextDocument, node: TolerantNode) -> bool:
    """Whether an element is what its name calls, and not something that refers to it."""
    if node.tag not in DEFINED or (node.tag == "model" and surroundings(document, node).in_state):
        return False
    row = document.schema.row(node)
    if row is None:
        return document.schema.place(node) is None and _is_misplaced(document, node)
    if node.tag == "material":
        return row.format == "urdf" and (row.definition == "robot" or bool(node.children))
    return row.fact.place is not None or row.fact.reference in DEFINED


def _is_misplaced(document: TextDocument, node: TolerantNode) -> bool:
    """Whether it stands where the facts have no such element, as while the element before it is not closed yet."""
    return not document.tree.whole and any(child.tag for child in node.children)


def kind_at(document: TextDocument, node: TolerantNode, attribute: str | None) -> ReferenceKind | None:
    """What an attribute, or the text of an element, names."""
    row = document.schema.row(node, attribute)
    if row is not None and row.fact.place is not None and row.fact.place != ".":
        return _FIELDS.get(_field(row))
    if _is_typed(document, node):
        return None
    element = Element.unchecked(name=node.tag, attributes=tuple(node.values.items()))
    if attribute is None:
        return kind_of_text(element, node.parent.tag if node.parent else "")
    if attribute == "name" and node.tag in {"sensor", "plugin", "frame", "param"}:
        return None
    return kind_of_attribute(element, attribute)


def _is_typed(document: TextDocument, node: TolerantNode) -> bool:
    """Whether the IR knows the element, so that what refers to something in it is known too."""
    row = document.schema.row(node)
    return row is not None and row.fact.place is not None


@cache
def _field(row: MappingRow) -> str:
    """The field of the IR that a row fills, whatever kind of node it is in."""
    return field_of(row).partition(":")[0]


def scope_of_reference(document: TextDocument, node: TolerantNode) -> TolerantNode | None:
    """The scope of what an element refers to: for the pose of a model itself that around the model."""
    scope = surroundings(document, node).scope
    if scope is not None and node.tag == "pose" and node.parent is scope:
        return surroundings(document, scope.parent).scope
    return scope


def found_in(document: TextDocument, name: Name) -> list[Name]:
    """The definitions that a name means in a document: of the first kind that has any, in the nearest scope."""
    format: FormatName | None = document.schema.format
    if format == "sdf" and "::" in name.text:
        return _inside(document, name)
    if name.kind in XACRO_KINDS:
        return _parameters(document, name) or defined_anywhere(document, name.text, name.kind)
    scope = None if format == "urdf" else _model_of_state(document, name.scope)
    for kind in name.kinds:
        own = defined(document, name.text, kind, scope) if scope else defined_anywhere(document, name.text, kind)
        if own:
            return own
    return []


def _parameters(document: TextDocument, name: Name) -> list[Name]:
    """The parameter that a name means: that of the nearest macro around it that has one."""
    around = surroundings(document, name.node) if name.kind in {"property", "param"} else None
    while around is not None and around.macro is not None:
        own = defined(document, name.text, "param", around.macro)
        if own:
            return own[-1:]
        around = surroundings(document, around.macro.parent)
    return []


def _model_of_state(document: TextDocument, scope: TolerantNode | None) -> TolerantNode | None:
    """The model whose state an element records; any other scope itself."""
    if scope is None or not surroundings(document, scope).in_state:
        return scope
    models = defined_anywhere(document, scope.get("name") or "", "model")
    return models[0].node if models else scope


def _inside(document: TextDocument, name: Name) -> list[Name]:
    """What `inner::name` means: the last of its words, in models of these names in each other."""
    *outer, last = name.text.split("::")
    scope = name.scope
    for step in outer:
        models = defined(document, step, "model", scope)
        if not models:
            return []
        scope = models[0].node
    return [own for kind in name.kinds for own in defined(document, last, kind, scope)][:1]
