"""Removing and inserting elements of untyped trees by path."""

from twinform.ir import Element


def take(element: Element, path: tuple[str, ...]) -> tuple[Element, Element | None]:
    """The element without the first one at a path below it, and that one; what held it stays, even if it is empty."""
    found = element.find(path[0])
    if found is None:
        return element, None
    if len(path) == 1:
        return without(element, found), found
    inner, taken = take(found, path[1:])
    return (replace(element, found, inner), taken) if taken is not None else (element, None)


def put(element: Element, path: tuple[str, ...], made: Element) -> Element:
    """The element with another one put into the element at a path below it, which is made where it is missing."""
    if not path:
        return element.copy(children=(*element.children, made))
    found = element.find(path[0])
    if found is None:
        inner = put(Element.unchecked(name=path[0]), path[1:], made)
        return element.copy(children=(*element.children, inner))
    return replace(element, found, put(found, path[1:], made))


def replace(element: Element, old: Element, new: Element) -> Element:
    """The element with one of its children replaced."""
    return element.copy(children=tuple(new if child is old else child for child in element.children))


def without(element: Element, child: Element) -> Element:
    """The element without one of its children."""
    return element.copy(children=tuple(each for each in element.children if each is not child))


def has(element: Element, path: tuple[str, ...]) -> bool:
    """Whether there is an element at a path below it."""
    found: Element | None = element
    for name in path:
        found = found.find(name) if found is not None else None
    return found is not None
