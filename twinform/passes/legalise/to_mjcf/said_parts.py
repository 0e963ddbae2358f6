"""What is left of a node of SDF once MJCF has said a part of it: fields and untyped elements without that part."""

import math
from collections.abc import Collection
from typing import TypeVar

from twinform.ir import Element, Node, Opaque

AnyNode = TypeVar("AnyNode", bound=Node)


def untyped(node: Node, name: str) -> Element | None:
    """The first untyped element of a name in a node, such as the `<camera>` of a sensor."""
    return next((part.element for part in node.opaque if part.element and part.element.name == name), None)


def child_text(element: Element | None, *path: str) -> str | None:
    """The text of the element at a path of names below an element; None where there is none."""
    for name in path:
        element = element.find(name) if element is not None else None
    return element.text if element is not None else None


def child_number(element: Element | None, *path: str, default: float) -> float:
    """The number at a path of names below an element, or the default."""
    text = child_text(element, *path)
    return default if text is None else float(text)


def child_count(element: Element | None, *path: str, default: int) -> int:
    """The whole number at a path of names below an element, or the default; it may be hexadecimal."""
    return whole_number(child_text(element, *path), default)


def whole_number(text: str | None, default: int) -> int:
    """The whole number in a text, which may be hexadecimal; the default where there is none."""
    try:
        return default if text is None else int(text, 0)
    except ValueError:  # such as 640.0, 007 and inf
        number = float(text or "nan")
        return int(number) if math.isfinite(number) else default


def child_vector(element: Element | None, *path: str) -> tuple[float, ...] | None:
    """The numbers at a path of names below an element; None where there are none."""
    text = child_text(element, *path)
    return None if text is None else tuple(map(float, text.split()))


def without_elements(node: AnyNode, paths: Collection[str]) -> AnyNode:
    """The node without the untyped elements at these paths, such as `camera/image/width`.

    An element that has nothing left goes too.
    """
    kept: list[Opaque] = []
    for part in node.opaque:
        if part.element is None:
            kept.append(part)
            continue
        left = _without(part.element, f"{part.at}/{part.element.name}".lstrip("/"), paths)
        if left is not None:
            kept.append(part.copy(element=left))
    return node.copy(opaque=tuple(kept))


def _without(element: Element, path: str, paths: Collection[str]) -> Element | None:
    if path in paths:
        return None
    if not any(each.startswith(f"{path}/") for each in paths):
        return element
    children = tuple(
        left for child in element.children if (left := _without(child, f"{path}/{child.name}", paths)) is not None
    )
    if not children and element.children and not element.attributes and not element.text:
        return None
    return element.copy(children=children)
