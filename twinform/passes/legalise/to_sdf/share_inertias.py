"""Inertias of links that Gazebo asks for in SDF, and puts together with others where it reads URDF."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Format, Link, Model, Pose
from twinform.ir.solids import ELEMENTS, ORIGIN, Solid
from twinform.passes.carriers.annotations import came_from
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.shared_inertias import shared_inertias, with_share
from twinform.passes.shared.link_shapes import write_solid


class ShareInertias(ModelPass):
    """Make inertias possible that no body has, with what links have that are fixed to theirs.

    Changes: 1. the inertia of a link that libsdformat would refuse in SDF, and takes in URDF, where fixed links are one
    body, becomes the nearest that a body can have; another link of that body has as much less. 2. Where no other has
    enough, the link and as many others as it takes keep their masses, at the center of them all, and each has as much
    of the inertia that they have together as it has of their mass. The body is what it was.
    Never touches: a body that is impossible as a whole.
    Diagnostics: `shared-inertia`; the ledger has each link. The old center and inertia are carried.
    """

    name: ClassVar[str] = "share-inertias"
    carriers: bool = True

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with inertias that libsdformat takes."""
        # Such a URDF was never refused as SDF, and an edit that made an inertia impossible stands
        # as it is written.
        if came_from(model, Format.SDF):
            return model
        found = shared_inertias(model)
        if not found:
            return model
        return model.copy(links=tuple(self._share(link, found, sink) for link in model.links))

    def _share(self, link: Link, found: dict[str, Solid], sink: DiagnosticSink) -> Link:
        written = link.inertial
        if written is None or link.name not in found:
            return link
        made, old = write_solid(written, found[link.name]), written.pose or Pose.unchecked()
        moved = found[link.name].center != (old.xyz or ORIGIN)
        made = made if moved else made.copy(pose=written.pose)
        what = "center of mass and inertia" if moved else "inertia"
        message = f"link {link.name!r} has another {what} in SDF, and with the links that are fixed to it the same"
        sink.report(rules.SHARED_INERTIA, message, written.location, found=link.name)
        where = written.location
        sink.account(Fate.APPROXIMATED, rules.SHARED_INERTIA, message, where.at("inertia"), len(ELEMENTS))
        if moved and old.xyz:
            sink.account(Fate.APPROXIMATED, rules.SHARED_INERTIA, message, where.at("origin/@xyz"))
        return link.copy(inertial=with_share(made, written) if self.carriers else made)
