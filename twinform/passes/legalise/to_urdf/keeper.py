"""What a pass does with parts that URDF cannot say: into a carrier and the ledger, or only the ledger."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeVar

from twinform.diagnostics import Fate, Location, Notes, Rule
from twinform.ir import Node, Opaque
from twinform.passes.legalise.carrier import carry
from twinform.passes.legalise.marks import MADE, made_fields, mark_made

__all__ = ["MADE", "Keeper", "made_fields", "mark_made"]

AnyNode = TypeVar("AnyNode", bound=Node)


@dataclass(frozen=True, slots=True)
class Keeper:
    """Where the parts go in one run."""

    notes: Notes
    carriers: bool

    def keep(
        self,
        node: AnyNode,
        pieces: Iterable[Opaque],
        rule: Rule,
        message: str,
        location: Location,
        weight: int | None = None,
    ) -> AnyNode:
        """The node with the pieces in carriers, and an entry in the ledger; the weight is the pieces' by default."""
        listed = tuple(pieces)
        if not listed:
            return node
        fate = Fate.CARRIED if self.carriers else Fate.DROPPED
        total = sum(piece.weight for piece in listed) if weight is None else weight
        self.notes.account(fate, rule, message, location, total)
        return carry(node, listed, "sdf") if self.carriers else node
