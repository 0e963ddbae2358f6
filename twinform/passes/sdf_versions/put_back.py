"""Unpacking carriers into a version of SDF that has their parts."""

from functools import partial
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import (
    Document,
    Element,
    Model,
    Node,
    Opaque,
    World,
    holds_opaque,
    map_children,
    node_fields,
    replace_fields,
    rewrite,
    untyped_elements,
)
from twinform.ir.record import field_values, fields_of
from twinform.ir.verify.verify_joints import verify_mimics
from twinform.passes.carriers.absorb import CarrierError, absorb, is_already_there
from twinform.passes.carriers.carriers import NAMESPACE, bits_of_ours, without_parts
from twinform.passes.carriers.misplaced import is_misplaced
from twinform.passes.carriers.sdf_versions import DIALECT, VersionKeeper, carried, condition_of, is_version_carrier
from twinform.passes.sdf_versions.steps import backward
from twinform.passes.sdf_versions.version_pass import VersionPass, is_foreign
from twinform.passes.shared.nodes import map_elements
from twinform.schemas import Version, parse_version

AnyNode = TypeVar("AnyNode", bound=Node)
_ITSELF = "."


class PutBack(VersionPass):
    """Put the parts in carriers of other versions back where they stood.

    Changes: every carrier whose part the version has; the last one that was made comes first. That a file of an older
    version (`source`) still means what the carriers were made from is proved by repetition: the restored model is
    written in its syntax once more, and has to equal the file. Where it does not, because the file was edited, the
    model or world stays as it is, and its carriers with it.
    Diagnostics: `stale-carrier`; `unknown-leader` where what a joint mimics is gone.
    """

    name: ClassVar[str] = "put-back"
    source: str

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with carried parts back in their places."""
        if not _has_carriers(document):
            return document
        try:
            own = restored_itself(document, self.number)
        except CarrierError as error:
            _report_unfit(document, "the file", error, keeper.sink)
            own = document
        return map_children(own, partial(self._restore_child, keeper))

    def _restore_child(self, keeper: VersionKeeper, node: AnyNode) -> AnyNode:
        called = f"{type(node).__name__.lower()} {getattr(node, 'name', '')!r}"
        try:
            made = restored(node, self.number)
        except CarrierError as error:
            _report_unfit(node, called, error, keeper.sink)
            return node
        if made is node:
            return made
        if isinstance(made, Model):
            verify_mimics(made.joints, keeper.sink)
        if self._means_the_same(made, node):
            return made
        message = f"{called} was edited since parts of it were left out for SDF {self.source}"
        keeper.sink.report(rules.STALE_CARRIER, message, node.location, found=called)
        return node

    def _means_the_same(self, made: Node, node: Node) -> bool:
        """Whether a restored model or world, lowered to the version of the file, equals the one in the file."""
        if self.number < parse_version(self.source):  # parts that are gone stand for nothing else
            return True
        if isinstance(node, Model):
            return same(self._lower_again(made, "models"), self._lower_again(node, "models"))
        if isinstance(node, World):
            return same(self._lower_again(made, "worlds"), self._lower_again(node, "worlds"))
        return True

    def _lower_again(self, node: Node, field: str) -> Document:
        """A document with one model or world, in the syntax of the version of the file."""
        sink = DiagnosticSink()
        document = Document.model_validate({"format": "sdf", "version": self.version}).copy(**{field: (node,)})
        # The proof by repetition: lowered once more, the restored model has to equal the file.
        for step in backward(self.number, parse_version(self.source)):
            document = step.run(document, sink)
        return without_carriers(document)


def _report_unfit(node: Node, called: str, error: CarrierError, sink: DiagnosticSink) -> None:
    message = f"a carrier in {called} does not fit there: {error}"
    sink.report(rules.STALE_CARRIER, message, node.location, found=str(error))


def restored(node: AnyNode, version: Version) -> AnyNode:
    """The node with all carriers that fit the version unpacked, at any depth."""
    if not holds_opaque(node):
        return node
    return map_children(restored_itself(node, version), lambda child: restored(child, version))


def restored_itself(node: AnyNode, version: Version) -> AnyNode:
    """The node with its own carriers unpacked."""
    fitting = (part for part in node.opaque if is_version_carrier(part) and condition_of(part).fit(version))
    own = [part for part in fitting if not is_misplaced(part, node)]
    if own:
        kept = tuple(part for part in node.opaque if not any(part is each for each in own))
        node = node.copy(opaque=kept)
        # The last carrier that was made stands first: each is unpacked into the state that it was
        # packed from.
        for part in reversed(own):
            condition = condition_of(part)
            # Somebody has written the element by hand since. That is an edit, and edits win.
            if any(is_already_there(node, piece, condition) for piece in carried(part)):
                raise CarrierError("the file now has its own element for what it holds")
            node = absorb(node, carried(part), condition, version)
    parts = (_restore_part(part, version) for part in node.opaque)
    return replace_fields(node, opaque=tuple(part for part in parts if part is not None))


def _restore_part(part: Opaque, version: Version) -> Opaque | None:
    if part.element is None or is_foreign(part.element) or part.element.name == "plugin":
        return part
    element = _restore_element(part.element, version)
    return None if element is None else replace_fields(part, element=element)


def _restore_element(element: Element, version: Version) -> Element | None:
    """The element with its carriers unpacked; None where a conversion made it up."""
    children: list[Element] = []
    made: list[Opaque] = []
    changed = False
    for child in element.children:
        part = Opaque.unchecked(element=child)
        if is_version_carrier(part) and (condition := condition_of(part)).fit(version):
            changed = True
            if _ITSELF in condition.without:
                return None
            pieces = carried(part)
            made += [piece for piece in pieces if piece.attribute]
            children = [each for each in children if each.name != condition.instead]
            children += [piece.element for piece in pieces if piece.element]
            continue
        inner = child if is_foreign(child) or child.name == "plugin" else _restore_element(child, version)
        changed = changed or inner is not child
        children += [inner] if inner else []
    if not changed:
        return element
    element = element.copy(children=tuple(children))
    for piece in made:
        element = _put_attribute(element, piece)
    return element


def _put_attribute(element: Element, piece: Opaque) -> Element:
    """The element with the attribute of a piece, on itself or on the descendant that the piece names."""
    if piece.attribute is None:
        return element
    if not piece.at:
        return element.copy(attributes=(*element.attributes, piece.attribute))
    name, _, rest = piece.at.partition("/")
    child = element.find(name)
    return element if child is None else element.exchange(child, _put_attribute(child, piece.copy(at=rest)))


def _has_carriers(document: Document) -> bool:
    carrier = f"{{{NAMESPACE}}}{DIALECT}"
    return any(element.name == carrier for element in untyped_elements(document, having=bits_of_ours(DIALECT)))


def without_carriers(node: AnyNode) -> AnyNode:
    """The node without carriers of other versions, at any depth."""
    return without_parts(node, is_version_carrier)


def comparable(node: AnyNode) -> AnyNode:
    """The node with untyped parts in a canonical order, and without empty nodes."""
    return rewrite(node, Node, _sort_parts)


def _sort_parts(node: Node) -> Node:
    if len(node.opaque) > 1 or any(part.element for part in node.opaque):
        parts = sorted(map_elements(node.opaque, _sort_element), key=_sorting_key)
        node = node.copy(opaque=tuple(parts))
    empty = [name for name in node_fields(type(node)) if _is_empty(getattr(node, name))]
    return node.copy(**dict.fromkeys(empty)) if empty else node


def _is_empty(value: object) -> bool:
    """Whether a value is a node with no more than defaults, of which nothing would be written."""
    if not isinstance(value, Node):
        return False
    fields = fields_of(type(value))
    return all(each == fields[name].default for name, each in field_values(value).items())


def _sorting_key(part: Opaque) -> tuple[str, ...]:
    """The sorting key of a part: its place and name, or those of the pieces in a carrier."""
    if not is_version_carrier(part):
        return (part.at, part.name, "", "")
    written = part.element.get("at") if part.element else None
    return (part.at, part.name, written or "", " ".join(piece.name for piece in carried(part)))


def _sort_element(element: Element) -> Element:
    attributes = tuple(sorted(element.attributes))
    if element.name == "plugin":  # only it knows what its order means
        return element.copy(attributes=attributes)
    children = sorted(map(_sort_element, element.children), key=lambda child: child.name)
    return element.copy(attributes=attributes, children=tuple(children))


def same(one: Node, other: Node) -> bool:
    """Whether two nodes are equal apart from the order of untyped parts and from empty nodes; NaN equals NaN."""
    one, other = comparable(one), comparable(other)
    # A NaN is not equal to itself, but it has the same text.
    return one == other or one.model_dump_json() == other.model_dump_json()
