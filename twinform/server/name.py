"""A name at its place in a text."""

from collections.abc import Mapping
from dataclasses import dataclass

from twinform.diagnostics import Span
from twinform.passes.structure.rename_parts import LOOKUP_ORDER
from twinform.server.tolerant_tree import TolerantNode


@dataclass(frozen=True, slots=True)
class Name:
    """A name at its place: where something is called so, or where something refers to it.

    `kind` is what has the name, such as `link`, or for a reference what kinds may have it. `scope` is the model in
    which it counts; None in a format, or for a kind, that has one scope alone.
    """

    text: str
    span: Span
    node: TolerantNode
    kind: str
    defines: bool
    scope: TolerantNode | None = None

    @property
    def kinds(self) -> tuple[str, ...]:
        """The kinds that it may be of."""
        if self.defines or self.kind == "material":
            return (self.kind,)
        orders: Mapping[str, tuple[str, ...]] = {**LOOKUP_ORDER}
        return orders.get(self.kind, (self.kind,))
