"""Legalisation to MJCF: the passes, in order."""

from collections.abc import Iterator

from twinform.ir import Format
from twinform.passes.framework.pass_base import Pass
from twinform.passes.legalise.to_mjcf.hold_root import HoldRoot
from twinform.passes.legalise.to_mjcf.write_mjcf import WriteMjcf
from twinform.passes.sdf_versions import change_version
from twinform.passes.sdf_versions.write_inertias import WriteInertias
from twinform.request_options import USUAL, Requested
from twinform.schemas import versions_of

__all__ = ["to_mjcf"]

_WITHOUT_AUTOMATIC = "1.10"
"""The last version of SDF in which no inertia is left to be computed from the collisions."""


def to_mjcf(source: Format, version: str | None, requested: Requested = USUAL) -> tuple[Pass, ...]:
    """The passes that make MJCF of a URDF or SDF document: by way of the newest SDF, and no other way."""
    newest = versions_of("sdf")[-1]
    declared = None if source is Format.URDF else version
    if source is Format.URDF:
        in_sdf = tuple(_robot_on_the_world(newest, requested))
    else:
        in_sdf = () if version == newest else change_version(version, newest, requested)
    write = WriteMjcf.unchecked(
        carriers=requested.carriers,
        source_version=declared,
        shape_error=requested.shape_error,
        side_files=requested.side_files,
    )
    # MuJoCo computes inertias of shapes in its own way, and of all links or none.
    written_out = WriteInertias.unchecked(version=_WITHOUT_AUTOMATIC, carriers=requested.carriers)
    return (*in_sdf, written_out, write)


def _robot_on_the_world(version: str, requested: Requested) -> Iterator[Pass]:
    """Yield the passes from URDF to SDF, with one more that fixes the robot to the world of SDF."""
    from twinform.passes.legalise.to_sdf.mesh_uris import MeshUris  # noqa: PLC0415 - see above
    from twinform.passes.legalise.to_sdf.sequence import to_sdf  # noqa: PLC0415 - many passes
    from twinform.passes.legalise.to_sdf.world_link import WorldLink  # noqa: PLC0415 - see above

    for each in to_sdf(version, requested):
        if isinstance(each, MeshUris):  # files are looked up, as the URDF names them
            continue
        yield each
        # From here on a joint may have the world as its parent. Names are made unique after it.
        if isinstance(each, WorldLink):
            yield HoldRoot.unchecked()
