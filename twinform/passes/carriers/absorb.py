"""Merging SDF elements into a typed node, as if they had been children of its element."""

from collections.abc import Iterator, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, TypeVar, cast

from lxml import etree

from twinform.diagnostics import DiagnosticSink
from twinform.ir import (
    Collision,
    Document,
    Element,
    Empty,
    Frame,
    Geometry,
    Include,
    Inertial,
    Joint,
    Light,
    Link,
    Material,
    Model,
    Node,
    Opaque,
    Plugin,
    Pose,
    Sensor,
    Surface,
    Visual,
    World,
)
from twinform.ir.node import NOT_CONTENT, are_nodes
from twinform.ir.record import field_value, fields_of
from twinform.passes.carriers.sdf_versions import VersionCondition
from twinform.schemas import Context, Fact, Version, XmlElement, element_xml, reader, table

if TYPE_CHECKING:
    from pydantic import ValidationError


AnyNode = TypeVar("AnyNode", bound=Node)

_REQUIRED = frozenset({"name", "type", "format", "version", "kind"})
"""Fields that a node cannot be made without."""


_UNCONDITIONAL = VersionCondition()


class CarrierError(Exception):
    """A carrier, perhaps edited, holds something that cannot stand in its place."""


def absorb(
    node: AnyNode,
    pieces: tuple[Opaque, ...],
    condition: VersionCondition = _UNCONDITIONAL,
    version: Version | None = None,
) -> AnyNode:
    """The node with the pieces of a version of SDF, by default the newest, and without what the condition removes.

    Raises:
        CarrierError: a piece is not of SDF.
    """
    for path in condition.without:
        node = _blanked(node, path.split("."))
    if condition.instead and isinstance(node, Model):
        node = node.copy(**_without_scope(node, condition.instead))
    for piece in pieces:
        node = _absorb(node, piece, condition, version or table("sdf").newest)
    return node


def is_already_there(node: Node, piece: Opaque, condition: VersionCondition) -> bool:
    """Whether a mimic was written by hand where a carrier holds one."""
    if condition.without or condition.instead or piece.element is None or piece.element.name != "mimic":
        return False
    holder: object = node
    for step in filter(None, piece.at.split("/")):
        holder = getattr(holder, step, None)
    return getattr(holder, "mimic", None) is not None


def _blanked(node: AnyNode, path: list[str]) -> AnyNode:
    first, *rest = path
    value = getattr(node, first, None)
    if value is None:
        return node
    inner = _blanked(value, rest) if rest else fields_of(type(node))[first].default
    return node.copy(**{first: inner})


def _without_scope(model: Model, prefix: str) -> dict[str, object]:
    """The fields of a model without the parts of one scope, and without the nested model of that name."""
    own = prefix.removesuffix("::")
    return {
        field: tuple(each for each in getattr(model, field) if each.name != own and not each.name.startswith(prefix))
        for field in ("links", "joints", "frames", "models")
    }


def _absorb(node: AnyNode, piece: Opaque, condition: VersionCondition, version: Version) -> AnyNode:
    data = _read(piece, type(node), definition_of(node) or "", version)
    if condition.index and piece.at:
        return _repeat_inside(node, piece.at.split("/"), piece)
    # A repeated element stays repeated: of two <material> readers take the first, and the second,
    # put in its place, would be a look that nobody saw in the file.
    if condition.index and is_repeated(piece, node):
        return node.copy(opaque=(*node.opaque, piece))
    if piece.element is not None and piece.element.name == "pose" and not piece.at and hasattr(node, "pose"):
        node = node.copy(pose=None)  # one pose stands for another
    return _merged(node, data, condition.index)


def _repeat_inside(node: AnyNode, path: list[str], piece: Opaque) -> AnyNode:
    """The node with an element deeper in it that repeats another one."""
    if not path:
        return node.copy(opaque=(*node.opaque, piece.copy(at="")))
    first, *rest = path
    field = "shape" if isinstance(node, Geometry) else first
    inner = field_value(node, field)
    if not isinstance(inner, Node):
        raise CarrierError(f"there is no <{first}>")
    return node.copy(**{field: _repeat_inside(inner, rest, piece)})


def _read(piece: Opaque, kind: type[Node], definition: str, version: Version) -> dict[str, Any]:
    """The fields that a piece sets in the node of a definition."""
    if not definition:
        raise CarrierError("there is nothing of SDF around it")
    xml = etree.SubElement(etree.Element("sdf"), definition)
    holder = xml
    for step in filter(None, piece.at.split("/")):
        holder = etree.SubElement(holder, step)
    _put_piece(piece, holder)
    sink = DiagnosticSink()
    data = reader("sdf", version).read(xml, Context(sink, "", "sdf", version), definition, kind)
    around = "/".join(("/sdf", definition, *filter(None, (piece.at,))))
    for found in sink.diagnostics:
        lacks_the_rest = f"{around}/".startswith(f"{found.location.path}/")
        if found.is_error and not lacks_the_rest:
            raise CarrierError(found.message)
    return {name: value for name, value in data.items() if name not in _REQUIRED or xml.get(name) is not None}


