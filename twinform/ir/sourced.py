"""Parts that know where they were written."""

from collections.abc import Mapping
from functools import cache
from typing import Annotated, Any, Self

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

    @classmethod
    def unchecked(cls, **values: Any) -> Self:
        """A part with values that need no validation, since they come from parts or trees that had it."""
        made = object.__new__(cls)
        object.__setattr__(made, "__dict__", {**_defaults(cls), **values})
        object.__setattr__(made, "__pydantic_fields_set__", set(values))
        object.__setattr__(made, "__pydantic_extra__", None)
        object.__setattr__(made, "__pydantic_private__", None)
        return made

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """The same part with other values, which are not validated.

        A frozen part has nothing private and no extra fields, so that there is less to copy than pydantic looks for;
        conversions make most of their parts so.
        """
        if deep or not update:
            return super().model_copy(update=update, deep=deep)
        made = object.__new__(type(self))
        object.__setattr__(made, "__dict__", {**self.__dict__, **update})
        object.__setattr__(made, "__pydantic_fields_set__", self.__pydantic_fields_set__ | update.keys())
        object.__setattr__(made, "__pydantic_extra__", None)
        object.__setattr__(made, "__pydantic_private__", None)
        return made

    def __eq__(self, other: object) -> bool:
        if self.__class__ is not other.__class__:
            return NotImplemented
        mine, theirs = self.__dict__, other.__dict__
        return all(value == theirs[name] for name, value in mine.items() if name not in _UNSEEN)

    def __hash__(self) -> int:
        return hash((self.__class__, *(value for name, value in self.__dict__.items() if name not in _UNSEEN)))


@cache
def _defaults(kind: type[Sourced]) -> dict[str, Any]:
    return {name: field.get_default(call_default_factory=True) for name, field in kind.model_fields.items()}
