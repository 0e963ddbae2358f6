"""Parts that only URDF knows go into carriers."""

from typing import ClassVar, TypeVar

from twinform.diagnostics import Fate, Notes
from twinform.diagnostics.rules import to_sdf
from twinform.ir import Model, Node, Opaque, Pose, map_children
from twinform.passes.legalise.carrier import carry, is_carrier, unpack
from twinform.passes.legalise.model_pass import ModelPass
from twinform.passes.legalise.sdf_versions.carriers import is_version_carrier

AnyNode = TypeVar("AnyNode", bound=Node)


class CarryUrdf(ModelPass):
    """Put every opaque part of a URDF model into a carrier where it stands, and unpack those that SDF left here.

    Changes: 1. opaque elements, attributes and text of URDF (transmissions, ros2_control, other tools' elements) become
    carriers; 2. parts of an origin, which is a plain text in SDF, are carried by what has the origin; 3. carriers of
    SDF become opaque parts of SDF again. With `carriers` false, the parts of the first two are dropped.
    Never touches: typed fields; carriers between versions of SDF.
    Diagnostics: none; every part has a ledger entry under `urdf-only`.
    """

    name: ClassVar[str] = "carry-urdf"
    carriers: bool = True

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model without opaque parts of URDF."""
        return self._sweep(model, notes)

    def _sweep(self, node: AnyNode, notes: Notes) -> AnyNode:
        node = map_children(node, lambda child: self._sweep(child, notes))
        pose: Pose | None = node.__dict__.get("pose")
        if not node.opaque and not (pose and pose.opaque):
            return node
        update: dict[str, object] = {"opaque": ()}
        stays = [part for part in node.opaque if is_version_carrier(part)]
        pieces = [part for part in node.opaque if not is_carrier(part, "sdf") and part not in stays]
        unpacked = [piece for part in node.opaque if is_carrier(part, "sdf") for piece in unpack(part)]
        update["opaque"] = (*unpacked, *stays)
        if pose and pose.opaque:
            pieces += [_inside("origin", part) for part in pose.opaque]
            update["pose"] = pose.model_copy(update={"opaque": ()})
        return self._carry(node.model_copy(update=update), pieces, notes) if not isinstance(node, Pose) else node

    def _carry(self, node: AnyNode, pieces: list[Opaque], notes: Notes) -> AnyNode:
        fate = Fate.CARRIED if self.carriers else Fate.DROPPED
        for piece in pieces:
            message = f"{piece.name} is not a part of SDF"
            notes.account(fate, to_sdf.URDF_ONLY, message, piece.location, max(1, piece.weight))
        return carry(node, pieces, "urdf") if self.carriers else node


def _inside(step: str, part: Opaque) -> Opaque:
    return part.model_copy(update={"at": f"{step}/{part.at}" if part.at else step})
