"""Names in a document: definitions, and references to them.

Which attributes and texts are references follows from the fields of the IR that they fill (`ir/references.py`). In
plugins and other parts without a typed form it follows from the name of the parameter, as for the pass `rename`.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator
from functools import cache
from typing import NamedTuple, TypeVar

from twinform.compiler.input.size_limits import MOST_ATTRIBUTES
from twinform.diagnostics import Span
from twinform.ir import Element
from twinform.ir.references import REFERENCES, ReferenceKind
from twinform.passes.structure.reference_words import kind_of_attribute, kind_of_text
from twinform.server import mjcf_names
from twinform.server.mapping import FormatName, MappingRow, field_of
from twinform.server.model_text import ModelText
from twinform.server.names import XACRO_KINDS, Name, xacro_names
from twinform.server.schema import SchemaPlace, is_of_xacro
from twinform.server.tolerant_tree import TolerantNode

Key = TypeVar("Key")
DEFINED = ("link", "joint", "frame", "model", "material", "sensor")
"""Elements whose attribute `name` defines a name."""
_SCOPES = frozenset({"model", "world", "robot"})
_STATES = frozenset({"model", "model_state"})
_MACRO = "xacro:macro"
# Deeper names are not followed: each step of `a::b::c` keeps all steps before it, which is quadratic.
_MOST_STEPS = 64
_FIELDS: dict[str, ReferenceKind] = {
    f"{node.__name__}.{field}": kind for node, fields in REFERENCES.items() for field, kind in fields.items()
}


def names_of(document: ModelText) -> tuple[Name, ...]:
    """Return all names in a document: those of models in the order of the text, then those of xacro."""
    return document.once(_collect_names)


def definitions_in(document: ModelText) -> tuple[Name, ...]:
    """Return all definitions in a document, without looking for references: few elements can define a name."""
    return document.once(_collect_definitions)


def _collect_definitions(document: ModelText) -> tuple[Name, ...]:
    own = (name for node in document.tree.nodes if (name := _definition(document, node)) is not None)
    return (*own, *(name for name in xacro_names(document) if name.defines))


def _definition(document: ModelText, node: TolerantNode) -> Name | None:
    """Return the name that the attribute `name` of an element defines, or the text of the `<name>` of an include."""
    if document.schema.format == "mjcf":
        return mjcf_names.definition_of(node)
    if node.tag in DEFINED and node.get("name") and _defines(document, node):
        scope = surroundings(document, node.parent).scope
        return Name(node.values["name"], node.attributes["name"].value, node, node.tag, defines=True, scope=scope)
    include = node.parent
    if node.tag != "name" or include is None or include.tag != "include" or not _has_text(node):
        return None
    span = document.tree.text_of(node)
    text, scope = span.of(document.text), surroundings(document, include.parent).scope
    return Name(text, span, include, "model", defines=True, scope=scope) if text else None


class NameSurroundings(NamedTuple):
    """The nearest scope and macro of an element, itself included, and whether it is in a recorded `<state>`."""

    scope: TolerantNode | None
    macro: TolerantNode | None
    in_state: bool


_NOWHERE = NameSurroundings(None, None, in_state=False)


def surroundings(document: ModelText, node: TolerantNode | None) -> NameSurroundings:
    """Return the surroundings of an element; empty ones if the element is of another document."""
    return document.once(_all_surroundings).get(node, _NOWHERE)


def is_in(document: ModelText, node: TolerantNode) -> bool:
    """Whether an element is one of this state of a document."""
    return node in document.once(_all_surroundings)


def _all_surroundings(document: ModelText) -> dict[TolerantNode | None, NameSurroundings]:
    """Return the surroundings of all elements, each made from its parent's: climbing up from each takes minutes."""
    found: dict[TolerantNode | None, NameSurroundings] = {None: _NOWHERE}
    for node in document.tree.nodes:
        outer, parent = found[node.parent], node.parent
        if node.tag in _SCOPES:
            outer = outer._replace(scope=node)
        elif node.tag == _MACRO:
            outer = outer._replace(macro=node)
        if parent is not None and parent.tag == "state" and not outer.in_state:
            outer = outer._replace(in_state=True)
        found[node] = outer
    return found


