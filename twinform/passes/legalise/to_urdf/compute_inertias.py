"""Computing automatic inertias of SDF, which URDF has to have written."""

from functools import partial
from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Inertial, Link, Model
from twinform.ir.frames import FrameGraph
from twinform.passes.framework.pass_base import AssetPass
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.link_shapes import COMPUTED_MASS, NoSolidError, automatic, map_automatic, written_out
from twinform.passes.shared.mesh_solids import Meshes


class ComputeInertias(ToUrdfPass, AssetPass):
    """Write the inertia that a reader of SDF would compute (`<inertial auto="true">`).

    Changes: mass, pose and inertia of such a link are those of its collisions, filled with their densities; a mass that
    is written stays. That they were computed travels in a carrier, and so do a pose and an inertia that were written,
    which readers of SDF overlook.
    Diagnostics: `automatic-inertia` for a link without collisions, and for shapes without an inside, such as planes and
    meshes that are open or not found; in the ledger `computed-inertia`.
    """

    name: ClassVar[str] = "compute-inertias"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with every inertia written out."""
        return map_automatic(model, partial(_compute_inertia, keeper, Meshes(self._assets)))


def _compute_inertia(keeper: UrdfKeeper, meshes: Meshes, link: Link, inertial: Inertial, graph: FrameGraph) -> Link:
    try:
        found = automatic(link, inertial, link.collisions, graph, meshes)
    except NoSolidError as error:
        keeper.sink.report(rules.AUTOMATIC_INERTIA, str(error), error.location, help=error.help)
        return link
    written, pieces, computed = written_out(inertial, found)
    if "mass" in computed:
        written = keeper.annotate(written, COMPUTED_MASS, always=True)
    message = f"the inertia of link {link.name!r} is computed from its collisions"
    kept = keeper.keep(written, pieces, rules.COMPUTED_INERTIA, message, inertial.location)
    return link.copy(inertial=kept)
