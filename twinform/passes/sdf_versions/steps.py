"""Selection of the passes between two versions of SDF."""

from collections.abc import Callable, Iterator

from twinform.passes.framework.pass_base import Pass
from twinform.passes.sdf_versions import kinds
from twinform.request_options import Requested
from twinform.schemas import Version, print_version

Changes = Callable[[int], bool]
"""Whether a change that came with a minor version lies between two versions."""


def _changes_between(old: Version, new: Version) -> Changes:
    return lambda minor: old < (1, minor) <= new


def forward(old: Version, new: Version, *, names: bool = True, mixed: bool = False) -> Iterator[Pass]:
    """The passes from an older version to a newer one, for the changes that lie between the two.

    With `names`, names become unique and lose their scopes, as newer versions want; `mixed` means that the file has
    newer syntax already.
    """
    changes = _changes_between(old, new)
    yield from _to_named_frames(changes, print_version(new), old, names=names, mixed=mixed)
    yield from _from_named_frames(changes, print_version(new), names=names)


def _to_named_frames(changes: Changes, version: str, old: Version, *, names: bool, mixed: bool) -> Iterator[Pass]:
    if changes(4):
        yield kinds.MoveTimeSteps.unchecked(version=version)
    if changes(5):
        yield kinds.FitJointTypes.unchecked(version=version)
    if changes(6):
        yield kinds.MoveWorldFields.unchecked(version=version)
        yield kinds.SpreadImuNoise.unchecked(version=version)
        yield kinds.NameTheNameless.unchecked(version=version)
    if changes(7):
        yield kinds.NamePoseFrames.unchecked(version=version)
    # Each pass has its place: frames are named before names are cleared, and models nest only when
    # all of their frames have names that are unique.
    if changes(5) or changes(7):
        yield kinds.NameAxisFrames.unchecked(version=version, source_before_1_5=old < (1, 5), both=mixed)
    if changes(7) and names:
        yield kinds.ClearNames.unchecked(version=version)


def _from_named_frames(changes: Changes, version: str, *, names: bool) -> Iterator[Pass]:
    if changes(8):
        yield kinds.PlaceInertials.unchecked(version=version)
    if changes(8) and names:
        yield kinds.NestModels.unchecked(version=version)
    if changes(10):
        yield kinds.WriteThreadPitches.unchecked(version=version)
    if changes(12):
        yield kinds.RenameStates.unchecked(version=version)


def unversioned(version: str, *, carriers: bool = True) -> Iterator[Pass]:
    """The passes for old syntax in a text without a version, as far as it means nothing else in newer versions."""
    # What depends on the version,
    # such as the frame of an axis without a word, is taken as the newest version has it: <gazebo>
    # declares none.
    yield kinds.SpreadImuNoise.unchecked(version=version, annotate=carriers)
    yield kinds.NamePoseFrames.unchecked(version=version)
    yield kinds.NameAxisFrames.unchecked(version=version)


def backward(new: Version, old: Version, requested: Requested | None = None) -> Iterator[Pass]:
    """The passes from a newer version to an older one, for the changes that lie between the two.

    Without what is requested, shapes that the older one lacks are carried, and no files are made for them.
    """
    carriers = requested is None or requested.carriers
    changes = _changes_between(old, new)
    yield from _models_back(changes, print_version(old), print_version(new), carriers=carriers)
    yield from _values_back(changes, print_version(old), carriers=carriers)
    if requested is not None:  # after the inertias, which may have to be computed from the shapes
        yield kinds.FoldCapsules.unchecked()
        yield kinds.ReplaceShapes.unchecked(
            version=print_version(old),
            carriers=carriers,
            shape_error=requested.shape_error,
            mesh_prefix=requested.mesh_prefix,
            side_files=requested.side_files,
        )
    yield kinds.LeaveOut.unchecked(version=print_version(old), carriers=carriers)


def meaning_back(new: Version, old: Version) -> Iterator[Pass]:
    """The passes from a newer version to an older one for syntax that both have with another meaning."""
    changes = _changes_between(old, new)
    version = print_version(old)
    if changes(5):
        yield kinds.TurnAxes.unchecked(version=version)
    if changes(6):
        yield kinds.GatherImuNoise.unchecked(version=version)
    if changes(10):
        yield kinds.BoundLimits.unchecked(version=version)
    if changes(4):
        yield kinds.MoveTimeSteps.unchecked(version=version, back=True)


def _models_back(changes: Changes, version: str, source: str, *, carriers: bool) -> Iterator[Pass]:
    """The passes that place models, joints and poses, from the outside in."""
    if changes(12):
        yield kinds.RenameStates.unchecked(version=version, carriers=carriers, back=True)
    if changes(11):
        yield kinds.WriteInertias.unchecked(version=version, carriers=carriers)
    if changes(5):
        # From the outside in: models first, then joints and axes, and poses last, since each step
        # asks for frames that the next one takes away.
        yield kinds.FlattenNested.unchecked(version=version, carriers=carriers, source=source)
    if changes(8):
        yield kinds.ConnectLinks.unchecked(version=version, carriers=carriers)
    if changes(7) or changes(5):
        yield kinds.TurnAxes.unchecked(version=version, carriers=carriers)
    if changes(8) or changes(7):
        yield kinds.PlaceAbsolutely.unchecked(version=version, carriers=carriers)


def _values_back(changes: Changes, version: str, *, carriers: bool) -> Iterator[Pass]:
    """The passes that rewrite values where they stand."""
    if changes(9):
        yield kinds.WritePlainPoses.unchecked(version=version, carriers=carriers)
    if any(map(changes, (4, 5, 6))):
        yield kinds.FitJointTypes.unchecked(version=version, carriers=carriers)
    if changes(10):
        yield kinds.BoundLimits.unchecked(version=version, carriers=carriers)
        yield kinds.WriteThreadPitches.unchecked(version=version, carriers=carriers, back=True)
        yield kinds.NameTheNameless.unchecked(version=version, carriers=carriers)
    if changes(6):
        yield kinds.GatherImuNoise.unchecked(version=version, carriers=carriers)
        yield kinds.MoveWorldFields.unchecked(version=version, carriers=carriers, back=True)
    if changes(4):
        yield kinds.MoveTimeSteps.unchecked(version=version, carriers=carriers, back=True)
