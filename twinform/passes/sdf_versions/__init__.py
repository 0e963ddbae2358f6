"""Conversion between versions of SDF: the passes, in order."""

from functools import lru_cache

from twinform.passes.framework.pass_base import Pass
from twinform.passes.sdf_versions import kinds
from twinform.passes.sdf_versions.put_back import PutBack
from twinform.passes.sdf_versions.set_version import SetVersion
from twinform.passes.sdf_versions.steps import backward, forward, meaning_back, unversioned
from twinform.passes.sdf_versions.version_pass import has_early_frames, sdf_version_read
from twinform.request_options import USUAL, Requested
from twinform.schemas import Version, parse_version, print_version, versions_of

__all__ = [
    "change_version",
    "has_early_frames",
    "lower_meaning",
    "lower_version",
    "raise_for_merging",
    "raise_unversioned",
    "raise_version",
    "raise_words",
    "sdf_version_read",
]

_ANY_POSE: Version = (1, 9)
"""Since this version a pose that comes out of a carrier may be in any notation."""
_NAMED_STATES: Version = (1, 12)
"""Since this version states have names of their own."""


def change_version(declared: str | None, asked: str, requested: Requested = USUAL) -> tuple[Pass, ...]:
    """The passes from the version that a file declares to the one asked for."""
    carriers = requested.carriers
    old = sdf_version_read(declared)
    if parse_version(old) < parse_version(asked):
        steps = raise_version(old, asked, carriers=carriers)
    else:
        # Carried parts of older versions come back first, so that they are lowered with the model.
        back = PutBack.unchecked(version=asked, source=old, carriers=carriers)
        steps = (back, *lower_version(old, asked, requested))
    return (*steps, SetVersion.unchecked(version=asked))


def raise_version(declared: str | None, asked: str, *, carriers: bool = True) -> tuple[Pass, ...]:
    """The passes that upgrade an older file and put back what it carries."""
    old, new = parse_version(sdf_version_read(declared)), parse_version(asked)
    back = PutBack.unchecked(version=asked, source=print_version(old), carriers=carriers)
    after: list[Pass] = []  # what came back may be in newer or older syntax
    if new < _ANY_POSE:
        after.append(kinds.WritePlainPoses.unchecked(version=asked, carriers=carriers))
    if new >= _NAMED_STATES:
        after.append(kinds.RenameStates.unchecked(version=asked, carriers=carriers))
    # Raising a version leaves parts out too: SDF dropped some elements along the way.
    shapes = (kinds.FoldCapsules.unchecked(), kinds.FoldShapeMeshes.unchecked(version=asked))
    return (*shapes, *forward(old, new), back, *after, kinds.LeaveOut.unchecked(version=asked, carriers=carriers))


@lru_cache(maxsize=64)
def raise_words(declared: str | None, *, carriers: bool = True, mixed: bool = False) -> tuple[Pass, ...]:
    """The passes that upgrade to the newest syntax, but keep names and parts that only older versions have.

    `mixed` means that the file has syntax of newer versions too.
    """
    old, newest = sdf_version_read(declared), versions_of("sdf")[-1]
    back = PutBack.unchecked(version=newest, source=old, carriers=carriers)
    return (*forward(parse_version(old), parse_version(newest), names=False, mixed=mixed), back)


def raise_for_merging(declared: str, asked: str, *, carriers: bool = True) -> tuple[Pass, ...]:
    """The passes that upgrade one of several files that become one, which still keeps parts of older versions."""
    back = PutBack.unchecked(version=asked, source=declared, carriers=carriers)
    return (*forward(parse_version(declared), parse_version(asked)), back, SetVersion.unchecked(version=asked))


def raise_unversioned(*, carriers: bool = True) -> tuple[Pass, ...]:
    """The passes that upgrade old syntax in a text without a version, such as that in `<gazebo>` elements."""
    return tuple(unversioned(versions_of("sdf")[-1], carriers=carriers))


def lower_version(declared: str | None, asked: str, requested: Requested = USUAL) -> tuple[Pass, ...]:
    """The passes that downgrade a newer file."""
    return tuple(backward(parse_version(sdf_version_read(declared)), parse_version(asked), requested))


def lower_meaning(asked: str) -> tuple[Pass, ...]:
    """The passes for syntax that means something else in an older version; other newer syntax stays."""
    return tuple(meaning_back(parse_version(versions_of("sdf")[-1]), parse_version(asked)))
