"""Automatic inertias of SDF (`<inertial auto="true">`): written out in URDF, and left to the reader of SDF again."""

import math
from collections.abc import Iterable
from functools import partial
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Format, Inertial, Link, Model, Opaque
from twinform.ir.frames import FrameError, FrameGraph
from twinform.ir.solids import Solid, placed, written_solid
from twinform.ir.transform import Transform
from twinform.passes.carriers.absorb import CarrierError, absorb
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.carriers import is_carrier, unpack
from twinform.passes.framework.pass_base import AssetPass, ModelPass
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.link_shapes import COMPUTED_MASS, NoSolidError, automatic, map_automatic, written_out
from twinform.passes.shared.mesh_solids import Meshes
from twinform.schemas import parse_version


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


_SINCE = (1, 11)
_FIELDS = ("mass", "pose", "inertia")
_CLOSE = 1e-9
"""The tolerance for numbers computed from the same shape, relative to the largest of their kind."""


class LeaveInertias(ModelPass, AssetPass):
    """Write `<inertial auto="true">` where SDF had it before.

    Changes: 1. an inertial that carries `auto`, and has the numbers that its collisions give, is automatic again, with
    what was written beside; 2. where the numbers or the collisions were edited, the numbers stay and are no longer
    automatic.
    Never touches: anything for an SDF before 1.11, which cannot express it: the numbers stay, and their carriers too.
    Diagnostics: `stale-carrier`.
    """

    name: ClassVar[str] = "leave-inertias"
    version: str

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with its automatic inertias."""
        if parse_version(self.version) < _SINCE or not any(map(_was_automatic, model.links)):
            return model
        graph = FrameGraph(model)
        meshes = Meshes(self._assets)
        links = tuple(
            _leave_to_reader(link, graph, meshes, sink) if _was_automatic(link) else link for link in model.links
        )
        return model.copy(links=links)


def _was_automatic(link: Link) -> bool:
    return link.inertial is not None and any(_is_auto(part) for part in link.inertial.opaque)


def _is_auto(part: Opaque) -> bool:
    pieces = unpack(part) if is_carrier(part, "sdf") else ()
    return any(piece.attribute and piece.attribute[0] == "auto" and not piece.at for piece in pieces)


def _leave_to_reader(link: Link, graph: FrameGraph, meshes: Meshes, sink: DiagnosticSink) -> Link:
    inertial = link.inertial or Inertial.unchecked()
    computed = _FIELDS if find_annotation(inertial, COMPUTED_MASS) else _FIELDS[1:]
    left = without_annotation(inertial.copy(**dict.fromkeys(computed)), COMPUTED_MASS)
    try:
        left = _unpack_carriers(left)
        found = automatic(link, left, link.collisions, graph, meshes)
    except (CarrierError, NoSolidError, FrameError) as error:
        return _keep_numbers(link, inertial, str(error), sink)
    # Numbers and shapes can both be edited in URDF. The inertia is automatic again only where the
    # shapes still give the numbers; otherwise the numbers count.
    if not _is_the_same(found, inertial):
        return _keep_numbers(link, inertial, "its numbers or its collisions were edited", sink)
    return link.copy(inertial=left)


def _unpack_carriers(inertial: Inertial) -> Inertial:
    """The inertial with its carriers of SDF unpacked."""
    pieces = tuple(piece for part in inertial.opaque if is_carrier(part, "sdf") for piece in unpack(part))
    kept = tuple(part for part in inertial.opaque if not is_carrier(part, "sdf"))
    return absorb(inertial.copy(opaque=kept), pieces)


def _is_the_same(found: Solid, inertial: Inertial) -> bool:
    """Whether an inertial has the same mass, center and inertia, whichever way its axes are turned."""
    if inertial.mass is None or inertial.inertia is None:
        return False
    written = placed(written_solid(inertial, Format.URDF), Transform.from_pose(inertial.pose))
    return (
        math.isclose(found.mass, written.mass, rel_tol=_CLOSE)
        and _are_close(found.center, written.center, max(1.0, *map(abs, found.center)))
        and _are_close(found.inertia, written.inertia, max(map(abs, found.inertia)))
    )


def _are_close(some: Iterable[float], others: Iterable[float], scale: float) -> bool:
    return all(abs(one - other) <= _CLOSE * scale for one, other in zip(some, others, strict=True))


def _keep_numbers(link: Link, inertial: Inertial, why: str, sink: DiagnosticSink) -> Link:
    message = f"the inertia of link {link.name!r} is no longer computed from its collisions: {why}"
    sink.report(rules.STALE_CARRIER, message, inertial.location, found=link.name)
    kept = tuple(part for part in inertial.opaque if not _is_auto(part))
    bare = without_annotation(inertial.copy(opaque=kept), COMPUTED_MASS)
    return link.copy(inertial=bare)
