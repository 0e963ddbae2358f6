"""Moving parts that only URDF has into carriers."""

from collections.abc import Container, Iterator
from functools import cache
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import (
    OPAQUE,
    Collision,
    Format,
    GazeboExtension,
    Inertial,
    Joint,
    Link,
    Model,
    Node,
    Opaque,
    Pose,
    Visual,
    bits_of,
    rewrite,
)
from twinform.ir.foreign_joints import closes_loop
from twinform.passes.carriers.annotations import came_from
from twinform.passes.carriers.carriers import DANGLING, Keeper, carry, is_carrier, is_ours, unpack
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.urdf_pieces import BALLS, OF_AN_AXIS, joints_of
from twinform.schemas import Fact, table

AnyNode = TypeVar("AnyNode", bound=Node)

_IN_BOTH = (Model, Link, Joint, Visual, Collision, Inertial)
"""Nodes that are an element in both formats, in which other tools' parts stand as they are."""


class CarryUrdf(ModelPass):
    """Put every opaque part of a URDF model into a carrier where it stands, and unpack those that SDF left here.

    Changes: 1. opaque elements, attributes and text of URDF (transmissions, ros2_control, other tools' elements) become
    carriers; 2. parts of an origin, which is a plain text in SDF, are carried by what has the origin; 3. carriers of
    SDF that add to what the model has become parts of it again; the others stay, for nothing may be stated twice; 4.
    what Bullet calls `spherical` and Drake `ball` is a `ball` that carries this name. With `carriers` false, none of
    these parts is carried.
    Never touches: typed fields.
    Diagnostics: none; every part has a ledger entry under `urdf-only`.
    """

    name: ClassVar[str] = "carry-urdf"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model without opaque parts of URDF."""
        joints = frozenset(joint.name for joint in model.joints)
        back = came_from(model, Format.SDF)
        # Only nodes with something to sweep are rewritten; in a plain robot that is none.
        having = OPAQUE | (bits_of(Joint) if any(joint.type in BALLS for joint in model.joints) else 0)
        swept = rewrite(model, Node, lambda node: self._sweep(node, sink, back), having=having)
        return swept.copy(opaque=tuple(_with_doubt(part, joints) for part in swept.opaque))

    def _sweep(self, node: Node, sink: DiagnosticSink, back: bool) -> Node:
        if isinstance(node, GazeboExtension):  # the next pass knows what may stand in it
            return node
        if isinstance(node, Joint) and node.type in BALLS:
            message = f"{node.type} joint {node.name!r} has a type that only dialects of URDF have"
            # Bullet's `spherical` and Drake's `ball` are ball joints of SDF. The name of the type
            # travels along, so the conversion back makes no chain of it.
            kept = [Opaque.unchecked(attribute=("type", node.type))]
            ball = self._swept(node.copy(type="ball"), sink, back)
            return self._carry(ball, kept, sink, message)
        return self._swept(node, sink, back)

    def _swept(self, node: AnyNode, sink: DiagnosticSink, back: bool) -> AnyNode:
        """The node with its own parts in carriers, or out of them."""
        pose: Pose | None = getattr(node, "pose", None)
        if not node.opaque and not (pose and pose.opaque):
            return node
        kept: list[Opaque] = []
        pieces: list[Opaque] = []
        for part in node.opaque:
            if is_ours(part):
                kept += _unpacked(part)
            elif closes_loop(part):  # as for <gazebo>: a later pass knows what it is
                kept.append(part)
            else:  # other tools' parts stood in the SDF file as they do here
                (kept if back and isinstance(node, _IN_BOTH) and _is_foreign(part) else pieces).append(part)
        update: dict[str, object] = {"opaque": tuple(kept)}
        if pose and pose.opaque:
            pieces += [_inside("origin", part) for part in pose.opaque]
            update["pose"] = pose.copy(opaque=())
        return self._carry(node.copy(**update), pieces, sink) if not isinstance(node, Pose) else node

    def _carry(self, node: AnyNode, pieces: list[Opaque], sink: DiagnosticSink, message: str = "") -> AnyNode:
        keeper = Keeper(sink, self.carriers)
        for piece in pieces:
            why = message or f"{piece.name} is not a part of SDF"
            where = piece.location if piece.source else node.location
            keeper.account(rules.URDF_ONLY, why, where, max(1, piece.weight))
        if not self.carriers:
            return node
        once = OF_AN_AXIS if isinstance(node, Joint) else ()  # a second one means nothing, and no edit has made it so
        first, again = list[Opaque](), list[Opaque]()
        for piece in pieces:
            (again if piece.element and piece.element.name in once else first).append(piece)
        return carry(carry(node, first, "urdf"), again, "urdf", DANGLING)


def _is_foreign(part: Opaque) -> bool:
    name = part.element.name if part.element else part.attribute[0] if part.attribute else ""
    return not part.at and name.startswith("{")


def _with_doubt(part: Opaque, joints: Container[str]) -> Opaque:
    """A carrier that states it, if what it holds is about a joint that the robot never had."""
    if not is_carrier(part, "urdf") or part.element is None or not part.element.children:
        return part
    named = [name for piece in unpack(part) if piece.element for name in joints_of(piece.element)]
    if all(name in joints for name in named):
        return part
    element = part.element.copy(attributes=(*DANGLING, *part.element.attributes))
    return part.copy(element=element)


def _unpacked(part: Opaque) -> tuple[Opaque, ...]:
    """What is in a carrier of SDF, if the model does not say it already in elements of its own; else the carrier."""
    pieces = unpack(part) if is_carrier(part, "sdf") and part.element and part.element.get("index") is None else ()
    # A carrier whose element the model may have by now in a field waits for `unpack-sdf`: nothing
    # may be stated twice.
    fit = all(piece.element and not piece.at and piece.element.name not in _typed_in_sdf() for piece in pieces)
    return pieces if pieces and fit else (part,)


@cache
def _typed_in_sdf() -> frozenset[str]:
    """Elements that a typed field of the IR stands for, which `unpack-sdf` puts back where nothing else is written."""
    definitions = table("sdf").definitions.values()
    placed = {row.name for definition in definitions for row in _rows(definition) if row.place}
    return frozenset(placed)


def _rows(fact: Fact) -> Iterator[Fact]:
    for row in fact.rows:
        yield row
        yield from _rows(row)


def _inside(step: str, part: Opaque) -> Opaque:
    return part.copy(at=f"{step}/{part.at}" if part.at else step)
