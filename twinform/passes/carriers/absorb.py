"""Merging SDF elements into a typed node, as if they had been children of its element."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeGuard, TypeVar, cast

from lxml import etree

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Geometry, Model, Node, Opaque
from twinform.ir.node import NOT_CONTENT
from twinform.ir.record import field_value, fields_of
from twinform.passes.carriers.definitions import definition_of, is_repeated
from twinform.passes.carriers.sdf_versions import VersionCondition
from twinform.schemas import Context, Version, XmlElement, element_xml, reader, table

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
    if _are_nodes(value):
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


def _are_nodes(value: object) -> TypeGuard[tuple[Node, ...]]:
    return isinstance(value, tuple) and isinstance(next(iter(cast("tuple[object, ...]", value)), None), Node)


def _inserted(mine: tuple[Node, ...], value: tuple[Node, ...], index: int | None, node: Node) -> tuple[Node, ...]:
    place = len(mine) if index is None else min(index, len(mine))
    # it stands where its neighbor stands, so that it is written there
    beside = mine[place] if place < len(mine) else mine[-1] if mine else node
    placed = tuple(one.copy(source=beside.source) for one in value)
    return (*mine[:place], *placed, *mine[place:])
