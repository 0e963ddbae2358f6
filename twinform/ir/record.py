"""`Record`: frozen objects with slots, whose values Pydantic validates where they come from people.

Fields are those of dataclasses, which type checkers, `help` and Pydantic know. To import Pydantic takes longer than
most of what a short command does, so that this waits until something is validated.

`Sourced` is the base class of parts of a document, which know where they come from.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import MISSING, Field, FrozenInstanceError, dataclass, field, fields
from functools import cache, partial
from operator import attrgetter
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    ClassVar,
    ParamSpec,
    Self,
    TypeVar,
    cast,
    dataclass_transform,
)

from twinform.dataclass import LazySignature
from twinform.diagnostics import NOWHERE, Location, Source
from twinform.diagnostics.wording import cut

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, TypeAdapter
    from pydantic.json_schema import JsonSchemaValue
    from pydantic_core import CoreSchema


Values = ParamSpec("Values")
AnyRecord = TypeVar("AnyRecord", bound="Record")


@dataclass_transform(frozen_default=True, kw_only_default=True, eq_default=True, field_specifiers=(field,))
def record(kind: type[AnyRecord]) -> type[AnyRecord]:
    """Make a class of records of a class body with annotated fields.

    `dataclass` would compile an initializer, `__eq__` and others for each class, which takes longer than to read a
    robot; `Record` has them once. As `slots` makes each class a second time, methods cannot call `super()`.
    """
    # Nine designs were measured on all node classes, and this one is better in start, making,
    # copying, comparing and memory at once. Pydantic models take a third of `twinform check` to
    # import and build, five times as long to make and three times the memory; `@dataclass` compiles
    # six methods for each class, 28 ms in all.
    made = cast(
        "type[Any]", dataclass(init=False, repr=False, eq=False, slots=True, kw_only=True, match_args=False)(kind)
    )
    own = fields(made)
    compared = [each.name for each in own if each.compare]
    made.field_names = tuple(each.name for each in own)
    made.compared_values = attrgetter(*compared or ("__class__",))
    made.__signature__ = LazySignature(attrgetter("repr"))
    return made


class Record:
    """The base class of frozen objects with slots; classes derived from it have the decorator `record`.

    Objects are equal if they are of one class and their fields are, but for those with `compare=False`.
    """

    __slots__ = ("_census",)  # what `twinform.ir.rewrite` has found, once it was asked

    field_names: ClassVar[tuple[str, ...]]
    compared_values: "ClassVar[attrgetter[Any]]"

    def __init__(self, /, **values: Any) -> None:
        _adapter(type(self)).validator.validate_python(values, self_instance=self)

    @classmethod  # pyright: ignore[reportArgumentType] - a class is a callable that makes its objects
    def unchecked(cls: Callable[Values, AnyRecord], *_: Values.args, **values: Values.kwargs) -> AnyRecord:
        """An object of values that need no validation: they come from parts or trees that had it, or from our code.

        Raises:
            TypeError: there is no such field, or one is missing.
        """
        kind = cast("type[AnyRecord]", cls)
        make = _keyword_maker(kind)
        try:
            return make(**values)
        except TypeError:
            missing, unknown = required_fields(kind) - values.keys(), values.keys() - fields_of(kind).keys()
            what = f"lacks {', '.join(sorted(missing))}" if missing else f"has no field {', '.join(sorted(unknown))}"
            raise TypeError(f"{kind.__name__} {what}") from None

    def replace(self, **changes: Any) -> Self:
        """Return a copy of the object with other values, which are validated.

        Raises:
            ValidationError: there is no such field, or it does not take such a value.
        """
        return type(self)(**{name: getattr(self, name) for name in self.field_names} | changes)

    def copy(self, **changes: Any) -> Self:
        """Return a copy of the object with other values that need no validation.

        Raises:
            AttributeError: there is no such field.
        """
        kind = self.__class__
        made = _duplicator(kind)(self)
        for name, value in changes.items():
            setattr(made, name, value)
        made.__class__ = kind
        return made

    def __setattr__(self, name: str, value: object) -> None:
        raise FrozenInstanceError(f"cannot assign to field {name!r} of a {type(self).__name__}; use replace")

    def __delattr__(self, name: str) -> None:
        raise FrozenInstanceError(f"cannot delete field {name!r} of a {type(self).__name__}")

    def __eq__(self, other: object) -> bool:
        if self.__class__ is not other.__class__:
            return NotImplemented
        return self.compared_values(self) == self.compared_values(other)

    def __hash__(self) -> int:
        return hash((self.__class__, self.compared_values(self)))

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.__class__, *(getattr(self, name) for name in self.field_names))

    def __repr__(self) -> str:
        """What is written in it, on one line, without what is in the records inside it."""
        own = ((each, getattr(self, each.name)) for each in fields(self) if each.repr)  # pyright: ignore[reportArgumentType]
        shown = ", ".join(f"{each.name}={_brief(value)}" for each, value in own if value != each.default)
        return f"{type(self).__name__}({shown})"

    # under the names that Pydantic's models have

    @classmethod
    def model_validate(cls, obj: Any) -> Self:
        """The object that data make, such as those of `model_dump`; one of this class stays as it is."""
        return obj if isinstance(obj, cls) else _adapter(cls).validate_python(obj)

    @classmethod
    def model_validate_json(cls, json_data: str | bytes) -> Self:
        """The object that a text of JSON makes."""
        return _adapter(cls).validate_json(json_data)

    @classmethod
    def model_json_schema(cls) -> dict[str, Any]:
        """The JSON Schema of such objects."""
        return _adapter(cls).json_schema()

    def model_dump(self, **options: Any) -> dict[str, Any]:
        """The object as data; options are those of Pydantic."""
        return _adapter(type(self)).dump_python(self, **options)

    def model_dump_json(self, **options: Any) -> str:
        """The object as a text of JSON; options are those of Pydantic."""
        return _adapter(type(self)).dump_json(self, **options).decode()

    def model_copy(self, *, update: Mapping[str, Any] | None = None) -> Self:
        """A copy with other values, which are not validated; `replace` validates them."""
        return self.copy(**(update or {}))


def _brief(value: object) -> str:
    if isinstance(value, Record):
        name = getattr(value, "name", None)
        return f"{type(value).__name__}({repr(name) if isinstance(name, str) else '...'})"
    if isinstance(value, tuple) and value and isinstance(value[0], Record):
        parts = cast("tuple[Record, ...]", value)
        return f"<{len(parts)} {type(parts[0]).__name__}>"
    return cut(repr(cast("object", value)))


@cache
def fields_of(kind: type[Record]) -> Mapping[str, Field[Any]]:
    """The fields of a class of records, by their names."""
    return {each.name: each for each in fields(kind)}  # pyright: ignore[reportArgumentType]


@cache
def required_fields(kind: type[Record]) -> frozenset[str]:
    """The fields that every object of a class has to be given."""
    return frozenset(name for name, each in fields_of(kind).items() if each.default is MISSING)


def field_values(part: Record) -> dict[str, Any]:
    """The values of a record by their fields, but for those that take no part in equality."""
    return {name: getattr(part, name) for name in _compared_fields(part.__class__)}


def field_value(part: Record, name: str) -> Any:
    """The value of a field; None where the class has no field of this name."""
    return getattr(part, name) if name in part.field_names else None


@cache
def _compared_fields(kind: type[Record]) -> tuple[str, ...]:
    """The fields that take part in equality, in their order."""
    return tuple(name for name, each in fields_of(kind).items() if each.compare)


def maker(kind: type[AnyRecord]) -> Callable[[dict[str, Any]], AnyRecord]:
    """What makes objects of a class from values that need no validation and that are all there."""
    return _maker(kind)


@cache
def _maker(kind: type[Any]) -> Callable[[dict[str, Any]], Any]:
    fill: Callable[[Iterable[object]], Any] = filler(kind)
    defaults = {name: each.default for name, each in fields_of(kind).items()}

    def make(values: dict[str, Any]) -> Any:
        try:
            return fill((defaults | values).values())
        except ValueError:
            unknown = ", ".join(sorted(values.keys() - defaults.keys()))
            raise TypeError(f"{kind.__name__} has no field {unknown}") from None

    return make


@cache
def filler(kind: type[AnyRecord]) -> Callable[[Iterable[object]], AnyRecord]:
    """What makes objects of a class from values of all its fields, in their order, that need no validation."""
    # The unpacking makes a name too many an error that costs nothing.
    return _compiled(kind, "values", ["{}, = values".format(", ".join(f"_made.{name}" for name in kind.field_names))])


@cache
def _keyword_maker(kind: type[AnyRecord]) -> Callable[..., AnyRecord]:
    """What makes objects of a class from values by name, which for a few of them is quicker than from a dictionary."""
    required = required_fields(kind)
    optional = [f"{name}=_defaults[{name!r}]" for name in kind.field_names if name not in required]
    lines = [f"_made.{name} = {name}" for name in kind.field_names]
    return _compiled(kind, ", ".join([*sorted(required), *optional]), lines)


@cache
def _duplicator(kind: type[AnyRecord]) -> Callable[[AnyRecord], Any]:
    """What makes a draft with the values of another object."""
    return _compiled(kind, "other", [f"_made.{name} = other.{name}" for name in kind.field_names], is_draft=True)


def _restored(kind: type[AnyRecord], *values: object) -> AnyRecord:
    """The object that was pickled."""
    return filler(kind)(values)


@cache
def _draft(kind: type[Record]) -> type[Any]:
    """The class of objects that are being made.

    A frozen object could be filled by `object.__setattr__`, field by field, which takes three times as long. A draft
    has the same slots and is not frozen; it becomes the object by `__class__`. It has its own `__delattr__`, as both
    methods share one slot of the type: with either of them in Python, each store would take the slow way.
    """
    if "__slots__" not in vars(kind):
        raise TypeError(f"{kind.__name__} needs the decorator `record`")
    writable = {"__setattr__": object.__setattr__, "__delattr__": object.__delattr__}
    return type(kind.__name__, kind.__bases__, {"__slots__": vars(kind)["__slots__"], **writable})


def _compiled(
    kind: type[Record], parameters: str, lines: Iterable[str], *, is_draft: bool = False
) -> Callable[..., Any]:
    """Compile a function that makes objects of a class; for each class this is done when it is first needed."""
    defaults = {name: each.default for name, each in fields_of(kind).items()}
    scope: dict[str, Any] = {"_new": partial(object.__new__, _draft(kind)), "_kind": kind, "_defaults": defaults}
    last = [] if is_draft else ["_made.__class__ = _kind"]
    body = "\n    ".join(["_made = _new()", "_made._census = None", *lines, *last, "return _made"])
    exec(f"def make({parameters}):\n    {body}", scope)  # noqa: S102 - our field names, as in namedtuple
    return scope["make"]


def amend(part: Record, name: str, value: object) -> None:
    """Write a value into an object that was just made and that nobody else has seen: others are frozen."""
    object.__setattr__(part, name, value)
    object.__setattr__(part, "_census", None)


@cache
def _adapter(kind: type[AnyRecord]) -> "TypeAdapter[AnyRecord]":
    from pydantic import TypeAdapter  # noqa: PLC0415 - see the docstring of the module

    return TypeAdapter(kind)


class Constraint:
    """Arguments for `pydantic.Field`: a discriminator, a pattern, or the length of a tuple."""

    def __init__(self, **options: Any) -> None:
        self._options = options

    def __repr__(self) -> str:
        return f"Constraint({', '.join(f'{name}={value!r}' for name, value in self._options.items())})"

    def __get_pydantic_core_schema__(self, source: Any, handler: "GetCoreSchemaHandler") -> "CoreSchema":
        import pydantic  # noqa: PLC0415 - only Pydantic calls this

        return handler.generate_schema(Annotated[source, pydantic.Field(**self._options)])


class Unseen:
    """Marks a field that exists in Python alone: an instance of its type, which JSON and its schema leave out."""

    def __repr__(self) -> str:
        return "Unseen()"

    def __get_pydantic_core_schema__(self, source: Any, handler: "GetCoreSchemaHandler") -> "CoreSchema":
        from pydantic_core import core_schema  # noqa: PLC0415 - only Pydantic calls this

        return core_schema.json_or_python_schema(core_schema.none_schema(), core_schema.is_instance_schema(source))

    def __get_pydantic_json_schema__(self, schema: "CoreSchema", handler: "GetJsonSchemaHandler") -> "JsonSchemaValue":
        from pydantic_core import PydanticOmit  # noqa: PLC0415 - only Pydantic calls this

        raise PydanticOmit


class OneOf:
    """Exactly one of several fields of a part has to be there."""

    def __init__(self, *names: str) -> None:
        self._names = names

    def __repr__(self) -> str:
        return f"OneOf({', '.join(map(repr, self._names))})"

    def __get_pydantic_core_schema__(self, source: Any, handler: "GetCoreSchemaHandler") -> "CoreSchema":
        from pydantic_core import core_schema  # noqa: PLC0415 - only Pydantic calls this

        return core_schema.no_info_after_validator_function(self._require_one, handler(source))

    def _require_one(self, part: Any) -> Any:
        from pydantic_core import PydanticCustomError  # noqa: PLC0415 - see above

        count = sum(getattr(part, name) is not None for name in self._names)
        if count != 1:
            told = {"count": count, "names": " or ".join(self._names)}
            raise PydanticCustomError("one_of", "has {count} of {names}; expected one", told)
        return part


@record
class Sourced(Record):
    """A frozen part of a document.

    Attributes:
        source: the place it was read from; it takes no part in equality or in JSON.
    """

    __pydantic_config__: ClassVar[dict[str, str]] = {"extra": "forbid", "ser_json_inf_nan": "strings"}

    source: Annotated[Source | None, Unseen()] = field(
        default=None, repr=False, compare=False, metadata={"exclude": True}
    )

    @property
    def location(self) -> Location:
        """The place where it was read; unknown for what a pass made."""
        return self.source.location if self.source else NOWHERE
