"""Changing what sensors cost, also of those that `<gazebo>` extensions of URDF have as elements."""

from collections.abc import Callable

from twinform.ir import Document, Element, GazeboExtension, Node, Sensor, bits_of, rewrite
from twinform.passes.analyses.sensor_costs import sensor_of

_HAVING = bits_of(Sensor) | bits_of(GazeboExtension)


def map_sensors(document: Document, change: Callable[[Sensor], Sensor]) -> Document:
    """The document with every sensor changed, in the order in which `sensors_in` has them."""

    def changed(node: Node) -> Node:
        if isinstance(node, Sensor):
            return change(node)
        if not isinstance(node, GazeboExtension):
            return node
        content = tuple(_element(each, node, change) for each in node.content)
        same = all(new is old for new, old in zip(content, node.content, strict=True))
        return node if same else node.copy(content=content)

    return rewrite(document, Node, changed, having=_HAVING)


def _element(element: Element, around: GazeboExtension, change: Callable[[Sensor], Sensor]) -> Element:
    if element.name == "sensor":
        old = sensor_of(element, around.source)
        new = change(old)
        element = element if new is old else _write_changes(element, old, new)
    children = tuple(_element(each, around, change) for each in element.children)
    same = all(new is old for new, old in zip(children, element.children, strict=True))
    return element if same else element.copy(children=children)


def _write_changes(element: Element, old: Sensor, new: Sensor) -> Element:
    """The element with what differs between two sensors."""
    if new.update_rate != old.update_rate:
        element = with_child(element, with_text("update_rate", f"{new.update_rate:.10g}", element))
    changed = {part.element.name: part.element for part in new.opaque if part.element}
    children = tuple(changed.get(child.name, child) for child in element.children)
    return element.copy(children=children)


def with_text(name: str, text: str, holder: Element) -> Element:
    """The child of a name that the holder has, or a new one, with this text."""
    return (holder.find(name) or Element(name=name)).copy(text=text)


def with_child(holder: Element, child: Element) -> Element:
    """The holder with a child in the place of the first one of its name, or at the end."""
    at = next((index for index, each in enumerate(holder.children) if each.name == child.name), None)
    before, after = (holder.children, ()) if at is None else (holder.children[:at], holder.children[at + 1 :])
    return holder.copy(children=(*before, child, *after))
