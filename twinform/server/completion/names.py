"""Completion of names: what a reference may mean in a document, in what it includes, and in its last good state."""

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import islice
from pathlib import Path

from twinform.ir.frames import MODEL, WORLD
from twinform.ir.references import ReferenceKind
from twinform.passes.structure.rename_parts import LOOKUP_ORDER
from twinform.server.completion.proposals import ITEM, Proposal, ValuePlace, literal
from twinform.server.document_names import definitions_in, kind_at, scope_of_reference, surroundings
from twinform.server.documents import TextDocument
from twinform.server.includes import includes_of, target
from twinform.server.mjcf_names import kinds_at
from twinform.server.names import Name
from twinform.server.navigation import first_model, included_as, search_of
from twinform.server.schema import parameter_of
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode

_MOST_INCLUDES = 20
"""The includes of a document whose models are read for one answer."""


_PLACEMENT = "include/placement_frame"
_IN_NAMESPACES = frozenset({"macro", "property"})
_DEEPEST = 8
"""The most steps of a name such as `model::model::link`."""
_DEEPEST_TREE = 256
"""The depth of elements beyond which no reader takes a file."""


def propose_names(place: ValuePlace) -> Iterator[Proposal]:
    """Propose what may be named in a value, if it is a reference."""
    row = place.document.schema.row(place.node, place.attribute)
    path = row.path if row else ""
    # a name in another file, which no reference of this one is about
    if place.document.schema.format == "mjcf":
        yield from _propose_mjcf_names(place)
        return
    kind = "any" if path == _PLACEMENT else _kind_of_value(place)
    if kind is None:
        return
    refused = _refused(place, path)
    inside = f"{place.node.parent.get('name')}::" if place.node.tag == "pose" and place.node.parent else "::"
    for text, found in _names_for(place, kind, path):
        if text not in refused and not text.startswith(inside):
            yield Proposal(text, literal(text), ITEM.Reference, found)


def _propose_mjcf_names(place: ValuePlace) -> Iterator[Proposal]:
    if place.attribute is None:
        return
    row = place.document.schema.row(place.node, place.attribute)
    own = place.node.get("name") or ""
    kinds = kinds_at(place.node, place.attribute, row)
    for name in definitions_of(place.session, place.document, *kinds):
        if name.text != own or name.node.tag != place.node.tag:
            yield Proposal(name.text, literal(name.text), ITEM.Reference, name.kind)


def _kind_of_value(place: ValuePlace) -> ReferenceKind | None:
    parameter = parameter_of(place.node) if place.attribute is None else None
    if parameter is not None and (parameter.type == "joint" or parameter.type == "link"):
        return parameter.type
    return kind_at(place.document, place.node, place.attribute)


def _names_for(place: ValuePlace, kind: ReferenceKind, path: str) -> Iterator[tuple[str, str]]:
    """Yield the names that a reference may mean, each with the kind of thing that has it."""
    session, document, node = place.session, place.document, place.node
    if document.schema.format != "sdf" or kind == "material":
        kinds = ("link", "joint") if path == "gazebo/@reference" else _kinds_in_urdf(kind)
        around = [None, *macros_around(node)]
        for name in definitions_of(session, document, *kinds):
            # what an expression makes of a parameter is known in its macro only
            if "$" not in name.text or next(macros_around(name.node), None) in around:
                yield name.text, name.kind
        return
    if path == _PLACEMENT and node.parent is not None:
        other, model = _included_model(session, document, node.parent)
        yield from _names_in_model(other, model, LOOKUP_ORDER["any"]) if other is not None and model is not None else ()
        return
    kinds = ("joint",) if kind == "joint" else LOOKUP_ORDER[kind][:2] if kind == "link" else LOOKUP_ORDER[kind]
    scope = scope_of_reference(document, node)
    yield from _names_in_scope(session, document, scope, kinds)
    if path == "joint/parent" or (scope is not None and scope.tag == WORLD and kind == "any"):
        yield WORLD, WORLD
    elif scope is not None and scope.tag == "model" and kind == "any":
        yield MODEL, "model"


def _kinds_in_urdf(kind: ReferenceKind) -> tuple[str, ...]:
    return (kind,) if kind in {"joint", "material"} else LOOKUP_ORDER[kind][:2]


def definitions_of(session: Session, document: TextDocument, *kinds: str) -> Iterator[Name]:
    """Yield the definitions of some kinds, each name once."""
    seen: set[str] = set()
    spaces = _namespaces(session, document)
    for other in documents_with_names(session, document):
        for name in definitions_in(other):
            space = spaces.get(other.path, "") if name.kind in _IN_NAMESPACES else ""
            text = f"{space}.{name.text}" if space else name.text
            if name.kind in kinds and text not in seen:
                seen.add(text)
                yield replace(name, text=text)


def _namespaces(session: Session, document: TextDocument) -> dict[Path, str]:
    """Return the namespaces of the xacro files that a document includes with `ns`."""
    found: dict[Path, str] = {}
    for include in includes_of(document):
        space = include.node.get("ns") if include.node.tag == "xacro:include" else None
        path = target(include, document, search_of(session, document)) if space else None
        if path is not None and space:
            found[path] = space
    return found


