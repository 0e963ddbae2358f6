"""`Node`: the base class of the IR."""

from collections.abc import Mapping
from typing import Annotated

from pydantic import Field, SkipValidation
from pydantic.json_schema import SkipJsonSchema

from twinform.ir.element import Opaque
from twinform.ir.sourced import Sourced

Vector3 = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
"""x, y, z, w"""
Color = Annotated[tuple[float, ...], Field(min_length=3, max_length=4)]
"""red, green, blue and perhaps alpha, each from 0 to 1"""


class Node(Sourced):
    """A part of a model. A field that is `None` was not written; a default is never filled in.

    Attributes:
        opaque: what has no typed field, kept where it was.
        spelling: how values were written that have several spellings (`1` for `true`), by the names of the fields; like
            `source`, it takes no part in equality.
    """

    opaque: tuple[Opaque, ...] = ()
    spelling: SkipJsonSchema[Annotated[Mapping[str, str] | None, SkipValidation]] = Field(
        default=None, exclude=True, repr=False
    )
