"""Legalisation: passes that rewrite what the target format cannot express into what it can."""

from collections.abc import Iterator
from functools import cache, lru_cache

from twinform.dataclass import dataclass
from twinform.ir import Format
from twinform.ir.versions import parse_version, version_read, versions_of
from twinform.passes.framework.pass_base import Pass
from twinform.request_options import USUAL, Requested, UrdfVersion

__all__ = ["Target", "legalisation"]


@dataclass(frozen=True, slots=True)
class Target:
    """The target of a conversion.

    The versions are those that are written, and `requested` is what was asked for. `mixed` allows syntax of newer
    versions in the result, as the original source had; `mixed_source` means that the source has such syntax.
    """

    format: Format
    sdf_version: str = "1.11"
    urdf_version: UrdfVersion = "1.0"
    requested: Requested = USUAL
    mixed: bool = False
    mixed_source: bool = False


@lru_cache(maxsize=256)  # passes keep no state, so that files of one kind may share theirs
def legalisation(source: Format, version: str | None, target: Target) -> tuple[Pass, ...]:
    """Every pass that a document of `source` in `version` needs before the target's back end can write it."""
    # imported here: a conversion goes one way only, and each way has many passes
    if target.format is Format.MJCF:
        if source is Format.MJCF:
            return ()
        from twinform.passes.legalise.to_mjcf.sequence import to_mjcf  # noqa: PLC0415 - see above

        return to_mjcf(source, version, target.requested, mixed_source=target.mixed_source)
    if source is target.format:
        if source is Format.URDF:
            return _between_urdf(version, target.urdf_version, carriers=target.requested.carriers)
        if version == target.sdf_version:
            return ()
        from twinform.passes.sdf_versions import change_version  # noqa: PLC0415 - see above

        return change_version(version, target.sdf_version, target.requested)
    if target.format is Format.SDF:
        from twinform.passes.legalise.to_sdf.sequence import to_sdf  # noqa: PLC0415 - see above

        return to_sdf(target.sdf_version, target.requested, mixed=target.mixed, mixed_source=target.mixed_source)
    from twinform.passes.legalise.to_urdf.sequence import to_urdf  # noqa: PLC0415 - see above

    return to_urdf(target.urdf_version, target.requested, mixed=target.mixed, mixed_source=target.mixed_source)


def _between_urdf(declared: str | None, version: UrdfVersion, *, carriers: bool) -> tuple[Pass, ...]:
    if version_read("urdf", declared) == parse_version(version):
        return ()
    from twinform.passes.legalise.fit_urdf_version import FitUrdfVersion  # noqa: PLC0415 - few ask for it

    return (FitUrdfVersion.unchecked(version=version, carriers=carriers),)


@cache
def legalisation_kinds() -> dict[str, type[Pass]]:
    """All legalisation passes by name, for reproducers; they are not registered for pipelines of users."""
    return dict(sorted((each.name, type(each)) for way in _ways() for each in way))


def _ways() -> Iterator[tuple[Pass, ...]]:
    versions = versions_of("sdf")
    for version in versions:
        yield legalisation(Format.URDF, None, Target(Format.SDF, version))
        for other in versions:
            yield legalisation(Format.SDF, version, Target(Format.SDF, other))
    yield legalisation(Format.URDF, None, Target(Format.URDF, urdf_version="1.2"))
    yield legalisation(Format.SDF, versions[-1], Target(Format.URDF))
    yield legalisation(Format.SDF, versions[-1], Target(Format.MJCF))
    yield legalisation(Format.URDF, None, Target(Format.MJCF))
