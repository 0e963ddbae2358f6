"""`FieldSignature`: the parameters of a class of parts, for `help`, notebooks and editors that ask a running Python."""

from collections.abc import Iterator
from inspect import Parameter, Signature
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pydantic import BaseModel


class FieldSignature:
    """The signature of the class that it is read from: its fields, in their order.

    Pydantic knows it when it has built a class, which ours put off until they have to validate something.
    """

    def __get__(self, instance: "BaseModel | None", owner: "type[BaseModel]") -> Signature:
        if instance is not None:
            raise AttributeError("__signature__")
        return Signature([*_parameters(owner)])


def _parameters(kind: "type[BaseModel]") -> Iterator[Parameter]:
    """What people write; where a part was read from, nobody does."""
    for name, field in kind.model_fields.items():
        if not field.exclude:
            default = Parameter.empty if field.is_required() else field.get_default(call_default_factory=True)
            yield Parameter(name, Parameter.KEYWORD_ONLY, default=default, annotation=field.annotation)
