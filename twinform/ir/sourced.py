"""Base class of parts with a source location."""

from collections.abc import Mapping
from functools import cache
from typing import Annotated, Any, Self, TypeVar

from pydantic import BaseModel, ConfigDict, Field, SkipValidation
from pydantic.json_schema import SkipJsonSchema

from twinform.diagnostics import NOWHERE, Location, Source

AnyPart = TypeVar("AnyPart", bound="Sourced")

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
        return _assembled(cls, {**_defaults(cls), **values}, set(values))

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """The same part with other values, which are not validated.

        A frozen part has nothing private and no extra fields, so that there is less to copy than pydantic looks for;
        conversions make most of their parts so.
        """
        if deep or not update:
            return super().model_copy(update=update, deep=deep)
        return _assembled(type(self), {**self.__dict__, **update}, self.__pydantic_fields_set__ | update.keys())

    def __eq__(self, other: object) -> bool:
        if self.__class__ is not other.__class__:
            return NotImplemented
        mine, theirs = self.__dict__, other.__dict__
        return all(value == theirs[name] for name, value in mine.items() if name not in _UNSEEN)

    def __hash__(self) -> int:
        return hash((self.__class__, *(value for name, value in self.__dict__.items() if name not in _UNSEEN)))


def _assembled(kind: type[AnyPart], values: dict[str, Any], written: set[str]) -> AnyPart:
    """A part with all its values, of which some were written. `model_construct` would look at each field again."""
    made = object.__new__(kind)
    object.__setattr__(made, "__dict__", values)
    object.__setattr__(made, "__pydantic_fields_set__", written)
    object.__setattr__(made, "__pydantic_extra__", None)
    object.__setattr__(made, "__pydantic_private__", None)
    return made


@cache
def _defaults(kind: type[Sourced]) -> dict[str, Any]:
    return {name: field.get_default(call_default_factory=True) for name, field in kind.model_fields.items()}
