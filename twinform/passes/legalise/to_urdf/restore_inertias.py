"""Reverse conversion of inertias that a URDF has for links, and SDF for what is fixed together."""

import math
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Format, Inertial, Model
from twinform.ir.frames import FrameGraph
from twinform.ir.solids import Solid
from twinform.passes.carriers.annotations import without_annotation
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.shared_inertias import SHARED, shared_inertias, without_share
from twinform.passes.shared.link_shapes import body_of

_CLOSE = 1e-9
"""How far numbers may be apart that were computed from the same ones: in m, and relative to the largest."""


class RestoreInertias(ModelPass):
    """Give links the inertias that they had before they were shared with links that are fixed to them.

    Changes: all annotated inertias, if the old ones would be shared again just so.
    Never touches: any of them once masses, places or joints were edited so that another share would come out.
    Diagnostics: `stale-carrier` for these.
    """

    name: ClassVar[str] = "restore-inertias"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with its old inertias."""
        old = {
            link.name: inertial
            for link in model.links
            if link.inertial is not None and (inertial := without_share(link.inertial)) is not None
        }
        if not old:
            return model
        restored = _with_inertials(model, old)
        shared, graph = shared_inertias(restored), FrameGraph(model)
        now = {link.name: body_of(link, graph, Format.URDF) for link in model.links if link.name in old}
        # Proved by repetition: the old inertias come back if sharing them would give the numbers of
        # the file again.
        if shared.keys() == old.keys() and all(_are_close(shared[name], now[name]) for name in old):
            return restored
        for link in model.links:
            if link.name in old and link.inertial:
                message = f"the inertia of link {link.name!r} stays: the body that it is a part of was edited"
                sink.report(STALE_CARRIER, message, link.inertial.location, found=link.name)
        bare = {
            link.name: without_annotation(link.inertial, SHARED)
            for link in model.links
            if link.inertial and link.name in old
        }
        return _with_inertials(model, bare)


def _with_inertials(model: Model, inertials: dict[str, Inertial]) -> Model:
    links = (link.copy(inertial=inertials[link.name]) if link.name in inertials else link for link in model.links)
    return model.copy(links=tuple(links))


def _are_close(one: Solid, other: Solid) -> bool:
    return all(
        math.isclose(a, b, rel_tol=0, abs_tol=_CLOSE * size)
        for there, here, size in (
            (one.center, other.center, max(1.0, *map(abs, one.center))),
            (one.inertia, other.inertia, max(map(abs, one.inertia))),
        )
        for a, b in zip(there, here, strict=True)
    )