def defined(document: ModelText, text: str, kind: str, scope: TolerantNode | None) -> list[Name]:
    """Return the definitions of a name of a kind in one scope."""
    return document.once(_by_scope).get((text, kind, scope), [])


def defined_anywhere(document: ModelText, text: str, kind: str) -> list[Name]:
    """Return the definitions of a name of a kind in any scope."""
    return document.once(_by_kind).get((text, kind), [])


def _collect_names(document: ModelText) -> tuple[Name, ...]:
    return (*_model_names(document), *xacro_names(document))


def _by_scope(document: ModelText) -> dict[tuple[str, str, TolerantNode | None], list[Name]]:
    return _group(((each.text, each.kind, each.scope), each) for each in names_of(document) if each.defines)


def _by_kind(document: ModelText) -> dict[tuple[str, str], list[Name]]:
    return _group(((each.text, each.kind), each) for each in names_of(document) if each.defines)


def _group(pairs: Iterable[tuple[Key, Name]]) -> dict[Key, list[Name]]:
    found: dict[Key, list[Name]] = defaultdict(list)
    for key, name in pairs:
        found[key].append(name)
    return found


def name_at(document: ModelText, offset: int) -> Name | None:
    """Return the name at an offset; the innermost, if an expression with names is part of a name."""
    around = [each for each in names_of(document) if each.span.start <= offset <= each.span.end]
    return min(around, key=lambda each: each.span.end - each.span.start, default=None)


def _model_names(document: ModelText) -> Iterator[Name]:
    for node in document.tree.nodes:
        if node.tag and not is_of_xacro(node.tag) and _may_name(document, node):
            definition = _definition(document, node)
            if definition is not None:
                yield definition
            yield from _names_in_attributes(document, node, definition)
            if definition is None or definition.node is node:
                yield from _names_in_text(document, node)


def _may_name(document: ModelText, node: TolerantNode) -> bool:
    """Whether there can be a name in an element, which most elements at most places do not have."""
    place = document.schema.place(node)
    if place is not None and place.row is not None and place.row.fact.place is not None:
        return _has_names(place) and len(node.attributes) <= MOST_ATTRIBUTES
    return len(node.attributes) <= MOST_ATTRIBUTES


@cache
def _has_names(place: SchemaPlace) -> bool:
    """Whether elements with a field in the IR define a name or refer to one."""
    tag = place.row.fact.name if place.row is not None else ""
    if tag in DEFINED or tag in _STATES or tag == "name":
        return True
    kept = [row for name, row in place.rows.items() if name.startswith("@")] + ([place.row] if place.row else [])
    return any(_kind_of_row(row) is not None for row in kept)


def _names_in_attributes(document: ModelText, node: TolerantNode, definition: Name | None) -> Iterator[Name]:
    for attribute, span in node.attributes.items():
        value = node.values[attribute]
        if not value:
            continue
        if definition is not None and span.value == definition.span:
            continue
        if document.schema.format == "mjcf":
            row = document.schema.row(node, attribute)
            yield from mjcf_names.references_of(node, attribute, span.value, row)
            continue
        if attribute == "name" and node.tag in _STATES and surroundings(document, node).in_state:
            yield Name(value, span.value, node, "model", defines=False)
            continue
        # Rows of the facts tables lead to fields of the IR, and `REFERENCES` says what these name,
        # so an editor needs no list of its own. A test renames every name of the examples in the
        # text and by the pass, and compares the models.
        kind = kind_at(document, node, attribute)
        if kind is not None:
            yield from _split_reference(document, value, span.value, node, kind)


def _split_reference(document: ModelText, text: str, span: Span, node: TolerantNode, kind: str) -> Iterator[Name]:
    """Yield a name for each step of a reference such as `model::part`, with all steps before it in its text."""
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


def _names_in_text(document: ModelText, node: TolerantNode) -> Iterator[Name]:
    kind = kind_at(document, node, None) if _has_text(node) else None
    span = document.tree.text_of(node) if kind is not None else None
    text = span.of(document.text) if span is not None else ""
    if kind is not None and span is not None and text and "<" not in text:
        yield from _split_reference(document, text, span, node, kind)


def _has_text(node: TolerantNode) -> bool:
    return not node.children and not node.empty and node.closed


