"""Computing automatic inertias, which SDF has since 1.11."""

from functools import partial
from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Document, Inertial, Link, Model, rewrite
from twinform.ir.frames import FrameGraph
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper
from twinform.passes.framework.pass_base import AssetPass
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.passes.shared.link_shapes import NoSolidError, automatic, map_automatic, written_out
from twinform.passes.shared.mesh_solids import Meshes

_SINCE = (1, 11)


class WriteInertias(VersionPass, AssetPass):
    """Write the inertias that newer versions leave to their reader (`<inertial auto="true">`).

    Changes: mass, pose and inertia of such a link are those of its collisions, filled with their densities; a mass that
    is written stays.
    Never touches: links without collisions or with shapes without an inside; of these a later pass reports that the
    version cannot express it.
    """

    name: ClassVar[str] = "write-inertias"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with every inertia written out."""
        write = partial(_write_inertia, keeper, Meshes(self._assets))
        return rewrite(document, Model, lambda model: map_automatic(model, write))


def _write_inertia(keeper: VersionKeeper, meshes: Meshes, link: Link, inertial: Inertial, graph: FrameGraph) -> Link:
    try:
        found = automatic(link, inertial, link.collisions, graph, meshes)
    except NoSolidError:
        return link
    written, pieces, made = written_out(inertial, found)
    message = f"the inertia of link {link.name!r} is left to be computed from its collisions"
    condition = VersionCondition(since=_SINCE, without=made)
    kept = keeper.keep(written, pieces, condition, rules.OTHER_WORDS, message, inertial.location, len(pieces))
    return link.copy(inertial=kept)
