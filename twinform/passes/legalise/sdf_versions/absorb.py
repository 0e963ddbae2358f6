"""Putting pieces of SDF into a typed node, as if they had stood in its element."""

from typing import Any

from lxml import etree

from twinform.diagnostics import Notes
from twinform.ir import Model, Node, Opaque
from twinform.passes.legalise.sdf_versions.carriers import Terms
from twinform.passes.legalise.sdf_versions.definitions import definition_of
from twinform.schemas import Context, Version, XmlElement, element_xml, reader

_REQUIRED = frozenset({"name", "type", "format", "version", "kind"})
"""Fields that a node cannot be made without; where a piece sets them, it says so."""


def absorb(node: Any, pieces: tuple[Opaque, ...], terms: Terms, version: Version) -> Any:
    """The node with the pieces; what the terms say is to go goes before they come."""
    for path in terms.without:
        node = _blanked(node, path.split("."))
    if terms.instead:
        node = _without_scope(node, terms.instead)
    for piece in pieces:
        node = _absorb(node, piece, terms, version)
    return node


def _blanked(node: Any, path: list[str]) -> Any:
    first, *rest = path
    value = getattr(node, first, None)
    if value is None:
        return node
    inner = _blanked(value, rest) if rest else type(node).model_fields[first].default
    return node.model_copy(update={first: inner})


def _without_scope(node: Any, prefix: str) -> Any:
    """A model without what was flattened into it from a nested one, and without that one as it was put together."""
    if not isinstance(node, Model):
        return node
    own = prefix.removesuffix("::")
    update = {
        field: tuple(each for each in getattr(node, field) if each.name != own and not each.name.startswith(prefix))
        for field in ("links", "joints", "frames", "models")
    }
    return node.model_copy(update=update)


def _absorb(node: Any, piece: Opaque, terms: Terms, version: Version) -> Any:
    definition = definition_of(node)
    if definition is None:
        return node
    root = etree.Element("sdf")
    xml = etree.SubElement(root, definition)
    holder = xml
    for step in filter(None, piece.at.split("/")):
        holder = etree.SubElement(holder, step)
    _put(piece, holder)
    data = reader("sdf", version).read(xml, Context(Notes(), "", "sdf", version), definition)
    fields = {name: value for name, value in data.items() if name not in _REQUIRED or xml.get(name) is not None}
    if piece.element is not None and piece.element.name == "pose" and not piece.at:
        node = node.model_copy(update={"pose": None})  # one pose stands for another
    return _merged(node, fields, terms.index)


def _put(piece: Opaque, holder: XmlElement) -> None:
    if piece.element is not None:
        element_xml(piece.element, holder)
    elif piece.attribute is not None:
        holder.set(*piece.attribute)
    else:
        holder.text = piece.text


def _merged(node: Any, data: dict[str, Any], index: int | None) -> Any:
    """The node with what was read: one of several is put in its place, a part of a part into that."""
    bare = type(node).model_validate({**_required_of(node), **data})
    update: dict[str, Any] = {}
    for name in data:
        if name in ("source", "spelling"):
            continue
        value, mine = getattr(bare, name), getattr(node, name)
        if name == "opaque":
            update[name] = (*mine, *value)
        elif isinstance(value, tuple) and value and isinstance(value[0], Node):
            update[name] = _inserted(mine, value, index, node)
        elif isinstance(value, Node) and type(value) is type(mine):
            update[name] = _merged(mine, _data(value), None)
        else:
            update[name] = _at_home(value, mine, node) if isinstance(value, Node) else value
    if bare.spelling:
        update["spelling"] = {**(node.spelling or {}), **bare.spelling}
    return node.model_copy(update=update)


def _data(node: Node) -> dict[str, Any]:
    """What a node says, as the data of another one."""
    return {
        name: getattr(node, name)
        for name, field in type(node).model_fields.items()
        if name != "source" and getattr(node, name) != field.default
    }


def _required_of(node: Any) -> dict[str, Any]:
    return {name: getattr(node, name) for name in type(node).model_fields if name in _REQUIRED}


def _inserted(mine: tuple[Any, ...], value: tuple[Any, ...], index: int | None, node: Any) -> tuple[Any, ...]:
    place = len(mine) if index is None else min(index, len(mine))
    # it stands where its neighbour stands, so that it is written there
    beside = mine[place] if place < len(mine) else mine[-1] if mine else node
    placed = tuple(one.model_copy(update={"source": beside.source}) for one in value)
    return (*mine[:place], *placed, *mine[place:])


def _at_home(value: Node, mine: Node | None, node: Any) -> Node:
    return value.model_copy(update={"source": (mine or node).source})
