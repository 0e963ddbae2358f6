"""`Sourced`: the base class of parts of a document."""

from dataclasses import field
from typing import Annotated, ClassVar

from twinform.diagnostics import NOWHERE, Location, Source
from twinform.ir.annotations import Unseen
from twinform.ir.record import Record, record


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
        """Where it was read; nowhere for what a pass made."""
        return self.source.location if self.source else NOWHERE