def _put_piece(piece: Opaque, holder: XmlElement) -> None:
    if piece.element is not None:
        element_xml(piece.element, holder)
    elif piece.attribute is not None:
        holder.set(*piece.attribute)
    else:
        holder.text = piece.text


def _merged(node: AnyNode, data: Mapping[str, Any], index: int | None = None) -> AnyNode:
    """The node with the fields that were read: items go to their place in lists, inner nodes are merged."""
    required = {name: getattr(node, name) for name in fields_of(type(node)) if name in _REQUIRED}
    try:
        read = type(node).model_validate({**required, **data})
    except ValueError as error:
        # Pydantic is imported when it validates
        raise CarrierError(cast("ValidationError", error).errors(include_url=False)[0]["msg"]) from error
    update: dict[str, object] = {
        name: _merged_value(node, name, getattr(read, name), index) for name in data if name not in NOT_CONTENT
    }
    if read.spelling:
        update["spelling"] = {**(node.spelling or {}), **read.spelling}
    return node.copy(**update)


def _merged_value(node: Node, name: str, value: object, index: int | None) -> object:
    mine = getattr(node, name)
    if name == "opaque":
        return (*mine, *cast("tuple[Opaque, ...]", value))
    if are_nodes(value):
        return _inserted(mine, value, index, node)
    if not isinstance(value, Node):
        return value
    if isinstance(mine, Node) and type(value) is type(mine):
        return _merged(mine, _written_fields(value))
    return value.copy(source=mine.source if isinstance(mine, Node) else node.source)


def _written_fields(node: Node) -> dict[str, Any]:
    """The fields of a node, as the data of another one."""
    fields = fields_of(type(node))
    return {
        name: getattr(node, name) for name in fields if name != "source" and getattr(node, name) != fields[name].default
    }


def _inserted(mine: tuple[Node, ...], value: tuple[Node, ...], index: int | None, node: Node) -> tuple[Node, ...]:
    place = len(mine) if index is None else min(index, len(mine))
    # it stands where its neighbor stands, so that it is written there
    beside = mine[place] if place < len(mine) else mine[-1] if mine else node
    placed = tuple(one.copy(source=beside.source) for one in value)
    return (*mine[:place], *placed, *mine[place:])


_DEFINITIONS: dict[type[Node], str] = {
    Document: "sdf",
    **{
        kind: kind.__name__.lower()
        for kind in (
            Collision, Frame, Geometry, Include, Inertial, Joint, Light, Link, Material, Model, Plugin, Pose,
            Sensor, Surface, Visual, World,
        )
    },
}  # fmt: skip


def definition_of(node: Node) -> str | None:
    """The definition of a node; None for a node, such as a limit, that is a row of another definition."""
    kind = getattr(node, "kind", None)
    if kind is not None:
        return None if isinstance(node, Empty) else f"{kind}_shape"
    return _DEFINITIONS.get(type(node))


def is_repeated(part: Opaque, node: Node) -> bool:
    """Whether a part repeats an element that may stand once; readers take the first one."""
    element = part.element
    if element is None or part.at or not (element.children or element.attributes or element.text):
        return False
    definition = definition_of(node)
    return element.name in _single(definition) and not _is_untyped(element, definition)


def _is_untyped(element: Element, definition: str | None) -> bool:
    """Whether the reader makes no fields of an element, since it holds several where readers take the last."""
    rows = table("sdf").definitions[definition].children if definition else ()
    last = {inner.name for row in rows if row.name == element.name for inner in row.rows if inner.last}
    names = [child.name for child in element.children if child.name in last]
    return len(names) > len({*names})


def inside(node: Node, at: str) -> Node | None:
    """The single node at a path of elements below another one, such as the limit of a joint at `axis/limit`."""
    holder: object = node
    for step in filter(None, at.split("/")):
        if isinstance(holder, Geometry):
            holder = holder.shape if holder.shape and holder.shape.kind == step else None
        else:
            holder = field_value(holder, step) if isinstance(holder, Node) else None
    return holder if isinstance(holder, Node) else None


def has_first(node: Node, name: str) -> bool:
    """Whether a node has a first element of this name, in a field or as an opaque part."""
    definition = definition_of(node)
    places = _single(definition).get(name, ()) if definition else (name,)
    if any(field_value(node, place) is not None for place in places):
        return True
    return any(name == (part.at.partition("/")[0] or part.element.name) for part in node.opaque if part.element)


@cache
def _single(definition: str | None) -> Mapping[str, tuple[str, ...]]:
    """The children of a definition that may stand once and have a typed form, with the fields that hold them."""
    rows = table("sdf").definitions[definition].children if definition else ()
    return {row.name: tuple(_fields_of(row)) for row in rows if row.place and not row.repeats}


def _fields_of(row: Fact) -> Iterator[str]:
    """The field that holds an element, or the fields that hold what is in it."""
    if row.place == ".":
        for each in row.rows:
            yield from _fields_of(each)
    elif row.place:
        yield row.place.partition(".")[0]
