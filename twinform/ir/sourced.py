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
    """Arguments for `pydantic.Field`: a discriminator, or the length of a tuple."""

    def __init__(self, **options: Any) -> None:
        self._options = options

    def __repr__(self) -> str:
        return f"Constraint({', '.join(f'{name}={value!r}' for name, value in self._options.items())})"

    def __get_pydantic_core_schema__(self, source: Any, handler: "GetCoreSchemaHandler") -> "CoreSchema":
        from pydantic import Field  # noqa: PLC0415 - only Pydantic calls this

        return handler.generate_schema(Annotated[source, Field(**self._options)])


class Unseen:
    """Marks a field that exists in Python alone: any value is accepted, and JSON and its schema leave it out."""

    def __repr__(self) -> str:
        return "Unseen()"

    def __get_pydantic_core_schema__(self, source: Any, handler: "GetCoreSchemaHandler") -> "CoreSchema":
        from pydantic_core import core_schema  # noqa: PLC0415 - only Pydantic calls this

        return core_schema.json_or_python_schema(core_schema.none_schema(), core_schema.any_schema())

    def __get_pydantic_json_schema__(self, schema: "CoreSchema", handler: "GetJsonSchemaHandler") -> "JsonSchemaValue":
        from pydantic_core import PydanticOmit  # noqa: PLC0415 - only Pydantic calls this

        raise PydanticOmit


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
