"""Parts that only URDF knows go into carriers."""

from collections.abc import Iterator
from functools import cache
from typing import ClassVar, TypeVar

from twinform.diagnostics import Fate, Notes
from twinform.diagnostics.rules import to_sdf
from twinform.ir import GazeboExtension, Joint, Model, Node, Opaque, Pose, map_children
from twinform.passes.legalise.carrier import carry, is_carrier, is_ours, unpack
from twinform.passes.legalise.joint_chains import is_chain_mark
from twinform.passes.legalise.model_pass import ModelPass
from twinform.passes.legalise.to_sdf.unpack_sdf import is_looked_into
from twinform.schemas import Fact, table

AnyNode = TypeVar("AnyNode", bound=Node)

_BALLS = frozenset({"ball", "spherical"})
"""What dialects of URDF call the ball joint of SDF."""


class CarryUrdf(ModelPass):
    """Put every opaque part of a URDF model into a carrier where it stands, and unpack those that SDF left here.

    Changes: 1. opaque elements, attributes and text of URDF (transmissions, ros2_control, other tools' elements) become
    carriers; 2. parts of an origin, which is a plain text in SDF, are carried by what has the origin; 3. carriers of
    SDF that add to what the model says become parts of it again; the others stay, for nothing may be said twice; 4.
    what Bullet calls `spherical` and Drake `ball` is a `ball` that carries this name. With `carriers` false, none of
    these parts is carried.
    Never touches: typed fields.
    Diagnostics: none; every part has a ledger entry under `urdf-only`.
    """

    name: ClassVar[str] = "carry-urdf"
    carriers: bool = True

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model without opaque parts of URDF."""
        return self._sweep(model, notes)

    def _sweep(self, node: AnyNode, notes: Notes) -> AnyNode:
        if isinstance(node, GazeboExtension):  # the next pass knows what may stand in it
            return node
        node = map_children(node, lambda child: self._sweep(child, notes))
        if isinstance(node, Joint) and node.type in _BALLS:
            message = f"{node.type} joint {node.name!r} is one of a dialect of URDF"
            kept = [Opaque(attribute=("type", node.type))]
            ball = self._swept(node.model_copy(update={"type": "ball"}), notes)
            return self._carry(ball, kept, notes, message)
        return self._swept(node, notes)

    def _swept(self, node: AnyNode, notes: Notes) -> AnyNode:
        """The node with its own parts in carriers, or out of them."""
        pose: Pose | None = node.__dict__.get("pose")
        if not node.opaque and not (pose and pose.opaque):
            return node
        pieces = [part for part in node.opaque if not is_ours(part)]
        ours = [piece for part in node.opaque if is_ours(part) for piece in _unpacked(part)]
        update: dict[str, object] = {"opaque": tuple(piece for piece in ours if self._keeps(piece, node))}
        if pose and pose.opaque:
            pieces += [_inside("origin", part) for part in pose.opaque]
            update["pose"] = pose.model_copy(update={"opaque": ()})
        return self._carry(node.model_copy(update=update), pieces, notes) if not isinstance(node, Pose) else node

    def _keeps(self, part: Opaque, node: Node) -> bool:
        if self.carriers or not is_ours(part):
            return True
        later = is_carrier(part, "sdf") and is_looked_into(node)  # by `unpack-sdf`
        return later or is_chain_mark(part)  # which goes where the chain is folded

    def _carry(self, node: AnyNode, pieces: list[Opaque], notes: Notes, message: str = "") -> AnyNode:
        fate = Fate.CARRIED if self.carriers else Fate.DROPPED
        for piece in pieces:
            why = message or f"{piece.name} is not a part of SDF"
            where = piece.location if piece.source else node.location
            notes.account(fate, to_sdf.URDF_ONLY, why, where, max(1, piece.weight))
        return carry(node, pieces, "urdf") if self.carriers else node


def _unpacked(part: Opaque) -> tuple[Opaque, ...]:
    """What is in a carrier of SDF, if the model does not say it already in words of its own; else the carrier."""
    pieces = unpack(part) if is_carrier(part, "sdf") else ()
    fit = all(piece.element and piece.element.name not in _typed_in_sdf() for piece in pieces)
    return pieces if pieces and fit else (part,)


@cache
def _typed_in_sdf() -> frozenset[str]:
    """Elements that a typed field of the IR stands for; whole shapes are listed there beside what URDF could say."""
    definitions = table("sdf").definitions.values()
    placed = {row.name for definition in definitions for row in _rows(definition) if row.place}
    return frozenset(placed - {"visual", "collision"})


def _rows(fact: Fact) -> Iterator[Fact]:
    for row in fact.rows:
        yield row
        yield from _rows(row)


def _inside(step: str, part: Opaque) -> Opaque:
    return part.model_copy(update={"at": f"{step}/{part.at}" if part.at else step})
