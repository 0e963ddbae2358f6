"""`Node`: the base class of the IR."""

from collections.abc import Mapping
from dataclasses import field
from typing import Annotated, TypeGuard, cast

from twinform.ir.element import Opaque
from twinform.ir.record import Constraint, OneOf, Sourced, fields_of, record

Vector3 = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
"""x, y, z, w"""
Color = Annotated[tuple[float, ...], Constraint(min_length=3, max_length=4)]
"""red, green, blue and perhaps alpha, each from 0 to 1"""


@record
class Node(Sourced):
    """A part of a model. A field that is `None` was not written; a default is never filled in.

    Attributes:
        opaque: what has no typed field, kept where it was.
        spelling: how values were written that have several spellings (`1` for `true`), by the names of the fields; like
            `source`, it takes no part in equality.
    """

    opaque: tuple[Annotated[Opaque, OneOf("element", "attribute", "text")], ...] = ()
    spelling: Mapping[str, str] | None = field(default=None, repr=False, compare=False, metadata={"exclude": True})


NOT_CONTENT = frozenset(name for name, each in fields_of(Node).items() if not each.compare)
"""Fields that say how the file was written, and nothing of the robot: those that are declared with `compare=False`."""


def are_nodes(value: object) -> TypeGuard[tuple[Node, ...]]:
    """Tell whether the value of a field is a list of nodes that is not empty."""
    return isinstance(value, tuple) and isinstance(next(iter(cast("tuple[object, ...]", value)), None), Node)
