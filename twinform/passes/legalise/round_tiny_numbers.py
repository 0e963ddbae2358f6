"""Numbers that are too small for libsdformat, which are rounded to the smallest that it reads."""

import math
import sys
from functools import cache
from operator import is_not
from typing import Any, ClassVar, get_args

from twinform.diagnostics import DiagnosticSink, Fate, Location, rules
from twinform.ir import Color, Element, Format, GazeboExtension, Model, Node, rewrite
from twinform.ir.record import fields_of
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.tiny_elements import (
    Least,
    rounded_block,
    rounded_content,
    rounded_part,
    rounded_paths,
)

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
        return rewrite(model, Node, lambda node: _rounded(node, self.to, sink))


def rounded_extension(extension: GazeboExtension, sink: DiagnosticSink) -> GazeboExtension:
    """An extension with numbers that libsdformat reads."""
    content = tuple(rounded_content(each, _LEAST[Format.URDF]) for each in extension.content)
    for old, new in zip(extension.content, content, strict=True):
        _account_inside(old, new, old.location if old.source else extension.location, sink)
    return extension.copy(content=content) if any(map(is_not, extension.content, content)) else extension


def _with_rounded_parts(node: Node, to: Format, sink: DiagnosticSink) -> Node:
    """A node whose parts without a field have numbers that libsdformat reads."""
    least = _LEAST[to]
    parts = tuple(
        rounded_part(one, node, least) if to is Format.SDF else rounded_block(one, least) for one in node.opaque
    )
    for old, new in zip(node.opaque, parts, strict=True):
        if old.element is not None and new.element is not None:
            _account_inside(old.element, new.element, old.location_in(node), sink)
    return node.copy(opaque=parts) if any(map(is_not, node.opaque, parts)) else node


def _account_inside(old: Element, new: Element, where: Location, sink: DiagnosticSink) -> None:
    for path in rounded_paths(old, new) if old is not new else ():
        _account(path.rpartition("/")[2] or old.name, where.at(path) if path else where, sink)


def _account(name: str, where: Location, sink: DiagnosticSink) -> None:
    message = f"Gazebo reads no number as small as one of {name!r}: the smallest that it reads is written"
    sink.account(Fate.APPROXIMATED, rules.TINY_NUMBER, message, where)


def _rounded(node: Node, to: Format, sink: DiagnosticSink) -> Node:
    if isinstance(node, GazeboExtension):
        return rounded_extension(node, sink)
    if node.opaque:
        node = _with_rounded_parts(node, to, sink)
    update: dict[str, object] = {}
    for name, least in _numbers(type(node), to):
        value = getattr(node, name)
        if value.__class__ is float:
            # Zero would be nearer, but a radius, a mass or an effort limit has to stay positive.
            if 0 < abs(value) < least:
                update[name] = math.copysign(least, value)
        elif value and any(0 < abs(each) < least for each in value):
            update[name] = tuple(math.copysign(least, each) if 0 < abs(each) < least else each for each in value)
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
