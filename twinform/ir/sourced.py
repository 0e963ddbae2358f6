"""Parts that know where they were written."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, SkipValidation
from pydantic.json_schema import SkipJsonSchema

from twinform.diagnostics import NOWHERE, Location, Source

_UNSEEN = frozenset({"source", "spelling"})


class Sourced(BaseModel):
    """A frozen part of a document. `source`, the place it was read from, takes no part in equality or in JSON."""

    model_config = ConfigDict(frozen=True, extra="forbid", ser_json_inf_nan="strings", defer_build=True)

    source: SkipJsonSchema[Annotated[Source | None, SkipValidation]] = Field(default=None, exclude=True, repr=False)

    @property
    def location(self) -> Location:
        """Where it was read; nowhere for what a pass made."""
        return self.source.location if self.source else NOWHERE

    def __eq__(self, other: object) -> bool:
        if self.__class__ is not other.__class__:
            return NotImplemented
        mine, theirs = self.__dict__, other.__dict__
        return all(value == theirs[name] for name, value in mine.items() if name not in _UNSEEN)

    def __hash__(self) -> int:
        return hash((self.__class__, *(value for name, value in self.__dict__.items() if name not in _UNSEEN)))
