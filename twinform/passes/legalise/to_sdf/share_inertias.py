"""Inertias of links that Gazebo asks for in SDF, and puts together with others where it reads URDF."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Format, Link, Model
from twinform.ir.solids import ELEMENTS, Solid
from twinform.passes.carriers.provenance import came_from
from twinform.passes.carriers.shared_inertia import with_share
from twinform.passes.framework.base import ModelPass
from twinform.passes.legalise.shared_inertias import shared_inertias
from twinform.passes.structure.bodies import with_solid


class ShareInertias(ModelPass):
    """Make inertias possible that no body has, with what links have that are fixed to theirs.

    Changes: a link with an inertia that libsdformat would refuse in SDF, and takes in URDF, where fixed links are one
    body, and as many others of that body as it takes. Each keeps its mass, at the center of them all, and has as much
    of the inertia that they have together as it has of their mass, so that the body is what it was.
    Never touches: a body that is impossible as a whole.
    Diagnostics: `shared-inertia`; the ledger has each link. The old center and inertia are carried.
    """

    name: ClassVar[str] = "share-inertias"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with inertias that libsdformat takes."""
        if came_from(model, Format.SDF):
            return model
        found = shared_inertias(model)
        if not found:
            return model
        return model.model_copy(update={"links": tuple(self._shared(link, found, sink) for link in model.links)})

    def _shared(self, link: Link, found: dict[str, Solid], sink: DiagnosticSink) -> Link:
        if link.inertial is None or link.name not in found:
            return link
        message = (
            f"link {link.name!r} has another center of mass and inertia in SDF, "
            "and with the links that are fixed to it the same"
        )
        sink.report(rules.SHARED_INERTIA, message, link.inertial.location, found=link.name)
        where, pose = link.inertial.location, link.inertial.pose
        sink.account(Fate.APPROXIMATED, rules.SHARED_INERTIA, message, where.at("inertia"), len(ELEMENTS))
        if pose and pose.xyz:
            sink.account(Fate.APPROXIMATED, rules.SHARED_INERTIA, message, where.at("origin/@xyz"))
        made = with_solid(link.inertial, found[link.name])
        return link.model_copy(update={"inertial": with_share(made, link.inertial) if self.carriers else made})
