"""What a pass does with parts that URDF cannot say: into a carrier and the ledger, or only the ledger."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeVar

from twinform.diagnostics import Fate, Location, Notes, Rule
from twinform.ir import Node, Opaque
from twinform.passes.legalise.carrier import NAMESPACE, carry
from twinform.schemas import Version

AnyNode = TypeVar("AnyNode", bound=Node)

MADE = f"{{{NAMESPACE}}}made"
"""The attribute that lists the fields of a node that were not in the SDF file; `.` is the whole node."""


@dataclass(frozen=True, slots=True)
class Keeper:
    """Where the parts go in one run; `version` is that of the SDF file."""

    notes: Notes
    carriers: bool
    version: Version

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


def mark_made(node: AnyNode, *fields: str) -> AnyNode:
    """The node with a mark on the fields that a pass has made up, so that the way back can leave them out again."""
    if "." in made_fields(node):
        return node
    rest = tuple(part for part in node.opaque if not _is_mark(part))
    words = " ".join(dict.fromkeys((*made_fields(node), *fields)))
    return node.model_copy(update={"opaque": (Opaque(attribute=(MADE, words)), *rest)}) if words else node


def made_fields(node: Node) -> tuple[str, ...]:
    """The fields that a pass has made up."""
    found = (part.attribute[1] for part in node.opaque if part.attribute is not None and _is_mark(part))
    return tuple(" ".join(found).split())


def _is_mark(part: Opaque) -> bool:
    return part.attribute is not None and part.attribute[0] == MADE
