"""Numbers in untyped elements of SDF that are too small for libsdformat."""

import math
import re
from collections.abc import Iterator, Mapping
from functools import cache
from operator import is_not
from typing import NamedTuple

from twinform.ir import Axis, Dynamics, Element, Limit, Mimic, Node, Opaque
from twinform.passes.carriers.definitions import definition_of
from twinform.passes.shared.gazebo_tags import NUMBER_TAGS
from twinform.schemas import Fact, format_value, table

_MAY_BE_TINY = re.compile(r"[eE]-0*\d\d|\.0{36}")
_NUMBERS = frozenset({"double", "vector2d", "vector3", "quaternion", "pose", "time"})
_BELOW_JOINT: Mapping[type[Node], str] = {
    Axis: "axis", Limit: "axis/limit", Dynamics: "axis/dynamics", Mimic: "axis/mimic"
}  # fmt: skip
"""The rows of nodes that have no definition of their own."""


class Least(NamedTuple):
    """The smallest number that is read, and the smallest part of a color."""

    number: float
    color: float


def rounded_paths(old: Element, new: Element, path: str = "") -> Iterator[str]:
    """Yield the paths of the elements whose numbers were changed, below an element; the empty path is its own."""
    if (old.text, old.attributes) != (new.text, new.attributes):
        yield path
    for one, other in zip(old.children, new.children, strict=True):
        if one is not other:
            yield from rounded_paths(one, other, f"{path}/{one.name}" if path else one.name)


def rounded_content(element: Element, least: Least) -> Element:
    """Return an element of a `<gazebo>` with its tiny numbers rounded; itself if it has none."""
    if not _may_be_tiny(element):
        return element
    if element.name in NUMBER_TAGS and not element.children:
        pairs = tuple((name, _rounded_text(text, least.number)) for name, text in element.attributes)
        return _copy_if_changed(element, element.text and _rounded_text(element.text, least.number), pairs, ())
    return _rounded(element, _rows_in_gazebo().get(element.name), least)


def rounded_block(part: Opaque, least: Least) -> Opaque:
    """Return a `<gazebo>` that came out of a carrier with its tiny numbers rounded; itself if it has none."""
    if part.element is None or part.element.name != "gazebo" or not _may_be_tiny(part.element):
        return part
    children = tuple(rounded_content(child, least) for child in part.element.children)
    element = _copy_if_changed(part.element, part.element.text, part.element.attributes, children)
    return part if element is part.element else part.copy(element=element)


def rounded_part(part: Opaque, node: Node, least: Least) -> Opaque:
    """Return an untyped part of an SDF node with its tiny numbers rounded; itself if it has none."""
    if part.element is None or not _may_be_tiny(part.element):
        return part
    definition = "joint" if type(node) in _BELOW_JOINT else definition_of(node)
    path = f"{_BELOW_JOINT.get(type(node), '')}/{part.at}/{part.element.name}"
    row = table("sdf").definitions[definition] if definition else None
    for step in filter(None, path.split("/")):
        row = _rows(row).get(step) if row else None
    element = _rounded(part.element, row, least)
    return part if element is part.element else part.copy(element=element)


def _may_be_tiny(element: Element) -> bool:
    texts = (text for each in element.walk() for text in (each.text, *(value for _, value in each.attributes)))
    return any(text and _MAY_BE_TINY.search(text) for text in texts)


@cache
def _rows_in_gazebo() -> Mapping[str, Fact]:
    """What may stand in a `<gazebo>` for the model, a joint or a link."""
    return {
        name: row for kind in ("model", "joint", "link") for name, row in _rows(table("sdf").definitions[kind]).items()
    }


def _rows(row: Fact) -> Mapping[str, Fact]:
    """The rows in an element; of what is free content, none."""
    fact = table("sdf").resolve(row)
    return {} if fact.any else {each.name: each for each in fact.rows}


def _rounded(element: Element, row: Fact | None, least: Least) -> Element:
    if row is None:
        return element
    rows, type = _rows(row), table("sdf").resolve(row).type
    text = element.text and _rounded_value(element.text, type, least)
    pairs = tuple(
        (name, _rounded_value(value, rows[f"@{name}"].type, least) if f"@{name}" in rows else value)
        for name, value in element.attributes
    )
    children = tuple(_rounded(child, rows.get(child.name), least) for child in element.children)
    return _copy_if_changed(element, text, pairs, children)


def _copy_if_changed(
    element: Element, text: str | None, attributes: tuple[tuple[str, str], ...], children: tuple[Element, ...]
) -> Element:
    """Return the element with other content, or the element itself if nothing in it is new."""
    is_same = (text, attributes) == (element.text, element.attributes) and not any(
        map(is_not, element.children, children)
    )
    return element if is_same else element.copy(text=text, attributes=attributes, children=children)


def _rounded_value(text: str, type: str | None, least: Least) -> str:
    if type == "color":
        return _rounded_text(text, least.color)
    return _rounded_text(text, least.number) if type in _NUMBERS else text


def _rounded_text(text: str, least: float) -> str:
    return re.sub(r"\S+", lambda word: _rounded_word(word[0], least), text)


def _rounded_word(word: str, least: float) -> str:
    try:
        number = float(word)
    except ValueError:
        return word
    if number == 0:  # or too small for a double
        return "0" if re.search("[1-9]", re.split("[eE]", word)[0]) else word
    return word if abs(number) >= least else format_value(math.copysign(least, number))
