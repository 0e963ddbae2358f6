"""Inertias that SDF leaves to its reader, URDF has to be told."""

from typing import ClassVar

from twinform.diagnostics.rules import to_urdf as rules
from twinform.ir import Inertia, Inertial, Link, Model, Opaque, Pose
from twinform.ir.frames import FrameGraph
from twinform.ir.solids import Solid
from twinform.passes.legalise.automatic_inertias import NoInertiaError, automatic
from twinform.passes.legalise.carrier import to_element
from twinform.passes.legalise.marks import mark_made
from twinform.passes.legalise.to_urdf.base import ToUrdfPass
from twinform.passes.legalise.to_urdf.keeper import Keeper


class ComputeInertias(ToUrdfPass):
    """Write the inertia that a reader of SDF would compute (`<inertial auto="true">`).

    Changes: mass, pose and inertia of such a link are those of its collisions, filled with their densities; a mass that
    is written stays. That they were computed travels in a carrier, and so do a pose and an inertia that were written,
    which readers of SDF overlook.
    Diagnostics: `automatic-inertia` for a link without collisions, and for shapes without an inside, such as planes and
    meshes; in the ledger `computed-inertia`.
    """

    name: ClassVar[str] = "compute-inertias"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model with every inertia written out."""
        if not any(link.inertial and link.inertial.auto for link in model.links):
            return model
        graph = FrameGraph(model)
        return model.model_copy(update={"links": tuple(_compute(link, graph, keeper) for link in model.links)})


def _compute(link: Link, graph: FrameGraph, keeper: Keeper) -> Link:
    inertial = link.inertial
    if inertial is None or not inertial.auto:
        return link
    try:
        found = automatic(link, inertial, link.collisions, graph)
    except NoInertiaError as error:
        keeper.notes.report(rules.AUTOMATIC_INERTIA, str(error), error.location)
        return link
    return link.model_copy(update={"inertial": _written(link.name, inertial, found, keeper)})


def _written(name: str, inertial: Inertial, found: Solid, keeper: Keeper) -> Inertial:
    overlooked = inertial.model_copy(update={"mass": None, "opaque": ()})
    whole = to_element(overlooked, "inertial", "sdf")
    pieces = [*(Opaque(attribute=pair) for pair in whole.attributes), *(Opaque(element=one) for one in whole.children)]
    made = ("pose", "inertia") if inertial.mass is not None else ("mass", "pose", "inertia")
    xx, yy, zz, xy, xz, yz = found.inertia
    update = {
        "auto": None,
        "mass": found.mass,
        "pose": Pose(xyz=found.centre) if any(found.centre) else None,
        "inertia": Inertia(ixx=xx, ixy=xy, ixz=xz, iyy=yy, iyz=yz, izz=zz),
    }
    written = mark_made(inertial.model_copy(update=update), *made)
    message = f"the inertia of link {name!r} is computed from its collisions"
    return keeper.keep(written, pieces, rules.COMPUTED_INERTIA, message, inertial.location)
