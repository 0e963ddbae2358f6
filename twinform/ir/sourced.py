"""`Sourced`, the base class of parts of a document, and what Pydantic is told about fields beside their types."""

from dataclasses import field
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from twinform.diagnostics import NOWHERE, Location, Source
from twinform.ir.record import Record, record

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
    from pydantic.json_schema import JsonSchemaValue
    from pydantic_core import CoreSchema


class Constraint:
    """Arguments for `pydantic.Field`: a discriminator, a pattern, or the length of a tuple."""

    def __init__(self, **options: Any) -> None:
        self._options = options

    def __repr__(self) -> str:
        return f"Constraint({', '.join(f'{name}={value!r}' for name, value in self._options.items())})"

    def __get_pydantic_core_schema__(self, source: Any, handler: "GetCoreSchemaHandler") -> "CoreSchema":
        from pydantic import Field  # noqa: PLC0415 - only Pydantic calls this

        return handler.generate_schema(Annotated[source, Field(**self._options)])


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
