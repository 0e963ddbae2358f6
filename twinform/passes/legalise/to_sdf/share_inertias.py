"""Inertias of links that Gazebo asks for in SDF, and puts together with others where it reads URDF."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Format, Link, Model
from twinform.ir.principal_moments import Symmetric
from twinform.ir.solids import ELEMENTS
from twinform.passes.carriers.provenance import came_from
from twinform.passes.carriers.shared_inertia import with_share
from twinform.passes.framework.base import ModelPass
from twinform.passes.legalise.shared_inertias import shared_inertias


class ShareInertias(ModelPass):
    """Make inertias possible that no body has, with what links have that are fixed to theirs.

    Changes: the inertia of a link that libsdformat would refuse in SDF, and takes in URDF, where fixed links are one
    body, becomes the nearest that a body can have; another link of that body has as much less, so that the body has the
    inertia that it had.
    Never touches: a body that is impossible as a whole; an inertia that no other link can make up for.
    Diagnostics: `shared-inertia`; the ledger has each link. The old inertia is carried.
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

    def _shared(self, link: Link, found: dict[str, Symmetric], sink: DiagnosticSink) -> Link:
        if link.inertial is None or link.name not in found:
            return link
        message = f"link {link.name!r} has another inertia in SDF, and with the links that are fixed to it the same"
        sink.report(rules.SHARED_INERTIA, message, link.inertial.location, found=link.name)
        sink.account(
            Fate.APPROXIMATED, rules.SHARED_INERTIA, message, link.inertial.location.at("inertia"), len(ELEMENTS)
        )
        return link.model_copy(
            update={"inertial": with_share(link.inertial, found[link.name], annotated=self.carriers)}
        )
