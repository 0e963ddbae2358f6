"""Removing elements and attributes that the SDF version does not define."""

from collections.abc import Iterator
from typing import Any, ClassVar, cast

from twinform.dataclass import dataclass
from twinform.diagnostics import NOWHERE, Location, Rule, rules
from twinform.ir import (
    Collision,
    Document,
    Element,
    Node,
    Opaque,
    Pose,
    Visual,
    census_of,
    count_parts,
    node_fields,
    replace_fields,
)
from twinform.ir.node import NOT_CONTENT
from twinform.ir.record import fields_of
from twinform.passes.carriers.absorb import definition_of
from twinform.passes.carriers.carriers import to_element
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper, is_version_carrier
from twinform.passes.sdf_versions.spans import ElementContent, VersionSpan, bits_lacking, shape, shape_of, whole
from twinform.passes.sdf_versions.version_pass import VersionPass, is_foreign
from twinform.schemas import Fact, Version, print_version

_OF_KINDS = "shape"
"""The field that holds one of several kinds of node."""
_ABOUT = NOT_CONTENT | {"name", "type", "kind", "format", "version", "namespaces"}
_IDENTITY = frozenset({"name", "type", "version"})


class LeaveOut(VersionPass):
    """Take out what the version does not define.

    Changes: 1. elements and attributes that came later or went earlier are carried; 2. a visual or collision whose
    shape the version does not have is carried as a whole, and so is what may stand only once in it and stands again.
    Never touches: what no version has, plugins, and elements of other namespaces.
    Diagnostics: `older-version`; in the ledger that and `gone-from-sdf`.
    """

    name: ClassVar[str] = "leave-out"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document without the parts that the version lacks."""
        # A file may have one model or light since 1.8: the only thing that no bit stands for.
        has_one_model = len(document.models) + len(document.lights) <= 1
        if has_one_model and not census_of(document) & bits_lacking(self.number):
            return document
        return _UndefinedRemover(keeper, self.number).cut_node(document, shape("sdf"))


@dataclass(frozen=True, slots=True)
class Leftover:
    """A part that was taken out: an untyped one, or the value at the end of `fields` below the node that carries it."""

    fields: tuple[str, ...]
    value: object
    condition: VersionCondition

    def inside(self, field: str, tag: str) -> "Leftover":
        """Return the leftover as part of the node around this one, which is its field `field` and element `tag`."""
        if isinstance(self.value, Opaque):
            at = f"{tag}/{self.value.at}" if self.value.at else tag
            return Leftover((), self.value.copy(at=at), self.condition)
        return Leftover((field, *self.fields), self.value, self.condition)

    @property
    def first(self) -> object:
        """The value; of a list, from which nodes go one by one, its only item."""
        return cast("tuple[object, ...]", self.value)[0] if isinstance(self.value, tuple) else self.value

    @property
    def location(self) -> Location:
        """Where the part was written; nowhere for plain values."""
        first = self.first
        return first.location if isinstance(first, Node | Opaque) else NOWHERE

    def describe(self, pieces: list[Opaque]) -> str:
        """The names of the pieces for a message."""
        names = [f"the attribute {piece.attribute[0]!r}" if piece.attribute else piece.name for piece in pieces]
        name = getattr(self.first, "name", None) if isinstance(self.first, Node) else None
        return " and ".join(dict.fromkeys(names)) + (f" {name!r}" if name else "")

    @property
    def weight(self) -> int:
        """How many elements and attributes were taken out."""
        first = self.first
        if isinstance(first, Opaque):
            return max(1, first.weight)
        return count_parts(first) if isinstance(first, Node) else 1


class _UndefinedRemover:
    """Takes what a version lacks out of nodes."""

    def __init__(self, keeper: VersionKeeper, version: Version) -> None:
        self.keeper = keeper
        self.version = version
        self.whole = whole(version)
        self.lacking = bits_lacking(version)
        self.elements = _Elements(keeper, version)

    def whole_node(self, node: Any, form: ElementContent) -> Any:
        """A node whose element can hold carriers, without what the version lacks and with carriers for it."""
        # Nearly all subtrees have nothing that the version lacks; a bit test skips them.
        return self.cut_node(node, form) if census_of(node) & self.lacking else node

    def cut_node(self, node: Any, form: ElementContent) -> Any:
        """The same for a node in which something may lack."""
        changed, left = self.node(node, form)
        for each in left:
            changed = self._carry(changed, node_pieces(node, each), each)
        return changed

    def node(self, node: Any, form: ElementContent) -> tuple[Any, list[Leftover]]:
        """The node without what the version lacks, and the parts taken out, the last of several first."""
        update: dict[str, Any] = {}
        left: list[Leftover] = []
        for field in form.lacking(self.version):
            value = getattr(node, field)
            if value is None or value == () or _is_plain_pose(value):
                continue
            span = form.kinds[value.kind] if field == _OF_KINDS else form.fields[field]
            update[field], over = self._field(node, field, value, span)
            left += over
        if node.opaque:
            update["opaque"], over = self.elements.parts(node, form)
            left += over
        return replace_fields(node, **update), left

    def _field(self, node: Node, field: str, value: Any, span: VersionSpan) -> tuple[Any, list[Leftover]]:
        row = span.row(self.version)
        if field in node_fields(type(node)) and not isinstance(value, Node):
            return self._many(field, value, span, row)
        if row is None:
            return fields_of(type(node))[field].default, [Leftover((field,), value, span.condition(self.version))]
        if isinstance(value, Node) and (row.reference not in self.whole or span.is_split):
            return self._inner(field, value, span, row)
        return value, []

    def _inner(self, field: str, value: Any, span: VersionSpan, row: Fact) -> tuple[Any, list[Leftover]]:
        form = span.shape(row)
        if definition_of(value) is not None and form.fact.type is None:
            return self.whole_node(value, form), []
        changed, left = self.node(value, form)
        if left and changed == type(value)():  # an empty element is not written
            changed = None
        return changed, [each.inside(field, row.name) for each in left]

    def _many(self, field: str, values: Any, span: VersionSpan, row: Fact | None) -> tuple[Any, list[Leftover]]:
        repetition = span.repetition(self.version)
        kept: list[Any] = []
        left: list[Leftover] = []
        for index, value in enumerate(values):
            condition = self._missing_since(value, span, row, index)
            if condition is None and repetition and kept:
                condition = repetition.condition(self.version)
            if condition is not None:
                # Last in, first out: the last of several is packed first, so that unpacking meets
                # the lower indexes while they are still right.
                left.insert(0, Leftover((field,), (value,), condition))
            elif row is not None and row.reference not in self.whole:
                kept.append(self.whole_node(value, shape_of(row)))
            else:
                kept.append(value)
        return tuple(kept), left

    def _missing_since(self, value: Any, span: VersionSpan, row: Fact | None, index: int) -> VersionCondition | None:
        """The versions that have a node of a list, if this one does not."""
        if row is None:
            return span.condition(self.version, index)
        # A visual without its shape is invalid and a collision without it means nothing, so the
        # whole part is carried.
        if isinstance(value, Visual | Collision) and value.geometry and value.geometry.shape:
            known = shape("geometry").kinds.get(value.geometry.shape.kind)
            if known and known.row(self.version) is None:
                return known.condition(self.version, index)
        return None

    def _carry(self, node: Any, pieces: list[Opaque], left: Leftover) -> Any:
        where = left.location if left.location.line else node.location
        rule, message = _report_gap(self.keeper, self.version, left.condition, left.describe(pieces), where)
        return self.keeper.keep(node, pieces, left.condition, rule, message, where, left.weight)


class _Elements:
    """Takes what a version lacks out of untyped parts."""

    def __init__(self, keeper: VersionKeeper, version: Version) -> None:
        self.keeper = keeper
        self.version = version
        self.whole = whole(version)

    def parts(self, node: Node, form: ElementContent) -> tuple[tuple[Opaque, ...], list[Leftover]]:
        kept: list[Opaque] = []
        left: list[Leftover] = []
        seen: dict[tuple[str, str], int] = {}
        for part in node.opaque:
            found = self._cut_part(node, part, form, seen)
            if isinstance(found, VersionCondition):
                left.insert(0, Leftover((), part, found))
                continue
            changed, attributes = found
            kept.append(changed)
            left += attributes
        return tuple(kept), left

    def _cut_part(
        self, node: Node, part: Opaque, form: ElementContent, seen: dict[tuple[str, str], int]
    ) -> VersionCondition | tuple[Opaque, list[Leftover]]:
        """The part as the version allows it, with lost attributes; or the versions that have the part at all."""
        name = part.element.name if part.element else f"@{part.attribute[0]}" if part.attribute else ""
        if not name or name.lstrip("@")[0] == "{" or is_version_carrier(part):
            return part, []
        steps = [*filter(None, part.at.split("/")), name]
        span: VersionSpan | None = None
        row: Fact | None = None
        for step in steps:
            span = form.names.get(step)
            if span is None:
                return part, []
            row = span.row(self.version)
            if row is None:
                return span.condition(self.version)
            form = span.shape(row)
        number = seen[part.at, name] = seen.get((part.at, name), int(self._is_typed(node, row))) + 1
        repetition = span.repetition(self.version) if span else None
        if part.element is None or row is None:
            return part, []
        if repetition and number > 1:
            return repetition.condition(self.version)
        where = part.location
        element, attributes = self._cut_element(part.element, row, form, where)
        if element is part.element:
            return part, []
        at = f"{part.at}/{name}" if part.at else name
        lifted = [
            Leftover((), Opaque.unchecked(at=at, attribute=pair, source=part.source), condition)
            for pair, condition in attributes
        ]
        return part.copy(element=element), lifted

    def _is_typed(self, node: Node, row: Fact | None) -> bool:
        """Whether a field of the node already holds the element of a row."""
        return bool(row and row.place and getattr(node, row.place, None))

    def _cut_element(
        self, element: Element, row: Fact, form: ElementContent, where: Location
    ) -> tuple[Element, list[tuple[tuple[str, str], VersionCondition]]]:
        """The element as the version allows it, and the lost attributes of a leaf, to be carried beside it."""
        if form.fact.any or (row.reference in self.whole and form is shape_of(row)):
            return element, []
        lost = [(pair, condition) for pair in element.attributes if (condition := self._gap(f"@{pair[0]}", form))]
        children: list[Element] = []
        for child in element.children:
            children += self._cut_child(child, form, where)
        gone = [pair for pair, _ in lost]
        # An element of text alone can hold no carrier; its lost attributes are carried beside it.
        if form.fact.type is None:
            for pair, condition in lost:
                children += self._keep(Opaque.unchecked(attribute=pair), condition, f"the attribute {pair[0]!r}", where)
            lost = []
        attributes = tuple(pair for pair in element.attributes if pair not in gone)
        return replace_fields(element, attributes=attributes, children=tuple(children)), lost

    def _cut_child(self, child: Element, form: ElementContent, where: Location) -> list[Element]:
        span = None if is_foreign(child) else form.names.get(child.name)
        if span is None:
            return [child]
        row = span.row(self.version)
        if row is not None and row.type and any(not is_foreign(inner) for inner in child.children):
            row, span = None, span.containers()  # a wrench is a value, and was a position and a force
        if row is None:
            return self._keep(Opaque.unchecked(element=child), span.condition(self.version), f"<{child.name}>", where)
        inner, lost = self._cut_element(child, row, span.shape(row), where)
        beside = [
            element
            for pair, condition in lost
            for element in self._keep(
                Opaque.unchecked(at=child.name, attribute=pair),
                condition,
                f"the attribute {pair[0]!r} of <{child.name}>",
                where,
            )
        ]
        return [inner, *beside]

    def _gap(self, name: str, form: ElementContent) -> VersionCondition | None:
        span = form.names.get(name)
        return span.condition(self.version) if span and span.row(self.version) is None else None

    def _keep(self, piece: Opaque, condition: VersionCondition, called: str, where: Location) -> list[Element]:
        rule, message = _report_gap(self.keeper, self.version, condition, called, where)
        return list(self.keeper.keep_element(piece, condition, rule, message, where))


def _report_gap(
    keeper: VersionKeeper, version: Version, condition: VersionCondition, called: str, where: Location
) -> tuple[Rule, str]:
    """The rule and message for the ledger about a part that a version lacks; a newer part is warned about too."""
    message = f"SDF {print_version(version)} does not have {called}"
    # A warning for what is newer, since the result lacks what the author meant. What only older
    # versions have goes into the ledger alone: leaving it behind is what an upgrade is for.
    if condition.since is None:
        return rules.GONE_FROM_SDF, message
    keeper.sink.report(rules.OLDER_VERSION, message, where, found=called)
    return rules.OLDER_VERSION, message


def _is_plain_pose(value: object) -> bool:
    """Whether a value is a pose that every version can express, as nearly all are."""
    return (
        isinstance(value, Pose)
        and not value.opaque
        and value.relative_to is None
        and value.degrees is None
        and value.rotation_format is None
    )


def node_pieces(node: Node, left: Leftover) -> list[Opaque]:
    """The carrier pieces of what was taken out of a node."""
    if isinstance(left.value, Opaque):
        return [left.value.copy(source=None)]
    bare = _keep_only(node, left.fields, left.value)
    definition = definition_of(node) or ""
    return list(_pieces(to_element(bare, definition, "sdf"), "", len(left.fields) - 1))


def _keep_only(node: Node, fields: tuple[str, ...], value: object) -> Node:
    """The node with a value at the end of a path of fields, and nothing else."""
    first, *rest = fields
    inner = _keep_only(getattr(node, first), tuple(rest), value) if rest else value
    # The writer makes the element: a node with nothing but the leftover is written, and what is in
    # that text is the piece.
    blank = {name: each.default for name, each in fields_of(type(node)).items() if name not in _ABOUT}
    return node.copy(**{**blank, first: inner})


def _pieces(element: Element, at: str, depth: int) -> Iterator[Opaque]:
    """Attributes and children of the element `depth` levels down; each level above has one child."""
    if depth:
        child = element.children[0]
        yield from _pieces(child, f"{at}/{child.name}" if at else child.name, depth - 1)
        return
    for pair in element.attributes:
        if at or pair[0] not in _IDENTITY:
            yield Opaque.unchecked(at=at, attribute=pair)
    for child in element.children:
        yield Opaque.unchecked(at=at, element=child)
