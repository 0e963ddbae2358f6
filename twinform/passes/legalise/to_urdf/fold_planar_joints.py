"""A chain that came from a planar joint of URDF becomes one again."""

from typing import ClassVar

from twinform.diagnostics.rules import to_urdf as rules
from twinform.ir import Joint, Link, Model, Opaque
from twinform.passes.legalise.carrier import is_carrier, unpack
from twinform.passes.legalise.to_urdf.base import ToUrdfPass
from twinform.passes.legalise.to_urdf.keeper import Keeper, made_fields


class FoldPlanarJoints(ToUrdfPass):
    """Put planar joints of URDF, which are three joints and two links in SDF, together again.

    Changes: 1. the joint that was called so is planar, and has the parent and the place of the first one of its chain;
    2. the other two joints and the links between them go.
    Never touches: chains that were edited since, and those that did not come from a planar joint.
    Diagnostics: `stale-carrier`.
    """

    name: ClassVar[str] = "fold-planar-joints"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model with planar joints."""
        marked = [joint for joint in model.joints if any(_is_mark(part) for part in joint.opaque)]
        if not marked:
            return model
        above = {joint.child: joint for joint in model.joints}
        links = {link.name: link for link in model.links}
        folded: dict[str, Joint] = {}
        gone: set[str] = set()
        for joint in marked:
            chain = _chain(joint, above, links)
            if chain is None:
                message = f"joint {joint.name!r} was planar, and the joints that it became have changed since"
                keeper.notes.report(rules.STALE_CARRIER, message, joint.location, found=joint.name)
            else:
                first, second = chain
                folded[joint.name] = _planar(joint, first)
                gone |= {first.name, second.name, first.child or "", second.child or ""}
        joints = tuple(folded.get(joint.name, joint) for joint in model.joints if joint.name not in gone)
        return model.model_copy(
            update={"joints": joints, "links": tuple(link for link in model.links if link.name not in gone)}
        )


def _is_mark(part: Opaque) -> bool:
    return is_carrier(part, "urdf") and any(piece.attribute == ("type", "planar") for piece in unpack(part))


def _chain(joint: Joint, above: dict[str | None, Joint], links: dict[str, Link]) -> tuple[Joint, Joint] | None:
    """The two sliding joints above, if the chain is still what it was made."""
    second = above.get(joint.parent)
    first = above.get(second.parent) if second else None
    if first is None or second is None or joint.type not in {"continuous", "revolute"}:
        return None
    between = [links.get(first.child or ""), links.get(second.child or "")]
    made = [part is not None and "." in made_fields(part) for part in (first, second, *between)]
    return (first, second) if all(made) and {first.type, second.type} == {"prismatic"} else None


def _planar(joint: Joint, first: Joint) -> Joint:
    opaque = tuple(part for part in joint.opaque if not _is_mark(part))
    return joint.model_copy(update={"type": "planar", "parent": first.parent, "pose": first.pose, "opaque": opaque})