def macros_around(node: TolerantNode | None) -> Iterator[TolerantNode]:
    """Yield the macros of xacro around an element, the nearest first."""
    for _ in range(_DEEPEST_TREE):
        if node is None:
            return
        if node.tag == "xacro:macro":
            yield node
        node = node.parent


def documents_with_names(session: Session, document: TextDocument) -> Iterator[TextDocument]:
    """Yield a document, its last well-formed state, and what it includes if it is xacro."""
    yield document
    # While somebody types, half of the document may be inside an element that is not closed yet.
    good = session.documents.last_good(document)
    if good is not None and good is not document:
        yield good
    if document.is_xacro or document.schema.format == "mjcf":
        yield from session.neighbors.included(document, search_of(session, document))[1:]


def _names_in_scope(
    session: Session, document: TextDocument, scope: TolerantNode | None, kinds: tuple[str, ...]
) -> Iterator[tuple[str, str]]:
    """Yield the names of SDF that count in a scope, those of nested and included models with their steps."""
    wanted = scope.get("name") if scope is not None else None
    for other in documents_with_names(session, document):
        for name in definitions_in(other):
            text = _seen_from(other, name, wanted) if name.kind in kinds else None
            if text is not None:
                yield text, name.kind
    for include in islice(includes_of(document), _MOST_INCLUDES):
        around = surroundings(document, include.node.parent).scope
        if around is not None and around.get("name") == wanted:
            yield from _names_in_include(session, document, include.node, kinds)


def _seen_from(document: TextDocument, name: Name, wanted: str | None) -> str | None:
    """Return how a name is written in the scope of that name; None if it is not inside of it."""
    steps, scope = [name.text], name.scope
    while scope is not None and scope.get("name") != wanted and len(steps) < _DEEPEST:
        steps.append(scope.get("name") or "")
        scope = surroundings(document, scope.parent).scope
    is_inside = scope is not None and scope.get("name") == wanted
    return "::".join(reversed(steps)) if is_inside and all(steps) else None


def _names_in_include(
    session: Session, document: TextDocument, include: TolerantNode, kinds: tuple[str, ...]
) -> Iterator[tuple[str, str]]:
    """Yield the names in an included model as the scope around the include knows them."""
    other, model = _included_model(session, document, include)
    called = included_as(include, document) or (model.get("name") if model is not None else None)
    if other is not None and model is not None and called:
        yield from ((f"{called}::{text}", kind) for text, kind in _names_in_model(other, model, kinds))


def _included_model(
    session: Session, document: TextDocument, include: TolerantNode
) -> tuple[TextDocument | None, TolerantNode | None]:
    found = next((each for each in includes_of(document) if each.node is include), None)
    path = target(found, document, search_of(session, document)) if found is not None else None
    other = session.files.document(path) if path is not None else None
    return other, first_model(other.tree.root) if other is not None else None


def _names_in_model(document: TextDocument, model: TolerantNode, kinds: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    for name in definitions_in(document):
        text = _seen_from(document, name, model.get("name")) if name.kind in kinds else None
        if text is not None:
            yield text, name.kind


def _refused(place: ValuePlace, path: str) -> set[str]:
    """Return the names that would be refused: the element's own, and ends of joints that are taken."""
    node, joint = place.node, place.node.parent
    own = joint if node.tag == "pose" else _joint_around(node) or node
    if path == "material/@name" and node.parent is not None and node.parent.tag == "robot":
        return {name.text for name in definitions_in(place.document) if name.kind == "material"}
    refused = {own.get("name") or ""} if own is not None and place.attribute != "name" else set[str]()
    if path in {"joint/parent/@link", "joint/child/@link", "joint/parent", "joint/child"} and joint is not None:
        refused |= set(_links_at_ends(place.document, [joint], "child" if node.tag == "parent" else "parent"))
        if node.tag == "child" and joint.parent is not None:  # a second joint above it would close a loop
            joints = (each for each in joint.parent.children if each.tag == "joint" and each is not joint)
            refused |= set(_links_at_ends(place.document, joints, "child"))
        refused |= set(_frames_on(refused, joint.parent))
    if path in {"joint/mimic/@joint", "controlled/@name"}:
        refused |= set(_fixed_joints(place.document))
    return refused


def _frames_on(names: set[str], model: TolerantNode | None) -> Iterator[str]:
    """Yield the frames of a model that are attached to some names, directly or by other frames."""
    attached = defaultdict[str, list[str]](list)
    for each in model.children if model is not None else ():
        if each.tag == "frame":
            attached[each.get("attached_to") or ""].append(each.get("name") or "")
    waiting = list(names)
    while waiting:
        found = attached.pop(waiting.pop(), [])
        waiting += found
        yield from found


def _joint_around(node: TolerantNode) -> TolerantNode | None:
    here: TolerantNode | None = node
    while here is not None and here.tag not in {"joint", "sensor", "plugin"}:
        here = here.parent
    return here if here is not None and here.tag == "joint" else None


def _links_at_ends(document: TextDocument, joints: Iterable[TolerantNode], tag: str) -> Iterator[str]:
    for joint in joints:
        for end in joint.children:
            if end.tag == tag:
                yield end.get("link") or document.tree.text_of(end).of(document.text)


def _fixed_joints(document: TextDocument) -> Iterator[str]:
    for node in document.tree.nodes:
        if node.tag == "joint" and node.mentions("fixed") and node.get("type") == "fixed":
            yield node.get("name") or ""
