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
    replace_fields,
    untyped_elements,
)
from twinform.ir.verify.verify_joints import verify_mimics
from twinform.passes.carriers.absorb import CarrierError, absorb, is_already_there
from twinform.passes.carriers.carriers import NAMESPACE, bits_of_ours
from twinform.passes.carriers.sdf_versions import DIALECT, VersionKeeper, carried, condition_of, is_version_carrier
from twinform.passes.sdf_versions.document_comparison import same, without_carriers
from twinform.passes.sdf_versions.steps import backward
from twinform.passes.sdf_versions.version_pass import VersionPass, is_foreign
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
        """The document with its parts."""
        if not _has_carriers(document):
            return document
        try:
            own = restored_itself(document, self.number)
        except CarrierError as error:
            _report_unfit(document, "the file", error, keeper.sink)
            own = document
        return map_children(own, partial(self._child, keeper))

    def _child(self, keeper: VersionKeeper, node: AnyNode) -> AnyNode:
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
        """Whether a restored model or world, written in the file's version, equals what the file has there."""
        if self.number < parse_version(self.source):  # parts that are gone stand for nothing else
            return True
        if isinstance(node, Model):
            return same(self._lower_again(made, "models"), self._lower_again(without_carriers(node), "models"))
        if isinstance(node, World):
            return same(self._lower_again(made, "worlds"), self._lower_again(without_carriers(node), "worlds"))
        return True

    def _lower_again(self, node: Node, field: str) -> Document:
        """A node in the syntax of the file's version."""
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
    """The node with every carrier that fits the version unpacked, in all that is in it too."""
    if not holds_opaque(node):
        return node
    return map_children(restored_itself(node, version), lambda child: restored(child, version))


def restored_itself(node: AnyNode, version: Version) -> AnyNode:
    """The node with its own carriers unpacked."""
    own = [part for part in node.opaque if is_version_carrier(part) and condition_of(part).fit(version)]
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
    parts = (_inside(part, version) for part in node.opaque)
    return replace_fields(node, opaque=tuple(part for part in parts if part is not None))


def _inside(part: Opaque, version: Version) -> Opaque | None:
    if part.element is None or is_foreign(part.element) or part.element.name == "plugin":
        return part
    element = _restored_element(part.element, version)
    return None if element is None else replace_fields(part, element=element)


def _restored_element(element: Element, version: Version) -> Element | None:
    """The element with what carriers in it hold; None for a synthesized one."""
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
        inner = child if is_foreign(child) or child.name == "plugin" else _restored_element(child, version)
        changed = changed or inner is not child
        children += [inner] if inner else []
    if not changed:
        return element
    element = element.copy(children=tuple(children))
    for piece in made:
        element = _with_attribute(element, piece)
    return element


def _with_attribute(element: Element, piece: Opaque) -> Element:
    pair = piece.attribute
    if pair is None:
        return element
    if not piece.at:
        return element.copy(attributes=(*element.attributes, pair))
    name, _, rest = piece.at.partition("/")
    child = element.find(name)
    if child is None:
        return element
    inner = _with_attribute(child, piece.copy(at=rest))
    return element.copy(children=tuple(inner if each is child else each for each in element.children))


def _has_carriers(document: Document) -> bool:
    carrier = f"{{{NAMESPACE}}}{DIALECT}"
    return any(element.name == carrier for element in untyped_elements(document, having=bits_of_ours(DIALECT)))
