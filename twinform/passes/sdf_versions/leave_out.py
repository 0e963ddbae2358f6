"""Removing elements and attributes that the SDF version does not define."""

from typing import Any, ClassVar

from twinform.diagnostics import Location, rules
from twinform.ir import Collision, Document, Element, Node, Opaque, Pose, Visual, census_of, node_fields, replace_fields
from twinform.ir.record import fields_of
from twinform.passes.carriers.definitions import definition_of
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper, is_version_carrier
from twinform.passes.sdf_versions.lacking import bits_lacking
from twinform.passes.sdf_versions.leftovers import Leftover, node_pieces
from twinform.passes.sdf_versions.spans import ElementContent, VersionSpan, shape, shape_of, whole
from twinform.passes.sdf_versions.version_pass import VersionPass, is_foreign
from twinform.schemas import Fact, Version, print_version

_OF_KINDS = "shape"
"""The field that holds one of several kinds of node."""


class LeaveOut(VersionPass):
    """Take out what the version does not have.

    Changes: 1. elements and attributes that came later or went earlier are carried; 2. a visual or collision whose
    shape the version does not have is carried as a whole, and so is what may stand only once in it and stands again.
    Never touches: what no version has, plugins, and elements of other namespaces.
    Diagnostics: `older-version`; in the ledger that and `gone-from-sdf`.
    """

    name: ClassVar[str] = "leave-out"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with what the version has."""
        return _UndefinedRemover(keeper, self.number).whole_node(document, shape("sdf"))


class _UndefinedRemover:
    """One run."""

    def __init__(self, keeper: VersionKeeper, version: Version) -> None:
        self.keeper = keeper
        self.version = version
        self.whole = whole(version)
        self.lacking = bits_lacking(version)
        self.elements = _Elements(keeper, version)

    def whole_node(self, node: Any, form: ElementContent) -> Any:
        """A node whose element can hold carriers, with all that was left over in it."""
        # Nearly all subtrees have nothing that the version lacks; a bit test skips them.
        if not census_of(node) & self.lacking:
            return node
        changed, left = self.node(node, form)
        for each in left:
            changed = self._carry(changed, node_pieces(node, each), each)
        return changed

    def node(self, node: Any, form: ElementContent) -> tuple[Any, list[Leftover]]:
        """The node without what the version lacks, and that; the last of several comes first."""
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
            condition = self._condition(value, span, row, index)
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

    def _condition(self, value: Any, span: VersionSpan, row: Fact | None, index: int) -> VersionCondition | None:
        """When there is such a thing, if not in this version."""
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
        called = left.called(pieces)
        where = left.location if left.location.line else node.location
        message = f"SDF {print_version(self.version)} does not have {called}"
        rule = rules.GONE_FROM_SDF
        # A warning for what is newer, since the result lacks what the author meant. What only older
        # versions have goes into the ledger alone: leaving it behind is what an upgrade is for.
        if left.condition.since is not None:
            rule = rules.OLDER_VERSION
            self.keeper.sink.report(rule, message, where, found=called)
        return self.keeper.keep(node, pieces, left.condition, rule, message, where, left.weight)


class _Elements:
    """The same for untyped parts."""

    def __init__(self, keeper: VersionKeeper, version: Version) -> None:
        self.keeper = keeper
        self.version = version
        self.whole = whole(version)

    def parts(self, node: Node, form: ElementContent) -> tuple[tuple[Opaque, ...], list[Leftover]]:
        kept: list[Opaque] = []
        left: list[Leftover] = []
        seen: dict[tuple[str, str], int] = {}
        for part in node.opaque:
            found = self._part(node, part, form, seen)
            if isinstance(found, VersionCondition):
                left.insert(0, Leftover((), part, found))
                continue
            changed, attributes = found
            kept.append(changed)
            left += attributes
        return tuple(kept), left

    def _part(
        self, node: Node, part: Opaque, form: ElementContent, seen: dict[tuple[str, str], int]
    ) -> VersionCondition | tuple[Opaque, list[Leftover]]:
        """The part as the version has it, or when there is such a thing."""
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
        element, attributes = self._element(part.element, row, form, where)
        if element is part.element:
            return part, []
        at = f"{part.at}/{name}" if part.at else name
        lifted = [
            Leftover((), Opaque.unchecked(at=at, attribute=pair, source=part.source), condition)
            for pair, condition in attributes
        ]
        return part.copy(element=element), lifted

    def _is_typed(self, node: Node, row: Fact | None) -> bool:
        """Whether the node has such a part in a field already."""
        return bool(row and row.place and getattr(node, row.place, None))

    def _element(
        self, element: Element, row: Fact, form: ElementContent, where: Location
    ) -> tuple[Element, list[tuple[tuple[str, str], VersionCondition]]]:
        """The element as the version has it; the attributes that a leaf loses have to be carried beside it."""
        if form.fact.any or (row.reference in self.whole and form is shape_of(row)):
            return element, []
        lost = [(pair, condition) for pair in element.attributes if (condition := self._missing(f"@{pair[0]}", form))]
        children: list[Element] = []
        for child in element.children:
            children += self._child(child, form, where)
        gone = [pair for pair, _ in lost]
        # An element of text alone can hold no carrier; its lost attributes are carried beside it.
        if form.fact.type is None:
            for pair, condition in lost:
                children += self._keep(Opaque.unchecked(attribute=pair), condition, f"the attribute {pair[0]!r}", where)
            lost = []
        attributes = tuple(pair for pair in element.attributes if pair not in gone)
        return replace_fields(element, attributes=attributes, children=tuple(children)), lost

    def _child(self, child: Element, form: ElementContent, where: Location) -> list[Element]:
        span = None if is_foreign(child) else form.names.get(child.name)
        if span is None:
            return [child]
        row = span.row(self.version)
        if row is not None and row.type and any(not is_foreign(inner) for inner in child.children):
            row, span = None, span.containers()  # a wrench is a value, and was a position and a force
        if row is None:
            return self._keep(Opaque.unchecked(element=child), span.condition(self.version), f"<{child.name}>", where)
        inner, lost = self._element(child, row, span.shape(row), where)
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

    def _missing(self, name: str, form: ElementContent) -> VersionCondition | None:
        span = form.names.get(name)
        return span.condition(self.version) if span and span.row(self.version) is None else None

    def _keep(self, piece: Opaque, condition: VersionCondition, called: str, where: Location) -> list[Element]:
        message = f"SDF {print_version(self.version)} does not have {called}"
        rule = rules.OLDER_VERSION if condition.since is not None else rules.GONE_FROM_SDF
        if condition.since is not None:
            self.keeper.sink.report(rule, message, where, found=called)
        return list(self.keeper.keep_element(piece, condition, rule, message, where))


def _is_plain_pose(value: object) -> bool:
    """Whether it is a pose that every version can express, which is nearly every one."""
    return (
        isinstance(value, Pose)
        and not value.opaque
        and value.relative_to is None
        and value.degrees is None
        and value.rotation_format is None
    )
