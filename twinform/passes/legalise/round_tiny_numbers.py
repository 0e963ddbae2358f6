"""Numbers that are too small for libsdformat, also in untyped elements: rounded to the smallest that it reads."""

import math
import re
import sys
from collections.abc import Iterator, Mapping
from functools import cache, partial
from operator import is_not
from typing import Any, ClassVar, NamedTuple, get_args

from twinform.diagnostics import DiagnosticSink, Fate, Location, rules
from twinform.ir import (
    Axis,
    Color,
    Dynamics,
    Element,
    Format,
    GazeboExtension,
    Limit,
    Mimic,
    Model,
    Node,
    Opaque,
    rewrite,
)
from twinform.ir.record import fields_of
from twinform.ir.rewrite import node_fields
from twinform.lazy import lazy_pattern
from twinform.passes.carriers.absorb import definition_of
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.shared.gazebo_tags import NUMBER_TAGS
from twinform.schemas import Fact, format_value, table

# With fewer zeros and an exponent of one digit a number is 1e-37 at least.
_MAY_BE_TINY = lazy_pattern(r"[eE]-0*[1-9]\d|\.0{28}")
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
    return _round_element(element, _rows_in_gazebo().get(element.name), least)


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
    element = _round_element(part.element, row, least)
    return part if element is part.element else part.copy(element=element)


def _may_be_tiny(element: Element) -> bool:
    search = _MAY_BE_TINY.search
    for each in element.walk():  # every untyped element is asked: a generator would take twice as long
        if each.text and search(each.text):
            return True
        for _, value in each.attributes:
            if search(value):
                return True
    return False


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


def _round_element(element: Element, row: Fact | None, least: Least) -> Element:
    if row is None:
        return element
    rows, type = _rows(row), table("sdf").resolve(row).type
    text = element.text and _rounded_value(element.text, type, least)
    pairs = tuple(
        (name, _rounded_value(value, rows[f"@{name}"].type, least) if f"@{name}" in rows else value)
        for name, value in element.attributes
    )
    children = tuple(_round_element(child, rows.get(child.name), least) for child in element.children)
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


_DOUBLE = sys.float_info.min
_FLOAT = 2.0**-126
"""The smallest float that is not subnormal: std::stof, by which libsdformat reads colors, refuses those below."""
# libsdformat makes SDF of URDF, with fewer digits, and refuses what it makes of the smallest double: Param.cc.
_IN_URDF = 2.3e-308
_LEAST = {Format.URDF: Least(_IN_URDF, _FLOAT), Format.SDF: Least(_DOUBLE, _FLOAT)}
"""The smallest numbers that libsdformat reads in elements of SDF, which stand in `<gazebo>` of URDF."""


