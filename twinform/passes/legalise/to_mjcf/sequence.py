"""Legalisation to MJCF: the passes, in order."""

from collections.abc import Iterator
from dataclasses import replace

from twinform.ir import Format
from twinform.passes.framework.pass_base import Pass
from twinform.passes.legalise.to_mjcf.factor_defaults import FactorDefaults
from twinform.passes.legalise.to_mjcf.hold_root import HoldRoot
from twinform.passes.legalise.to_mjcf.write_mjcf import WriteMjcf
from twinform.passes.sdf_versions import change_version, raise_words
from twinform.passes.sdf_versions.clear_names import ClearNames
from twinform.passes.sdf_versions.nest_models import NestModels
from twinform.passes.sdf_versions.set_version import SetVersion
from twinform.passes.sdf_versions.write_inertias import WriteInertias
from twinform.request_options import USUAL, Requested
from twinform.schemas import versions_of

__all__ = ["to_mjcf"]

_WITHOUT_AUTOMATIC = "1.10"
"""The last version of SDF in which no inertia is left to be computed from the collisions."""


def to_mjcf(
    source: Format, version: str | None, requested: Requested = USUAL, *, mixed_source: bool = False
) -> tuple[Pass, ...]:
    """The passes that make MJCF of a URDF or SDF document: by way of the newest SDF, and no other way.

    `mixed_source` means that the source has syntax of newer versions.
    """
    newest = versions_of("sdf")[-1]
    # Marks tell the writer which parts the way through SDF has made. Without carriers it writes none.
    marking = replace(requested, carriers=True)
    if source is Format.URDF:
        declared, in_sdf = None, tuple(_robot_on_the_world(newest, marking, mixed=mixed_source))
    elif mixed_source:
        declared = version
        in_sdf = (*raise_words(version, mixed=True), SetVersion.unchecked(version=newest))
    else:
        declared, in_sdf = version, () if version == newest else tuple(_with_old_names(version, newest, marking))
    write = WriteMjcf.unchecked(
        carriers=requested.carriers,
        source_version=declared,
        mixed=mixed_source and source is Format.SDF,
        shape_error=requested.shape_error,
        side_files=requested.side_files,
        mesh_folder=requested.mesh_folder,
    )
    # MuJoCo computes inertias of shapes in its own way, and of all links or none.
    factor = (FactorDefaults.unchecked(),) if requested.default_classes else ()
    return (*in_sdf, WriteInertias.unchecked(version=_WITHOUT_AUTOMATIC), write, *factor)


def _with_old_names(version: str | None, newest: str, requested: Requested) -> Iterator[Pass]:
    """Yield the passes to the newest version of SDF, which mark what had a name that is free in MJCF.

    A name with `::` in it, which is no scope before 1.8, is a name like others in MJCF.
    """
    for each in change_version(version, newest, requested):
        if isinstance(each, NestModels):
            continue
        yield each.model_copy(update={"marks": True}) if isinstance(each, ClearNames) else each


def _robot_on_the_world(version: str, requested: Requested, *, mixed: bool) -> Iterator[Pass]:
    """Yield the passes from URDF to SDF, with one more that fixes the robot to the world of SDF."""
    from twinform.passes.legalise.changed_names import UniqueNames  # noqa: PLC0415 - see above
    from twinform.passes.legalise.round_tiny_numbers import RoundTinyNumbers  # noqa: PLC0415 - see above
    from twinform.passes.legalise.to_sdf.mesh_uris import MeshUris  # noqa: PLC0415 - few conversions go this way
    from twinform.passes.legalise.to_sdf.retarget import RetargetSdf  # noqa: PLC0415 - see above
    from twinform.passes.legalise.to_sdf.sequence import to_sdf  # noqa: PLC0415 - many passes
    from twinform.passes.legalise.world_link import WorldLink  # noqa: PLC0415 - see above

    for each in to_sdf(version, requested, mixed_source=mixed, scopes=False):
        match each:
            case MeshUris():
                yield MeshUris.unchecked(carriers=each.carriers, rewrites=False)
            case UniqueNames():
                yield UniqueNames.unchecked(silent=True)  # names of MJCF are unique per kind, as in URDF
            case WorldLink():
                yield each
                yield HoldRoot.unchecked()  # from here on a joint may have the world as its parent
            case RetargetSdf():
                yield each.model_copy(update={"keeps_provenance": True})
            case RoundTinyNumbers():
                continue  # MuJoCo reads what libsdformat refuses
            case _:
                yield each
