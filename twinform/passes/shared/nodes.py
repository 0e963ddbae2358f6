"""Helpers for nodes: unique names, pieces for carriers, mapping of elements."""

from collections.abc import Callable, Container, Iterable

from twinform.ir import Element, Node, Opaque, Pose, replace_fields
from twinform.passes.carriers.carriers import to_element


def unique_name(name: str, taken: Container[str]) -> str:
    """The name, or the name with the first number behind it that makes it unique."""
    made, number = name, 1
    while made in taken:
        made, number = f"{name}_{number}", number + 1
    return made


def reserve_name(name: str, taken: set[str], numbers: dict[str, int] | None = None) -> str:
    """A unique name made of this one, which is added to the taken names.

    Where many ask for one name, `numbers` has the numbers that were given last, so that they need not be counted again.
    """
    if numbers is None or name not in taken:
        made = unique_name(name, taken)
    else:
        number = numbers.get(name, 0) + 1
        while (made := f"{name}_{number}") in taken:
            number += 1
        numbers[name] = number
    taken.add(made)
    return made


def piece(node: Node, tag: str) -> Opaque:
    """A node as a carrier piece: an element of SDF."""
    return Opaque.unchecked(element=to_element(node, tag, "sdf"))


def pose_piece(pose: Pose) -> Opaque:
    """A pose as a carrier piece."""
    return piece(pose, "pose")


def text_piece(name: str, text: str, at: str = "") -> Opaque:
    """An element with text as a carrier piece."""
    return Opaque.unchecked(at=at, element=Element.unchecked(name=name, text=text))


def map_elements(parts: Iterable[Opaque], change: Callable[[Element], Element]) -> tuple[Opaque, ...]:
    """Opaque parts with each element changed; `change` handles the children."""
    return tuple(
        [part if part.element is None else replace_fields(part, element=change(part.element)) for part in parts]
    )
