"""Names in MJCF: which elements have one of which kind, and which attributes refer to such a kind by the facts tables.

Each kind has names of its own in the whole model: a body and a joint may share one, and none has a scope.
"""

from collections.abc import Iterator

from twinform.diagnostics import Span
from twinform.lazy import lazy_pattern
from twinform.schemas.mjcf_references import kind_of_object, kind_of_tag
from twinform.server.mapping import MappingRow
from twinform.server.names import Name
from twinform.server.tolerant_tree import TolerantNode

CLASS = "default"
"""The kind of the classes of defaults."""
_OTHERS = {"frame": "frame", "instance": "instance"}
"""Elements with names that no check asks for, by their tags: kinds that the tables name."""
_OBJECT_TYPES = {"objname": "objtype", "refname": "reftype"}
_ELSEWHERE = frozenset({"attach"})
"""Elements whose references are about another file."""
_WORD = lazy_pattern(r"\S+")


def definition_of(node: TolerantNode) -> Name | None:
    """Return the name that an element has."""
    attribute, kind = ("class", CLASS) if node.tag == CLASS else ("name", _kind_of(node))
    text = node.get(attribute)
    if kind is None or not text:
        return None
    return Name(text, node.attributes[attribute].value, node, kind, defines=True)


def _kind_of(node: TolerantNode) -> str | None:
    section = node
    while section.parent is not None and section.parent.parent is not None:
        section = section.parent
    return _OTHERS.get(node.tag) or kind_of_tag(node.tag, section.tag)


def kinds_at(node: TolerantNode, attribute: str, row: MappingRow | None) -> tuple[str, ...]:
    """Return the kinds of which an attribute names one; none where it names nothing here."""
    if row is None or node.tag in _ELSEWHERE:
        return ()
    said = node.get(_OBJECT_TYPES.get(attribute, ""))
    return (kind_of_object(said),) if said and row.fact.names else row.fact.names


def references_of(node: TolerantNode, attribute: str, span: Span, row: MappingRow | None) -> Iterator[Name]:
    """Yield what an attribute refers to: one name, or several with blanks between them."""
    kinds, value = kinds_at(node, attribute, row), node.values[attribute]
    if not kinds or row is None:
        return
    places = [(0, len(value))] if row.fact.type != "words" else [found.span() for found in _WORD.finditer(value)]
    for start, end in places:
        place = Span(span.start + start, span.start + end)
        yield Name(value[start:end], place, node, kinds[0], defines=False)
