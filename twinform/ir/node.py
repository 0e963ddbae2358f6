"""What every node of the IR has."""

from collections.abc import Mapping
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, SkipValidation
from pydantic.json_schema import SkipJsonSchema

from twinform.diagnostics import NOWHERE, Location
from twinform.ir.element import Opaque

Vector3 = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
"""x, y, z, w"""
Color = tuple[float, float, float] | tuple[float, float, float, float]
"""red, green, blue and perhaps alpha, each from 0 to 1"""

_UNSEEN = frozenset({"source", "spelling"})


class Node(BaseModel):
    """A frozen part of a model. A field that is `None` was not written; a default is never filled in.

    `source` says where the node was read and `spelling` how values were written that have several spellings
    (`1` for `true`). Neither takes part in equality.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", ser_json_inf_nan="strings")

    opaque: tuple[Opaque, ...] = ()
    source: SkipJsonSchema[Annotated[Location | None, SkipValidation]] = Field(default=None, exclude=True, repr=False)
    spelling: SkipJsonSchema[Annotated[Mapping[str, str] | None, SkipValidation]] = Field(
        default=None, exclude=True, repr=False
    )

    @property
    def location(self) -> Location:
        """Where it was read; nowhere for a node made by a pass."""
        return self.source or NOWHERE

    def __eq__(self, other: object) -> bool:
        if self.__class__ is not other.__class__:
            return NotImplemented
        mine, theirs = self.__dict__, other.__dict__
        return all(value == theirs[name] for name, value in mine.items() if name not in _UNSEEN)

    def __hash__(self) -> int:
        return hash((self.__class__, *(value for name, value in self.__dict__.items() if name not in _UNSEEN)))