class RoundTinyNumbers(ModelPass):
    """Round numbers that are too small for libsdformat, which refuses files with them.

    Changes: 1. a subnormal number becomes the smallest one of its sign that libsdformat reads, which is 2.3e-308 in
    URDF; 2. so does a part of a color in SDF, of those that a float can hold; 3. both also in elements without a field,
    and in those in `<gazebo>`, where SDF has a number there.
    Never touches: zero, content of plugins, elements of others, and carriers.
    Diagnostics: ledger entries under `tiny-number`.
    """

    name: ClassVar[str] = "round-tiny-numbers"
    to: Format

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with numbers that libsdformat reads."""
        # Nearly no model has any, and to look for them takes half as long.
        return rewrite(model, Node, partial(_rounded, self.to, sink)) if _may_have_tiny(model, self.to) else model


def _may_have_tiny(model: Model, to: Format) -> bool:
    """Whether a number in a node may be tiny, or one in a part without a field."""
    nodes: list[Node] = [model]
    numbers: list[float] = []  # they are compared at once, which takes half as long
    for node in nodes:  # grows while it is walked
        of_numbers, fields = _places(node.__class__, to)
        for name, _ in of_numbers:
            value = getattr(node, name)
            if value.__class__ is tuple:
                numbers += value
            elif value:
                numbers.append(value)
        if (node.opaque or node.__class__ is GazeboExtension) and any(map(_may_be_tiny, _untyped(node))):
            return True
        for name in fields:
            inside = getattr(node, name)
            if inside:
                nodes += inside if inside.__class__ is tuple else (inside,)
    # None of the least numbers is larger than that of colors.
    tiny = [each for each in numbers if -_FLOAT < each < _FLOAT and each]
    return bool(tiny)


def _untyped(node: Node) -> list[Element]:
    """The elements in a node that have no field."""
    content = node.content if isinstance(node, GazeboExtension) else ()
    return [*content, *(part.element for part in node.opaque if part.element)]


@cache
def _places(kind: type[Node], to: Format) -> tuple[tuple[tuple[str, float], ...], tuple[str, ...]]:
    """The fields of a class that hold numbers, each with the smallest that is read there, and those with nodes."""
    return _numbers(kind, to), node_fields(kind)


def rounded_extension(extension: GazeboExtension, sink: DiagnosticSink) -> GazeboExtension:
    """An extension with numbers that libsdformat reads."""
    content = tuple(rounded_content(each, _LEAST[Format.URDF]) for each in extension.content)
    for old, new in zip(extension.content, content, strict=True):
        if new is not old:
            _account_inside(old, new, old.location if old.source else extension.location, sink)
    return extension.copy(content=content) if any(map(is_not, extension.content, content)) else extension


def _with_rounded_parts(node: Node, to: Format, sink: DiagnosticSink) -> Node:
    """A node whose parts without a field have numbers that libsdformat reads."""
    least = _LEAST[to]
    parts = tuple(
        [rounded_part(one, node, least) if to is Format.SDF else rounded_block(one, least) for one in node.opaque]
    )
    for old, new in zip(node.opaque, parts, strict=True):
        if new is not old and old.element is not None and new.element is not None:
            _account_inside(old.element, new.element, old.location_in(node), sink)
    return node.copy(opaque=parts) if any(map(is_not, node.opaque, parts)) else node


def _account_inside(old: Element, new: Element, where: Location, sink: DiagnosticSink) -> None:
    for path in rounded_paths(old, new):
        _account(path.rpartition("/")[2] or old.name, where.at(path) if path else where, sink)


def _account(name: str, where: Location, sink: DiagnosticSink) -> None:
    message = f"Gazebo reads no number as small as one of {name!r}: the smallest that it reads is written"
    sink.account(Fate.APPROXIMATED, rules.TINY_NUMBER, message, where)


def _rounded(to: Format, sink: DiagnosticSink, node: Node) -> Node:
    if isinstance(node, GazeboExtension):
        return rounded_extension(node, sink)
    if node.opaque:
        node = _with_rounded_parts(node, to, sink)
    update: dict[str, object] = {}
    for name, least in _numbers(type(node), to):
        value = getattr(node, name)
        if value is None:
            continue
        # Zero would be nearer, but a radius, a mass or an effort limit has to stay positive.
        if value.__class__ is float:
            if -least < value < least and value:
                update[name] = math.copysign(least, value)
            continue
        for each in value:  # of every vector of a robot: `any` with a generator would take twice as long
            if -least < each < least and each:
                update[name] = tuple(math.copysign(least, one) if 0 < abs(one) < least else one for one in value)
                break
    for name in update:
        _account(name, node.location, sink)
    return node.copy(**update) if update else node


@cache
def _numbers(kind: type[Node], to: Format) -> tuple[tuple[str, float], ...]:
    """The fields of a class that hold numbers, each with the smallest that libsdformat reads there."""
    types: dict[str, Any] = {name: field.type for name, field in fields_of(kind).items()}
    return tuple((name, _least(type, to)) for name, type in types.items() if _holds_numbers(type))


def _least(type: Any, to: Format) -> float:
    if to is Format.URDF:
        return _IN_URDF
    return _FLOAT if Color in get_args(type) else _DOUBLE


def _holds_numbers(type: Any) -> bool:
    return type is float or any(map(_holds_numbers, get_args(type)))
