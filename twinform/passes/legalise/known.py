"""Legalisation passes by name. They are not available in a user's pipeline and not registered."""

from collections.abc import Iterator
from functools import cache

from twinform.ir import Format
from twinform.passes.framework.pass_base import Pass
from twinform.passes.legalise import Target, legalisation
from twinform.schemas import versions_of


@cache
def legalisation_kinds() -> dict[str, type[Pass]]:
    """Every pass that any target asks for, sorted by name."""
    return dict(sorted((each.name, type(each)) for way in _ways() for each in way))


def _ways() -> Iterator[tuple[Pass, ...]]:
    versions = versions_of("sdf")
    for version in versions:
        yield legalisation(Format.URDF, None, Target(Format.SDF, version))
        for other in versions:
            yield legalisation(Format.SDF, version, Target(Format.SDF, other))
    yield legalisation(Format.SDF, versions[-1], Target(Format.URDF))
