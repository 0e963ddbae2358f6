"""Legalisation to MJCF: the passes, in order."""

from twinform.ir import Format
from twinform.passes.framework.pass_base import Pass
from twinform.passes.legalise.to_mjcf.write_mjcf import WriteMjcf
from twinform.passes.sdf_versions import change_version
from twinform.request_options import USUAL, Requested
from twinform.schemas import versions_of

__all__ = ["to_mjcf"]


def to_mjcf(source: Format, version: str | None, requested: Requested = USUAL) -> tuple[Pass, ...]:
    """The passes that make MJCF of a URDF or SDF document: by way of the newest SDF, and no other way."""
    newest = versions_of("sdf")[-1]
    if source is Format.URDF:
        from twinform.passes.legalise.to_sdf.sequence import to_sdf  # noqa: PLC0415 - many passes

        in_sdf = to_sdf(newest, requested)
    else:
        in_sdf = () if version == newest else change_version(version, newest, requested)
    return (*in_sdf, WriteMjcf.unchecked(carriers=requested.carriers))
