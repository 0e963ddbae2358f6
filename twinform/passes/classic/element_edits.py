"""Reading and writing texts in an element by path, such as `camera/clip/near` or `noise/@type`."""

from twinform.ir import Element


def text_at(element: Element, path: str) -> str | None:
    """The text at a path; None where there is none."""
    *steps, last = path.split("/")
    here: Element | None = element
    for step in steps:
        here = here.find(step) if here is not None else None
    if here is None:
        return None
    if last.startswith("@"):
        return here.get(last[1:])
    found = here.find(last)
    return found.text if found is not None else None


def with_text(element: Element, path: str, text: str) -> Element:
    """The element with a text at a path, in place of the one that was there; what is missing on the way is made."""
    step, _, rest = path.partition("/")
    if step.startswith("@"):
        others = tuple(each for each in element.attributes if each[0] != step[1:])
        return element.copy(attributes=(*others, (step[1:], text)))
    child = element.find(step) or Element(name=step)
    new = with_text(child, rest, text) if rest else child.copy(text=text)
    return with_child(element, child, new)


def with_child(element: Element, old: Element, new: Element) -> Element:
    """The element with one child in place of another, or added where the other is not in it."""
    if any(child is old for child in element.children):
        children = tuple(new if child is old else child for child in element.children)
    else:
        children = (*element.children, new)
    return element.copy(children=children)


def added(element: Element, child: Element) -> Element:
    """The element with one more child."""
    return element.copy(children=(*element.children, child))