def _defines(document: ModelText, node: TolerantNode) -> bool:
    """Whether the attribute `name` of an element defines a name, and does not refer to one."""
    if node.tag not in DEFINED or (node.tag == "model" and surroundings(document, node).in_state):
        return False
    row = document.schema.row(node)
    if row is None:
        return document.schema.place(node) is None and _is_misplaced(document, node)
    if node.tag == "material":
        return row.format == "urdf" and (row.definition == "robot" or bool(node.children))
    return row.fact.place is not None or row.fact.reference in DEFINED


def _is_misplaced(document: ModelText, node: TolerantNode) -> bool:
    """Whether an element with children has no place there because an element before it is not closed yet."""
    return not document.tree.whole and any(child.tag for child in node.children)


def kind_at(document: ModelText, node: TolerantNode, attribute: str | None) -> ReferenceKind | None:
    """Return the kind of thing that an attribute refers to or, without one, the text of an element."""
    if document.schema.format == "mjcf":
        return None
    row = document.schema.row(node, attribute)
    if row is not None and row.fact.place is not None and row.fact.place != ".":
        return _kind_of_row(row)
    if _is_typed(document, node):
        return None
    element = Element.unchecked(name=node.tag, attributes=tuple(node.values.items()))
    if attribute is None:
        return kind_of_text(element, node.parent.tag if node.parent else "")
    if attribute == "name" and node.tag in {"sensor", "plugin", "frame", "param"}:
        return None
    return kind_of_attribute(element, attribute)


def _is_typed(document: ModelText, node: TolerantNode) -> bool:
    """Whether the IR has a field for the element, and so for all references in it."""
    row = document.schema.row(node)
    return row is not None and row.fact.place is not None


@cache
def _kind_of_row(row: MappingRow) -> ReferenceKind | None:
    """Return the kind of thing that the field names which a row fills, whatever the kind of a union."""
    return _FIELDS.get(field_of(row).partition(":")[0])


def scope_of_reference(document: ModelText, node: TolerantNode) -> TolerantNode | None:
    """Return the scope of the references in an element; the pose of a model refers to names around the model."""
    scope = surroundings(document, node).scope
    if scope is not None and node.tag == "pose" and node.parent is scope:
        return surroundings(document, scope.parent).scope
    return scope


def resolve_in(document: ModelText, name: Name) -> list[Name]:
    """Find the definitions that a name refers to in a document: of the first kind that has any, in its scope."""
    format: FormatName | None = document.schema.format
    if format == "sdf" and "::" in name.text:
        return _resolve_scoped(document, name)
    if name.kind in XACRO_KINDS:
        return _resolve_parameter(document, name) or defined_anywhere(document, name.text, name.kind)
    scope = None if format != "sdf" else _model_of_state(document, name.scope)
    for kind in name.kinds:
        own = defined(document, name.text, kind, scope) if scope else defined_anywhere(document, name.text, kind)
        if own:
            return own
    return []


def _resolve_parameter(document: ModelText, name: Name) -> list[Name]:
    """Find the parameter of that name of the nearest macro around it that has one."""
    around = surroundings(document, name.node) if name.kind in {"property", "param"} else None
    while around is not None and around.macro is not None:
        own = defined(document, name.text, "param", around.macro)
        if own:
            return own[-1:]
        around = surroundings(document, around.macro.parent)
    return []


def _model_of_state(document: ModelText, scope: TolerantNode | None) -> TolerantNode | None:
    """Return the model that a scope in a `<state>` stands for; any other scope itself."""
    if scope is None or not surroundings(document, scope).in_state:
        return scope
    models = defined_anywhere(document, scope.get("name") or "", "model")
    return models[0].node if models else scope


def _resolve_scoped(document: ModelText, name: Name) -> list[Name]:
    """Find what `outer::inner::name` refers to, through nested models."""
    *outer, last = name.text.split("::")
    scope = name.scope
    for step in outer:
        models = defined(document, step, "model", scope)
        if not models:
            return []
        scope = models[0].node
    return [own for kind in name.kinds for own in defined(document, last, kind, scope)][:1]


def undefined_names(document: ModelText) -> Iterator[Name]:
    """Yield the references to what has no definition in the text; other files may define some of it."""
    for name in names_of(document):
        if not name.defines and not resolve_in(document, name):
            yield name
