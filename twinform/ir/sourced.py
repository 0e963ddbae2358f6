"""Base class of parts with a source location."""

from collections.abc import Callable, Mapping
from functools import cache, lru_cache
from typing import Annotated, Any, ParamSpec, Self, TypeVar, cast

from pydantic import BaseModel, ConfigDict, Field, SkipValidation
from pydantic.json_schema import SkipJsonSchema

from twinform.diagnostics import NOWHERE, Location, Source
from twinform.ir.signature import FieldSignature

Values = ParamSpec("Values")
AnyPart = TypeVar("AnyPart", bound="Sourced")

NOT_CONTENT = frozenset({"source", "spelling"})
"""Fields of parts that say how the file was written, and nothing of the robot: they take no part in comparisons."""


class Sourced(BaseModel):
    """A frozen part of a document.

    Attributes:
        source: the place it was read from; it takes no part in equality or in JSON.
    """

    __slots__ = ("_census",)  # what `twinform.ir.census` has found, once it was asked

    __signature__ = FieldSignature()  # pyright: ignore[reportAssignmentType] - it is one where it is read

    model_config = ConfigDict(frozen=True, extra="forbid", ser_json_inf_nan="strings", defer_build=True)

    source: SkipJsonSchema[Annotated[Source | None, SkipValidation]] = Field(default=None, exclude=True, repr=False)

    @property
    def location(self) -> Location:
        """Where it was read; nowhere for what a pass made."""
        return self.source.location if self.source else NOWHERE

    @classmethod  # pyright: ignore[reportArgumentType] - a class is a callable that makes its objects
    def unchecked(cls: Callable[Values, AnyPart], *_: Values.args, **values: Values.kwargs) -> AnyPart:
        """A part with values that need no validation: they come from parts or trees that had it, or from our code."""
        kind = cast("type[AnyPart]", cls)
        return assembled(kind, _defaults(kind) | values, set(values))

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """The same part with other values, which are not validated.

        A frozen part has nothing private and no extra fields, so that there is less to copy than pydantic looks for;
        conversions make most of their parts so.
        """
        if deep or not update:
            return super().model_copy(update=update, deep=deep)
        written = self.__pydantic_fields_set__
        if not update.keys() <= written:
            written = _names(frozenset(written | update.keys()))
        values = self.__dict__.copy()
        values.update(update)
        return assembled(type(self), values, written)

    def __eq__(self, other: object) -> bool:
        if self.__class__ is not other.__class__:
            return NotImplemented
        mine, theirs = self.__dict__, other.__dict__
        return all(value == theirs[name] for name, value in mine.items() if name not in NOT_CONTENT)

    def __hash__(self) -> int:
        return hash((self.__class__, *(value for name, value in self.__dict__.items() if name not in NOT_CONTENT)))


_new = object.__new__
_set_values, _set_written, _set_extra, _set_private, _set_census = (
    vars(kind)[slot].__set__
    for kind, slot in (
        (BaseModel, "__dict__"),
        (BaseModel, "__pydantic_fields_set__"),
        (BaseModel, "__pydantic_extra__"),
        (BaseModel, "__pydantic_private__"),
        (Sourced, "_census"),
    )
)
"""The slots of a part, without the detour through its `__setattr__`, which refuses because parts are frozen."""
_MOST_SHARED = 256
_INSTANCES_WITH_ROOM = 30


@lru_cache(maxsize=4096)
def _names(fields: frozenset[str]) -> set[str]:
    """One set for all parts in which the same fields were written: nobody changes it."""
    return set(fields)


def _unknown(_: tuple[str, ...]) -> None:
    """The census where nobody knows it yet."""


def maker(
    kind: type[AnyPart], census: Callable[[tuple[str, ...]], int | None] = _unknown
) -> Callable[[dict[str, Any]], AnyPart]:
    """What makes parts of a class from the values that were written, where these need no validation.

    Parts in which the same fields were written share the set of their names: nobody changes it, and a set for each part
    would be most of what small parts need. They also have one `census`, where the names of the fields tell it.
    """
    defaults = _defaults(kind)
    shared: dict[tuple[str, ...], tuple[set[str], int | None]] = {}

    def share(fields: tuple[str, ...]) -> tuple[set[str], int | None]:
        if len(shared) >= _MOST_SHARED:
            shared.clear()
        found = shared[fields] = _names(frozenset(fields)), census(fields)
        return found

    def make(values: dict[str, Any]) -> AnyPart:
        fields = tuple(values)
        written, bits = shared.get(fields) or share(fields)
        made = _new(kind)
        _set_values(made, defaults | values)
        _set_written(made, written)
        _set_extra(made, None)
        _set_private(made, None)
        _set_census(made, bits)
        return made

    return make


def amend(part: Sourced, field: str, value: object) -> None:
    """Write a value into a part that was just made and that nobody else has seen: others are frozen."""
    part.__dict__[field] = value  # pyright: ignore[reportIndexIssue] - typeshed has the view that classes have
    _set_written(part, _names(frozenset((*part.__pydantic_fields_set__, field))))
    _set_census(part, None)


def assembled(kind: type[AnyPart], values: dict[str, Any], written: set[str]) -> AnyPart:
    """A part with all its values, of which some were written. `model_construct` would look at each field again."""
    made = _new(kind)
    _set_values(made, values)
    _set_written(made, written)
    _set_extra(made, None)
    _set_private(made, None)
    _set_census(made, None)
    return made


@cache
def _defaults(kind: type[Sourced]) -> dict[str, Any]:
    """The values of a part in which nothing is written, in a dictionary whose copies share its keys.

    Python makes such dictionaries for the instances of a class, the first of which have room for more attributes than
    there are. With one of its own a part would need twice the memory.
    """
    values = {name: field.get_default(call_default_factory=True) for name, field in kind.model_fields.items()}
    holder = type(kind.__name__, (), {})
    for _ in range(_INSTANCES_WITH_ROOM):
        _instance_values(holder, values)
    return _instance_values(holder, values).copy()


def _instance_values(kind: type[object], values: Mapping[str, object]) -> dict[str, Any]:
    """The dictionary of a new instance of a class that has these attributes."""
    made = kind()
    for name, value in values.items():
        setattr(made, name, value)
    return vars(made)
